//! The rod of the flexible slider-crank: closed forms, structure of its matrices, mistakes in its description.

use linchpin_models::nonsmooth::system::MechanicalSystem;
use linchpin_models::nonsmooth::systems::flexible_slider_crank::{
    ANGLES, FlexibleMechanism, FlexibleSliderCrank,
};
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism};
use linchpin_models::nonsmooth::systems::rod::{Rectangle, Reference, RodError};

use super::golden_flexible::STEEL;

const ELEMENTS: usize = 4;

fn system(mechanism: FlexibleMechanism) -> FlexibleSliderCrank {
    FlexibleSliderCrank::new(mechanism, Guide::Free).unwrap()
}

#[test]
fn frequencies_of_beams() {
    let mut mechanism = FlexibleMechanism::of(&Mechanism::table_1(), 40, STEEL).unwrap();
    mechanism.rod.modes = Some(4);
    let rod = mechanism.rod;
    let bending = (rod.youngs_modulus * rod.section.second_moment * rod.length / rod.mass()).sqrt()
        / rod.length.powi(2);
    let along = (rod.youngs_modulus / rod.density).sqrt() / rod.length;
    let pi = std::f64::consts::PI;
    // Clamped and free: roots of cos x cosh x = -1, and a quarter wave along. Pinned at both ends: half waves.
    let clamped: [f64; 2] = [1.875104068711961, 4.694091132974175];
    let clamped = [
        clamped[0].powi(2) * bending,
        0.5 * pi * along,
        1.5 * pi * along,
        clamped[1].powi(2) * bending,
    ];
    let pinned = [
        pi * pi * bending,
        0.5 * pi * along,
        1.5 * pi * along,
        2.5 * pi * along,
    ];
    for (reference, mut expected) in [
        (Reference::Tangential, clamped),
        (Reference::Pinned, pinned),
    ] {
        mechanism.rod.reference = reference;
        expected.sort_by(f64::total_cmp);
        let system = system(mechanism);
        for (own, expected) in system.body().angular_frequencies().iter().zip(expected) {
            assert!(
                (own / expected - 1.0).abs() < 2e-3,
                "{reference:?}: {own:e} {expected:e}"
            );
        }
    }
}

/// `w = c x^2` has the moment `2 E I c` everywhere.
#[test]
fn moment_at_the_root() {
    let system = system(FlexibleMechanism::of(&Mechanism::table_1(), ELEMENTS, STEEL).unwrap());
    let rod = system.mechanism().rod;
    let mut q = vec![0.0; system.shape().order()];
    for node in 1..rod.nodes() {
        let x = rod.length * node as f64 / rod.elements as f64;
        q[ANGLES + 3 * node - 2] = 0.1 * x * x;
        q[ANGLES + 3 * node - 1] = 0.2 * x;
    }
    let expected = 0.2 * rod.youngs_modulus * rod.section.second_moment;
    assert!((system.root_moment(&q) / expected - 1.0).abs() < 1e-12);
    let end = system.nodes(&q)[rod.elements];
    let slider = system.slider(&q);
    assert!((end[0] - slider[0]).abs() < 1e-15 && (end[1] - slider[1]).abs() < 1e-15);
}

/// Numbers that are kept do not grow faster than the elements.
#[test]
fn bands_do_not_widen() {
    for elements in [2, 21, 80] {
        for reference in [Reference::Tangential, Reference::Pinned] {
            let mut form = FlexibleMechanism::of(&Mechanism::table_1(), elements, STEEL).unwrap();
            form.rod.reference = reference;
            let shape = system(form).shape();
            assert_eq!((shape.border, shape.banded), (3, 3 * elements));
            assert_eq!(shape.half_bandwidth, 4);
            form.rod.modes = Some(6);
            let shape = system(form).shape();
            assert_eq!((shape.banded, shape.half_bandwidth), (6, 0));
        }
    }
}

#[test]
fn mistakes() {
    let good = FlexibleMechanism::of(&Mechanism::table_1(), 2, STEEL).unwrap();
    let error = |change: &dyn Fn(&mut FlexibleMechanism)| {
        let mut mechanism = good;
        change(&mut mechanism);
        FlexibleSliderCrank::new(mechanism, Guide::Free)
            .unwrap_err()
            .to_string()
    };
    assert!(error(&|m| m.rod.elements = 0).contains("no elements"));
    assert!(error(&|m| m.rod.modes = Some(7)).contains("6 modes"));
    assert!(error(&|m| m.rod.modes = Some(0)).contains("1 to 6"));
    assert!(error(&|m| m.rod.youngs_modulus = f64::NAN).contains("Young's modulus"));
    assert!(error(&|m| m.rod.material_damping = -1.0).contains("damping"));
    let thin = Rectangle::of_inertia(0.038, 2e-4, 0.306, 7800.0);
    assert!(matches!(thin, Err(RodError::TooThin { .. })));
}
