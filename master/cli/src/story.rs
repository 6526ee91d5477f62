//! The story of a run in the log: how it begins, where it stands after every tenth, and how it ends.

use std::time::Instant;

use linchpin_master::CoSimulation;
use linchpin_master::scene::Scene;

/// Parts of a run after which its story goes on.
const PARTS: f64 = 10.0;

/// What the log has been told of a run.
pub(crate) struct Story {
    start: f64,
    span: f64,
    began: Instant,
    /// Parts of the run that have been told.
    told: f64,
}

impl Story {
    /// Tells how the run begins; `None` if nobody listens.
    pub fn begin(scene: &Scene) -> Option<Self> {
        if !tracing::enabled!(tracing::Level::INFO) {
            return None;
        }
        tracing::info!(
            scene = scene.name,
            subsystems = scene.subsystems.len(),
            joints = scene.joints.len(),
            connections = scene.connections.len(),
            method = ?scene.coupling.method,
            t_start = scene.t_start,
            t_end = scene.t_end,
            H = scene.coupling.macro_step,
            "coupled"
        );
        Some(Self {
            start: scene.t_start,
            span: scene.t_end - scene.t_start,
            began: Instant::now(),
            told: 0.0,
        })
    }

    /// Tells where the run stands, if another part of it is done.
    pub fn go_on(&mut self, simulation: &CoSimulation) {
        let part = (PARTS * (simulation.t() - self.start) / self.span).floor();
        if part <= self.told || simulation.is_finished() {
            return;
        }
        self.told = part;
        self.tell(simulation, "at");
    }

    /// Tells how the run ended.
    pub fn end(&self, simulation: &CoSimulation) {
        self.tell(simulation, "finished");
    }

    fn tell(&self, simulation: &CoSimulation, what: &str) {
        let statistics = simulation.statistics();
        let corrections = &statistics.corrections;
        tracing::info!(
            t = simulation.t(),
            steps = statistics.macro_steps,
            rejected = statistics.steps.map(|steps| steps.rejected),
            jacobian_refreshes = corrections.steps_with_columns,
            passes = corrections.passes,
            exchanges = statistics.exchanges,
            integrations = statistics.integrations,
            seconds = self.began.elapsed().as_secs_f64(),
            "{what}"
        );
    }
}
