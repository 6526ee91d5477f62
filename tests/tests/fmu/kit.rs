//! The conformance kit examines FMUs.

use linchpin_tests::fmus::{Equation, TestFmu, VERSIONS};

use crate::{MASSES, workshop};

const OSCILLATOR: [&str; 10] = [
    "-p",
    "m=2",
    "-p",
    "c=1000",
    "-p",
    "d=10",
    "-p",
    "marker.mass.kind=scalar",
    "-p",
    "marker.mass.names=*",
];
const LINK: [&str; 10] = [
    "-p",
    "m=2",
    "-p",
    "inertia=0.3",
    "-p",
    "angle=0.7",
    "-p",
    "marker.tip.kind=planar",
    "-p",
    "marker.tip.names=tip_*",
];
const BODY: [&str; 14] = [
    "-p",
    "j1=0.5",
    "-p",
    "j2=0.7",
    "-p",
    "body.omega1=1",
    "-p",
    "body.qw=0.8",
    "-p",
    "body.qx=0.6",
    "-p",
    "marker.centre.kind=spatial",
    "-p",
    "marker.centre.names=body.*",
];

#[test]
fn no_sound_fmu_is_accused() {
    let program = {
        let test = std::env::current_exe().unwrap();
        let folder = test.parent().and_then(std::path::Path::parent).unwrap();
        folder.join("linchpin").display().to_string()
    };
    for fmi in VERSIONS {
        for (equation, parameters) in [
            (Equation::Oscillator, &OSCILLATOR[..]),
            (Equation::Link, &LINK),
            (Equation::Body, &BODY),
        ] {
            for fmu in [
                TestFmu::with_varying_inputs(equation, fmi),
                TestFmu::new(equation, fmi),
            ] {
                let workshop = workshop(MASSES, &fmu);
                let worker = ["--", &program, "worker", "--fmu", "mass.fmu"];
                let arguments = [&["conformance"][..], parameters, &worker].concat();
                let outcome = workshop.run(&arguments);
                println!("{fmu:?}\n{}", outcome.stdout);
                outcome.exits_with(0);
                outcome.prints(&["pass           mobility", "0 failed"]);
            }
        }
    }
}
