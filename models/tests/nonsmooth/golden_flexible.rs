//! The flexible slider-crank against golden data: integrals, matrices, frequencies, runs.

use std::path::Path;

use linchpin_models::nonsmooth::matrix::BorderedBand;
use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::system::{Instant, MechanicalSystem};
use linchpin_models::nonsmooth::systems::flexible_slider_crank::{
    ANGLES, FlexibleMechanism, FlexibleSliderCrank,
};
use linchpin_models::nonsmooth::systems::notch::{CornerLaw, Notch};
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism};
use linchpin_models::nonsmooth::systems::rod::coordinates::Free;
use linchpin_models::nonsmooth::systems::rod::integrals::{ShapeIntegrals, dense};
use linchpin_models::nonsmooth::systems::rod::modes::lowest;
use linchpin_models::nonsmooth::systems::rod::{Rectangle, Reference, RotaryInertia};
use serde_json::Value;

use super::golden::{Row, assert_near, rows, runs};
use super::stand::{AS_PRINTED, Stand};

/// Young's modulus (N/m^2) and density (kg/m^3) of the golden files.
pub const STEEL: [f64; 2] = [2e11, 7800.0];

/// Laws of the corners of S2 Table 1.
pub const TABLE_1: CornerLaw = CornerLaw {
    normal_restitution: 0.4,
    tangential_restitution: 0.0,
    friction: 0.01,
};

/// The same of Table 2.
pub const TABLE_2: CornerLaw = CornerLaw {
    normal_restitution: 0.1,
    tangential_restitution: 0.0,
    friction: 0.1,
};

/// Lengths and masses of the case `hidden1` of the golden file.
fn hidden_1() -> Mechanism {
    Mechanism {
        lengths: [0.12, 0.41],
        masses: [0.05, 0.06, 0.11],
        inertias: [9e-5, 9e-4, 2e-5],
        gravity: 9.81,
        torque: 0.0,
        notch: Notch {
            half_length: 0.04,
            half_height: 0.02,
            clearance: 7e-4,
        },
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(values) => values.iter().flat_map(numbers).collect(),
        other => vec![other.as_f64().unwrap()],
    }
}

/// Agreement to `tolerance` of the largest golden number.
fn assert_same(what: &str, own: &[f64], golden: &[f64], tolerance: f64) {
    assert_eq!(own.len(), golden.len(), "{what}");
    let largest = golden.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    for (place, (own, golden)) in own.iter().zip(golden).enumerate() {
        assert!(
            (own - golden).abs() <= tolerance * largest,
            "{what}[{place}] = {own:e}, golden {golden:e}, largest {largest:e}"
        );
    }
}

fn row_by_row(matrix: &BorderedBand) -> Vec<f64> {
    dense(matrix).transpose().as_slice().to_vec()
}

/// The integrals without reference conditions.
fn compare_integrals(case: &Value, mechanism: &FlexibleMechanism) {
    let rod = &mechanism.rod;
    let integrals = ShapeIntegrals::of(rod, &Free::all(rod.nodes()));
    let section = &case["section"];
    let one = |key: &str, own: f64, golden: &Value| {
        assert_same(key, &[own], &numbers(golden), 1e-12);
    };
    one("A", rod.section.area, &section["A"]);
    one("I", rod.section.second_moment, &section["I"]);
    one("rod_m", integrals.mass, &case["rod_m"]);
    one("I2", integrals.second_moment, &case["I2"]);
    let many = |key: &str, own: &[f64]| assert_same(key, own, &numbers(&case[key]), 1e-12);
    many("I1", &integrals.first_moment);
    many("I3", &integrals.stretch);
    many("I4", &integrals.turn);
    many("Sbar", &integrals.mean.concat());
    many("Sff", &row_by_row(&integrals.elastic));
    many("Stilde", &row_by_row(&integrals.skew));
    many("Kff", &row_by_row(&integrals.stiffness));
    let free = Free::of(rod.reference, rod.nodes());
    let values: Vec<f64> = free.values().iter().map(|&value| value as f64).collect();
    many("free_dofs", &values);
}

fn frequencies(mechanism: &FlexibleMechanism) -> Vec<f64> {
    let rod = &mechanism.rod;
    let free = Free::of(rod.reference, rod.nodes());
    let integrals = ShapeIntegrals::of(rod, &free);
    let [stiffness, mass] = [&integrals.stiffness, &integrals.elastic].map(dense);
    let modes = lowest(&stiffness, &mass, free.count()).unwrap();
    let angular = modes.angular_frequencies.into_iter();
    angular.map(|omega| omega / std::f64::consts::TAU).collect()
}

/// Mass matrix, forces, gaps and directions of contacts at the golden `q` and `v`.
fn compare_system(case: &Value, system: &FlexibleSliderCrank) {
    let (q, v) = (numbers(&case["q"]), numbers(&case["v"]));
    let n = q.len();
    let mut mass = BorderedBand::zeros(system.shape());
    system.mass(&q, &mut mass);
    let many = |key: &str, own: &[f64]| assert_same(key, own, &numbers(&case[key]), 1e-12);
    many("M", &row_by_row(&mass));
    // The golden h has no elastic forces.
    let at = Instant {
        t: 0.0,
        q: &q,
        v: &v,
        inputs: &[],
    };
    let mut force = vec![0.0; n];
    system.force(at, &mut force);
    let [mut stiffness, mut damping] = [(); 2].map(|()| BorderedBand::zeros(system.shape()));
    assert!(system.tangents(at, &mut stiffness, &mut damping));
    let elastic: Vec<f64> = (0..n).map(|row| stiffness.row_times(row, &q)).collect();
    let golden = numbers(&case["h"]);
    for row in 0..n {
        let own = force[row] + elastic[row];
        let size = 1.0 + elastic[row].abs();
        assert!(
            (own - golden[row]).abs() <= 1e-12 * size,
            "h[{row}] = {own:e}, golden {:e}",
            golden[row]
        );
    }
    let mut gaps = [0.0; 4];
    system.gaps(&q, &mut gaps);
    many("gap", &gaps);
    let mut directions = vec![0.0; 8 * n];
    system.directions(&q, &mut directions);
    for (key, first) in [("WN", 0), ("WT", 1)] {
        let entry = |k: usize| directions[(2 * (k % 4) + first) * n + k / 4];
        let own: Vec<f64> = (0..4 * n).map(entry).collect();
        many(key, &own);
    }
}

#[test]
fn matrices() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/golden/s2/flex_matrices.json");
    let cases: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let described = [
        (
            "table1_nel2_tangential",
            Mechanism::table_1(),
            2,
            Reference::Tangential,
            RotaryInertia::Frame,
        ),
        (
            "hidden1_nel3_pinned",
            hidden_1(),
            3,
            Reference::Pinned,
            RotaryInertia::Frame,
        ),
        (
            "table1_nel2_rayleigh",
            Mechanism::table_1(),
            2,
            Reference::Tangential,
            RotaryInertia::Consistent,
        ),
    ];
    for (name, rigid, elements, reference, rotary_inertia) in described {
        let case = &cases[name];
        let mut mechanism = FlexibleMechanism::of(&rigid, elements, STEEL).unwrap();
        mechanism.rod.reference = reference;
        mechanism.rod.rotary_inertia = rotary_inertia;
        compare_integrals(case, &mechanism);
        let golden = numbers(&case["freqs_hz"]);
        for (own, golden) in frequencies(&mechanism).iter().zip(&golden) {
            assert_same(name, &[*own], &[*golden], 1e-11);
        }
        let system = FlexibleSliderCrank::new(mechanism, Guide::Clearance(TABLE_1)).unwrap();
        compare_system(case, &system);
    }
}

#[test]
fn section_of_the_paper() {
    let [mass, inertia, length] = [0.038, 5.9e-4, 0.306];
    let rectangle = Rectangle::of_inertia(mass, inertia, length, STEEL[1]).unwrap();
    assert_same("D", &[rectangle.depth], &[0.3044335551046964], 1e-12);
    assert_same("H", &[rectangle.width], &[5.229679188407521e-05], 1e-12);
    assert!(Rectangle::of_inertia(mass, 1e-4, length, STEEL[1]).is_err());
}

#[test]
fn frequencies_of_21_elements() {
    let mechanism = FlexibleMechanism::of(&Mechanism::table_1(), 21, STEEL).unwrap();
    let golden = rows("flex_freqs_21el_tangential.csv");
    let own = frequencies(&mechanism);
    assert_eq!(own.len(), golden.len());
    for (own, golden) in own.iter().zip(&golden) {
        assert_same("f", &[*own], &[golden.get("f_Hz")], 1e-9);
    }
    // S2 Sect. 4.5 counts 52.
    assert_eq!(own.iter().filter(|&&f| f < 1e7).count(), 53);
}

const Q: [&str; 3] = ["theta1", "theta2", "theta3"];
const V: [&str; 3] = ["omega1", "omega2", "omega3"];
const FORCES: [&str; 4] = ["lamN1", "lamN2", "lamN3", "lamN4"];

/// Positions and velocities agree to 1e-8 of the largest of their column, forces to 1e-6 (all are 0 at the golden
/// instants, which lie between contacts); numbers of impacts are the same.
fn compare_runs(file: &str, system: &FlexibleSliderCrank, v: [f64; 3]) {
    let key = |row: &Row| (row.name.clone(), row.get("rho"));
    let runs = runs(rows(file), key);
    assert_eq!(runs.len(), 4, "{file}");
    for run in runs {
        let n = system.shape().order();
        let (q, mut start) = (vec![0.0; n], vec![0.0; n]);
        start[..ANGLES].copy_from_slice(&v);
        let settings = Settings {
            tolerance: 1e-13,
            ..AS_PRINTED
        };
        let mut stand = Stand::new(system.clone(), run[0].scheme(), settings, [&q, &start]);
        let dt = run[0].get("dt");
        let mut done = 0;
        for row in &run {
            let number = (row.get("t") / dt).round() as usize;
            stand.steps(number - done, dt);
            done = number;
            let q = stand.q();
            assert_near(&run, row, &Q, &q[..3], 1e-8);
            assert_near(&run, row, &V, &stand.v()[..3], 1e-8);
            // The golden energy has the potential of the torque.
            let energy = stand.integrator.energy() - system.mechanism().torque * q[0];
            let [tip, slider] = [system.end_displacement(q), system.slider(q)];
            assert_near(&run, row, &["tip_x"], &tip[..1], 1e-8);
            assert_near(&run, row, &["tip_y"], &tip[1..], 1e-8);
            assert_near(&run, row, &["slider_x"], &slider[..1], 1e-8);
            assert_near(&run, row, &["slider_y"], &slider[1..], 1e-8);
            assert_near(&run, row, &["energy"], &[energy], 1e-8);
            if number > 0 {
                let forces = &stand.integrator.state.forces;
                let normal: Vec<f64> = forces.iter().step_by(2).copied().collect();
                assert_near(&run, row, &FORCES, &normal, 1e-6);
            }
        }
        let (log, last) = (stand.integrator.log, &run[run.len() - 1]);
        assert_eq!(log.impacts as f64, last.get("nimp_total"));
        let first = log.first_impact.unwrap_or(-1.0);
        assert!((first - last.get("first_impact_t")).abs() < 1e-9);
    }
}

#[test]
fn table_1_without_contact() {
    let mut rigid = Mechanism::table_1();
    rigid.notch.clearance = 1.0;
    let mechanism = FlexibleMechanism::of(&rigid, 4, STEEL).unwrap();
    let system = FlexibleSliderCrank::new(mechanism, Guide::Clearance(TABLE_1)).unwrap();
    compare_runs(
        "flex_nocontact_table1_nel4.csv",
        &system,
        [150.0, -75.0, 0.0],
    );
}

#[test]
fn table_2() {
    let mechanism = FlexibleMechanism::of(&Mechanism::table_2(), 4, STEEL).unwrap();
    let system = FlexibleSliderCrank::new(mechanism, Guide::Clearance(TABLE_2)).unwrap();
    compare_runs("flex_table2_nel4.csv", &system, [0.0; 3]);
}

#[test]
fn table_2_with_modes() {
    let mut mechanism = FlexibleMechanism::of(&Mechanism::table_2(), 10, STEEL).unwrap();
    mechanism.rod.modes = Some(6);
    let system = FlexibleSliderCrank::new(mechanism, Guide::Clearance(TABLE_2)).unwrap();
    compare_runs("flex_table2_nel10_modes6.csv", &system, [0.0; 3]);
}
