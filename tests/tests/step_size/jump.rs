//! A load that jumps inside a macro step, against the closed form.

use std::sync::Arc;

use linchpin_master::CoSimulation;
use linchpin_master::connection::{Connection, Direct, StartError};
use linchpin_master::cosimulation::Options;
use linchpin_master::scene::{self, Scene};
use linchpin_models::oscillator::Oscillator;
use linchpin_proto::v1;
use linchpin_tests::runs::Trajectory;
use linchpin_tests::scenes::with_settings;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Host, Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem};

use super::traces::with_steps_of;

/// From this time on, in s, the free mass feels a load that gives it this acceleration in m/s^2.
const T_JUMP: f64 = 0.3137;
const KICK: f64 = 870.0;

const FREE: f64 = 1.3;
const SPRUNG: f64 = 2.1;
const STIFFNESS: f64 = 930.0;
const START: f64 = 0.21;

fn scene(coupling: &str) -> Scene {
    let text = format!(
        "[scene]\nname = \"jump\"\nt_end = 0.8\n[coupling]\nmethod = \"weighted\"\ntolerance = 1e-6\n\
         [[subsystem]]\nname = \"free\"\nmodel = \"oscillator\"\nparameters = {{ m = {FREE}, x0 = {START} }}\n\
         [[subsystem]]\nname = \"sprung\"\nmodel = \"oscillator\"\nparameters = {{ m = {SPRUNG}, c = {STIFFNESS}, x0 = {START} }}\n\
         [[joint]]\nname = \"link\"\nkind = \"rigid-link\"\na = \"free\"\nb = \"sprung\"\n"
    );
    with_settings(&text, coupling, &[])
}

fn exact(t: f64) -> f64 {
    let omega = (STIFFNESS / (FREE + SPRUNG)).sqrt();
    let rest = KICK * FREE / STIFFNESS;
    let since = (t - T_JUMP).max(0.0);
    START * (omega * t).cos() + rest * (1.0 - (omega * since).cos())
}

fn run(scene: &Scene, options: &Options) -> Trajectory {
    let mut simulation = CoSimulation::start(scene, &mut connect, options).unwrap();
    let mut trajectory = Trajectory {
        columns: simulation.row().columns().to_vec(),
        rows: vec![simulation.row().values().to_vec()],
        ..Trajectory::default()
    };
    while simulation.macro_step().unwrap() {
        trajectory.rows.push(simulation.row().values().to_vec());
    }
    trajectory.statistics = simulation.statistics();
    trajectory
}

fn connect(_: &Scene, subsystem: &scene::Subsystem) -> Result<Box<dyn Connection>, StartError> {
    let model: Box<dyn Model> = match subsystem.name.as_str() {
        "free" => Box::new(Kicked),
        _ => Box::new(Oscillator),
    };
    Ok(Box::new(Direct::new(Arc::new(Host::new(vec![model])))))
}

/// A mass without spring and damper, so the motion that the load adds is that of constant acceleration.
struct Kicked;

struct KickedRun(Box<dyn Subsystem>);

impl Model for Kicked {
    fn describe(&self) -> v1::Model {
        let mut model = Oscillator.describe();
        let capabilities = model.capabilities.get_or_insert_default();
        capabilities.directional_derivatives = false;
        model
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        Ok(Box::new(KickedRun(Oscillator.initialize(setup)?)))
    }
}

impl Subsystem for KickedRun {
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        self.0.step(interval, inputs)?;
        let mut kept = Snapshot::default();
        self.0.snapshot(&mut kept);
        let mut state = [0.0; 3];
        kept.get(&mut state)?;
        let under_load = (interval.end() - T_JUMP).clamp(0.0, interval.length);
        state[0] += 0.5 * KICK * under_load * under_load;
        state[1] += KICK * under_load;
        kept.clear();
        kept.put(&state);
        self.0.restore(&kept)
    }

    fn outputs(
        &mut self,
        t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        self.0.outputs(t, inputs, wanted, values)?;
        let acceleration = 2;
        for (value, _) in values
            .iter_mut()
            .zip(wanted)
            .filter(|(_, output)| **output == acceleration)
        {
            *value += if t >= T_JUMP { KICK } else { 0.0 };
        }
        Ok(())
    }

    fn snapshot(&self, into: &mut Snapshot) {
        self.0.snapshot(into);
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        self.0.restore(from)
    }
}

#[test]
fn the_degree_falls_at_a_jump_and_rises_again() {
    let mut found_jumps = 0;
    for method in ["method=weighted", "method=baumgarte"] {
        for tolerance in [1e-4, 1e-6] {
            let scene = scene(&format!(
                "{method} degree=automatic tolerance={tolerance:e}"
            ));
            let found = run(&scene, &Options::default());
            let (t, x) = (found.column("t"), found.column("free.x"));
            let errors = t.iter().zip(&x).map(|(t, x)| (x - exact(*t)).abs());
            let largest =
                errors.fold(0.0, f64::max) / x.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
            assert!(
                largest < 10.0 * tolerance,
                "{method} {tolerance}: {largest}"
            );
            let context = format!("{method} {tolerance}");
            let degrees = found.column("degree");
            let before = t.iter().rposition(|t| *t < T_JUMP - 0.01).unwrap();
            let after = t.iter().position(|t| *t > T_JUMP + 0.02).unwrap();
            assert_eq!(degrees[before], 3.0, "{context}");
            let lowest = degrees[before..after].iter().copied().fold(3.0, f64::min);
            assert!(lowest <= 1.0, "{context}: {:?}", &degrees[before..after]);
            if let Some(fall) = degrees[before..after]
                .iter()
                .position(|degree| *degree == 0.0)
            {
                found_jumps += 1;
                let fall = before + fall;
                assert_eq!(degrees[fall..fall + 3], [0.0, 0.0, 1.0], "{context}");
            }
            assert_eq!(degrees.last(), Some(&3.0), "{context}");
            for degree in 1..=3 {
                let fixed =
                    self::scene(&format!("{method} degree={degree} tolerance={tolerance:e}"));
                let fixed = run(&fixed, &Options::default()).statistics.integrations;
                assert!(found.statistics.integrations < fixed, "{context}: {degree}");
            }
            let expected = run(&scene, &with_steps_of(&found));
            assert!(found.bits() == expected.bits(), "{method} {tolerance}");
        }
    }
    // Where two attempts at one step tell of the jump.
    assert!(found_jumps > 0);
}
