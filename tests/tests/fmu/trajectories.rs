//! Coupled runs with an FMU against the same runs with the built-in model.

use linchpin_tests::fmus::{Equation, Fmi, TestFmu, VERSIONS};

use crate::table::{difference, table};
use crate::{MASSES, run, workshop};

/// The same scene with the built-in model.
pub fn built_in() -> String {
    let (head, tail) = MASSES.split_once("fmu = \"mass.fmu\"").unwrap();
    let (_, joint) = tail.split_once("[[joint]]").unwrap();
    format!(
        "{head}model = \"oscillator\"\nparameters = {{ m = 2.0, c = 1000.0, d = 10.0, v0 = 100.0 }}\n[[joint]]{joint}"
    )
}

/// Largest differences of position, velocity and multiplier.
fn differences(fmu: &TestFmu, more: &[&'static str]) -> [f64; 3] {
    let workshop = workshop(MASSES, fmu);
    let set = |settings: &[&'static str]| -> Vec<&str> {
        settings.iter().flat_map(|own| ["--set", own]).collect()
    };
    workshop.run(&run(&set(more))).succeeds();
    let own = table(&workshop.read("out/results.csv"));
    let others: Vec<&str> = { more.iter().copied() }
        .filter(|setting| !setting.contains("solver"))
        .collect();
    workshop.write("scene.toml", built_in());
    workshop.run(&run(&set(&others))).succeeds();
    let expected = table(&workshop.read("out/results.csv"));
    ["mass2.x", "mass2.v", "link.lambda"].map(|name| difference(&own[name], &expected[name]))
}

/// The FMU integrates with an error of 2e-11 of its own.
#[test]
fn inputs_that_vary_inside_a_step_give_the_built_in_trajectory() {
    for fmi in VERSIONS {
        let fmu = TestFmu::with_varying_inputs(Equation::Oscillator, fmi);
        let found = differences(&fmu, &[]);
        println!("{fmi:?} {found:?}");
        for (found, most) in found.into_iter().zip([1e-9, 1e-9, 1e-8]) {
            assert!(found < most, "{fmi:?}: {found:e}");
        }
    }
}

/// Constant inputs in four sub-steps whose moments are kept: nothing is lost.
#[test]
fn sub_steps_give_the_built_in_trajectory() {
    for fmi in VERSIONS {
        let fmu = TestFmu::new(Equation::Oscillator, fmi);
        let found = differences(&fmu, &[]);
        println!("{fmi:?} {found:?}");
        for (found, most) in found.into_iter().zip([1e-8, 1e-8, 1e-7]) {
            assert!(found < most, "{fmi:?}: {found:e}");
        }
    }
}

/// An FMU that takes derivatives up to order 1 gets lines on two parts.
#[test]
fn derivatives_of_low_order_are_used_on_parts() {
    let fmu = TestFmu {
        orders: 1,
        ..TestFmu::new(Equation::Oscillator, Fmi::Two)
    };
    let found = differences(&fmu, &[]);
    println!("{found:?}");
    assert!(found.iter().all(|one| *one < 1e-7), "{found:?}");
    // With the mean over the whole step, as any input that is constant in a step, order is lost.
    let coarse = differences(
        &fmu,
        &["subsystem.mass2.solver={kind=\"sub-steps\",substeps=1}"],
    );
    println!("{coarse:?}");
    assert!(coarse[0] > 100.0 * found[0], "{coarse:?}");
}

/// An FMU with steps of one length is coupled like any other as long as the macro step stays.
#[test]
fn steps_of_one_length_are_enough() {
    let fmu = TestFmu {
        varies_steps: false,
        ..TestFmu::new(Equation::Oscillator, Fmi::Three)
    };
    let found = differences(&fmu, &["coupling.degree=2"]);
    assert!(found.iter().all(|one| *one < 1e-7), "{found:?}");
    let workshop = workshop(MASSES, &fmu);
    let settings = ["--set", "coupling.degree=2", "--set", "scene.t_end=0.0211"];
    workshop.run(&run(&settings)).fails(
        1,
        &[
            "oscillator-fmu",
            "canHandleVariableCommunicationStepSize",
            "0.002 s",
            "macro steps of one length",
        ],
    );
}

const LINKS: &str = r#"
[scene]
name = "links"
t_end = 0.3

[coupling]
macro_step = 5e-3

[[subsystem]]
name = "upper"
model = "pendulum"
parameters = { m = 1.0, inertia = 0.1, length = 1.0, angle0 = 0.3 }

[[subsystem]]
name = "lower"
SERVED

[[joint]]
name = "hinge"
kind = "revolute"
a = "upper.tip"
b = "lower.END"
"#;

const BODIES: &str = r#"
[scene]
name = "bodies"
t_end = 0.2

[coupling]
macro_step = 5e-3

[[subsystem]]
name = "one"
model = "spatial-body"
parameters = { m = 1.3, j1 = 0.021, j2 = 0.027, j3 = 0.034, start_x = -0.2, x0 = 0.2, vz0 = 0.4, omega1_0 = 1.0, omega2_0 = -2.0 }

[[subsystem]]
name = "other"
SERVED

[[joint]]
name = "ball"
kind = "atpoint"
a = "one.start"
b = "other.END"
"#;

/// Runs a scene with the FMU and with the built-in model, and compares the multipliers.
fn compare(scene: &str, fmu: &TestFmu, served: [&str; 2], ends: [&str; 2], most: f64) {
    let with = |number: usize| {
        scene
            .replace("SERVED", served[number])
            .replace("END", ends[number])
    };
    let workshop = workshop(&with(0), fmu);
    workshop.run(&run(&[])).succeeds();
    let own = table(&workshop.read("out/results.csv"));
    workshop.write("scene.toml", with(1));
    workshop.run(&run(&[])).succeeds();
    let expected = table(&workshop.read("out/results.csv"));
    let multipliers = expected.keys().filter(|name| name.contains(".lambda"));
    for name in multipliers {
        let found = difference(&own[name], &expected[name]);
        println!("{name} {found:e}");
        assert!(found < most, "{name}: {found:e}");
    }
}

#[test]
fn a_planar_marker_takes_a_hinge() {
    let served = [
        "fmu = \"mass.fmu\"\n[subsystem.parameters]\nm = 2.0\ninertia = 0.3\nhalf = -0.55\nx = FX\ny = FY\nangle = 0.7\n\
         [subsystem.parameters.marker.tip]\nkind = \"planar\"\nnames = \"tip_*\"",
        "model = \"planar-body\"\nparameters = { m = 2.0, inertia = 0.3, length = 1.1, angle0 = 0.7, x0 = TX, y0 = TY }",
    ];
    // The centre of the lower link, with its start at the end of the upper one.
    let fx = 0.3_f64.cos() + 0.55 * 0.7_f64.cos();
    let fy = 0.3_f64.sin() + 0.55 * 0.7_f64.sin();
    let served = served.map(|text| {
        text.replace("FX", &fx.to_string())
            .replace("FY", &fy.to_string())
            .replace("TX", &0.3_f64.cos().to_string())
            .replace("TY", &0.3_f64.sin().to_string())
    });
    for fmi in VERSIONS {
        let fmu = TestFmu::with_varying_inputs(Equation::Link, fmi);
        let served = [served[0].as_str(), served[1].as_str()];
        compare(LINKS, &fmu, served, ["tip", "start"], 1e-6);
    }
}

#[test]
fn a_spatial_marker_takes_a_ball_joint() {
    let served = [
        "fmu = \"mass.fmu\"\n[subsystem.parameters]\nm = 0.9\nj1 = 0.02\nj2 = 0.03\nj3 = 0.04\n\"body.omega3\" = 3.0\n\
         [subsystem.parameters.marker.centre]\nkind = \"spatial\"\nnames = \"body.*\"",
        "model = \"spatial-body\"\nparameters = { m = 0.9, j1 = 0.02, j2 = 0.03, j3 = 0.04, omega3_0 = 3.0 }",
    ];
    for fmi in VERSIONS {
        let fmu = TestFmu::with_varying_inputs(Equation::Body, fmi);
        compare(BODIES, &fmu, served, ["centre", "start"], 1e-6);
    }
}
