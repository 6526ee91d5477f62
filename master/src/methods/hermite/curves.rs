//! The curves of all coupling variables on one macro step, without a past.

use linchpin_proto::v1::Signal;
use nalgebra::{UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::variant::Variant;
use crate::layout::Layout;
use crate::signal::attitude::{attitude, quaternions, rotation_of_change};
use crate::signal::{Curve, Curves, ErrorShares, History, SharePolynomial, vector_at};
use crate::system::unknowns::Unknowns;

/// What a variable is, and so what its curve is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A multiplier: the unknowns are values at the shares of the variant.
    Multiplier,
    /// Exchanged motion: the unknowns are value and `H` times the rate at the end.
    Motion,
    /// A connected signal: the unknown is the end value; past values make the rest.
    Signal,
}

/// State of a variable at the present macro point: value, rate and second derivative.
type Start = [f64; 3];

/// The curves over a step of length `H` from the present macro point, and what they continue.
///
/// * multiplier: the polynomial through its values at `0, 1/n, .., 1` of the step;
/// * exchanged motion: `p + v tau + a tau^2/2` and the two polynomials that bring value and rate at the end to what they
///   are, while they leave `p`, `v` and, of degree 4, `a` as they are;
/// * connected signal: the Lagrange polynomial through its end value and past values.
#[derive(Debug, Clone)]
pub struct HermiteCurves {
    length: f64,
    unknowns: Unknowns,
    kinds: Vec<Kind>,
    shapes: Shapes,
    values: Vec<f64>,
    curves: Vec<SharePolynomial>,
    starts: Vec<Start>,
    /// Multipliers over the step before, and rates of the second derivatives of motion.
    past: Vec<SharePolynomial>,
    jerks: Vec<f64>,
    past_length: f64,
    has_past: bool,
    history: History,
    rotations: Vec<usize>,
    attitudes: Vec<UnitQuaternion<f64>>,
}

/// What the curves are, and what they continue, without what they are made of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Past {
    length: f64,
    values: Vec<f64>,
    starts: Vec<Start>,
    past: Vec<SharePolynomial>,
    jerks: Vec<f64>,
    past_length: f64,
    has_past: bool,
    history: History,
    #[serde(with = "quaternions")]
    attitudes: Vec<UnitQuaternion<f64>>,
}

/// The shapes of the unknowns and of what is known.
#[derive(Debug, Clone, PartialEq)]
struct Shapes {
    /// Of a multiplier that is 1 at `T_N` and 0 at the unknown nodes; absent where the start value is an unknown.
    held: Option<SharePolynomial>,
    multiplier: Vec<SharePolynomial>,
    motion: [SharePolynomial; 2],
    has_acceleration: bool,
    degrees: [usize; 2],
}

impl Shapes {
    fn new(variant: Variant) -> Self {
        let unknown = variant.shares();
        let all: Vec<f64> = match variant.starts_anew() {
            true => unknown.clone(),
            false => [&[0.0], &unknown[..]].concat(),
        };
        let at = |node: f64| {
            let roots = all.iter().copied().filter(|other| *other != node);
            SharePolynomial::with_roots(roots, node)
        };
        let has_acceleration = variant.motion_degree() == 4;
        let motion = match has_acceleration {
            true => [[0.0, 0.0, 0.0, 4.0, -3.0], [0.0, 0.0, 0.0, -1.0, 1.0]],
            false => [[0.0, 0.0, 3.0, -2.0, 0.0], [0.0, 0.0, -1.0, 1.0, 0.0]],
        };
        Self {
            held: (!variant.starts_anew()).then(|| at(0.0)),
            multiplier: unknown.iter().map(|&node| at(node)).collect(),
            motion: motion.map(SharePolynomial::new),
            has_acceleration,
            degrees: [variant.degree(), variant.motion_degree()],
        }
    }

    fn of(&self, kind: Kind) -> &[SharePolynomial] {
        match kind {
            Kind::Multiplier => &self.multiplier,
            Kind::Motion => &self.motion,
            Kind::Signal => &[],
        }
    }
}

/// The unknowns of a macro step of a variant.
pub fn unknowns_of(layout: &Layout, variant: Variant) -> Unknowns {
    let shapes = Shapes::new(variant);
    let shares = variant.shares();
    let at_shares = |shape: &SharePolynomial| -> Vec<f64> {
        shares.iter().map(|&share| shape.value(share)).collect()
    };
    let of_kind = |kind: Kind| match kind {
        // Only the end value of a signal is known to change; no load is made of signals.
        Kind::Signal => vec![1.0; shares.len()],
        kind => shapes.of(kind).iter().flat_map(at_shares).collect(),
    };
    let kinds = kinds_of(layout);
    Unknowns::new(
        layout,
        shares.clone(),
        kinds.into_iter().map(of_kind).collect(),
    )
}

fn kinds_of(layout: &Layout) -> Vec<Kind> {
    let mut kinds = vec![Kind::Multiplier; layout.rows.len()];
    for exchanged in &layout.exchanged {
        let kind = match exchanged.rates {
            Some(_) => Kind::Motion,
            None => Kind::Signal,
        };
        kinds.extend((0..exchanged.size()).map(|_| kind));
    }
    kinds
}

impl HermiteCurves {
    /// Curves that start from the values of `history`; motion gets its rates by [`HermiteCurves::set_rates`].
    pub fn new(layout: &Layout, variant: Variant, unknowns: Unknowns, history: History) -> Self {
        let size = layout.variables();
        let starts = history.newest().iter().map(|&value| [value, 0.0, 0.0]);
        let rotations: Vec<usize> = layout.attitudes().map(|one| one.first).collect();
        let mut starts: Vec<Start> = starts.collect();
        for &first in &rotations {
            starts[first..first + 3].fill([0.0; 3]);
        }
        let constant = |start: &Start| SharePolynomial::new([start[0], 0.0, 0.0, 0.0, 0.0]);
        Self {
            length: 0.0,
            kinds: kinds_of(layout),
            shapes: Shapes::new(variant),
            values: vec![0.0; unknowns.len()],
            unknowns,
            curves: vec![SharePolynomial::default(); size],
            past: starts.iter().map(constant).collect(),
            jerks: vec![0.0; size],
            past_length: 1.0,
            has_past: false,
            starts,
            rotations,
            attitudes: history.attitudes().to_vec(),
            history,
        }
    }

    /// Takes over another state of the same curves, in memory that is already there.
    pub fn copy_from(&mut self, other: &Self) {
        self.length = other.length;
        self.values.clone_from(&other.values);
        self.curves.clone_from(&other.curves);
        self.starts.clone_from(&other.starts);
        self.past.clone_from(&other.past);
        self.jerks.clone_from(&other.jerks);
        self.past_length = other.past_length;
        self.has_past = other.has_past;
        self.history.copy_from(&other.history);
        self.attitudes.clone_from(&other.attitudes);
    }

    /// What they are, to be written.
    pub fn past(&self) -> Past {
        Past {
            length: self.length,
            values: self.values.clone(),
            starts: self.starts.clone(),
            past: self.past.clone(),
            jerks: self.jerks.clone(),
            past_length: self.past_length,
            has_past: self.has_past,
            history: self.history.clone(),
            attitudes: self.attitudes.clone(),
        }
    }

    /// Goes on from what was written.
    pub fn resume(&mut self, past: Past) {
        self.length = past.length;
        self.values = past.values;
        self.starts = past.starts;
        self.past = past.past;
        self.jerks = past.jerks;
        self.past_length = past.past_length;
        self.has_past = past.has_past;
        self.history = past.history;
        self.attitudes = past.attitudes;
        self.shape_curves();
    }

    /// Whether there was a step before.
    pub fn has_past(&self) -> bool {
        self.has_past
    }

    /// What the difference between corrected and predicted values tells of the multipliers.
    pub fn load_error(&self) -> ErrorShares {
        match self.has_past {
            true => {
                ErrorShares::of_continuation(self.shapes.degrees[0], self.past_length / self.length)
            }
            false => ErrorShares::WITHOUT_PAST,
        }
    }

    /// The value of a connected signal at the present macro point if its curve over the step is a chord because it has no longer past.
    pub fn chord_start(&self, variable: usize) -> Option<f64> {
        let is_chord = self.history.is_chord(variable);
        is_chord.then(|| self.history.newest()[variable])
    }

    /// What the difference between corrected and predicted end value tells of a connected signal.
    pub fn signal_error(&self, variable: usize, step: f64) -> ErrorShares {
        self.history.error_shares(variable, step)
    }

    /// Rate and second derivative of a variable of motion at the present macro point.
    pub fn set_rates(&mut self, variable: usize, speed: f64, acceleration: f64) {
        self.starts[variable][1] = speed;
        self.starts[variable][2] = acceleration;
    }

    /// Predicts the curves over a step of length `length`: multipliers go on as they did, motion by its jerk.
    pub fn predict(&mut self, length: f64) {
        self.length = length;
        for variable in 0..self.kinds.len() {
            let ahead = |share: f64| 1.0 + share * length / self.past_length;
            let [p, v, a] = self.starts[variable];
            let jerk = self.jerks[variable] * length.powi(3);
            let (speed, bend) = (v * length, a * length * length);
            let unknowns = self.unknowns.of(variable);
            let values = &mut self.values[unknowns];
            match self.kinds[variable] {
                Kind::Multiplier => {
                    for (value, &share) in values.iter_mut().zip(self.unknowns.shares()) {
                        *value = self.past[variable].value(ahead(share));
                    }
                }
                Kind::Motion => {
                    values[0] = p + speed + bend / 2.0 + jerk / 6.0;
                    values[1] = speed + bend + jerk / 2.0;
                }
                Kind::Signal => {
                    values[0] = self
                        .history
                        .value(variable, Curve::Extrapolated, length, length);
                }
            }
        }
        self.shape_curves();
    }

    /// Changes the unknowns.
    pub fn change(&mut self, change: &[f64]) {
        for (value, change) in self.values.iter_mut().zip(change) {
            *value += change;
        }
        self.shape_curves();
    }

    fn shape_curves(&mut self) {
        for variable in 0..self.kinds.len() {
            let [p, v, a] = self.starts[variable];
            let (speed, bend) = (v * self.length, a * self.length * self.length);
            let values = &self.values[self.unknowns.of(variable)];
            let mut curve = SharePolynomial::default();
            match self.kinds[variable] {
                Kind::Multiplier => {
                    if let Some(held) = &self.shapes.held {
                        curve.add(p, held);
                    }
                    for (value, shape) in values.iter().zip(&self.shapes.multiplier) {
                        curve.add(*value, shape);
                    }
                }
                Kind::Motion => {
                    let bend = if self.shapes.has_acceleration {
                        bend
                    } else {
                        0.0
                    };
                    curve = SharePolynomial::new([p, speed, bend / 2.0, 0.0, 0.0]);
                    let missing = [
                        values[0] - curve.value(1.0),
                        values[1] - curve.derivative(1.0),
                    ];
                    for (missing, shape) in missing.iter().zip(&self.shapes.motion) {
                        curve.add(*missing, shape);
                    }
                }
                Kind::Signal => {}
            }
            self.curves[variable] = curve;
        }
    }

    /// The values of all variables at one share of the step.
    pub fn sample(&self, share: f64, values: &mut [f64]) {
        for (variable, value) in values.iter_mut().enumerate() {
            *value = self.value(variable, share * self.length);
        }
    }

    /// `H` times the rate of every variable of motion at the end of the step.
    pub fn sample_rates(&self, rates: &mut [f64]) {
        for (variable, rate) in rates.iter_mut().enumerate() {
            if self.kinds[variable] == Kind::Motion {
                *rate = self.values[self.unknowns.of(variable)][1];
            }
        }
    }

    /// Moves on to the end of the step, where all variables have the values `ends` and motion the second derivatives
    /// `accelerations`; those of rotation vectors are angular accelerations.
    pub fn move_on(&mut self, ends: &[f64], accelerations: &[f64]) {
        for variable in 0..self.kinds.len() {
            if self.kinds[variable] == Kind::Motion {
                let speed = self.values[self.unknowns.of(variable)][1] / self.length;
                let [_, before_speed, before] = self.starts[variable];
                let now = match self.shapes.has_acceleration {
                    true => accelerations[variable],
                    false => (speed - before_speed) / self.length,
                };
                self.jerks[variable] = match self.shapes.has_acceleration {
                    true => (now - before) / self.length,
                    false => 0.0,
                };
                self.starts[variable] = [ends[variable], speed, now];
            } else {
                self.starts[variable] = [ends[variable], 0.0, 0.0];
            }
        }
        for (rotation, &first) in self.rotations.iter().enumerate() {
            let phi = vector_at(ends, first);
            let rate = Vector3::from_fn(|component, _| self.starts[first + component][1]);
            let omega = rotation_of_change(&phi, &rate);
            self.attitudes[rotation] = attitude(&self.attitudes[rotation], &phi);
            for component in 0..3 {
                let start = &mut self.starts[first + component];
                start[0] = 0.0;
                start[1] = omega[component];
            }
        }
        std::mem::swap(&mut self.past, &mut self.curves);
        self.past_length = self.length;
        self.has_past = true;
        self.history.push(self.length, ends);
    }

    /// Values of the multipliers at the present macro point.
    pub fn starts(&self) -> impl Iterator<Item = f64> {
        self.starts.iter().map(|start| start[0])
    }

    fn degree(&self, variable: usize) -> usize {
        match self.kinds[variable] {
            Kind::Multiplier => self.shapes.degrees[0],
            Kind::Motion => self.shapes.degrees[1],
            Kind::Signal => self.history.degree(variable).max(1),
        }
    }
}

impl Curves for HermiteCurves {
    fn length(&self) -> f64 {
        self.length
    }

    fn attitudes(&self) -> &[UnitQuaternion<f64>] {
        &self.attitudes
    }

    fn value(&self, variable: usize, tau: f64) -> f64 {
        match self.kinds[variable] {
            Kind::Signal => {
                let end = self.values[self.unknowns.of(variable).start];
                self.history
                    .value_through(variable, Some(end), self.length, tau)
            }
            Kind::Multiplier | Kind::Motion => self.curves[variable].value(tau / self.length),
        }
    }

    fn signal(&self, combination: &[(usize, f64)], signal: &mut Signal) {
        signal.nodes.clear();
        signal.values.clear();
        let degree = combination
            .first()
            .map_or(0, |&(first, _)| self.degree(first));
        for node in 0..=degree {
            let tau = self.length * node as f64 / degree as f64;
            let terms = combination.iter();
            let value = terms.map(|&(variable, factor)| factor * self.value(variable, tau));
            signal.nodes.push(tau);
            signal.values.push(value.sum());
        }
    }

    fn shape(&self, variable: usize, shape: usize) -> SharePolynomial {
        match self.kinds[variable] {
            Kind::Signal => self.history.end_shape(variable, self.length),
            kind => self.shapes.of(kind)[shape],
        }
    }
}
