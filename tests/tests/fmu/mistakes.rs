//! Damaged archives, wrong platforms, missing functions, and mistakes in a scene.

use std::fs;

use linchpin_tests::fmus::{Equation, Fmi, TestFmu, VERSIONS, write_archive};

use crate::{MASSES, run, workshop};

fn oscillator(fmi: Fmi) -> TestFmu {
    TestFmu::new(Equation::Oscillator, fmi)
}

/// The words of `linchpin worker --fmu mass.fmu`, and of a run, for archives that are made by `make` of the sound one.
fn refused(fmi: Fmi, make: impl Fn(&std::path::Path), words: &[&str]) {
    let workshop = workshop(MASSES, &oscillator(fmi));
    let path = workshop.path().join("mass.fmu");
    make(&path);
    workshop
        .run(&["worker", "--fmu", "mass.fmu"])
        .fails(2, words);
    // The run shows the last lines of the worker.
    let words: Vec<&str> = [&["mass2"], words].concat();
    workshop.run(&run(&[])).fails(1, &words);
}

#[test]
fn archives_that_are_damaged() {
    refused(
        Fmi::Two,
        |path| fs::remove_file(path).unwrap(),
        &["mass.fmu", "No such file"],
    );
    refused(
        Fmi::Two,
        |path| fs::write(path, "nothing").unwrap(),
        &["mass.fmu", "no sound FMU", "zip"],
    );
    refused(
        Fmi::Three,
        |path| {
            let bytes = fs::read(path).unwrap();
            fs::write(path, &bytes[..bytes.len() / 2]).unwrap();
        },
        &["mass.fmu", "no sound FMU"],
    );
    refused(
        Fmi::Three,
        |path| {
            let mut bytes = fs::read(path).unwrap();
            let middle = bytes.len() / 2;
            bytes[middle..middle + 200].fill(0x5a);
            fs::write(path, bytes).unwrap();
        },
        &["mass.fmu", "no sound FMU"],
    );
    refused(
        Fmi::Two,
        |path| {
            write_archive(path, &[("readme.txt", b"no model")]);
        },
        &["mass.fmu", "no modelDescription.xml"],
    );
    refused(
        Fmi::Two,
        |path| {
            let text = oscillator(Fmi::Two).description();
            write_archive(
                path,
                &[
                    ("modelDescription.xml", text.as_bytes()),
                    ("../../evil.so", b"x"),
                ],
            );
        },
        &["../../evil.so", "outside the folder", "Do not trust"],
    );
    // A size in the directory of the archive that no FMU has.
    refused(
        Fmi::Two,
        |path| {
            let text = oscillator(Fmi::Two).description();
            let zeros = vec![0; 0x0012_3456];
            write_archive(
                path,
                &[
                    ("modelDescription.xml", text.as_bytes()),
                    ("resources/zeros", &zeros),
                ],
            );
            let mut bytes = fs::read(path).unwrap();
            for place in 0..bytes.len() - 4 {
                if bytes[place..place + 4] == 0x0012_3456_u32.to_le_bytes() {
                    bytes[place..place + 4].copy_from_slice(&0xf000_0000_u32.to_le_bytes());
                }
            }
            fs::write(path, bytes).unwrap();
        },
        &["mass.fmu", "2147483648 bytes", "resources"],
    );
}

#[test]
fn descriptions_that_are_not_understood() {
    for (from, to, words) in [
        ("<CoSimulation ", "<ModelExchange ", "not for co-simulation"),
        (
            "fmiVersion=\"2.0\"",
            "fmiVersion=\"1.0\"",
            "2.0 and 3.0 are served",
        ),
        ("</ModelVariables>", "", "line"),
    ] {
        refused(
            Fmi::Two,
            |path| {
                let text = oscillator(Fmi::Two).description().replace(from, to);
                write_archive(path, &[("modelDescription.xml", text.as_bytes())]);
            },
            &["mass.fmu", "modelDescription.xml", words],
        );
    }
}

#[test]
fn libraries_that_do_not_fit() {
    for (fmi, other, wanted) in [
        (Fmi::Two, "win64", "binaries/linux64/model.so"),
        (
            Fmi::Three,
            "aarch64-darwin",
            "binaries/x86_64-linux/model.so",
        ),
    ] {
        let text = oscillator(fmi).description();
        let folder = format!("binaries/{other}/model.bin");
        refused(
            fmi,
            |path| {
                write_archive(
                    path,
                    &[("modelDescription.xml", text.as_bytes()), (&folder, b"x")],
                );
            },
            &[wanted, other, "Linux on x86_64"],
        );
        refused(
            fmi,
            |path| {
                write_archive(path, &[("modelDescription.xml", text.as_bytes())]);
            },
            &[wanted, "none at all"],
        );
        refused(
            fmi,
            |path| {
                let entries = [
                    ("modelDescription.xml", text.as_bytes()),
                    (wanted, &b"no library"[..]),
                ];
                write_archive(path, &entries);
            },
            &["cannot be loaded"],
        );
    }
}

#[test]
fn functions_that_are_missing() {
    let two = oscillator(Fmi::Two);
    let without_step = TestFmu {
        defined: vec!["WITHOUT_STEP"],
        ..two.clone()
    };
    refused(
        Fmi::Two,
        |path| without_step.write(path),
        &["no function fmi2DoStep", "FMI 2.0 demands"],
    );
    for fmi in VERSIONS {
        let state = if fmi == Fmi::Two {
            "fmi2GetFMUstate"
        } else {
            "fmi3GetFMUState"
        };
        let flag = state
            .replace("fmi2Get", "canGetAndSet")
            .replace("fmi3Get", "canGetAndSet");
        let text = oscillator(fmi).description();
        let without = TestFmu {
            keeps_states: false,
            ..oscillator(fmi)
        };
        refused(
            fmi,
            |path| {
                let library = without.compile(path);
                let entries = [
                    ("modelDescription.xml", text.as_bytes()),
                    (without.library(), &library[..]),
                ];
                write_archive(path, &entries);
            },
            &[state, "because it says", &flag],
        );
    }
}

#[test]
fn names_in_a_scene() {
    for (from, to, words) in [
        (
            "c = 1000.0\nd = 10.0\nv",
            "stiffness = 1000.0\nv",
            &["parameters.stiffness", "no such parameter", "there are"][..],
        ),
        (
            "c = 1000.0\nd = 10.0\nv",
            "labl = 1\nv",
            &["parameters.labl", "did you mean \"label\""],
        ),
        (
            "c = 1000.0\nd = 10.0\nv",
            "f = 1\nv",
            &["parameters.f", "cannot be set", "initial"],
        ),
        (
            "c = 1000.0\nd = 10.0\nv",
            "c = \"soft\"\nv",
            &["parameters.c", "a finite number"],
        ),
        (
            "c = 1000.0\nd = 10.0\nv",
            "fault = 0.5\nv",
            &["parameters.fault", "a whole number"],
        ),
        (
            "c = 1000.0\nd = 10.0\nv",
            "fault = 1e12\nv",
            &["parameters.fault", "too large"],
        ),
        (
            "c = 1000.0\nd = 10.0\nv",
            "held = 3\nv",
            &["parameters.held", "true or false"],
        ),
        (
            "c = 1000.0\nd = 10.0\nv",
            "label = 3\nv",
            &["parameters.label", "a text"],
        ),
        (
            "kind = \"scalar\"",
            "kind = \"round\"",
            &["marker.mass.kind", "scalar, planar, spatial"],
        ),
        ("kind = \"scalar\"", "", &["marker.mass.kind is missing"]),
        (
            "kind = \"scalar\"",
            "kind = 3",
            &["marker.mass.kind", "a text"],
        ),
        (
            "names = \"*\"",
            "names = \"x\"",
            &["marker.mass.names", "one *"],
        ),
        (
            "names = \"*\"",
            "names = \"tip_*\"",
            &["marker.mass.names", "no variable \"tip_x\""],
        ),
        ("names = \"*\"", "", &["marker.mass.x", "has no position"]),
        (
            "names = \"*\"",
            "x = \"X1\"",
            &["marker.mass.x", "no variable \"X1\"", "did you mean \"x\""],
        ),
        (
            "names = \"*\"",
            "x = \"fault\"",
            &["marker.mass.x", "no Real"],
        ),
        (
            "names = \"*\"",
            "names = \"*\"\nf = \"v\"",
            &["marker.mass.f", "no input", "\"f\""],
        ),
        (
            "names = \"*\"",
            "names = \"*\"\nangle = \"v\"",
            &["marker.mass.angle", "no \"angle\"", "kind"],
        ),
        (
            "[subsystem.parameters.marker.mass]",
            "[subsystem.parameters.marker]\nmass = \"x\"\n[subsystem.parameters.marker.two]",
            &["marker.mass", "marker.NAME.KEY"],
        ),
    ] {
        let scene = MASSES.replace(from, to);
        assert_ne!(scene, MASSES, "{to}");
        let workshop = workshop(&scene, &oscillator(Fmi::Two));
        workshop
            .run(&["check", "scene.toml"])
            .fails(2, &[&["mass2"], words].concat());
    }
    let gap = MASSES.replace(
        "kind = \"scalar\"\nnames = \"*\"",
        "kind = \"planar\"\nx = \"x\"\nangle = \"v\"",
    );
    workshop(&gap, &oscillator(Fmi::Two))
        .run(&["check", "scene.toml"])
        .fails(
            2,
            &[
                "marker.mass.angle",
                "angle is mapped and y before it is not",
            ],
        );
}

#[test]
fn units_that_are_not_si() {
    let fmu = oscillator(Fmi::Two);
    let workshop = workshop(MASSES, &fmu);
    let units = "<UnitDefinitions><Unit name=\"m\"><BaseUnit m=\"1\" factor=\"0.001\"/></Unit></UnitDefinitions><ModelVariables>";
    let text = fmu.description().replace("<ModelVariables>", units);
    let path = workshop.path().join("mass.fmu");
    let library = fmu.compile(&path);
    write_archive(
        &path,
        &[
            ("modelDescription.xml", text.as_bytes()),
            (fmu.library(), &library[..]),
        ],
    );
    workshop.run(&["check", "scene.toml"]).fails(
        2,
        &[
            "marker.mass.names",
            "\"x\" has the unit m",
            "0.001 of the SI unit",
        ],
    );
}

#[test]
fn keys_and_options() {
    let workshop = workshop(
        &MASSES.replace("fmu = \"", "command = [\"true\"]\nfmu = \""),
        &oscillator(Fmi::Two),
    );
    workshop
        .run(&["check", "scene.toml"])
        .fails(2, &["both command and fmu"]);
    workshop.write("scene.toml", MASSES.replace("\"mass.fmu\"", "\"\""));
    workshop
        .run(&["check", "scene.toml"])
        .fails(2, &["subsystem.mass2.fmu", "the path of an FMU"]);
    workshop.write("scene.toml", MASSES);
    for (solver, words) in [
        (
            "{kind=\"sub-steps\",substeps=1.5}",
            &["solver.substeps", "10000"][..],
        ),
        (
            "{kind=\"sub-steps\",tolerance=-1}",
            &["solver.tolerance", "0 (the FMU's own)"],
        ),
        ("{kind=\"input-derivatives\"}", &["solver", "sub-steps"]),
        ("{kind=\"sub-steps\",order=1}", &["solver.order"]),
    ] {
        let setting = format!("subsystem.mass2.solver={solver}");
        workshop
            .run(&["check", "scene.toml", "--set", &setting])
            .fails(2, words);
    }
    let fmu = TestFmu {
        orders: 3,
        ..oscillator(Fmi::Two)
    };
    fmu.write(&workshop.path().join("mass.fmu"));
    let setting = "subsystem.mass2.solver={kind=\"input-derivatives\",order=9}";
    workshop
        .run(&["check", "scene.toml", "--set", setting])
        .fails(2, &["solver.order", "from 0", "to 7"]);
}

/// Values of all types reach the FMU: a mass that is held stays.
#[test]
fn parameters_of_all_types_are_set() {
    for fmi in VERSIONS {
        let scene = MASSES.replace(
            "c = 1000.0\nd = 10.0\nv = 100.0",
            "held = true\nlabel = \"held\"\nx = 0.25",
        );
        let scene = scene.split("[[joint]]").next().unwrap().to_owned()
            + "[output]\nvariables = [\"mass2.x\"]\n";
        let scene = scene.replace("v0 = 100.0", "v0 = 1.0");
        let workshop = workshop(&scene, &oscillator(fmi));
        workshop
            .run(&run(&[
                "--set",
                "coupling.method=explicit",
                "--set",
                "coupling.mu=10H",
            ]))
            .succeeds();
        let own = crate::table::table(&workshop.read("out/results.csv"));
        assert!(own["mass2.x"].iter().all(|x| *x == 0.25), "{fmi:?}");
    }
}
