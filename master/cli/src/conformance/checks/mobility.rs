//! Accelerations answer loads as mechanics asks.

use linchpin_proto::v1::MarkerKind;

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::measured::{MOBILITY_SHARE, Mobility};
use crate::conformance::subject::{Marker, Motion};
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// `d(acceleration)/d(load)` is symmetric and positive.
pub struct MobilityMatrix;

/// Share of the acceleration by which it may differ from a linear function of the load.
const LINEAR: f64 = 1e-3;

/// Attitudes closer than this (rad) to that of the inertial axes do not tell the axes of a body from them.
const PARALLEL: f64 = 1e-3;

impl Check for MobilityMatrix {
    fn about(&self) -> About {
        About {
            name: "mobility",
            title: "d(acceleration)/d(load) is symmetric and positive, for all markers together",
            equation: "A = J M^-1 J^T: A_ij = A_ji, eigenvalues >= 0",
            tolerance: "1e-6 of sqrt(A_ii A_jj): accelerations are computed and not integrated",
            look_at: "axes (loads and accelerations are in inertial ones), moments about the marker's point and not the centre of mass, signs, \
                      order of components, arms",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let instance = bench.in_motion()?;
        let mobility = Mobility::measure(bench, &instance)?;
        let curved = curvature(&mobility);
        let is_linear = curved.holds();
        verdict.judge(
            curved,
            Grade::Warn,
            "accelerations are not linear in the loads (contacts, friction?), so the symmetry below means little",
        );
        let grade = match is_linear {
            true => bench.grade_of_motion(),
            false => Grade::Warn,
        };
        verdict.judge(symmetry(&mobility), grade, "not symmetric");
        verdict.judge(positivity(&mobility), grade, "not positive");
        let held: Vec<&str> = (0..mobility.freedoms.len())
            .filter(|&freedom| !mobility.is_free(freedom))
            .map(|freedom| mobility.freedoms[freedom].names[1].as_str())
            .collect();
        if !held.is_empty() {
            let names = held.join(", ");
            verdict.note(format!(
                "loads under which their marker does not accelerate (held?): {names}"
            ));
        }
        let values = instance.evaluate(&bench.subject.defaults)?;
        let is_turned = |angle: f64| angle.abs() > PARALLEL;
        if !angles(bench, &values).into_iter().all(is_turned) {
            verdict.note(
                "a marker is parallel to the inertial axes, so that axes of the body cannot be told from them; start from another \
                 attitude (--parameter)",
            );
        }
        Ok(())
    }
}

/// `a(u) + a(-u) = 2 a(0)`.
fn curvature(mobility: &Mobility) -> Comparison {
    let mut comparison = Comparison::default();
    for (column, driven) in mobility.freedoms.iter().enumerate() {
        for (row, told) in mobility.freedoms.iter().enumerate() {
            let size = mobility.largest[row] * mobility.largest[column];
            let place = format!("change of {} per {}", told.names[0], driven.names[1]);
            let allowed = LINEAR * size + 4.0 * mobility.rounding[(row, column)];
            let slope = mobility.matrix[(row, column)];
            comparison.near(
                place,
                slope + mobility.curvature[(row, column)],
                slope,
                allowed,
            );
        }
    }
    comparison
}

fn symmetry(mobility: &Mobility) -> Comparison {
    let mut comparison = Comparison::default();
    for (column, driven) in mobility.freedoms.iter().enumerate() {
        for (row, told) in mobility.freedoms.iter().enumerate().skip(column + 1) {
            let [a, b] = [told, driven].map(|own| &own.names);
            let place = format!("{} per {} against {} per {}", a[0], b[1], b[0], a[1]);
            let (own, other) = ((row, column), (column, row));
            let rounding = mobility.rounding[own].max(mobility.rounding[other]);
            let allowed = mobility.allowed(row, column) + rounding;
            comparison.near(place, mobility.matrix[own], mobility.matrix[other], allowed);
        }
    }
    comparison
}

/// The diagonal first; then the smallest eigenvalue of the matrix, with rows and columns divided by the largest `sqrt(A_ii)` of
/// their kind.
fn positivity(mobility: &Mobility) -> Comparison {
    let mut comparison = Comparison::default();
    for (place, freedom) in mobility.freedoms.iter().enumerate() {
        let own = mobility.matrix[(place, place)];
        let name = format!("{} per {}", freedom.names[0], freedom.names[1]);
        comparison.near(name, own.min(0.0), 0.0, mobility.allowed(place, place));
    }
    let scale = |place: usize| match mobility.largest[place] {
        0.0 => 1.0,
        largest => largest,
    };
    let mut scaled = (&mobility.matrix + mobility.matrix.transpose()) / 2.0;
    let mut noise = 0.0_f64;
    for row in 0..scaled.nrows() {
        for column in 0..scaled.ncols() {
            scaled[(row, column)] /= scale(row) * scale(column);
            noise = noise.max(mobility.rounding[(row, column)] / (scale(row) * scale(column)));
        }
    }
    let count = scaled.nrows() as f64;
    let smallest = scaled.symmetric_eigen().eigenvalues.min();
    let allowed = count * (MOBILITY_SHARE + noise);
    comparison.near(
        "smallest eigenvalue, scaled",
        smallest.min(0.0),
        0.0,
        allowed,
    );
    comparison
}

/// How far each marker with an attitude is turned from the inertial axes (rad).
fn angles(bench: &Bench<'_>, values: &[f64]) -> Vec<f64> {
    let rotates = |marker: &&Marker| {
        (0..marker.load.len()).any(|component| marker.motion(component) == Motion::Rotation)
    };
    let angle = |marker: &Marker| match (marker.quaternion(), marker.kind) {
        (Some([_, vector @ ..]), _) => {
            let length: f64 = vector.map(|place| values[place].powi(2)).iter().sum();
            Some(2.0 * length.sqrt().clamp(0.0, 1.0).asin())
        }
        (None, MarkerKind::Planar) => marker.position.get(2).map(|&place| values[place].sin()),
        (None, _) => None,
    };
    bench
        .subject
        .markers
        .iter()
        .filter(rotates)
        .filter_map(angle)
        .collect()
}
