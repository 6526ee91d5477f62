//! `scenes/hard` against closed forms and a monolithic solution.
//!
//! [`COMMAND`] prints the table of docs/evidence/step-size.md, and writes it with `LINCHPIN_WRITE=1`.

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_models::reference::{DoublePendulum, GroundHinge, Link};
use linchpin_tests::errors::closed_form;
use linchpin_tests::evidence;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;

/// Errors at the end and the largest ones over time, of all positions, each relative to the largest position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Error {
    end: f64,
    pub(super) largest: f64,
}

/// The positions of a scene and their exact values at all macro points of a run.
type Exact = fn(&Scene, &Trajectory) -> Vec<(Vec<f64>, Vec<f64>)>;

fn linear(scene: &Scene, trajectory: &Trajectory) -> Vec<(Vec<f64>, Vec<f64>)> {
    let exact = closed_form(scene);
    let column = |subsystem: &linchpin_master::scene::Subsystem| {
        let name = format!("{}.x", subsystem.name);
        let times = trajectory.column("t").into_iter();
        let exact = times.map(|t| exact(&name, t).unwrap()).collect();
        (trajectory.column(&name), exact)
    };
    scene.subsystems.iter().map(column).collect()
}

fn heavy_end(_: &Scene, trajectory: &Trajectory) -> Vec<(Vec<f64>, Vec<f64>)> {
    let link = |m, inertia, length| Link { m, inertia, length };
    let pendulum = DoublePendulum {
        links: [link(0.037, 0.002, 0.6), link(37.0, 1.9, 0.8)],
        hinge: GroundHinge {
            spring: 2.3e3,
            damping: 310.0,
            rest_angle: -0.2,
        },
        gravity: 9.81,
        angles: [-0.9, -1.3],
        rates: [0.0; 2],
    };
    let motions = pendulum.motions(&trajectory.column("t")).unwrap();
    let column = |number: usize| {
        let name = format!("link{}.angle", number + 1);
        let exact = motions.iter().map(|motion| motion.angles[number]);
        (trajectory.column(&name), exact.collect())
    };
    vec![column(0), column(1)]
}

fn error(exact: Exact, scene: &Scene, trajectory: &Trajectory) -> Error {
    let mut own = Error {
        end: 0.0,
        largest: 0.0,
    };
    for (found, exact) in exact(scene, trajectory) {
        let size = exact
            .iter()
            .fold(0.0, |size: f64, value| size.max(value.abs()));
        for (found, exact) in found.iter().zip(&exact) {
            own.end = (found - exact).abs() / size;
            own.largest = own.largest.max(own.end);
        }
    }
    own
}

/// Integrations with the longest fixed macro step, of those a quarter shorter each, that is as accurate.
fn cheapest_fixed(exact: Exact, scene: &Scene, wanted: f64) -> (f64, u64) {
    let mut scene = scene.clone().with_fixed_steps();
    scene.coupling.macro_step = 0.03 * scene.t_end;
    loop {
        let trajectory = try_run(&scene, Place::InProcess, &Options::default());
        if let Ok(trajectory) = trajectory
            && error(exact, &scene, &trajectory).largest <= wanted
        {
            return (scene.coupling.macro_step, trajectory.integrations);
        }
        scene.coupling.macro_step *= 0.75;
    }
}

/// A hard scene and how the errors of its positions are found.
pub(super) struct Hard {
    pub(super) name: &'static str,
    text: &'static str,
    exact: Exact,
}

const STIFF_SPRING: Hard = Hard {
    name: "stiff-spring",
    text: include_str!("../../../scenes/hard/stiff-spring.toml"),
    exact: linear,
};

const PRELOADED_SPRING: Hard = Hard {
    name: "preloaded-spring",
    text: include_str!("../../../scenes/hard/preloaded-spring.toml"),
    exact: linear,
};

const MASS_RATIO: Hard = Hard {
    name: "mass-ratio",
    text: include_str!("../../../scenes/hard/mass-ratio.toml"),
    exact: linear,
};

const HEAVY_END: Hard = Hard {
    name: "heavy-end",
    text: include_str!("../../../scenes/hard/heavy-end.toml"),
    exact: heavy_end,
};

pub(super) const LOAD_STEP: Hard = Hard {
    name: "load-step",
    text: include_str!("../../../scenes/hard/load-step.toml"),
    exact: linear,
};

/// Time at which the load of [`LOAD_STEP`] sets in.
pub(super) const LOADED_FROM: f64 = 0.9137;

const METHODS: [&str; 5] = [
    "method=weighted degree=1",
    "method=weighted degree=2",
    "method=weighted degree=3",
    "method=baumgarte degree=2",
    "method=hermite",
];

/// A run with variable steps that meets its tolerance.
pub(super) struct Sound {
    pub(super) context: String,
    pub(super) scene: Scene,
    pub(super) trajectory: Trajectory,
    pub(super) error: Error,
}

/// A run that takes at least about so many integrations, by a shorter macro step if need be; `None` if it does not reach its end.
fn costing(fixed: &mut Scene, least: f64) -> Option<Trajectory> {
    loop {
        let trajectory = try_run(fixed, Place::InProcess, &Options::default()).ok()?;
        let share = trajectory.integrations as f64 / least;
        if share > 0.8 {
            return Some(trajectory);
        }
        fixed.coupling.macro_step *= share;
    }
}

impl Hard {
    pub(super) fn run(&self, coupling: &str, tolerance: f64) -> Sound {
        let coupling = format!("{coupling} tolerance={tolerance:e}");
        let scene = with_settings(self.text, &coupling, &[]);
        let trajectory = run(&scene, Place::InProcess);
        let error = error(self.exact, &scene, &trajectory);
        let context = format!("{}, {coupling}: {error:?}", self.name);
        assert!(error.largest <= 10.0 * tolerance, "{context}");
        assert!(error.largest >= 1e-4 * tolerance, "{context}: too careful");
        Sound {
            context,
            scene,
            trajectory,
            error,
        }
    }

    /// A fixed macro step that takes `times` as many integrations is less accurate.
    fn check(&self, methods: &[&str], times: f64) {
        for coupling in methods {
            for tolerance in [1e-4, 1e-6] {
                let own = self.run(coupling, tolerance);
                let mut fixed = own.scene.clone().with_fixed_steps();
                let steps = (own.trajectory.rows.len() - 1) as f64;
                fixed.coupling.macro_step = fixed.t_end / (times * steps);
                let least = times * own.trajectory.integrations as f64;
                let Some(trajectory) = costing(&mut fixed, least) else {
                    continue;
                };
                let error = error(self.exact, &fixed, &trajectory);
                assert!(
                    error.largest > own.error.largest,
                    "{}: {error:?}",
                    own.context
                );
            }
        }
    }

    /// Rows of the table of docs/evidence/step-size.md.
    fn rows(&self, table: &mut String) {
        for coupling in METHODS {
            let method = coupling
                .trim_start_matches("method=")
                .replace(" degree=", ", k = ");
            for tolerance in [1e-4, 1e-6, 1e-8] {
                let own = self.run(coupling, tolerance);
                let (step, fixed) = cheapest_fixed(self.exact, &own.scene, own.error.largest);
                *table += &format!(
                    "| {} | {method} | {tolerance:e} | {:.1e} | {:.1e} | {} | {} | {} | {step:.1e} | {fixed} |\n",
                    self.name,
                    own.error.largest,
                    own.error.end,
                    own.trajectory.rows.len() - 1,
                    own.trajectory.rejected,
                    own.trajectory.integrations,
                );
            }
        }
    }
}

/// All of them.
pub(super) const ALL: [Hard; 5] = [
    STIFF_SPRING,
    PRELOADED_SPRING,
    MASS_RATIO,
    HEAVY_END,
    LOAD_STEP,
];

#[test]
fn a_stiff_spring() {
    STIFF_SPRING.check(&METHODS, 1.3);
}

#[test]
fn a_preloaded_spring() {
    PRELOADED_SPRING.check(&METHODS, 20.0);
}

/// Hermite coupling judges the velocity of the gram as well, whose vibration it resolves: equal steps cost it no more.
#[test]
fn masses_of_a_gram_and_a_ton() {
    MASS_RATIO.check(&METHODS[..4], 1.2);
    for tolerance in [1e-4, 1e-6] {
        MASS_RATIO.run("method=hermite", tolerance);
    }
}

#[test]
fn a_chain_with_a_heavy_end() {
    HEAVY_END.check(&METHODS, 2.0);
}

#[test]
fn a_load_that_sets_in_at_once() {
    LOAD_STEP.check(&METHODS, 2.0);
}

/// Every step of a swing that drives the joint open in one direction is allowed as much as any other; all together too.
#[test]
fn a_joint_does_not_open_step_by_step() {
    let own = HEAVY_END.run("method=weighted degree=1", 1e-8);
    for direction in ["x", "y"] {
        let openings = own
            .trajectory
            .column(&format!("hinge.residual.position.{direction}"));
        let largest = openings
            .iter()
            .fold(0.0, |most: f64, at| most.max(at.abs()));
        assert!(largest < 1e-8, "{}: {largest:e}", own.context);
    }
}

/// The step is short where the load sets in, after few attempts, and as long as before soon after.
#[test]
fn steps_grow_again_after_a_jump() {
    for coupling in METHODS {
        for tolerance in [1e-4, 1e-6] {
            let own = LOAD_STEP.run(coupling, tolerance);
            let (t, steps) = (own.trajectory.column("t"), own.trajectory.column("step"));
            let of = |place: usize| (t[place] - steps[place], t[place], steps[place]);
            let all = || (1..t.len()).map(of);
            let inside = all().find(|(from, to, _)| *from < LOADED_FROM && LOADED_FROM < *to);
            let (from, to, across) = inside.unwrap();
            assert!(
                LOADED_FROM - from > 0.0 && to > LOADED_FROM,
                "{}",
                own.context
            );
            let longest = |from: f64, to: f64| {
                let within = all().filter(|(start, end, _)| *start > from && *end < to);
                within.map(|(.., step)| step).fold(0.0, f64::max)
            };
            let (before, after) = (longest(0.7, LOADED_FROM), longest(LOADED_FROM, 1.3));
            let context = format!("{}: {before:e} {across:e} {after:e}", own.context);
            assert!(across < 0.5 * before, "{context}");
            assert!(after > 0.2 * before && after > 3.0 * across, "{context}");
            assert!(
                own.trajectory.rejected < 60,
                "{context}, {} rejected",
                own.trajectory.rejected
            );
        }
    }
}

const COMMAND: &str = "cargo test --release -p linchpin-tests --test step_size -- --ignored --nocapture table_of_hard_scenes";

#[test]
#[ignore = "prints a table of docs/evidence/step-size.md"]
fn table_of_hard_scenes() {
    let mut table = String::from(
        "| scene | method | tolerance | largest error | at the end | steps | rejected | integrations | fixed H \
         | integrations |\n|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for scene in ALL {
        scene.rows(&mut table);
    }
    evidence::show("step-size.md", "hard scenes", COMMAND, &table);
}
