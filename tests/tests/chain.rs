//! The hanging chain, one worker a link: against its monolithic solution, and how its cost grows with the number of links.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::{Connector, Place};
use linchpin_master::CoSimulation;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_master::system::solve::LinearSolver;
use linchpin_models::reference::LinkMotion;
use linchpin_tests::chain::{reference, scene_text};
use linchpin_tests::hinges;
use linchpin_tests::runs::{Trajectory, run, try_run};
use linchpin_tests::scenes::with_settings;

const TIGHT: &str = "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-11, atol = 1e-11 }";

fn scene(links: usize, settings: &[&str]) -> Scene {
    with_settings(&scene_text(links), "", settings)
}

#[test]
fn the_scenes_of_users_are_those_of_the_tests() {
    for (links, text) in [
        (2, include_str!("../../scenes/chain/2.toml")),
        (8, include_str!("../../scenes/chain/8.toml")),
        (64, include_str!("../../scenes/chain/64.toml")),
    ] {
        assert!(text == scene_text(links), "scenes/chain/{links}.toml");
    }
}

/// The last one has a sparse coupling system.
#[test]
fn angles_and_forces_are_those_of_the_monolithic_chain() {
    for (n, t_end) in [(2, 0.3), (3, 0.3), (5, 0.3), (8, 0.3), (24, 0.1)] {
        let trajectory = run(
            &scene(n, &[&format!("scene.t_end={t_end}"), TIGHT]),
            Place::InProcess,
        );
        let motions = reference(n).motions(&trajectory.column("t")).unwrap();
        for link in 0..n {
            let found = trajectory.column(&format!("link{}.angle", link + 1));
            let off = |(found, motion): (&f64, &LinkMotion)| (found - motion.angles[link]).abs();
            let worst = found.iter().zip(&motions).map(off).fold(0.0, f64::max);
            assert!(worst < 1e-7, "n = {n}, link {link}: {worst:e}");
        }
        for hinge in 1..n {
            let found = trajectory.column(&format!("hinge{hinge}.lambda.y"));
            let last = motions.last().unwrap().hinge_forces[hinge - 1][1];
            let off = (found.last().unwrap() - last).abs() / last.abs().max(1.0);
            assert!(off < 1e-3, "n = {n}, hinge {hinge}: {off:e}");
        }
    }
}

fn start(scene: &Scene) -> CoSimulation {
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    CoSimulation::start(scene, &mut connect, &Options::default()).unwrap()
}

#[test]
fn one_exchange_a_worker_and_macro_step_for_any_length() {
    for n in [2, 4, 8, 16, 32, 64] {
        let mut simulation = start(&scene(n, &["coupling.jacobian=every-step"]));
        let exchanges = |simulation: &CoSimulation| -> Vec<u64> {
            let subsystems = simulation.statistics().subsystems;
            subsystems.iter().map(|own| own.exchanges).collect()
        };
        let before = exchanges(&simulation);
        assert_eq!(before.len(), n);
        for step in 1..=3 {
            assert!(simulation.macro_step().unwrap());
            let expected: Vec<u64> = before.iter().map(|before| before + step).collect();
            assert_eq!(exchanges(&simulation), expected);
        }
    }
}

/// What is counted at a number of links.
fn assert_linear(what: &str, count: impl Fn(usize) -> usize) {
    let [short, middle, long] = [16, 32, 64].map(count);
    assert!(short > 0, "{what}");
    assert_eq!(long - middle, 2 * (middle - short), "{what}");
}

#[test]
fn what_a_macro_step_takes_grows_linearly_with_the_links() {
    assert_linear("entries of the Jacobian", |n| {
        hinges::pattern(n, &hinges::chain(n)).entries()
    });
    assert_linear("integrations", |n| {
        let mut simulation = start(&scene(n, &[]));
        let before = simulation.statistics().integrations;
        simulation.macro_step().unwrap();
        (simulation.statistics().integrations - before) as usize
    });
    assert_linear("numbers in the messages", |n| {
        let mut simulation = start(&scene(n, &[]));
        // The polynomials have their full degree.
        (0..3).for_each(|_| assert!(simulation.macro_step().unwrap()));
        let messages = |subsystem| {
            let (request, reply) = simulation.last_messages(subsystem).unwrap();
            let advance = &request.advance.as_ref().unwrap().signals;
            let predict = request.predict.as_ref().unwrap();
            let signals = advance
                .iter()
                .chain(&predict.signals)
                .chain(&predict.perturbed);
            let sent: usize = signals.map(|signal| signal.values.len()).sum();
            let perturbed: usize = reply.perturbed.iter().map(|one| one.values.len()).sum();
            sent + perturbed
        };
        (0..n).map(messages).sum()
    });
}

/// Bodies that hang on each other one by one, in a ring or as a tree keep the system sparse; a star fills it.
#[test]
fn the_system_is_sparse_where_few_bodies_meet() {
    let is_sparse =
        |hinges: &[[usize; 2]]| LinearSolver::new(&hinges::pattern(64, hinges)).is_sparse();
    assert!(is_sparse(&hinges::chain(64)));
    assert!(is_sparse(&hinges::ring(64)));
    assert!(is_sparse(&hinges::tree(64)));
    assert!(!is_sparse(&hinges::star(64)));
    assert!(!LinearSolver::new(&hinges::pattern(3, &hinges::chain(3))).is_sparse());
}

/// Large enough for a sparse coupling system: a twin hinge moves nothing, takes half of the load, and is told.
#[test]
fn a_redundant_hinge_of_a_long_chain_is_told() {
    let twin = "[[joint]]\nname = \"twin\"\nkind = \"atpoint\"\na = \"link12.end\"\nb = \"link13.start\"\n";
    let settings = &["scene.t_end=0.05"];
    let one = run(
        &with_settings(&scene_text(40), "", settings),
        Place::InProcess,
    );
    let two = run(
        &with_settings(&(scene_text(40) + twin), "", settings),
        Place::InProcess,
    );
    let last = |run: &Trajectory, name: &str| *run.column(name).last().unwrap();
    for name in ["link13.start_x", "link40.start_y"] {
        let off = (last(&two, name) - last(&one, name)).abs();
        assert!(off < 1e-9, "{name}: {off:e}");
    }
    let [twin, other] =
        ["twin", "hinge12"].map(|joint| two.column(&format!("{joint}.lambda.y"))[0]);
    assert!((twin - other).abs() < 1e-9 * other.abs(), "{twin} {other}");
    let told = &two.statistics.redundancy;
    assert_eq!(
        (told.conditions, &told.joints[..]),
        (2, &["hinge12".to_owned(), "twin".to_owned()][..])
    );
}
