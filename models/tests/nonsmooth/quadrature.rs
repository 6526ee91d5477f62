//! Energies of the flexible slider-crank by quadrature over its particles, from the places and velocities of these
//! alone.

use linchpin_models::nonsmooth::systems::flexible_slider_crank::FlexibleSliderCrank;
use linchpin_models::nonsmooth::systems::rod::RotaryInertia;

/// Points and weights of Gauss's rule with 4 points on 0 to 1.
fn gauss() -> [(f64, f64); 4] {
    let inner = (3.0 / 7.0 - 2.0 / 7.0 * 1.2_f64.sqrt()).sqrt();
    let outer = (3.0 / 7.0 + 2.0 / 7.0 * 1.2_f64.sqrt()).sqrt();
    let (large, small) = (
        (18.0 + 30.0_f64.sqrt()) / 72.0,
        (18.0 - 30.0_f64.sqrt()) / 72.0,
    );
    [
        (-outer, small),
        (-inner, large),
        (inner, large),
        (outer, small),
    ]
    .map(|(x, w)| (0.5 + 0.5 * x, w))
}

/// Displacements `u`, `w` and slope `w'` inside an element by its nodal values.
fn inside(nodal: &[f64], xi: f64, l: f64) -> [f64; 3] {
    let (two, three) = (xi * xi, xi * xi * xi);
    let u = (1.0 - xi) * nodal[0] + xi * nodal[3];
    let w = (1.0 - 3.0 * two + 2.0 * three) * nodal[1]
        + l * (xi - 2.0 * two + three) * nodal[2]
        + (3.0 * two - 2.0 * three) * nodal[4]
        + l * (three - two) * nodal[5];
    let slope = (-6.0 * xi + 6.0 * two) / l * nodal[1]
        + (1.0 - 4.0 * xi + 3.0 * two) * nodal[2]
        + (6.0 * xi - 6.0 * two) / l * nodal[4]
        + (3.0 * two - 2.0 * xi) * nodal[5];
    [u, w, slope]
}

/// Kinetic energy by quadrature over all particles of the rod, with the velocity of each (S2 118, 122).
pub fn kinetic_energy(system: &FlexibleSliderCrank, q: &[f64], v: &[f64]) -> f64 {
    let mechanism = system.mechanism();
    let rod = &mechanism.rod;
    let l = rod.length / rod.elements as f64;
    let mut nodal = [
        vec![0.0; system.nodal_count()],
        vec![0.0; system.nodal_count()],
    ];
    system.write_nodal(q, &mut nodal[0]);
    system.write_nodal(v, &mut nodal[1]);
    let l1 = mechanism.crank_length;
    let origin = [-l1 * q[0].sin() * v[0], l1 * q[0].cos() * v[0]];
    let (sin, cos) = q[1].sin_cos();
    let velocity = |place: [f64; 2], rate: [f64; 2]| {
        let along = rate[0] - v[1] * place[1];
        let across = rate[1] + v[1] * place[0];
        [
            origin[0] + cos * along - sin * across,
            origin[1] + sin * along + cos * across,
        ]
    };
    let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
    // Two fibres at plus and minus the radius of gyration have the mass and the second moment of the section.
    let radius = (rod.section.second_moment / rod.section.area).sqrt();
    let mut doubled = 0.0;
    for element in 0..rod.elements {
        for (xi, weight) in gauss() {
            let x = (element as f64 + xi) * l;
            let [place, rate] =
                [&nodal[0], &nodal[1]].map(|nodal| inside(&nodal[3 * element..], xi, l));
            let mass = weight * rod.density * rod.section.area * l;
            for y in [-radius, radius] {
                let velocity = match rod.rotary_inertia {
                    RotaryInertia::Consistent => velocity(
                        [x + place[0] - y * place[2], y + place[1]],
                        [rate[0] - y * rate[2], rate[1]],
                    ),
                    RotaryInertia::Frame => velocity([x + place[0], place[1]], [rate[0], rate[1]]),
                };
                doubled += 0.5 * mass * square(velocity);
            }
        }
    }
    if rod.rotary_inertia == RotaryInertia::Frame {
        doubled += rod.mass() * radius * radius * v[1] * v[1];
    }
    let last = 3 * rod.elements;
    let [place, rate] = [&nodal[0], &nodal[1]].map(|nodal| [nodal[last], nodal[last + 1]]);
    doubled += mechanism.slider_mass * square(velocity([rod.length + place[0], place[1]], rate));
    doubled += mechanism.slider_inertia * v[2] * v[2];
    let crank = mechanism.crank_inertia + 0.25 * mechanism.crank_mass * l1 * l1;
    0.5 * (doubled + crank * v[0] * v[0])
}

/// Potential energy by quadrature: weight and strain.
pub fn potential_energy(system: &FlexibleSliderCrank, q: &[f64]) -> f64 {
    let mechanism = system.mechanism();
    let rod = &mechanism.rod;
    let l = rod.length / rod.elements as f64;
    let mut nodal = vec![0.0; system.nodal_count()];
    system.write_nodal(q, &mut nodal);
    let (l1, (sin, cos)) = (mechanism.crank_length, q[1].sin_cos());
    let height = |x: f64, y: f64| l1 * q[0].sin() + sin * x + cos * y;
    let mut weight = 0.5 * mechanism.crank_mass * l1 * q[0].sin();
    let mut strain = 0.0;
    for element in 0..rod.elements {
        let nodal = &nodal[3 * element..];
        for (xi, share) in gauss() {
            let [u, w, _] = inside(nodal, xi, l);
            let x = (element as f64 + xi) * l;
            weight += share * rod.density * rod.section.area * l * height(x + u, w);
            let stretch = (nodal[3] - nodal[0]) / l;
            let bend = ((12.0 * xi - 6.0) * (nodal[1] - nodal[4])
                + l * (6.0 * xi - 4.0) * nodal[2]
                + l * (6.0 * xi - 2.0) * nodal[5])
                / (l * l);
            let section =
                rod.section.area * stretch * stretch + rod.section.second_moment * bend * bend;
            strain += 0.5 * share * l * rod.youngs_modulus * section;
        }
    }
    let last = &nodal[3 * rod.elements..];
    weight += mechanism.slider_mass * height(rod.length + last[0], last[1]);
    mechanism.gravity * weight + strain
}
