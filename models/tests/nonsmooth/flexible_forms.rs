//! Equations of the flexible slider-crank at an instant, against an independent quadrature of the kinetic energy,
//! Lagrange's equations by differences, and closed forms.

use linchpin_models::nonsmooth::matrix::{BorderedBand, Factors};
use linchpin_models::nonsmooth::system::{Instant, MechanicalSystem, rows};
use linchpin_models::nonsmooth::systems::flexible_slider_crank::{
    ANGLES, FlexibleMechanism, FlexibleSliderCrank,
};
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism};
use linchpin_models::nonsmooth::systems::rod::{Reference, Rod, RotaryInertia};

use super::golden_flexible::TABLE_1;
use super::quadrature::{kinetic_energy, potential_energy};

const ELEMENTS: usize = 4;
/// So soft that differences of energies keep their digits; all forms are linear in Young's modulus.
const SOFT: [f64; 2] = [2e5, 7800.0];

/// The mechanism of Table 2 in all forms that its rod can have.
fn all_forms() -> Vec<FlexibleMechanism> {
    let mut forms = Vec::new();
    for reference in [Reference::Tangential, Reference::Pinned] {
        for rotary_inertia in [RotaryInertia::Frame, RotaryInertia::Consistent] {
            for modes in [None, Some(5)] {
                let mut form =
                    FlexibleMechanism::of(&Mechanism::table_2(), ELEMENTS, SOFT).unwrap();
                form.rod.reference = reference;
                form.rod.rotary_inertia = rotary_inertia;
                form.rod.modes = modes;
                form.rod.material_damping = 1e-2;
                forms.push(form);
            }
        }
    }
    forms
}

fn system(mechanism: FlexibleMechanism) -> FlexibleSliderCrank {
    FlexibleSliderCrank::new(mechanism, Guide::Clearance(TABLE_1)).unwrap()
}

/// Coordinates and velocities of moderate size: large angles, displacements of centimetres.
fn somewhere(system: &FlexibleSliderCrank) -> [Vec<f64>; 2] {
    let n = system.shape().order();
    let number = |i: usize, seed: f64| (12.9898 * (i as f64 + seed)).sin();
    // What the deformation is in each coordinate so that the nodes move alike, with modes and without.
    let size = if system.mechanism().rod.modes.is_some() {
        1e-3
    } else {
        1e-2
    };
    let scaled =
        |i: usize, seed: f64, size: f64| number(i, seed) * if i < ANGLES { 1.0 } else { size };
    [
        (0..n).map(|i| scaled(i, 0.5, size)).collect(),
        (0..n).map(|i| scaled(i, 7.25, 10.0 * size)).collect(),
    ]
}

fn mass(system: &FlexibleSliderCrank, q: &[f64]) -> BorderedBand {
    let mut mass = BorderedBand::zeros(system.shape());
    system.mass(q, &mut mass);
    mass
}

fn moved(q: &[f64], by: f64, along: &[f64]) -> Vec<f64> {
    q.iter()
        .zip(along)
        .map(|(q, along)| q + by * along)
        .collect()
}

fn force(system: &FlexibleSliderCrank, q: &[f64], v: &[f64], inputs: &[f64]) -> Vec<f64> {
    let mut force = vec![0.0; q.len()];
    let at = Instant {
        t: 0.0,
        q,
        v,
        inputs,
    };
    system.force(at, &mut force);
    force
}

fn unit(n: usize, place: usize) -> Vec<f64> {
    let mut unit = vec![0.0; n];
    unit[place] = 1.0;
    unit
}

#[test]
fn mass_matrix_is_that_of_the_kinetic_energy() {
    for form in all_forms() {
        let system = system(form);
        let [q, v] = somewhere(&system);
        let (n, mass) = (q.len(), mass(&system, &q));
        let energy = |v: &[f64]| kinetic_energy(&system, &q, v);
        for i in 0..n {
            for j in 0..n {
                let (own, other) = (unit(n, i), unit(n, j));
                let both = energy(&moved(&own, 1.0, &other));
                let expected = both - energy(&own) - energy(&other);
                let size = (mass.get(i, i) * mass.get(j, j)).sqrt();
                let error = (mass.get(i, j) - expected).abs();
                assert!(error <= 1e-12 * size, "{:?} {i} {j}: {error:e}", form.rod);
            }
        }
        let expected = energy(&v) + potential_energy(&system, &q);
        let error = (system.energy(&q, &v) / expected - 1.0).abs();
        assert!(error <= 1e-12, "{:?}: {error:e}", form.rod);
    }
}

/// `f = -dM/dt v + dT/dq - dV/dq + Q`, with central differences.
#[test]
fn forces_are_those_of_lagrange() {
    for form in all_forms() {
        let system = system(FlexibleMechanism {
            rod: Rod {
                material_damping: 0.0,
                ..form.rod
            },
            ..form
        });
        let [q, v] = somewhere(&system);
        let n = q.len();
        let step = 1e-5;
        let mut expected = vec![0.0; n];
        for side in [1.0, -1.0] {
            mass(&system, &moved(&q, side * step, &v)).multiply_add(
                -side / (2.0 * step),
                &v,
                &mut expected,
            );
            for (place, expected) in expected.iter_mut().enumerate() {
                let q = moved(&q, side * step, &unit(n, place));
                let lagrangian = kinetic_energy(&system, &q, &v) - potential_energy(&system, &q);
                *expected += side * lagrangian / (2.0 * step);
            }
        }
        expected[0] += form.torque + 0.25;
        let own = force(&system, &q, &v, &[0.25]);
        for (place, (own, expected)) in own.iter().zip(&expected).enumerate() {
            let size = 1.0 + expected.abs();
            let error = (own - expected).abs() / size;
            assert!(
                error <= 2e-8,
                "{:?} {place}: {own:e} {expected:e} {error:e}",
                form.rod
            );
        }
    }
}

/// `dE/dt` is the power of the torque less that of the damping.
#[test]
fn energy_changes_by_work() {
    for form in all_forms() {
        let system = system(form);
        let [q, v] = somewhere(&system);
        let mut factors = Factors::new(system.shape());
        factors.factor(&mass(&system, &q)).unwrap();
        let mut a = force(&system, &q, &v, &[0.25]);
        factors.solve(&mut a);
        let step = 1e-6;
        let energy = |by: f64| system.energy(&moved(&q, by, &v), &moved(&v, by, &a));
        let rate = (energy(step) - energy(-step)) / (2.0 * step);
        let [mut stiffness, mut damping] = [(); 2].map(|()| BorderedBand::zeros(system.shape()));
        let at = Instant {
            t: 0.0,
            q: &q,
            v: &v,
            inputs: &[],
        };
        assert!(system.tangents(at, &mut stiffness, &mut damping));
        let dissipated: f64 = v
            .iter()
            .enumerate()
            .map(|(row, v_row)| v_row * damping.row_times(row, &v))
            .sum();
        let power = (form.torque + 0.25) * v[0] - dissipated;
        assert!(dissipated > 0.0);
        assert!(
            (rate - power).abs() <= 1e-7 * power.abs(),
            "{:?}: {rate:e} {power:e}",
            form.rod
        );
    }
}

#[test]
fn directions_are_derivatives_of_gaps() {
    for guide in [
        Guide::Clearance(TABLE_1),
        Guide::Bilateral { friction: 0.1 },
        Guide::Free,
    ] {
        for form in all_forms() {
            let system = FlexibleSliderCrank::new(form, guide).unwrap();
            let [q, v] = somewhere(&system);
            let (n, contacts) = (q.len(), system.contacts().to_vec());
            let rows = rows(&contacts);
            let directions = |q: &[f64]| {
                let mut directions = vec![0.0; rows * n];
                system.directions(q, &mut directions);
                directions
            };
            let step = 1e-6;
            let difference = |along: &[f64], of: &dyn Fn(&[f64]) -> Vec<f64>| -> Vec<f64> {
                let [before, after] = [-step, step].map(|by| of(&moved(&q, by, along)));
                after
                    .iter()
                    .zip(before)
                    .map(|(a, b)| (a - b) / (2.0 * step))
                    .collect()
            };
            let own = directions(&q);
            for place in 0..n {
                let gaps = |q: &[f64]| {
                    let mut gaps = vec![0.0; contacts.len()];
                    system.gaps(q, &mut gaps);
                    gaps
                };
                let mut row = 0;
                for (contact, expected) in contacts.iter().zip(difference(&unit(n, place), &gaps)) {
                    assert!((own[row * n + place] - expected).abs() < 1e-8);
                    row += contact.rows();
                }
            }
            let mut rates = vec![0.0; rows];
            system.direction_rates(&q, &v, &mut rates);
            for (rate, row) in rates
                .iter()
                .zip(difference(&v, &directions).chunks_exact(n))
            {
                let expected: f64 = row.iter().zip(&v).map(|(row, v)| row * v).sum();
                assert!((rate - expected).abs() < 1e-8, "{rate:e} {expected:e}");
            }
        }
    }
}

/// Tangents of the corners: `g_T' = x'` of the corner.
#[test]
fn tangents_are_velocities_of_corners() {
    for form in all_forms() {
        let system = system(form);
        let [q, v] = somewhere(&system);
        let n = q.len();
        let mut directions = vec![0.0; 8 * n];
        system.directions(&q, &mut directions);
        let notch = form.notch;
        let corner = |q: &[f64], along: f64, upper: f64| {
            let (sin, cos) = q[2].sin_cos();
            system.slider(q)[0] + along * notch.half_length * cos - upper * notch.half_height * sin
        };
        let signs = [(-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        for (number, (along, upper)) in signs.into_iter().enumerate() {
            let step = 1e-6;
            let [before, after] = [-step, step].map(|by| corner(&moved(&q, by, &v), along, upper));
            let row = &directions[(2 * number + 1) * n..][..n];
            let own: f64 = row.iter().zip(&v).map(|(row, v)| row * v).sum();
            assert!((own - (after - before) / (2.0 * step)).abs() < 1e-8);
        }
    }
}
