//! FMUs that fail, hang or crash in a call.

use std::time::Duration;

use linchpin_tests::fmus::{Equation, Fmi, TestFmu, VERSIONS};
use linchpin_tests::process::Workshop;

use crate::serving::Served;
use crate::{MASSES, run, workshop};

/// The scene with a fault of the FMU from t = 0.1 s on.
fn faulty(fault: u32) -> String {
    let values = format!(
        "fault = {fault}\nfault_at = 0.1\nlabel = \"the spring of mass 2 is broken\"\n[subsystem.parameters.marker.mass]"
    );
    MASSES.replace("[subsystem.parameters.marker.mass]", &values)
}

fn with_fault(fault: u32, fmi: Fmi) -> Workshop {
    workshop(
        &faulty(fault),
        &TestFmu::with_varying_inputs(Equation::Oscillator, fmi),
    )
}

#[test]
fn a_call_that_fails_is_told_with_what_the_fmu_says() {
    for fmi in VERSIONS {
        let step = if fmi == Fmi::Two {
            "fmi2DoStep"
        } else {
            "fmi3DoStep"
        };
        for (fault, status) in [(1, "Discard"), (2, "Error"), (3, "Fatal")] {
            let workshop = with_fault(fault, fmi);
            let outcome = workshop.run(&run(&[]));
            let answered = format!("{step} answered {status}");
            outcome.fails(
                1,
                &[
                    "mass2",
                    "\"oscillator-fmu\"",
                    &answered,
                    "the spring of mass 2 is broken",
                    "t = 0.1",
                ],
            );
        }
    }
}

#[test]
fn an_output_that_is_not_finite_is_told() {
    let workshop = with_fault(6, Fmi::Two);
    let outcome = workshop.run(&run(&[]));
    outcome.fails(1, &["mass2", "oscillator-fmu", "the output \"x\" is NaN"]);
}

#[test]
fn a_call_that_crashes_ends_its_process_only() {
    for fmi in VERSIONS {
        let workshop = with_fault(5, fmi);
        let outcome = workshop.run(&run(&[]));
        outcome.fails(1, &["mass2", "signal: 11"]);
    }
}

#[test]
fn a_call_that_hangs_ends_with_the_deadline() {
    let workshop = with_fault(4, Fmi::Two);
    let outcome = workshop.run(&run(&["--set", "run.deadline=0.5"]));
    outcome.fails(1, &["mass2", "0.5 s"]);
    outcome.takes_less_than(Duration::from_secs(10));
}

/// A crash takes the instances of its own process along; another worker of the same FMU goes on.
#[test]
fn other_processes_live_on() {
    let fmu = TestFmu::with_varying_inputs(Equation::Oscillator, Fmi::Three);
    let workshop = workshop(&faulty(5), &fmu);
    let mut other = Served::start(&workshop, "mass.fmu");
    let mut own = Served::start(&workshop, "mass.fmu");
    let at = |address: &str, fault: u32| {
        faulty(fault).replace("fmu = \"mass.fmu\"", &format!("address = \"{address}\""))
    };
    workshop.write("scene.toml", at(own.address(), 5));
    workshop
        .run(&run(&["--set", "run.recoveries=0"]))
        .exits_with(1);
    assert!(own.has_ended() && !other.has_ended());
    workshop.write("scene.toml", at(other.address(), 0));
    workshop.run(&run(&[])).exits_with(0);
}

/// What fails as Fatal must not be called again in its process, by any instance.
#[test]
fn a_fatal_call_closes_the_fmu_in_its_process() {
    let fmu = TestFmu::with_varying_inputs(Equation::Oscillator, Fmi::Two);
    let workshop = workshop(&faulty(3), &fmu);
    let served = Served::start(&workshop, "mass.fmu");
    let scene = |fault| {
        faulty(fault).replace(
            "fmu = \"mass.fmu\"",
            &format!("address = \"{}\"", served.address()),
        )
    };
    workshop.write("scene.toml", scene(3));
    workshop
        .run(&run(&[]))
        .exits_with(1)
        .says(&["answered Fatal"]);
    workshop.write("scene.toml", scene(0));
    workshop
        .run(&run(&[]))
        .exits_with(2)
        .says(&["fmi2Instantiate was not called", "start the worker again"]);
}

#[test]
fn a_start_that_fails_is_told() {
    for fmi in VERSIONS {
        let fmu = TestFmu::with_varying_inputs(Equation::Oscillator, fmi);
        let workshop = workshop(&MASSES.replace("m = 2.0", "m = -2.0"), &fmu);
        workshop.run(&run(&[])).fails(
            2,
            &["oscillator-fmu", "EnterInitializationMode answered Error"],
        );
        let text = fmu.description().replace("{linchpin}", "{other}");
        let entries = [
            ("modelDescription.xml", text.as_bytes()),
            (fmu.library(), &fmu.compile(&workshop.path().join("x"))[..]),
        ];
        linchpin_tests::fmus::write_archive(&workshop.path().join("mass.fmu"), &entries);
        workshop
            .run(&run(&[]))
            .fails(2, &["oscillator-fmu", "gave nothing", "it says: wrong"]);
    }
}
