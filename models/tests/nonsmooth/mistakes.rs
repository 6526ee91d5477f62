//! What a scene can get wrong about nonsmooth models, and what it is told.

use std::collections::BTreeMap;

use linchpin_models::nonsmooth::{BLOCK, BOUNCING_BALL, MASS_CHAIN, SLIDER_CRANK, WOODPECKER};
use linchpin_proto::v1::{self, value::Kind};
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup};

enum Given {
    Number(f64),
    Text(&'static str),
}
use Given::{Number, Text};

/// Values by name.
type Names<'a> = &'a [(&'a str, Given)];

fn values(given: Names<'_>) -> BTreeMap<String, v1::Value> {
    let value = |given: &Given| {
        let kind = match given {
            Number(number) => Kind::Number(*number),
            Text(text) => Kind::Text((*text).to_owned()),
        };
        v1::Value { kind: Some(kind) }
    };
    given
        .iter()
        .map(|(name, given)| ((*name).to_owned(), value(given)))
        .collect()
}

/// The message on a model with these parameters and solver options.
fn mistake(model: &dyn Model, parameters: Names<'_>, solver: &str, options: Names<'_>) -> String {
    let build = || {
        let description = model.describe_with(&values(parameters))?;
        let solver = v1::Solver {
            kind: solver.to_owned(),
            options: values(options),
        };
        let setup = Setup::from_request(&description, values(parameters), Some(solver), 0.0)?;
        model.initialize(&setup)
    };
    let built: Result<_, SetupError> = build();
    match built {
        Ok(_) => panic!("nothing wrong"),
        Err(error) => error.to_string(),
    }
}

#[track_caller]
fn assert_says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "{part:?} is not in: {message}");
    }
}

#[test]
fn parameters_of_the_slider_crank() {
    let cases: [(Names, &[&str]); 12] = [
        (
            &[("l1", Number(-0.1))],
            &["parameters.l1 = -0.1", "greater than 0"],
        ),
        (
            &[("restitution", Number(1.3))],
            &["parameters.restitution = 1.3", "0 to 1"],
        ),
        (
            &[("friction", Number(-0.1))],
            &["parameters.friction", "0 or greater"],
        ),
        (&[("c", Number(f64::NAN))], &["parameters.c", "finite"]),
        (
            &[("elements", Number(2.5))],
            &["parameters.elements = 2.5", "whole number"],
        ),
        (
            &[("modes", Number(3.0))],
            &["parameters.modes", "rigid", "give elements"],
        ),
        (
            &[("elements", Number(2.0)), ("modes", Number(60.0))],
            &["6 modes", "60 are asked for", "take 1 to 6"],
        ),
        (
            &[("guide", Text("rails"))],
            &["parameters.guide = \"rails\"", "clearance, bilateral, free"],
        ),
        (
            &[("lenght", Number(1.0))],
            &["parameters.lenght", "unknown", "l1"],
        ),
        (
            &[("elements", Number(2.0)), ("width", Number(0.01))],
            &["parameters.width", "depth is missing"],
        ),
        (
            &[
                ("elements", Number(2.0)),
                ("width", Number(0.01)),
                ("depth", Number(0.01)),
            ],
            &["parameters.width", "0.238680 kg", "m2 = 0.038"],
        ),
        (
            &[("elements", Number(2.0)), ("j2", Number(1e-4))],
            &["parameters.j2", "inertia above", "0.0001 is given"],
        ),
    ];
    for (given, parts) in cases {
        assert_says(&mistake(&SLIDER_CRANK, given, "bathe", &[]), parts);
    }
}

#[test]
fn parameters_of_ball_block_and_woodpecker() {
    let cases: [(&dyn Model, &str, f64, &[&str]); 20] = [
        (&BOUNCING_BALL, "m", 0.0, &["greater than 0"]),
        (&BOUNCING_BALL, "height0", -0.1, &["0 or greater"]),
        (&BOUNCING_BALL, "restitution", 1.1, &["0 to 1"]),
        (&BOUNCING_BALL, "speed0", f64::INFINITY, &["finite"]),
        (&BOUNCING_BALL, "radius", -1.0, &["0 or greater"]),
        (&BLOCK, "half_width", 0.0, &["greater than 0"]),
        (&BLOCK, "inertia", 0.0, &["greater than 0"]),
        (&BLOCK, "slope", 1.6, &["between -pi/2 and pi/2"]),
        (&BLOCK, "friction", -0.1, &["0 or greater"]),
        (&BLOCK, "tangential_restitution", -0.1, &["0 to 1"]),
        (&BLOCK, "gap0", -1e-9, &["0 or greater"]),
        (&BLOCK, "tilt0", f64::NAN, &["finite"]),
        (
            &BLOCK,
            "plane_to",
            -1.0,
            &["plane_from", "would end at -1 m"],
        ),
        (&BLOCK, "half_hight", 1.0, &["unknown", "half_height"]),
        (
            &WOODPECKER,
            "sleeve_radius",
            2e-3,
            &["greater than pole_radius"],
        ),
        (&WOODPECKER, "m_bird", -1.0, &["greater than 0"]),
        (
            &WOODPECKER,
            "phi_m0",
            -0.2,
            &["the lower edge", "5.600e-4 m inside the pole"],
        ),
        (
            &WOODPECKER,
            "phi_m0",
            0.2,
            &["the upper edge", "inside the pole"],
        ),
        (&WOODPECKER, "phi_s0", 0.2, &["the beak", "inside the pole"]),
        (&WOODPECKER, "pole_bottom", 0.1, &["below pole_top"]),
    ];
    for (model, name, value, parts) in cases {
        let message = mistake(model, &[(name, Number(value))], "bathe", &[]);
        assert_says(&message, &["parameters."]);
        assert_says(&message, parts);
    }
}

#[test]
fn solvers_and_their_options() {
    let cases: [(&str, Names, &[&str]); 11] = [
        (
            "radau5",
            &[],
            &["no solver \"radau5\"", "generalized-alpha", "hets"],
        ),
        (
            "generalized-alpha",
            &[("rho_inf", Number(1.2))],
            &["solver.rho_inf = 1.2", "0 to 1"],
        ),
        (
            "newmark-alpha",
            &[("alpha_f", Number(0.6))],
            &["solver.alpha_f = 0.6", "at most 0.5"],
        ),
        (
            "newmark-alpha",
            &[("alpha_m", Number(0.3)), ("alpha_f", Number(0.2))],
            &["solver.alpha_m = 0.3", "at most alpha_f"],
        ),
        (
            "ed-alpha",
            &[("alpha_ar", Number(0.0))],
            &["solver.alpha_ar = 0", "greater than 0"],
        ),
        (
            "ed-alpha",
            &[("rho_inf", Number(1.0))],
            &["solver", "rho_inf = 1", "take rho_inf < 1"],
        ),
        (
            "bathe",
            &[("step", Number(0.0))],
            &["solver.step = 0", "greater than 0"],
        ),
        (
            "bathe",
            &[("tolerance", Number(1.0))],
            &["solver.tolerance = 1", "1e-15 to 1e-3"],
        ),
        (
            "bathe",
            &[("iterations", Number(0.0))],
            &["solver.iterations = 0", "1 to 10000"],
        ),
        (
            "bathe",
            &[("restart", Number(0.5))],
            &["solver.restart = 0.5", "0 or 1"],
        ),
        (
            "moreau",
            &[("acceleration_level", Number(1.0))],
            &[
                "solver.acceleration_level",
                "only generalised-alpha",
                "velocity level",
            ],
        ),
    ];
    for (solver, options, parts) in cases {
        assert_says(&mistake(&MASS_CHAIN, &[], solver, options), parts);
    }
}
