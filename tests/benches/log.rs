//! What the log costs a run that does not log: `cargo bench -p linchpin-tests --bench log`; `-- --write` writes the table of
//! `docs/evidence/cost.md`.
//!
//! One run measures, in turns, the macro step of the two-mass oscillator with the workers in this process, the shortest that there
//! is, and the spans and events that such a step has, with the filter that `linchpin` has by default.

// A bench stops at the first thing that is not as it should be.
#![allow(clippy::unwrap_used)]

use std::hint::black_box;
use std::time::Instant;

use linchpin::connect::{Connector, Place};
use linchpin::log;
use linchpin_master::CoSimulation;
use linchpin_master::scene::{Scene, parse};
use linchpin_master::setup::Options;
use linchpin_tests::evidence;

const SCENE: &str = include_str!("../../scenes/oscillator.toml");

/// Steps of one block; the time of a block is one sample.
const BLOCK: u32 = 20_000;

const ROUNDS: usize = 20;

const COMMAND: &str = "cargo bench -p linchpin-tests --bench log -- --write";

fn main() {
    log::begin(&"warn".parse().unwrap());
    // Columns in every step: the same work in every block.
    let overrides = ["coupling.jacobian=every-step", "scene.t_end=1e5"];
    let overrides: Vec<_> = overrides.iter().map(|text| text.parse().unwrap()).collect();
    let scene = parse(SCENE, "oscillator.toml", &overrides).unwrap();
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    let mut simulation = CoSimulation::start(&scene, &mut connect, &Options::default()).unwrap();
    let (mut steps, mut logs) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        steps.push(nanoseconds(|| {
            assert!(simulation.macro_step().unwrap());
        }));
        logs.push(nanoseconds(spans_of_a_step));
    }
    let [step, log] = [steps, logs].map(median);
    let table = format!(
        "| macro step in process, ns | its spans and events, switched off, ns | share |\n|---|---|---|\n\
         | {step:.0} | {log:.0} | {:.1} % |",
        100.0 * log / step
    );
    evidence::show("cost.md", "log", COMMAND, &table);
}

/// As many as a step has that is corrected once: three spans, and two events where steps vary.
fn spans_of_a_step() {
    let number = black_box(1);
    let _step = tracing::debug_span!("macro_step", number, t = black_box(0.5)).entered();
    tracing::trace_span!("correction").in_scope(|| black_box(number));
    tracing::debug!(error = black_box(0.5), "accepted");
    tracing::debug!(rate = black_box(0.5), "Jacobian refresh");
    tracing::trace_span!("exchange").in_scope(|| black_box(number));
}

/// Time of one call, over a block of them.
fn nanoseconds(mut call: impl FnMut()) -> f64 {
    let started = Instant::now();
    (0..BLOCK).for_each(|_| call());
    started.elapsed().as_secs_f64() * 1e9 / f64::from(BLOCK)
}

fn median(mut samples: Vec<f64>) -> f64 {
    samples.sort_by(f64::total_cmp);
    samples[samples.len() / 2]
}
