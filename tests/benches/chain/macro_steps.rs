//! The macro step of a chain.

use std::time::Instant;

use linchpin::connect::{Connector, Place};
use linchpin_master::CoSimulation;
use linchpin_master::setup::Options;
use linchpin_tests::chain::scene_text;
use linchpin_tests::scenes::with_settings;

use crate::{BLOCKS, LINKS};

/// Steps until all memory has been taken.
const WARM_UP: usize = 20;

/// A chain on its way.
pub struct Running {
    simulation: CoSimulation,
    place: Place,
    // Kept: it ends the workers.
    _connector: Connector,
}

/// What one macro step takes, in us.
#[derive(Clone, Copy)]
pub struct Cost {
    pub links: usize,
    /// Exchanges per worker.
    exchanges: f64,
    /// Assembling the system and solving it.
    pub solving: f64,
    /// All that the master does: also judging, recording, messages.
    pub master: f64,
    /// From one macro point to the next.
    pub whole: f64,
}

impl Running {
    pub fn start(links: usize, place: Place, settings: &[&str]) -> Self {
        // Columns in every step: the same work in every block.
        let settings = [&["coupling.jacobian=every-step"], settings].concat();
        let scene = with_settings(&scene_text(links), "", &settings);
        let connector = Connector::new(place);
        let mut connect = |scene: &_, subsystem: &_| connector.connect(scene, subsystem);
        let simulation = CoSimulation::start(&scene, &mut connect, &Options::default()).unwrap();
        Self {
            simulation,
            place,
            _connector: connector,
        }
    }

    pub fn steps(&mut self, count: usize) {
        for _ in 0..count {
            assert!(self.simulation.macro_step().unwrap());
        }
    }

    fn block(&mut self, steps: usize) -> Cost {
        let before = self.simulation.statistics();
        let (started, busy) = (Instant::now(), busy());
        self.steps(steps);
        let (whole, busy) = (started.elapsed().as_secs_f64(), self::busy() - busy);
        let after = self.simulation.statistics();
        let links = after.subsystems.len();
        let master = match self.place {
            // The workers of other processes are not on this thread.
            Place::Processes => busy,
            _ => whole - (after.time_in_solvers - before.time_in_solvers),
        };
        let each = 1e6 / steps as f64;
        Cost {
            links,
            exchanges: (after.exchanges - before.exchanges) as f64 / (links * steps) as f64,
            solving: (after.time_solving - before.time_solving) * each,
            master: master * each,
            whole: whole * each,
        }
    }
}

/// Time in s that this thread has had a core, which the system counts in ns.
fn busy() -> f64 {
    let line = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    let nanoseconds: f64 = line.split(' ').next().unwrap().parse().unwrap();
    nanoseconds * 1e-9
}

/// What a macro step of so many links takes with these settings beside columns in every step.
pub fn measure(links: usize, place: Place, settings: &[&str]) -> Cost {
    let mut running = Running::start(links, place, &[&["scene.t_end=1e3"], settings].concat());
    running.steps(WARM_UP);
    let blocks = (0..BLOCKS).map(|_| running.block(512 / links));
    let least = |one: Cost, other: Cost| Cost {
        links,
        exchanges: one.exchanges.max(other.exchanges),
        solving: one.solving.min(other.solving),
        master: one.master.min(other.master),
        whole: one.whole.min(other.whole),
    };
    blocks.reduce(least).unwrap()
}

/// Shows and returns the costs of all lengths, with the workers in this process and in processes of their own.
pub fn show() -> [Vec<Cost>; 2] {
    let costs = [Place::InProcess, Place::Processes]
        .map(|place| LINKS.map(|links| measure(links, place, &[])).to_vec());
    let mut table = String::from(
        "| links | exchanges per worker | in process: assemble and solve | master | whole \
         | processes: assemble and solve | master | whole |\n|---|---|---|---|---|---|---|---|\n",
    );
    for (inside, outside) in costs[0].iter().zip(&costs[1]) {
        table += &format!(
            "| {} | {} |",
            inside.links,
            inside.exchanges.max(outside.exchanges)
        );
        for cost in [inside, outside] {
            table += &format!(
                " {:.1} | {:.0} | {:.0} |",
                cost.solving, cost.master, cost.whole
            );
        }
        table.push('\n');
    }
    crate::show("macro step", &table);
    costs
}
