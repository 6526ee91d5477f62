//! A double pendulum whose lower link hits the floor, against its equations in minimal coordinates and the closed form of the impact.

use crate::{PENDULUM, here};

/// Masses (kg), moments of inertia about the centres (kg m^2), lengths (m) of the links; height of the hinge (m); half the thickness of
/// the lower link (m); weight (m/s^2); restitution.
const MASSES: [f64; 2] = [1.1, 0.7];
const LENGTHS: [f64; 2] = [0.6, 0.5];
const HEIGHT: f64 = 0.8;
const HALF: f64 = 0.01;
const GRAVITY: f64 = 9.81;
const RESTITUTION: f64 = 0.6;

fn inertias() -> [f64; 2] {
    [0.04, MASSES[1] * (0.25 * 0.25 + HALF * HALF) / 3.0]
}

/// Angles of the links from the x axis, and their rates.
type State = [f64; 4];

/// `M(q)`: symmetric, so three entries.
fn mass([a, b]: [f64; 2]) -> [f64; 3] {
    let ([m1, m2], [l1, l2], [j1, j2]) = (MASSES, LENGTHS, inertias());
    [
        j1 + (0.25 * m1 + m2) * l1 * l1,
        0.5 * m2 * l1 * l2 * (a - b).cos(),
        j2 + 0.25 * m2 * l2 * l2,
    ]
}

fn solve([a, b, c]: [f64; 3], [f, g]: [f64; 2]) -> [f64; 2] {
    let determinant = a * c - b * b;
    [(c * f - b * g) / determinant, (a * g - b * f) / determinant]
}

fn rate([a, b, u, v]: State) -> State {
    let ([m1, m2], [l1, l2]) = (MASSES, LENGTHS);
    let coupling = 0.5 * m2 * l1 * l2 * (a - b).sin();
    let [p, q] = solve(
        mass([a, b]),
        [
            -coupling * v * v - (0.5 * m1 + m2) * GRAVITY * l1 * a.cos(),
            coupling * u * u - 0.5 * m2 * GRAVITY * l2 * b.cos(),
        ],
    );
    [u, v, p, q]
}

fn runge_kutta(state: State, dt: f64) -> State {
    let ahead = |k: State, share: f64| std::array::from_fn(|i| state[i] + share * dt * k[i]);
    let k1 = rate(state);
    let k2 = rate(ahead(k1, 0.5));
    let k3 = rate(ahead(k2, 0.5));
    let k4 = rate(ahead(k3, 1.0));
    std::array::from_fn(|i| state[i] + dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
}

/// Height of the lower far corner, and its derivatives by the angles.
fn gap([a, b, ..]: State) -> (f64, [f64; 2]) {
    let [l1, l2] = LENGTHS;
    let height = HEIGHT + l1 * a.sin() + l2 * b.sin() - HALF * b.cos();
    (height, [l1 * a.cos(), l2 * b.cos() + HALF * b.sin()])
}

/// `q'^+ = q'^- - (1 + e) g'^- M^-1 w / (w^T M^-1 w)`.
fn collide(state: State) -> State {
    let [a, b, u, v] = state;
    let (_, w) = gap(state);
    let response = solve(mass([a, b]), w);
    let impulse =
        (1.0 + RESTITUTION) * (w[0] * u + w[1] * v) / (w[0] * response[0] + w[1] * response[1]);
    [a, b, u - impulse * response[0], v - impulse * response[1]]
}

/// The state at `end`, and the time of the impact: one, which happens before.
fn exact(end: f64) -> (State, f64) {
    let dt = 1e-4;
    let (mut t, mut state) = (0.0, [0.0; 4]);
    loop {
        let next = runge_kutta(state, dt);
        if gap(next).0 <= 0.0 {
            break;
        }
        (t, state) = (t + dt, next);
    }
    let (mut early, mut late) = (0.0, dt);
    while late - early > 1e-15 {
        let middle = 0.5 * (early + late);
        match gap(runge_kutta(state, middle)).0 > 0.0 {
            true => early = middle,
            false => late = middle,
        }
    }
    let impact = t + late;
    let behind = collide(runge_kutta(state, late));
    let steps = ((end - impact) / dt).ceil();
    let dt = (end - impact) / steps;
    let end = (0..steps as usize).fold(behind, |state, _| runge_kutta(state, dt));
    (end, impact)
}

const END: f64 = 0.6;

/// Differences of the two angles and of the rate of the upper link at the end, time of the impact after the true one, and the change of the
/// energy with what the impact took.
fn errors(h: f64, dt: f64, more: &[&str]) -> ([f64; 3], f64, f64) {
    let own = [
        format!("coupling.macro_step={h:e}"),
        format!("subsystem.lower.solver.step={dt:e}"),
    ];
    let own: Vec<&str> = own.iter().map(String::as_str).collect();
    let run = here(PENDULUM, &[&own[..], more].concat());
    let ([a, b, u, _], impact) = exact(END);
    let last = |name: &str| *run.column(name).last().unwrap();
    let found = run.statistics.subsystems[1].contacts.unwrap();
    assert_eq!(found.impacts, 1);
    let energy = |row: usize| -> f64 {
        let parts = ["upper.energy", "lower.energy", "lower.impact_loss"];
        parts.iter().map(|name| run.column(name)[row]).sum()
    };
    let errors = [
        last("upper.angle") - a,
        last("lower.tilt") - b,
        last("upper.rate") - u,
    ];
    (
        errors.map(f64::abs),
        found.first_impact.unwrap() - impact,
        energy(run.rows.len() - 1) - energy(0),
    )
}

/// The impact comes at the end of the internal step in which the corner reaches the floor: what is left falls with that step.
#[test]
fn the_impact_has_its_closed_form() {
    let coarse = errors(2e-3, 1e-4, &[]);
    let fine = errors(5e-4, 1e-5, &[]);
    for (errors, late, energy) in [coarse, fine] {
        assert!(late > -1e-7, "{late:e} {errors:?} {energy:e}");
    }
    assert!(
        coarse.1 < 1.01e-4 && fine.1 < 1.01e-5,
        "{coarse:?} {fine:?}"
    );
    // By that time and by what the loads of the step with the impact are off.
    let allowed = [3e-3, 6e-3, 2e-2];
    for (error, allowed) in coarse.0.iter().zip(allowed) {
        assert!(*error < allowed, "{coarse:?}");
    }
    for (fine, allowed) in fine.0.iter().zip(allowed) {
        assert!(*fine < 0.12 * allowed, "{fine:?}");
    }
    assert!(
        fine.2.abs() < 2e-3 && coarse.2.abs() < 2e-2,
        "{coarse:?} {fine:?}"
    );
}

/// Without impulses at the joint it is another motion.
#[test]
fn forces_alone_lose_it() {
    let (errors, ..) = errors(5e-4, 1e-5, &["coupling.impacts=forces"]);
    let (right, ..) = errors_with_impulses();
    assert!(errors[1] > 20.0 * right[1], "{errors:?} {right:?}");
}

fn errors_with_impulses() -> ([f64; 3], f64, f64) {
    errors(5e-4, 1e-5, &[])
}
