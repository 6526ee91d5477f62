//! modelDescription.xml of the FMUs of the tests.

use std::fmt::Write;

use super::{Equation, Fmi, TestFmu};

/// Name, value reference, role, unit, start.
type Variable<'a> = (String, usize, Role, &'a str, Option<f64>);

#[derive(Clone, Copy, PartialEq)]
enum Role {
    Parameter,
    State,
    Input,
    Output,
}

pub(super) fn text(fmu: &TestFmu) -> String {
    let two = fmu.fmi == Fmi::Two;
    let (version, token, state) = match two {
        true => ("2.0", "guid", "FMUstate"),
        false => ("3.0", "instantiationToken", "FMUState"),
    };
    let flags = [
        (format!("canGetAndSet{state}"), fmu.keeps_states),
        (format!("canSerialize{state}"), fmu.serializes),
        ("canInterpolateInputs".to_owned(), fmu.orders > 0),
        ("providesIntermediateUpdate".to_owned(), fmu.updates),
        (
            "canHandleVariableCommunicationStepSize".to_owned(),
            fmu.varies_steps,
        ),
        ("canBeInstantiatedOnlyOncePerProcess".to_owned(), fmu.once),
    ];
    let flags = flags.iter().filter(|(_, is_set)| *is_set);
    let flags: String = flags.map(|(name, _)| format!(" {name}=\"true\"")).collect();
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"{version}\" modelName=\"{}\" \
         {token}=\"{{linchpin}}\" description=\"made by a test\">\n<CoSimulation modelIdentifier=\"model\"{flags}/>\n<ModelVariables>\n",
        name(fmu.equation)
    );
    for (name, reference, role, unit, start) in variables(fmu.equation) {
        let (causality, initial) = match role {
            Role::Parameter => ("parameter", ""),
            Role::State => ("output", " initial=\"exact\""),
            Role::Input => ("input", ""),
            Role::Output => ("output", ""),
        };
        let variability = match role {
            Role::Parameter => " variability=\"fixed\"",
            _ => "",
        };
        let start = start.map_or_else(String::new, |start| format!(" start=\"{start}\""));
        let own = format!(
            "name=\"{name}\" valueReference=\"{reference}\" causality=\"{causality}\"{variability}{initial}"
        );
        let inside = match role == Role::Input && fmu.updates {
            true => " intermediateUpdate=\"true\"",
            false => "",
        };
        let _ = match two {
            true => writeln!(
                text,
                "<ScalarVariable {own}><Real unit=\"{unit}\"{start}/></ScalarVariable>"
            ),
            false => writeln!(text, "<Float64 {own}{inside} unit=\"{unit}\"{start}/>"),
        };
    }
    text += match two {
        true => {
            "<ScalarVariable name=\"fault\" valueReference=\"90\" causality=\"parameter\" variability=\"fixed\"><Integer start=\"0\"/></ScalarVariable>\n\
             <ScalarVariable name=\"fault_at\" valueReference=\"91\" causality=\"parameter\" variability=\"fixed\"><Real start=\"0\"/></ScalarVariable>\n\
             <ScalarVariable name=\"held\" valueReference=\"92\" causality=\"parameter\" variability=\"fixed\"><Boolean start=\"false\"/></ScalarVariable>\n\
             <ScalarVariable name=\"label\" valueReference=\"93\" causality=\"parameter\" variability=\"fixed\"><String start=\"\"/></ScalarVariable>\n"
        }
        false => {
            "<Int32 name=\"fault\" valueReference=\"90\" causality=\"parameter\" variability=\"fixed\" start=\"0\"/>\n\
             <Float64 name=\"fault_at\" valueReference=\"91\" causality=\"parameter\" variability=\"fixed\" start=\"0\"/>\n\
             <Boolean name=\"held\" valueReference=\"92\" causality=\"parameter\" variability=\"fixed\" start=\"false\"/>\n\
             <String name=\"label\" valueReference=\"93\" causality=\"parameter\" variability=\"fixed\"><Start value=\"\"/></String>\n"
        }
    };
    text + "</ModelVariables>\n</fmiModelDescription>\n"
}

fn name(equation: Equation) -> &'static str {
    match equation {
        Equation::Oscillator => "oscillator-fmu",
        Equation::Link => "link-fmu",
        Equation::Body => "body-fmu",
    }
}

fn numbered<'a>(
    from: usize,
    role: Role,
    prefix: &str,
    all: &[(&str, &'a str, Option<f64>)],
) -> Vec<Variable<'a>> {
    let all = all.iter().enumerate();
    all.map(|(place, (name, unit, start))| {
        (format!("{prefix}{name}"), from + place, role, *unit, *start)
    })
    .collect()
}

fn variables(equation: Equation) -> Vec<Variable<'static>> {
    let zero = Some(0.0);
    let parameters = |all: &[_]| numbered(0, Role::Parameter, "", all);
    let states = |prefix: &str, all: &[_]| numbered(20, Role::State, prefix, all);
    let inputs = |prefix: &str, all: &[_]| numbered(40, Role::Input, prefix, all);
    let outputs = |prefix: &str, all: &[_]| numbered(60, Role::Output, prefix, all);
    match equation {
        Equation::Oscillator => [
            parameters(&[
                ("m", "kg", Some(1.0)),
                ("c", "N/m", zero),
                ("d", "N.s/m", zero),
            ]),
            states("", &[("x", "m", zero), ("v", "m/s", zero)]),
            inputs("", &[("f", "N", zero)]),
            outputs("", &[("a", "m/s2", None)]),
        ]
        .concat(),
        Equation::Link => [
            parameters(&[
                ("m", "kg", Some(1.0)),
                ("inertia", "kg.m2", Some(1.0)),
                ("half", "m", Some(0.5)),
                ("gravity", "m/s2", Some(9.81)),
            ]),
            states(
                "",
                &[
                    ("x", "m", zero),
                    ("y", "m", zero),
                    ("angle", "rad", zero),
                    ("vx", "m/s", zero),
                    ("vy", "m/s", zero),
                    ("rate", "rad/s", zero),
                ],
            ),
            inputs(
                "tip_",
                &[
                    ("fx", "N", zero),
                    ("fy", "N", zero),
                    ("moment", "N.m", zero),
                ],
            ),
            outputs(
                "tip_",
                &[
                    ("x", "m", None),
                    ("y", "m", None),
                    ("angle", "rad", None),
                    ("vx", "m/s", None),
                    ("vy", "m/s", None),
                    ("rate", "rad/s", None),
                    ("ax", "m/s2", None),
                    ("ay", "m/s2", None),
                    ("alpha", "rad/s2", None),
                ],
            ),
        ]
        .concat(),
        Equation::Body => [
            parameters(&[
                ("m", "kg", Some(1.0)),
                ("j1", "kg.m2", Some(1.0)),
                ("j2", "kg.m2", Some(1.0)),
                ("j3", "kg.m2", Some(1.0)),
                ("gravity", "m/s2", Some(9.81)),
            ]),
            states(
                "body.",
                &[
                    ("x", "m", zero),
                    ("y", "m", zero),
                    ("z", "m", zero),
                    ("qw", "1", Some(1.0)),
                    ("qx", "1", zero),
                    ("qy", "1", zero),
                    ("qz", "1", zero),
                    ("vx", "m/s", zero),
                    ("vy", "m/s", zero),
                    ("vz", "m/s", zero),
                    ("omega1", "rad/s", zero),
                    ("omega2", "rad/s", zero),
                    ("omega3", "rad/s", zero),
                ],
            ),
            inputs(
                "body.",
                &[
                    ("fx", "N", zero),
                    ("fy", "N", zero),
                    ("fz", "N", zero),
                    ("moment_x", "N.m", zero),
                    ("moment_y", "N.m", zero),
                    ("moment_z", "N.m", zero),
                ],
            ),
            outputs(
                "body.",
                &[
                    ("omega_x", "rad/s", None),
                    ("omega_y", "rad/s", None),
                    ("omega_z", "rad/s", None),
                    ("ax", "m/s2", None),
                    ("ay", "m/s2", None),
                    ("az", "m/s2", None),
                    ("alpha_x", "rad/s2", None),
                    ("alpha_y", "rad/s2", None),
                    ("alpha_z", "rad/s2", None),
                ],
            ),
        ]
        .concat(),
    }
}
