//! What impacts cost, and what goes over the wire.

use linchpin::connect::{Connector, Place};
use linchpin_master::CoSimulation;
use linchpin_master::setup::Options;
use linchpin_proto::v1::{ExchangeRequest, Impact};

use crate::{SPLIT, here, scene};

/// Before the first impact nothing is different, neither in cost nor in bits, from where forces alone cross the joint.
#[test]
fn steps_without_impacts_cost_nothing_more() {
    let before = ["scene.t_end=2.6e-3"];
    let forces = ["scene.t_end=2.6e-3", "coupling.impacts=forces"];
    let [own, forces] = [&before[..], &forces[..]].map(|more| here(SPLIT, more));
    assert_eq!(own.bits(), forces.bits());
    let cost = |run: &linchpin_tests::runs::Trajectory| {
        let all = &run.statistics;
        (all.exchanges, all.integrations_by_cause, all.solver_steps)
    };
    assert_eq!(cost(&own), cost(&forces));
    assert_eq!(own.statistics.corrections.steps_with_impacts, 0);
}

/// The impacts that the last advance of each subsystem had.
fn advanced(simulation: &CoSimulation) -> [Vec<Impact>; 2] {
    [0, 1].map(|subsystem| {
        let (request, _): (&ExchangeRequest, _) = simulation.last_messages(subsystem).unwrap();
        let impacts = request.advance.as_ref().unwrap().impacts.clone();
        impacts.map_or_else(Vec::new, |own| own.impacts)
    })
}

/// An impact takes at most three exchanges. Both advances have the same impulses at the same instants, with opposite signs: momentum goes
/// from one to the other without loss.
#[test]
fn impulses_are_opposite_to_the_last_bit() {
    let scene = scene(SPLIT, &["scene.t_end=0.0305"]);
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &_, subsystem: &_| connector.connect(scene, subsystem);
    let mut simulation = CoSimulation::start(&scene, &mut connect, &Options::default()).unwrap();
    let mut exchanges = simulation.statistics().exchanges;
    let (mut struck, mut several) = (0, 0);
    while simulation.macro_step().unwrap() {
        let now = simulation.statistics().exchanges;
        let taken = now - std::mem::replace(&mut exchanges, now);
        let [crank, slider] = advanced(&simulation);
        if slider.is_empty() {
            assert!(crank.is_empty());
            continue;
        }
        struck += 1;
        several += usize::from(slider.len() > 1);
        assert!(taken <= 2 * 3, "{taken} exchanges of two workers");
        assert_eq!(crank.len(), slider.len());
        for (a, b) in crank.iter().zip(&slider) {
            assert_eq!(a.at.to_bits(), b.at.to_bits());
            assert!(a.contacts.is_empty() && !b.contacts.is_empty());
            let [fx, fy] = [a.loads[0], a.loads[1]];
            assert!(fx.abs() + fy.abs() > 0.0);
            assert_eq!([-fx, -fy], [b.loads[0], b.loads[1]]);
        }
    }
    assert!(struck > 8 && several > 0, "{struck} {several}");
    assert_eq!(
        simulation.statistics().corrections.steps_with_impacts,
        struck
    );
}
