//! Driven inputs: how they follow from the coupling variables.

use std::f64::consts::PI;

use linchpin_proto::joint_load::{Displacement, End, JointLaw};
use linchpin_proto::v1::Signal;
use nalgebra::{UnitQuaternion, Vector3};

use super::exchanged::PoseVariables;
use crate::signal::{Curves, SharePolynomial, combine};

/// An input of a subsystem and what drives it.
#[derive(Debug, Clone, PartialEq)]
pub struct DrivenInput {
    /// Place of the subsystem in the scene.
    pub subsystem: usize,
    /// Place among the signals of its subsystem.
    pub place: usize,
    /// Its name: in the model, or of a joint input.
    pub name: String,
    /// Whether it belongs to a joint load.
    pub is_joint_input: bool,
    /// Whether the response to it is asked for.
    pub is_perturbed: bool,
    /// What drives it.
    pub source: Source,
}

/// What drives an input.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    /// `sum factor variable`
    Sum(Vec<(usize, f64)>),
    /// A part of an attitude `(w, x, y, z)` of the history, constant over the step.
    Attitude {
        /// Number in the history.
        attitude: usize,
        /// 0 to 3.
        part: usize,
    },
    /// A component of force or moment whose direction turns with the bodies.
    Load(Box<Load>),
}

/// A component of the force (0, 1, 2) or moment (3, 4, 5) at a marker: the sum of loads of fixed and of turning direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Which component.
    pub component: usize,
    /// `sum factor multiplier`
    pub fixed: Vec<(usize, f64)>,
    /// Loads that depend on the poses of the markers.
    pub turning: Vec<TurningLoad>,
    /// Degree of the polynomial that is sent.
    pub degree: usize,
}

/// The load of one multiplier on a marker.
#[derive(Debug, Clone, PartialEq)]
pub struct TurningLoad {
    /// The multiplier.
    pub multiplier: usize,
    /// Its law.
    pub law: JointLaw,
    /// The end that is loaded.
    pub end: End,
    /// Poses of markers a and b.
    pub poses: [PoseVariables; 2],
}

impl Source {
    /// Adds a term of fixed factor.
    pub(super) fn add_fixed(&mut self, term: (usize, f64)) {
        match self {
            Self::Sum(combination) => combination.push(term),
            Self::Load(load) => load.fixed.push(term),
            Self::Attitude { .. } => {}
        }
    }

    /// Adds a load whose direction turns; the input then is a load of this component.
    pub(super) fn add_turning(&mut self, component: usize, degree: usize, turning: TurningLoad) {
        if let Self::Sum(fixed) = self {
            *self = Self::Load(Box::new(Load {
                component,
                fixed: std::mem::take(fixed),
                turning: Vec::new(),
                degree,
            }));
        }
        if let Self::Load(load) = self {
            load.turning.push(turning);
        }
    }
}

impl DrivenInput {
    /// Whether the input depends on multipliers, the first `rows` variables.
    pub fn drives_load(&self, rows: usize) -> bool {
        match &self.source {
            Source::Sum(combination) => combination.iter().any(|(variable, _)| *variable < rows),
            Source::Attitude { .. } => false,
            Source::Load(_) => true,
        }
    }

    /// Value of the input at values `w` of all variables.
    pub fn value(&self, w: &[f64], attitudes: &[UnitQuaternion<f64>]) -> f64 {
        match &self.source {
            Source::Sum(combination) => combine(combination, w),
            Source::Attitude { attitude, part } => {
                let q = &attitudes[*attitude];
                [q.w, q.i, q.j, q.k][*part]
            }
            Source::Load(load) => load.value(w, attitudes),
        }
    }

    /// Numbers of the variables that the input depends on, in the order of [`DrivenInput::gradient`].
    pub fn variables(&self, variables: &mut Vec<usize>) {
        match &self.source {
            Source::Sum(combination) => variables.extend(combination.iter().map(|(v, _)| *v)),
            Source::Attitude { .. } => {}
            Source::Load(load) => {
                variables.extend(load.fixed.iter().map(|(variable, _)| *variable));
                for turning in &load.turning {
                    variables.push(turning.multiplier);
                    variables.extend(turning.poses.iter().flat_map(PoseVariables::variables));
                }
            }
        }
    }

    /// Appends the derivatives of [`DrivenInput::value`] with respect to those variables.
    pub fn gradient(&self, w: &[f64], attitudes: &[UnitQuaternion<f64>], gradient: &mut Vec<f64>) {
        match &self.source {
            Source::Sum(combination) => gradient.extend(combination.iter().map(|(_, f)| *f)),
            Source::Attitude { .. } => {}
            Source::Load(load) => load.gradient(w, attitudes, gradient),
        }
    }

    /// The signal over the step of `over`.
    pub fn signal(&self, over: &mut Over<'_>, signal: &mut Signal) {
        match &self.source {
            Source::Sum(combination) => over.curves.signal(combination, signal),
            Source::Attitude { .. } => {
                signal.set_constant(self.value(&[], over.curves.attitudes()));
            }
            Source::Load(load) => load.signal(over, signal),
        }
    }

    /// The direction in which [`DrivenInput::raised_signal`] raises the signal.
    pub fn direction(&self, over: &mut Over<'_>, shape: &SharePolynomial, signal: &mut Signal) {
        self.signal(over, signal);
        for (value, &tau) in signal.values.iter_mut().zip(&signal.nodes) {
            *value = shape.value(over.curves.share(tau));
        }
    }

    /// The signal that is higher by `increment` times `shape`, a polynomial of no higher degree.
    pub fn raised_signal(
        &self,
        over: &mut Over<'_>,
        shape: &SharePolynomial,
        increment: f64,
        signal: &mut Signal,
    ) {
        self.signal(over, signal);
        for (value, &tau) in signal.values.iter_mut().zip(&signal.nodes) {
            *value += increment * shape.value(over.curves.share(tau));
        }
    }
}

/// The step that signals are made for.
pub struct Over<'a> {
    /// The variables over the step.
    pub curves: &'a dyn Curves,
    /// Memory for one value of every variable.
    pub memory: &'a mut [f64],
}

impl Load {
    fn value(&self, w: &[f64], attitudes: &[UnitQuaternion<f64>]) -> f64 {
        let turning = self.turning.iter().map(|turning| {
            let poses = turning.poses.each_ref().map(|pose| pose.pose(w, attitudes));
            let unit = turning.law.unit_wrench(turning.end, &poses);
            w[turning.multiplier] * unit.component(self.component)
        });
        combine(&self.fixed, w) + turning.sum::<f64>()
    }

    fn gradient(&self, w: &[f64], attitudes: &[UnitQuaternion<f64>], gradient: &mut Vec<f64>) {
        gradient.extend(self.fixed.iter().map(|(_, factor)| *factor));
        for turning in &self.turning {
            let poses = turning.poses.each_ref().map(|pose| pose.pose(w, attitudes));
            let unit = turning.law.unit_wrench(turning.end, &poses);
            gradient.push(unit.component(self.component));
            let multiplier = w[turning.multiplier];
            for (end, pose) in turning.poses.iter().enumerate() {
                for (_, displacement) in pose.displacements(w) {
                    let mut moved = [Displacement {
                        position: Vector3::zeros(),
                        rotation: Vector3::zeros(),
                    }; 2];
                    moved[end] = displacement;
                    let change = turning.law.unit_wrench_change(turning.end, &poses, &moved);
                    gradient.push(multiplier * change.component(self.component));
                }
            }
        }
    }

    /// The multiplier in whose shapes the load is raised.
    pub fn leading(&self) -> usize {
        self.turning.first().map_or(0, |first| first.multiplier)
    }

    /// The polynomial through samples of the load under the curves of all variables, at Chebyshev points that include both
    /// ends of the step; a single one stands at its end.
    fn signal(&self, over: &mut Over<'_>, signal: &mut Signal) {
        signal.nodes.clear();
        signal.values.clear();
        let step = over.curves.length();
        let degree = if step > 0.0 { self.degree } else { 0 };
        for node in 0..=degree {
            let tau = match degree {
                0 => step,
                degree => {
                    let angle = PI * node as f64 / degree as f64;
                    0.5 * step * (1.0 - angle.cos())
                }
            };
            self.sample_variables(over, tau);
            signal.nodes.push(tau);
            signal
                .values
                .push(self.value(over.memory, over.curves.attitudes()));
        }
    }

    /// Writes the values at `tau` of all variables that the load depends on.
    fn sample_variables(&self, over: &mut Over<'_>, tau: f64) {
        let curves = over.curves;
        let memory = &mut *over.memory;
        let mut sample = |variable: usize| memory[variable] = curves.value(variable, tau);
        self.fixed
            .iter()
            .for_each(|&(variable, _)| sample(variable));
        for turning in &self.turning {
            sample(turning.multiplier);
            let poses = turning.poses.iter();
            poses
                .flat_map(PoseVariables::variables)
                .for_each(&mut sample);
        }
    }
}
