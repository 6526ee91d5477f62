//! Columns of the coupling Jacobian by finite differences over solvers with an error tolerance, at H = 1e-4.
//!
//! A multiplier moves a mass by about H^2/2m there, so the increment of S1, 1e-5 max(1, |lambda|), moves it by far less
//! than the tolerance of 1e-8. It works where perturbed steps repeat the internal steps of the prediction, so that the
//! errors cancel; otherwise the increment must follow the tolerance, as the automatic one does.

#![allow(clippy::unwrap_used, missing_docs)]

use std::sync::Arc;

use linchpin_master::connection::{Connection, Direct, StartError};
use linchpin_master::scene::{self, Scene};
use linchpin_master::setup::Options;
use linchpin_master::{CoSimulation, RunError};
use linchpin_models::oscillator::Oscillator;
use linchpin_proto::v1;
use linchpin_tests::errors::{Errors, closed_form};
use linchpin_tests::runs::Trajectory;
use linchpin_tests::scenes::{RADAU5, oscillator_with};
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Host, Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem};

const COUPLINGS: [&str; 6] = [
    "index=1 beta=2H gamma=H^2 degree=0",
    "index=1 beta=2H gamma=H^2 degree=2",
    "method=weighted index=1 a=2 b=2.6 degree=1",
    "method=weighted index=2 a=1 degree=0",
    "index=2 beta=2e-1 degree=1",
    "index=3 beta=0 degree=0",
];

fn scene(coupling: &str, increment: &str, others: &[&str]) -> Scene {
    let coupling = format!("{coupling} macro_step=1e-4 jacobian=every-step increment={increment}");
    let velocities = "output.variables=[\"mass1.v\", \"mass2.v\"]";
    oscillator_with(
        &coupling,
        &[&["scene.t_end=0.25", velocities], others].concat(),
    )
}

#[test]
fn repeated_internal_steps_allow_any_increment() {
    for coupling in COUPLINGS {
        let exact = Errors::against_closed_form(&scene(coupling, "automatic", &[]));
        for increment in ["1e-5", "1e-3", "automatic"] {
            let found = Errors::against_closed_form(&scene(coupling, increment, &[RADAU5]));
            let message = format!("{coupling} {increment}: {found:?}, exact solver {exact:?}");
            assert!(found.x < 1.01 * exact.x + 1e-13, "{message}");
            assert!(found.lambda < 1.01 * exact.lambda, "{message}");
        }
    }
}

/// The noise of a solver that takes other internal steps in every run.
const NOISE: f64 = 1e-8;

/// With the increment of S1 the runs go wrong by hundreds of tolerances, or diverge.
#[test]
fn incoherent_errors_need_the_automatic_increment() {
    for coupling in COUPLINGS {
        let errors = |increment| {
            let scene = scene(coupling, increment, &[]);
            noisy_run(&scene).map(|trajectory| Errors::of(&trajectory, closed_form(&scene)))
        };
        let without_noise = Errors::against_closed_form(&scene(coupling, "automatic", &[]));
        let automatic = errors("automatic").unwrap();
        let is_accurate = automatic.x < without_noise.x + 2.0 * NOISE;
        assert!(
            is_accurate,
            "{coupling}: {automatic:?}, without noise {without_noise:?}"
        );
        match errors("1e-5") {
            Ok(small) => assert!(small.x > 100.0 * NOISE, "{coupling}: {small:?}"),
            Err(error) => assert!(
                matches!(error, RunError::Diverged { .. }),
                "{coupling}: {error}"
            ),
        }
    }
}

fn noisy_run(scene: &Scene) -> Result<Trajectory, RunError> {
    let mut simulation = CoSimulation::start(scene, &mut connect_noisy, &Options::default())?;
    let mut trajectory = Trajectory {
        columns: simulation.row().columns().to_vec(),
        ..Trajectory::default()
    };
    while simulation.macro_step()? {
        trajectory.rows.push(simulation.row().values().to_vec());
    }
    Ok(trajectory)
}

fn connect_noisy(_: &Scene, _: &scene::Subsystem) -> Result<Box<dyn Connection>, StartError> {
    Ok(Box::new(Direct::new(Arc::new(Host::new(vec![Box::new(
        Noisy,
    )])))))
}

/// The oscillator with an error of up to [`NOISE`] at the end of every step, a different one in every run.
struct Noisy;

impl Model for Noisy {
    fn describe(&self) -> v1::Model {
        let mut model = Oscillator.describe();
        let capabilities = model.capabilities.get_or_insert_default();
        capabilities.repeats_step_sequence = false;
        model
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let exact = Oscillator.initialize(setup)?;
        Ok(Box::new(NoisyRun { exact, runs: 0 }))
    }
}

struct NoisyRun {
    exact: Box<dyn Subsystem>,
    runs: u32,
}

impl NoisyRun {
    /// Between -1 and 1, the fractional parts of multiples of an irrational number.
    fn next_noise(&mut self) -> f64 {
        self.runs += 1;
        2.0 * (f64::from(self.runs) * std::f64::consts::SQRT_2).fract() - 1.0
    }
}

impl Subsystem for NoisyRun {
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.exact.step(interval, inputs)?;
        let mut kept = Snapshot::default();
        self.exact.snapshot(&mut kept);
        let mut state = [0.0; 3];
        kept.get(&mut state)?;
        state[0] += NOISE * self.next_noise();
        state[1] += NOISE * self.next_noise();
        kept.clear();
        kept.put(&state);
        self.exact.restore(&kept)
    }

    fn outputs(
        &mut self,
        t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        self.exact.outputs(t, inputs, wanted, values)
    }

    fn snapshot(&self, into: &mut Snapshot) {
        self.exact.snapshot(into);
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        self.exact.restore(from)
    }

    fn tolerance(&self) -> Option<f64> {
        Some(NOISE)
    }
}
