//! Signals that depend on each other without delay and not linearly: where the search for them begins, and how it goes on.

use std::sync::Arc;

use linchpin_master::connection::Direct;
use linchpin_master::scene::{self, Scene};
use linchpin_master::setup::Options;
use linchpin_master::{CoSimulation, RunError};
use linchpin_proto::v1;
use linchpin_tests::scenes::with_settings;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Host, Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem};

/// Outputs as a function of inputs, which has no value everywhere.
type Formula = fn(&[f64]) -> Option<f64>;

/// One output `y` of the inputs `u0`, `u1`, .., whose defaults are given.
#[derive(Clone, Copy)]
struct Block {
    formula: Formula,
    defaults: &'static [f64],
}

struct Running(Block);

impl Model for Block {
    fn describe(&self) -> v1::Model {
        let variable = |name: String, default| v1::Variable {
            name,
            unit: "1".into(),
            default,
            ..Default::default()
        };
        let inputs = self.defaults.iter().enumerate();
        v1::Model {
            name: "block".into(),
            inputs: inputs
                .map(|(number, default)| variable(format!("u{number}"), Some(*default)))
                .collect(),
            outputs: vec![variable("y".into(), None)],
            ..v1::Model::default()
        }
    }

    fn initialize(&self, _: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        Ok(Box::new(Running(*self)))
    }
}

impl Subsystem for Running {
    fn step(&mut self, _: Interval, _: &Inputs) -> Result<(), StepFailure> {
        Ok(())
    }

    fn outputs(
        &mut self,
        t: f64,
        inputs: &[f64],
        _: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        let value = (self.0.formula)(inputs).ok_or_else(|| StepFailure::Recoverable {
            t,
            message: format!("no value at {inputs:?}"),
        })?;
        values.fill(value);
        Ok(())
    }

    fn snapshot(&self, _: &mut Snapshot) {}

    fn restore(&mut self, _: &Snapshot) -> Result<(), StepFailure> {
        Ok(())
    }
}

/// Blocks in a ring, each the input of the next one, with start values.
fn ring(blocks: &[Block], starts: &[Option<f64>]) -> Scene {
    let mut text = String::from(
        "[scene]\nname = \"ring\"\nt_end = 0.1\n[coupling]\nmethod = \"weighted\"\nmacro_step = 1e-2\n",
    );
    for number in 0..blocks.len() {
        text += &format!("[[subsystem]]\nname = \"b{number}\"\nmodel = \"block\"\n");
        let next = (number + 1) % blocks.len();
        text += &format!(
            "[[connection]]\nname = \"c{number}\"\nfrom = \"b{number}.y\"\nto = \"b{next}.u0\"\n"
        );
        if let Some(start) = starts.get(number).copied().flatten() {
            text += &format!("start = {start:?}\n");
        }
    }
    with_settings(&text, "", &[])
}

/// The outputs of all blocks at the start and at the end.
fn run(scene: &Scene, blocks: &[Block]) -> Result<[Vec<f64>; 2], RunError> {
    let mut connect = |_: &Scene, subsystem: &scene::Subsystem| {
        let number = scene
            .subsystems
            .iter()
            .position(|own| own.name == subsystem.name);
        let block = blocks[number.unwrap()];
        let host = Host::new(vec![Box::new(block)]);
        Ok(Box::new(Direct::new(Arc::new(host))) as Box<_>)
    };
    let mut simulation = CoSimulation::start(scene, &mut connect, &Options::default())?;
    let outputs = |simulation: &CoSimulation| {
        let row = simulation.row();
        let own = row.columns().iter().zip(row.values());
        own.filter(|(name, _)| name.ends_with(".y"))
            .map(|(_, value)| *value)
            .collect::<Vec<f64>>()
    };
    let start = outputs(&simulation);
    while simulation.macro_step()? {}
    Ok([start, outputs(&simulation)])
}

fn block(formula: Formula) -> Block {
    Block {
        formula,
        defaults: &[0.0],
    }
}

/// `c = sqrt(1.76 - a^2)`, `a = 1.8 - c`: two solutions, a circle and a line; what the blocks show first leaves the circle.
#[test]
fn a_circle_and_a_line_meet_where_the_search_begins() {
    let blocks = [
        block(|u| Some(1.8 - u[0])),
        block(|u| {
            Some(1.76 - u[0] * u[0])
                .filter(|own| *own >= 0.0)
                .map(f64::sqrt)
        }),
    ];
    let half = (2.0 * 1.76 - 1.8_f64 * 1.8).sqrt();
    let [small, large] = [-1.0, 1.0].map(|sign| 0.5 * (1.8 + sign * half));
    for (starts, [a, c]) in [
        (&[][..], [small, large]),
        (&[Some(0.2)], [small, large]),
        (&[Some(1.3)], [large, small]),
        (&[Some(1.1), Some(0.7)], [large, small]),
    ] {
        for found in run(&ring(&blocks, starts), &blocks).unwrap() {
            let off = (found[0] - a).abs().max((found[1] - c).abs());
            assert!(off < 1e-12, "{starts:?}: {found:?}, {a} {c}");
        }
    }
}

/// Newton's method alone goes to and fro or away from where it began.
#[test]
fn steep_and_flat_formulas_are_solved_as_well() {
    let rings: [(&str, [Block; 2], Formula); 4] = [
        (
            "tanh",
            [
                block(|u| Some((20.0 * u[0]).tanh())),
                block(|u| Some(1.5 - 2.0 * u[0])),
            ],
            |w| Some(w[0] - (20.0 * (1.5 - 2.0 * w[0])).tanh()),
        ),
        (
            "cube",
            [block(|u| Some(u[0].powi(3))), block(|u| Some(1.0 - u[0]))],
            |w| Some(w[0] - (1.0 - w[0]).powi(3)),
        ),
        (
            "atan",
            [
                block(|u| Some(5.0 * u[0].atan())),
                block(|u| Some(3.0 - u[0])),
            ],
            |w| Some(w[0] - 5.0 * (3.0 - w[0]).atan()),
        ),
        (
            "small",
            [
                block(|u| Some(1e-13 * (2e12 * u[0]).sin())),
                block(|u| Some(3e-13 - 2.0 * u[0])),
            ],
            |w| Some(w[0] - 1e-13 * (2e12 * (3e-13 - 2.0 * w[0])).sin()),
        ),
    ];
    for (name, blocks, residual) in rings {
        let [start, end] = run(&ring(&blocks, &[]), &blocks).unwrap();
        for found in [start, end] {
            let left = residual(&found).unwrap().abs();
            assert!(
                left < 1e-11 * found[0].abs(),
                "{name}: {found:?} leaves {left:e}"
            );
        }
    }
}

/// A logarithm has no value where nothing is said of its input.
#[test]
fn a_search_begins_where_the_scene_or_the_model_says() {
    let logarithm: Formula = |u| Some(u[0]).filter(|own| *own > 0.0).map(f64::ln);
    let other = block(|u| Some(2.0 - u[0]));
    let unsaid = [block(logarithm), other];
    let error = run(&ring(&unsaid, &[]), &unsaid).unwrap_err().to_string();
    for word in ["no value at [0.0]", "`start`", "[[connection]]", "b0"] {
        assert!(error.contains(word), "{word:?} is missing in {error}");
    }
    assert!(!error.contains("macro_step"), "{error}");
    let by_model = [
        Block {
            formula: logarithm,
            defaults: &[1.0],
        },
        other,
    ];
    // ln(x) = 2 - x
    let x = 1.557_145_598_997_611_4;
    for (blocks, starts) in [(unsaid, &[None, Some(0.5)][..]), (by_model, &[])] {
        let [start, _] = run(&ring(&blocks, starts), &blocks).unwrap();
        assert!((start[1] - x).abs() < 1e-12, "{start:?}");
    }
}

#[test]
fn loops_without_a_solution_are_refused_by_name() {
    let blocks = [block(|u| Some(u[0] * u[0] + 1.0)), block(|u| Some(u[0]))];
    let error = run(&ring(&blocks, &[]), &blocks).unwrap_err();
    assert!(matches!(error, RunError::Scene(_)), "{error}");
    let shown = error.to_string();
    for word in [
        "connection.c",
        "no value of \"b",
        "Newton's method",
        "`start`",
    ] {
        assert!(shown.contains(word), "{word:?} is missing in {shown}");
    }
}

#[test]
fn one_output_has_one_start_value() {
    let blocks = [
        block(|_| Some(1.0)),
        Block {
            formula: |u| Some(u[0] + u[1]),
            defaults: &[0.0, 0.0],
        },
    ];
    let scene = |other: &str| {
        let text = format!(
            "[scene]\nname = \"ring\"\nt_end = 0.1\n[coupling]\nmethod = \"weighted\"\nmacro_step = 1e-2\n\
             [[subsystem]]\nname = \"b0\"\nmodel = \"block\"\n[[subsystem]]\nname = \"b1\"\nmodel = \"block\"\n\
             [[connection]]\nname = \"one\"\nfrom = \"b0.y\"\nto = \"b1.u0\"\nstart = 2.0\n\
             [[connection]]\nname = \"other\"\nfrom = \"b0.y\"\nto = \"b1.u1\"\n{other}"
        );
        with_settings(&text, "", &[])
    };
    assert_eq!(run(&scene(""), &blocks).unwrap(), [[1.0], [1.0]]);
    let error = run(&scene("start = 3.0"), &blocks).unwrap_err().to_string();
    for word in ["connection.other.start", "\"one\"", "both the same"] {
        assert!(error.contains(word), "{word:?} is missing in {error}");
    }
}
