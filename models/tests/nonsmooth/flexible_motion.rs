//! Runs of the flexible slider-crank against what must hold: the rigid limit, independence of the description, energy.

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::system::MechanicalSystem;
use linchpin_models::nonsmooth::systems::flexible_slider_crank::{
    ANGLES, FlexibleMechanism, FlexibleSliderCrank,
};
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism, RigidSliderCrank};
use linchpin_models::nonsmooth::systems::rod::{Reference, RotaryInertia};

use super::golden_flexible::{STEEL, TABLE_1, TABLE_2};
use super::stand::Stand;

const DT: f64 = 1e-5;
const DENSITY: f64 = 7800.0;
const ENERGY_DECAYING: SchemeKind = SchemeKind::EdAlpha {
    rho_inf: 0.0,
    alpha_ar: 1.0 / 6.0,
};

/// A run and its system, for what is derived from the state.
struct Run {
    system: FlexibleSliderCrank,
    stand: Stand,
}

impl Run {
    fn new(mechanism: FlexibleMechanism, guide: Guide, scheme: SchemeKind, w: [f64; 2]) -> Self {
        let system = FlexibleSliderCrank::new(mechanism, guide).unwrap();
        let n = system.shape().order();
        let (q, mut v) = (vec![0.0; n], vec![0.0; n]);
        v[..2].copy_from_slice(&w);
        let stand = Stand::new(system.clone(), scheme, Settings::default(), [&q, &v]);
        Self { system, stand }
    }

    fn slider(&self) -> [f64; 2] {
        self.system.slider(self.stand.q())
    }

    fn nodal(&self) -> Vec<f64> {
        let mut nodal = vec![0.0; self.system.nodal_count()];
        self.system.write_nodal(self.stand.q(), &mut nodal);
        nodal
    }
}

fn table_2(elements: usize) -> FlexibleMechanism {
    FlexibleMechanism::of(&Mechanism::table_2(), elements, STEEL).unwrap()
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// With a rod of 1e15 N/m^2 the mechanism is the rigid one (S2 Fig. 21), whose first impact is at 2.6925 ms. What is
/// left before it comes from the start: there the rod has no strain yet.
#[test]
fn stiff_rod_is_rigid() {
    let rigid = Mechanism::table_1();
    let guide = Guide::Clearance(TABLE_1);
    let dt = 1e-6;
    for reference in [Reference::Tangential, Reference::Pinned] {
        let mut mechanism = FlexibleMechanism::of(&rigid, 2, [1e15, DENSITY]).unwrap();
        mechanism.rod.reference = reference;
        let mut flexible = Run::new(mechanism, guide, SchemeKind::Bathe, [150.0, -75.0]);
        let system = RigidSliderCrank::new(rigid, guide);
        let start: [&[f64]; 2] = [&[0.0; 3], &[150.0, -75.0, 0.0]];
        let mut stand = Stand::new(system, SchemeKind::Bathe, Settings::default(), start);
        flexible.stand.steps(2690, dt);
        stand.steps(2690, dt);
        let own = &flexible.stand.q()[..ANGLES];
        assert!(largest_difference(own, stand.q()) < 2e-7);
        let own = &flexible.stand.v()[..ANGLES];
        assert!(largest_difference(own, stand.v()) < 1e-3);
        flexible.stand.steps(5, dt);
        let first = flexible.stand.integrator.log.first_impact.unwrap();
        assert!((first - 2.693e-3).abs() < 1e-9, "{first}");
    }
}

/// Largest difference of the slider's height before the first impact of Table 2, as a share of the clearance.
fn share_of_clearance(rotary_inertia: RotaryInertia) -> f64 {
    let [mut tangential, mut pinned] =
        [Reference::Tangential, Reference::Pinned].map(|reference| {
            let mut mechanism = table_2(4);
            mechanism.rod.reference = reference;
            mechanism.rod.rotary_inertia = rotary_inertia;
            let guide = Guide::Clearance(TABLE_2);
            Run::new(mechanism, guide, SchemeKind::Bathe, [0.0; 2])
        });
    let mut largest = 0.0_f64;
    for _ in 0..740 {
        tangential.stand.step(DT);
        pinned.stand.step(DT);
        largest = largest.max((tangential.slider()[1] - pinned.slider()[1]).abs());
    }
    largest / tangential.system.mechanism().notch.clearance
}

/// The motion does not depend on the reference if all integrals are those of the same particles; with the rotary
/// inertia of the frame it does, a little.
#[test]
fn tangential_and_pinned() {
    let consistent = share_of_clearance(RotaryInertia::Consistent);
    assert!(consistent < 3e-9, "{consistent:e}");
    let frame = share_of_clearance(RotaryInertia::Frame);
    assert!((3e-5..5e-5).contains(&frame), "{frame:e}");
}

/// Through impacts.
#[test]
fn all_modes_are_all_nodal_values() {
    for reference in [Reference::Tangential, Reference::Pinned] {
        let mut mechanism = table_2(4);
        mechanism.rod.reference = reference;
        let guide = Guide::Clearance(TABLE_2);
        let mut nodal = Run::new(mechanism, guide, ENERGY_DECAYING, [0.0; 2]);
        mechanism.rod.modes = Some(12);
        let mut modal = Run::new(mechanism, guide, ENERGY_DECAYING, [0.0; 2]);
        nodal.stand.steps(1000, DT);
        modal.stand.steps(1000, DT);
        let angles = [&nodal, &modal].map(|run| run.stand.q()[..ANGLES].to_vec());
        assert!(largest_difference(&angles[0], &angles[1]) < 1e-13);
        let displacements = [nodal.nodal(), modal.nodal()];
        let size = largest_difference(&displacements[0], &[0.0; 15]);
        assert!(size > 1e-6);
        assert!(largest_difference(&displacements[0], &displacements[1]) < 1e-10 * size);
        let impacts = [&nodal, &modal].map(|run| run.stand.integrator.log.impacts);
        assert!(impacts[0] == impacts[1] && impacts[0] > 0);
    }
}

/// Share of the energy that the schemes take in 0.05 s without contact.
#[test]
fn energy_that_schemes_take() {
    let schemes = [
        (SchemeKind::GeneralizedAlpha { rho_inf: 0.8 }, -6.1e-5),
        (SchemeKind::Bathe, -1.42e-4),
        (ENERGY_DECAYING, -4.87e-4),
    ];
    for (scheme, expected) in schemes {
        let mechanism = FlexibleMechanism::of(&Mechanism::table_1(), 4, STEEL).unwrap();
        let mut run = Run::new(mechanism, Guide::Free, scheme, [150.0, -75.0]);
        let before = run.stand.integrator.energy();
        run.stand.steps(5000, DT);
        let taken = run.stand.integrator.energy() / before - 1.0;
        assert!(
            (taken / expected - 1.0).abs() < 0.01,
            "{scheme:?}: {taken:e}"
        );
    }
}

/// The rod hangs on a hinge: no moment there, up to the elements; with the tangential frame and its rotary inertia
/// there is what turns all sections.
#[test]
fn moment_at_the_hinge() {
    let moment = |elements: usize, reference: Reference, rotary_inertia: RotaryInertia| {
        let mut mechanism = table_2(elements);
        mechanism.rod.reference = reference;
        mechanism.rod.rotary_inertia = rotary_inertia;
        mechanism.rod.material_damping = 1e-5;
        let rod = mechanism.rod;
        let mut run = Run::new(mechanism, Guide::Free, ENERGY_DECAYING, [0.0; 2]);
        run.stand.steps(600, DT);
        let turning = rod.density * rod.section.second_moment * rod.length;
        run.system.root_moment(run.stand.q()) / (turning * run.stand.integrator.state.a[1])
    };
    for reference in [Reference::Tangential, Reference::Pinned] {
        let [coarse, fine] =
            [8, 16].map(|elements| moment(elements, reference, RotaryInertia::Consistent).abs());
        assert!(
            fine < 5e-3 && (3.5..4.5).contains(&(coarse / fine)),
            "{coarse} {fine}"
        );
    }
    let frame = moment(16, Reference::Tangential, RotaryInertia::Frame);
    assert!((frame - 1.0).abs() < 5e-3, "{frame}");
}

/// The fixed point of every step converges in steps of 1e-4 s: S2 Fig. 28, Table 2 up to 0.5 s.
#[test]
fn large_steps() {
    for scheme in [SchemeKind::Bathe, ENERGY_DECAYING] {
        for modes in [None, Some(6)] {
            let mut mechanism = table_2(10);
            mechanism.rod.modes = modes;
            let guide = Guide::Clearance(TABLE_2);
            let mut run = Run::new(mechanism, guide, scheme, [0.0; 2]);
            run.stand.steps(5000, 1e-4);
            let integrator = &run.stand.integrator;
            let counters = integrator.mechanics.counters;
            assert!(counters.iterations < 10 * counters.steps);
            assert!(integrator.log.penetration < 3e-4);
            // The work of the torque is in the motion, or impacts and friction took it; the scheme took little.
            let given = run.system.mechanism().torque * integrator.state.q[0];
            let log = integrator.log;
            let found = integrator.energy() + log.impact_loss + log.friction_loss;
            assert!(
                (0.95..1.01).contains(&(found / given)),
                "{found} of {given}"
            );
        }
    }
}
