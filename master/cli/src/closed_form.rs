//! The exact solution of scenes that have one: oscillators that rigid links make one body.

use linchpin_master::scene::{Scene, Served, Subsystem};
use linchpin_models::models;
use linchpin_models::oscillator::{LoadStep, OscillatorParameters};
use linchpin_models::reference::LinkedOscillators;
use linchpin_worker::Setup;

/// Exact values of the result columns of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedForm {
    solution: LinkedOscillators,
    t_start: f64,
    subsystems: Vec<String>,
    joints: Vec<String>,
}

/// A result column with an exact value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Position of a mass.
    Position,
    /// Velocity of a mass.
    Velocity,
    /// Acceleration of a mass.
    Acceleration,
    /// Multiplier of the joint with this number.
    Multiplier(usize),
}

impl ClosedForm {
    /// The closed form of `scene`, if all its subsystems are built-in oscillators that the joints link to a tree.
    pub fn of(scene: &Scene) -> Option<Self> {
        let parameters = scene
            .subsystems
            .iter()
            .map(|subsystem| parameters(subsystem, scene.t_start))
            .collect::<Option<Vec<_>>>()?;
        let (masses, loads): (Vec<_>, Vec<_>) = parameters.into_iter().unzip();
        let links: Vec<_> = scene
            .joints
            .iter()
            .map(|joint| (joint.a.subsystem, joint.b.subsystem))
            .collect();
        Some(Self {
            solution: LinkedOscillators::loaded(&masses, &links, &loads).ok()?,
            t_start: scene.t_start,
            subsystems: scene
                .subsystems
                .iter()
                .map(|subsystem| subsystem.name.clone())
                .collect(),
            joints: scene
                .joints
                .iter()
                .map(|joint| joint.name.clone())
                .collect(),
        })
    }

    /// What a result column holds; `None` if there is no exact value for it.
    pub fn quantity(&self, column: &str) -> Option<Quantity> {
        let (owner, variable) = column.split_once('.')?;
        if variable == "lambda" {
            return self
                .joints
                .iter()
                .position(|joint| joint == owner)
                .map(Quantity::Multiplier);
        }
        if !self.subsystems.iter().any(|subsystem| subsystem == owner) {
            return None;
        }
        match variable {
            "x" => Some(Quantity::Position),
            "v" => Some(Quantity::Velocity),
            "a" => Some(Quantity::Acceleration),
            _ => None,
        }
    }

    /// The exact value at time `t`; `None` for a joint that does not exist.
    pub fn value(&self, quantity: Quantity, t: f64) -> Option<f64> {
        let elapsed = t - self.t_start;
        let motion = self.solution.motion(elapsed);
        match quantity {
            Quantity::Position => Some(motion.x),
            Quantity::Velocity => Some(motion.v),
            Quantity::Acceleration => Some(motion.a),
            Quantity::Multiplier(joint) => self.solution.multiplier(joint, elapsed, &motion),
        }
    }
}

/// The mass and its load, whose time counts from the start of the scene.
fn parameters(subsystem: &Subsystem, t_start: f64) -> Option<(OscillatorParameters, LoadStep)> {
    if subsystem.served != Served::BuiltIn || subsystem.model.as_deref() != Some("oscillator") {
        return None;
    }
    let models = models();
    let model = models
        .iter()
        .find(|model| model.describe().name == "oscillator")?
        .describe();
    let given = subsystem
        .parameters
        .iter()
        .map(|(name, value)| match value.kind {
            Some(linchpin_proto::v1::value::Kind::Number(number)) => Some((name.as_str(), number)),
            _ => None,
        });
    let given: Vec<(&str, f64)> = given.collect::<Option<_>>()?;
    let setup = Setup::new(&model, &given, None, 0.0).ok()?;
    let is_bound = setup.parameter("partner_stiffness").ok()? != 0.0
        || setup.parameter("partner_damping").ok()? != 0.0;
    if is_bound {
        return None;
    }
    let load = LoadStep::from_setup(&setup).ok()?;
    // A load that acts from before the start acts from the start on.
    let from = (load.from - t_start).max(0.0);
    let own = OscillatorParameters::from_setup(&setup).ok()?;
    Some((own, LoadStep { from, ..load }))
}
