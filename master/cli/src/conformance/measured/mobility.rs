//! By how much loads change accelerations.

use nalgebra::DMatrix;

use crate::conformance::bench::Bench;
use crate::conformance::instance::Instance;
use crate::conformance::subject::Motion;
use crate::conformance::verdict::Stop;

/// Share of `sqrt(A_ii A_jj)` by which an entry `A_ij` may be off. Accelerations under given loads are computed and not
/// integrated; this leaves half of the digits to the equation solver of the worker.
pub const MOBILITY_SHARE: f64 = 1e-6;

/// Share of the largest `sqrt(A_ii)` below which a freedom counts as held.
const HELD: f64 = 1e-5;

/// Share of the largest entries that the worker's equation solver may leave where nothing moves.
const LEFT_OVER: f64 = 1e-9;

/// A component of a marker that takes a load and tells its acceleration.
#[derive(Debug, Clone, PartialEq)]
pub struct Freedom {
    /// Place of the marker.
    pub marker: usize,
    /// Place in its lists.
    pub component: usize,
    /// Translation or rotation.
    pub motion: Motion,
    /// The output.
    pub acceleration: usize,
    /// The input.
    pub load: usize,
    /// Names of output and input.
    pub names: [String; 2],
}

/// The matrix `A = d(acceleration)/d(load)` of all markers at one state, rows in m/s^2 and rad/s^2, columns per N and N m, all
/// in inertial axes. It is `J M^-1 J^T` with the mass matrix `M` and the Jacobian `J` of the markers' velocities, reduced by what holds
/// the bodies: symmetric, and no eigenvalue is negative.
#[derive(Debug, Clone, PartialEq)]
pub struct Mobility {
    /// Rows and columns.
    pub freedoms: Vec<Freedom>,
    /// The matrix.
    pub matrix: DMatrix<f64>,
    /// By how much rounding may have changed an entry.
    pub rounding: DMatrix<f64>,
    /// By how much twice the acceleration without load differs from the sum of those with the load and its opposite: rows and
    /// columns as those of the matrix, in m/s^2 and rad/s^2 per unit of load.
    pub curvature: DMatrix<f64>,
    /// `sqrt(A_ii)`.
    pub own: Vec<f64>,
    /// The largest of them among all translations, or all rotations.
    pub largest: Vec<f64>,
}

impl Mobility {
    /// Measures it at the present state by central differences.
    ///
    /// # Errors
    /// [`Stop::NotApplicable`] if no marker has accelerations and takes loads; calls that fail.
    pub fn measure(bench: &Bench<'_>, instance: &Instance<'_>) -> Result<Self, Stop> {
        let freedoms = freedoms(bench);
        if freedoms.is_empty() {
            return Err(Stop::not_applicable(
                "no marker of the model takes loads and tells its acceleration",
            ));
        }
        let count = freedoms.len();
        let [mut matrix, mut rounding, mut curvature] =
            [(); 3].map(|()| DMatrix::zeros(count, count));
        let rest = instance.evaluate(&bench.subject.defaults)?;
        for (column, driven) in freedoms.iter().enumerate() {
            let size = bench.sizes[driven.load];
            let under = |load: f64| {
                let mut values = bench.subject.defaults.clone();
                values[driven.load] += load;
                instance.evaluate(&values)
            };
            let (plus, minus) = (under(size)?, under(-size)?);
            for (row, told) in freedoms.iter().enumerate() {
                let [plus, minus, rest] = [&plus, &minus, &rest].map(|all| all[told.acceleration]);
                matrix[(row, column)] = (plus - minus) / (2.0 * size);
                curvature[(row, column)] = (plus + minus - 2.0 * rest) / size;
                rounding[(row, column)] =
                    crate::conformance::compare::rounding(&[plus, minus, rest]) / size;
            }
        }
        let own: Vec<f64> = (0..count).map(|i| matrix[(i, i)].max(0.0).sqrt()).collect();
        let largest = freedoms
            .iter()
            .map(|of| {
                let alike = freedoms
                    .iter()
                    .zip(&own)
                    .filter(|(own, _)| own.motion == of.motion);
                alike.fold(0.0_f64, |largest, (_, own)| largest.max(*own))
            })
            .collect();
        Ok(Self {
            freedoms,
            matrix,
            rounding,
            curvature,
            own,
            largest,
        })
    }

    /// Whether a freedom moves under its load at all.
    pub fn is_free(&self, freedom: usize) -> bool {
        self.own[freedom] > HELD * self.largest[freedom]
    }

    /// By how much an entry may be off.
    pub fn allowed(&self, row: usize, column: usize) -> f64 {
        let own = self.own[row] * self.own[column];
        let largest = self.largest[row] * self.largest[column];
        MOBILITY_SHARE * own + LEFT_OVER * largest + self.rounding[(row, column)]
    }
}

fn freedoms(bench: &Bench<'_>) -> Vec<Freedom> {
    let mut freedoms = Vec::new();
    for (place, marker) in bench.subject.markers.iter().enumerate() {
        let pairs = marker.acceleration.iter().zip(&marker.load).enumerate();
        freedoms.extend(pairs.map(|(component, (&acceleration, &load))| Freedom {
            marker: place,
            component,
            motion: marker.motion(component),
            acceleration,
            load,
            names: [
                bench.subject.outputs[acceleration].clone(),
                bench.subject.inputs[load].clone(),
            ],
        }));
    }
    freedoms
}
