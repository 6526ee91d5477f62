//! Stable or not by comparison with a reference run, for scenes of any kind.

use linchpin_master::RunError;
use linchpin_master::methods::Weighted;
use linchpin_master::scene::{self, Coupling, Degree, Index, Method, Scene};

use super::Simulated;
use super::cell::MOST_DEVIATION;
use crate::study::StudyError;
use crate::study::columns::{Column, Kind, names, record};
use crate::study::reference::Reference;
use crate::study::runs::{Variant, watched};

/// Simulates and compares the velocities with those of a reference.
///
/// Nothing is excited: the start of a mechanism is consistent, and the errors of the coupling excite its modes. The run is
/// watched as `run` does it, so a joint that comes apart ends it.
pub struct Deviation {
    columns: Vec<Column>,
    /// For maps over settings of the coupling, which all have one solution.
    shared: Option<Reference>,
}

/// The steps of a reference run are shorter by this factor.
const REFINEMENT: f64 = 4.0;

/// Couplings that are stable as H falls to 0 for any system: method, degrees of multipliers and of exchanged variables. The
/// first one that the scene can have is taken: where a signal and a load share an input the degrees must be equal, and some
/// workers tell no accelerations.
const REFERENCES: [(Method, usize, usize); 3] = [
    (BY_ACCELERATIONS, 1, 2),
    (BY_ACCELERATIONS, 2, 2),
    (BY_VELOCITIES, 0, 2),
];
const BY_ACCELERATIONS: Method = Method::Weighted(Weighted {
    index: Index::One,
    a: 2.0,
    b: 2.6,
});
const BY_VELOCITIES: Method = Method::Weighted(Weighted {
    index: Index::Two,
    a: 1.0,
    b: 0.0,
});

impl Deviation {
    /// `smallest_step` in s is that of all points of the map, if these differ in their coupling only.
    pub fn new(
        variant: &Variant,
        columns: Vec<Column>,
        smallest_step: Option<f64>,
    ) -> Result<Self, StudyError> {
        let shared = match smallest_step {
            None => None,
            Some(step) => match Reference::known(variant, &columns, scene::Reference::Automatic)? {
                None => reference_run(&variant.scene, &columns, step)
                    .map_err(|error| variant.failed(error))?,
                known => known,
            },
        };
        Ok(Self { columns, shared })
    }

    pub fn simulate(&self, scene: &Scene) -> Result<Simulated, RunError> {
        let own = match self.shared {
            Some(_) => None,
            None => reference_run(scene, &self.columns, scene.coupling.macro_step)?,
        };
        let mut scene = scene.clone();
        record(&mut scene, &self.columns);
        let reference = self.shared.as_ref().or(own.as_ref());
        let mut sizes = JUDGED.map(|_| Sizes::default());
        let outcome = watched(&scene, &names(&self.columns), |t, values| {
            self.add(&mut sizes, reference, t, values);
        });
        let growth = match outcome? {
            Ok(_) => deviation(&sizes),
            Err(_) => f64::INFINITY,
        };
        Ok(Simulated::new(growth, MOST_DEVIATION, &scene))
    }

    /// Takes the values of the columns at time `t`.
    fn add(
        &self,
        sizes: &mut [Sizes; 2],
        reference: Option<&Reference>,
        t: f64,
        values: &[Option<f64>],
    ) {
        let mut norms = JUDGED.map(|_| Sizes::default());
        for (number, (column, value)) in self.columns.iter().zip(values).enumerate() {
            let kind = JUDGED.iter().position(|kind| *kind == column.kind);
            let exact = reference.and_then(|known| known.value(number, t));
            if let (Some(kind), Some(value), Some(exact)) = (kind, value, exact) {
                norms[kind].deviation += (value - exact).powi(2);
                norms[kind].reference += exact.powi(2);
            }
        }
        for (sizes, norms) in sizes.iter_mut().zip(norms) {
            sizes.deviation = sizes.deviation.max(norms.deviation);
            sizes.reference = sizes.reference.max(norms.reference);
        }
    }
}

/// A run that can be trusted; `None` if it diverged.
fn reference_run(
    scene: &Scene,
    columns: &[Column],
    macro_step: f64,
) -> Result<Option<Reference>, RunError> {
    let mut scene = scene.clone();
    record(&mut scene, columns);
    let mut refusal = None;
    for (method, degree, exchanged_degree) in REFERENCES {
        scene.coupling = Coupling {
            method,
            degree: Degree::Fixed(degree),
            exchanged_degree: Degree::Fixed(exchanged_degree),
            macro_step: macro_step / REFINEMENT,
            ..scene.coupling
        };
        match Reference::of_run(&scene, columns) {
            Ok(run) => return Ok(run.ok().map(|(reference, _)| reference)),
            Err(RunError::Scene(errors)) => refusal = Some(errors),
            Err(error) => return Err(error),
        }
    }
    refusal.map_or(Ok(None), |errors| Err(errors.into()))
}

/// What is compared: the first of these that the reference knows.
const JUDGED: [Kind; 2] = [Kind::Velocity, Kind::Position];

/// Squares of the largest norms over all columns of a kind.
#[derive(Debug, Clone, Copy, Default)]
struct Sizes {
    deviation: f64,
    reference: f64,
}

/// Largest deviation over the largest size of the reference; not a number if there is none.
fn deviation(sizes: &[Sizes; 2]) -> f64 {
    let known = sizes.iter().find(|sizes| sizes.reference > 0.0);
    known.map_or(f64::NAN, |sizes| (sizes.deviation / sizes.reference).sqrt())
}
