//! What an FMU cannot do is told before the run, and what it can do serves.

use linchpin_tests::fmus::{Equation, Fmi, TestFmu, VERSIONS};

use crate::table::{difference, table};
use crate::{MASSES, run, workshop};

#[test]
fn without_states_methods_that_look_ahead_are_refused_at_check() {
    for (fmi, flag) in [
        (Fmi::Two, "canGetAndSetFMUstate"),
        (Fmi::Three, "canGetAndSetFMUState"),
    ] {
        let fmu = TestFmu {
            keeps_states: false,
            serializes: false,
            ..TestFmu::new(Equation::Oscillator, fmi)
        };
        let workshop = workshop(MASSES, &fmu);
        let words = [
            "coupling.method",
            "\"hermite\" takes steps that do not stay",
            "\"mass2\" cannot go back",
            "\"oscillator-fmu\"",
            flag,
            "\"explicit\"",
        ];
        workshop.run(&["check", "scene.toml"]).fails(2, &words);
        workshop.run(&run(&[])).fails(2, &words);
        let weighted = ["check", "scene.toml", "--set", "coupling.method=weighted"];
        workshop.run(&weighted).fails(2, &["\"weighted\"", flag]);
    }
}

#[test]
fn without_states_methods_without_a_corrector_run() {
    for fmi in VERSIONS {
        let fmu = TestFmu {
            keeps_states: false,
            serializes: false,
            ..TestFmu::with_varying_inputs(Equation::Oscillator, fmi)
        };
        let workshop = workshop(MASSES, &fmu);
        let settings = [
            "--set",
            "coupling.method=explicit",
            "--set",
            "coupling.mu=10H",
            "--set",
            "coupling.macro_step=1e-4",
        ];
        workshop
            .run(&[&["check", "scene.toml"], &settings[..]].concat())
            .succeeds();
        workshop.run(&run(&settings)).succeeds();
        let own = table(&workshop.read("out/results.csv"));
        let able = TestFmu::with_varying_inputs(Equation::Oscillator, fmi);
        able.write(&workshop.path().join("mass.fmu"));
        workshop.run(&run(&settings)).succeeds();
        let expected = table(&workshop.read("out/results.csv"));
        assert_eq!(difference(&own["mass2.x"], &expected["mass2.x"]), 0.0);
        let samples = [&settings[..], &["--set", "output.interval=1e-3"]].concat();
        fmu.write(&workshop.path().join("mass.fmu"));
        workshop
            .run(&run(&samples))
            .fails(2, &["output.interval", "cannot go back", "output.every"]);
    }
}

#[test]
fn the_description_tells_the_grades() {
    let fmu = TestFmu {
        keeps_states: false,
        serializes: false,
        varies_steps: false,
        ..TestFmu::new(Equation::Oscillator, Fmi::Two)
    };
    let workshop = workshop(MASSES, &fmu);
    let peer = crate::serving::Served::start(&workshop, "mass.fmu");
    workshop.run(&["describe", peer.address()]).prints(&[
        "oscillator-fmu",
        "made by a test",
        "FMI 2.0",
        "methods without a corrector only (canGetAndSetFMUstate)",
        "no checkpoints (canSerializeFMUstate)",
        "inputs by sub-steps (canInterpolateInputs)",
        "steps of one length only (canHandleVariableCommunicationStepSize)",
        "marker.NAME.kind",
        "sub-steps",
    ]);
}

/// The states of the FMU go into a checkpoint, and a run that was stopped goes on with the same bits.
#[test]
fn serialised_states_are_exported() {
    for fmi in VERSIONS {
        let fmu = TestFmu::with_varying_inputs(Equation::Oscillator, fmi);
        let workshop = workshop(MASSES, &fmu);
        workshop.run(&run(&[])).succeeds();
        let expected = workshop.read("out/results.csv");
        let settings = [
            "--set",
            "run.export_every=7",
            "--set",
            "run.checkpoint_steps=10",
        ];
        workshop.run(&run(&settings)).succeeds();
        assert_eq!(workshop.read("out/results.csv"), expected, "{fmi:?}");
    }
}

#[test]
fn one_instance_in_a_process_where_there_may_be_no_more() {
    let once = TestFmu {
        once: true,
        ..TestFmu::new(Equation::Oscillator, Fmi::Two)
    };
    let workshop = workshop(MASSES, &once);
    // The run gives it a process of its own.
    workshop.run(&run(&[])).succeeds();
    let both = |address: &str| {
        let mass = |name: &str| {
            format!(
                "[[subsystem]]\nname = \"{name}\"\naddress = \"{address}\"\n[subsystem.parameters.marker.mass]\nkind = \"scalar\"\nnames = \"*\"\n"
            )
        };
        let (head, _) = MASSES.split_once("[[subsystem]]").unwrap();
        let (_, joint) = MASSES.split_once("[[joint]]").unwrap();
        format!("{head}{}{}[[joint]]{joint}", mass("mass1"), mass("mass2"))
    };
    let served = crate::serving::Served::start(&workshop, "mass.fmu");
    workshop.write("scene.toml", both(served.address()));
    workshop
        .run(&run(&[]))
        .exits_with(2)
        .says(&["canBeInstantiatedOnlyOncePerProcess", "a worker of its own"]);
    drop(served);
    let many = TestFmu::new(Equation::Oscillator, Fmi::Two);
    many.write(&workshop.path().join("many.fmu"));
    let served = crate::serving::Served::start(&workshop, "many.fmu");
    workshop.write("scene.toml", both(served.address()));
    workshop.run(&run(&[])).exits_with(0);
}
