//! Columns of the workers' responses: finite differences with respect to their driven inputs (S1 eqs. 62, 63).
//!
//! * `basis`: in which curves inputs are raised;
//! * `responses`: columns from the answers;
//! * `measured`: responses over one length, and what they depend on;
//! * `kept`: responses of earlier macro steps that stay in use;
//! * `axes`: responses that turn with the bodies;
//! * `lengths`: responses over one length, from those that were measured over others;
//! * `settings`: its constants;
//! * `resolution`: whether the macro step resolves the responses.

mod axes;
mod basis;
mod kept;
mod lengths;
mod measured;
mod resolution;
mod responses;
mod settings;

use std::ops::Range;

use crate::joint::Level;
use crate::layout::{DrivenInput, Layout, Position};
use crate::signal::{Curves, Nodes, SharePolynomial};
use crate::system::unknowns::Unknowns;
use crate::system::{
    Column, Differentiation, Increment, Listening, LookAhead, Perturbation, Response, Sizes,
};

use serde::{Deserialize, Serialize};

pub use basis::{Basis, Measuring};
use kept::Kept;
use measured::{Kind, Measured};
pub use resolution::Resolution;
pub(crate) use settings::SETTINGS;
pub use settings::Settings;

/// Part of the largest response of a subsystem by which loads are raised that hardly move it.
const LEAST_RESPONSE: f64 = 1e-4;

/// The columns of all driven inputs, one for each shape of an input.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    rule: Increment,
    basis: Basis,
    /// How the responses of each subsystem are had.
    differentiation: Vec<Differentiation>,
    columns: Vec<Column>,
    /// The shape of each column in the present step.
    shapes: Vec<SharePolynomial>,
    /// The columns of each input.
    of_input: Vec<Range<usize>>,
    /// Inputs raised in each of the curves of the basis.
    raised: Vec<Column>,
    /// The raised ones of each input.
    raised_of_input: Vec<Range<usize>>,
    /// How many of them the present step asks of each subsystem.
    raised_of_subsystem: Vec<usize>,
    /// What the last look-ahead was asked for.
    asked: Vec<Perturbation>,
    /// Which ones a step needs.
    needed: Vec<bool>,
    /// The responses to them, as they were last measured or carried along.
    responses: Vec<Vec<f64>>,
    /// The markers' positions among the coupling outputs of each subsystem.
    positions: Vec<Vec<Position>>,
    /// For each input whether it is a length, and whether a moment.
    kinds: Vec<[bool; 2]>,
    /// The largest responses of each subsystem to forces and to moments.
    largest: Vec<[Response; 2]>,
    /// What motion is measured by at the present macro point.
    sizes: Sizes,
    /// Size of the mechanism in m at the end of the look-ahead.
    length_ahead: f64,
    /// Whether the last look-ahead was asked for responses that were not taken yet.
    are_fresh: bool,
    kept: Kept,
    resolution: Resolution,
    /// Length of the look-ahead in s.
    length: f64,
}

/// What is remembered of earlier macro steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    settled: Vec<Measured>,
    last: Kind,
    /// For each raised input the response by which increments are chosen.
    responses: Vec<Response>,
    /// Size of the mechanism in m.
    size: f64,
    resolution: Resolution,
}

impl Columns {
    /// The columns of the driven inputs of `layout` over a look-ahead, one for each shape of an input; the conditions are made of outputs on
    /// `levels`.
    pub fn new(
        measuring: Measuring,
        levels: &'static [Level],
        layout: &Layout,
        unknowns: &Unknowns,
        differentiation: &[Differentiation],
    ) -> Self {
        let Measuring {
            increment,
            sizes,
            basis,
            stay,
        } = measuring;
        let mut own = Self {
            rule: increment,
            basis,
            differentiation: differentiation.to_vec(),
            columns: Vec::new(),
            shapes: Vec::new(),
            of_input: Vec::new(),
            raised: Vec::new(),
            raised_of_input: Vec::new(),
            raised_of_subsystem: vec![0; layout.outputs.len()],
            asked: Vec::new(),
            needed: Vec::new(),
            responses: Vec::new(),
            positions: positions_of(layout),
            kinds: kinds_of(layout),
            largest: vec![[Response::default(); 2]; layout.outputs.len()],
            length_ahead: sizes.length,
            sizes,
            are_fresh: false,
            kept: Kept::new(layout, levels, stay, sizes.length),
            resolution: Resolution::new(layout),
            length: 0.0,
        };
        for (number, input) in layout.inputs.iter().enumerate() {
            let numbers = unknowns.columns(number);
            own.columns.resize_with(numbers.end, Column::default);
            let first = own.raised.len();
            if !numbers.is_empty() {
                let end = first + basis.curves(numbers.len());
                own.raised.resize_with(end, || Column::new(input, layout));
            }
            own.raised_of_input.push(first..own.raised.len());
            // All shapes of an input are needed; which powers these are made of depends on the step.
            own.needed.resize(own.raised.len(), input.is_perturbed);
            own.of_input.push(numbers);
        }
        own.shapes
            .resize(own.columns.len(), SharePolynomial::default());
        own.responses.resize_with(own.raised.len(), Vec::new);
        own
    }

    /// What is remembered, to be written.
    pub fn state(&self) -> State {
        let (settled, last) = self.kept.state();
        State {
            settled,
            last,
            responses: self.raised.iter().map(Column::kept_response).collect(),
            size: self.sizes.length,
            resolution: self.resolution.clone(),
        }
    }

    /// Goes on from what was written.
    pub fn resume(&mut self, state: State) {
        self.are_fresh = false;
        self.kept.resume(state.settled, state.last);
        for (raised, response) in self.raised.iter_mut().zip(state.responses) {
            raised.resume_response(response);
        }
        (self.sizes.length, self.length_ahead) = (state.size, state.size);
        self.resolution = state.resolution;
    }

    /// Foresees the responses to loads, for each driven input one where it is known.
    pub fn foresee(&mut self, responses: &[Option<Response>]) {
        for (own, response) in self.raised_of_input.iter().zip(responses) {
            if let Some(response) = response {
                let raised = self.raised[own.clone()].iter_mut();
                raised.for_each(|raised| raised.resume_response(*response));
            }
        }
    }

    /// Takes the largest responses of each subsystem to forces and to moments; where there are none of one kind, they are those of the other
    /// with an arm of the size of the mechanism.
    fn take_largest(&mut self, layout: &Layout) {
        self.largest.fill([Response::default(); 2]);
        for (number, input) in layout.inputs.iter().enumerate() {
            let [_, is_moment] = self.kinds[number];
            let largest = &mut self.largest[input.subsystem][usize::from(is_moment)];
            for raised in &self.raised[self.raised_of_input[number].clone()] {
                if raised.is_load {
                    *largest = largest.larger(raised.kept_response());
                }
            }
        }
        let arm = self.sizes.length;
        for [of_force, of_moment] in &mut self.largest {
            if of_force.share == 0.0 {
                *of_force = of_moment.times(arm);
            } else if of_moment.share == 0.0 {
                *of_moment = of_force.times(1.0 / arm);
            }
        }
    }

    /// The columns in the order of the inputs; those of inputs that are not perturbed are empty.
    pub fn all(&self) -> &[Column] {
        &self.columns
    }

    /// Whether responses stay in use after their macro step.
    pub fn stay(&self) -> bool {
        self.kept.stay
    }

    /// How well the macro steps have resolved the responses.
    pub fn resolution(&self) -> &Resolution {
        &self.resolution
    }

    /// Chooses what a look-ahead over these curves is asked for beside its outputs: every perturbed input in the curves that are needed,
    /// if `with_columns`. `ends` are the values of all variables at its end.
    pub fn ask(
        &mut self,
        layout: &Layout,
        curves: &dyn Curves,
        ends: &[f64],
        with_columns: bool,
    ) -> &[Perturbation] {
        self.are_fresh = with_columns;
        self.length = curves.length();
        if with_columns || self.basis == Basis::Powers {
            self.take_shapes(layout, curves);
        }
        self.asked.clear();
        if with_columns {
            self.take_largest(layout);
            self.raised_of_subsystem.fill(0);
            for (number, input) in layout.inputs.iter().enumerate() {
                if input.is_perturbed {
                    let end = input.value(ends, curves.attitudes());
                    self.ask_input(layout, number, (input, end));
                }
            }
        }
        &self.asked
    }

    /// The shapes of the columns over these curves, and which raised inputs they need.
    fn take_shapes(&mut self, layout: &Layout, curves: &dyn Curves) {
        if self.basis == Basis::Powers {
            self.needed.fill(false);
        }
        let ranges = self.of_input.iter().zip(&self.raised_of_input);
        for (input, (columns, raised)) in layout.inputs.iter().zip(ranges) {
            if !input.is_perturbed {
                continue;
            }
            let leading = Unknowns::leading(input);
            for (number, column) in columns.clone().enumerate() {
                let shape = curves.shape(leading, number);
                if self.basis == Basis::Powers {
                    let needed = self.needed[raised.clone()].iter_mut();
                    for (needed, coefficient) in needed.zip(shape.coefficients()) {
                        *needed |= *coefficient != 0.0;
                    }
                }
                self.shapes[column] = shape;
            }
        }
    }

    /// Raises an input, whose predicted value at the end of the step is `end`, in the curves that are needed.
    fn ask_input(&mut self, layout: &Layout, number: usize, (input, end): (&DrivenInput, f64)) {
        let is_read = !layout.outputs[input.subsystem].is_empty();
        let Differentiation { noise, .. } = self.differentiation[input.subsystem];
        let gives_derivatives = self.gives_derivatives(input.subsystem);
        let [is_length, is_moment] = self.kinds[number];
        let unit = if is_length { self.sizes.length } else { 1.0 };
        let largest = self.largest[input.subsystem][usize::from(is_moment)];
        let curves =
            { self.raised[self.raised_of_input[number].clone()].iter() }.map(Column::kept_response);
        let of_others = curves.fold(largest.times(LEAST_RESPONSE), Response::larger);
        let listening = Listening {
            length: self.length,
            noise,
            span: self.sizes.span,
            of_others,
        };
        let shapes = &self.shapes[self.of_input[number].clone()];
        let own = self.raised_of_input[number].clone();
        let needed = &self.needed[own.clone()];
        let count = &mut self.raised_of_subsystem[input.subsystem];
        for (curve, (raised, is_needed)) in self.raised[own].iter_mut().zip(needed).enumerate() {
            raised.place = (is_read && *is_needed).then_some(*count);
            let Some(place) = raised.place else {
                continue;
            };
            *count += 1;
            let increment = (!gives_derivatives).then(|| {
                let least = raised.least(end, listening);
                raised.choose_increment(self.rule, end, least, unit);
                raised.increment
            });
            self.asked.push(Perturbation {
                input: number,
                place,
                shape: self.basis.curve(shapes, curve),
                increment,
            });
        }
    }

    fn gives_derivatives(&self, subsystem: usize) -> bool {
        self.rule == Increment::Derivatives && self.differentiation[subsystem].has_derivatives
    }

    /// Looks for responses of earlier macro steps for a look-ahead of this length over these curves, with these past nodes. Gives the
    /// share of them that may be wrong because they were measured over other lengths; `None` if there are none.
    pub fn prepare(
        &mut self,
        layout: &Layout,
        (length, nodes): (f64, Nodes<'_>),
        curves: &dyn Curves,
    ) -> Option<f64> {
        if self.basis == Basis::Powers {
            self.take_shapes(layout, curves);
        }
        let nodes = self.basis.nodes(nodes);
        let needed = (&self.raised_of_input[..], &self.needed[..]);
        self.kept.prepare(layout, (length, nodes), needed)
    }

    /// Begins with the first look-ahead over a macro step, or over a repeated one, of this length and with these past nodes. Gives
    /// whether the macro step before was such a one.
    pub fn begin(&mut self, length: f64, nodes: Nodes<'_>) -> bool {
        self.raised.iter_mut().for_each(Column::drop_response);
        self.length_ahead = self.sizes.length;
        self.kept.begin(length, self.basis.nodes(nodes))
    }

    /// The step is done: its responses may serve later ones, and increments are chosen by them.
    pub fn settle(&mut self) {
        self.kept.settle();
        self.raised.iter_mut().for_each(Column::keep_response);
        self.sizes.length = self.length_ahead;
    }

    /// Takes the difference quotients of the last answers of all workers, if columns were asked for; otherwise carries earlier
    /// ones along to the attitudes of the last prediction.
    pub fn difference(&mut self, layout: &Layout, ahead: &dyn LookAhead) {
        if std::mem::take(&mut self.are_fresh) {
            self.take_responses(layout, ahead);
            self.kept.keep(layout, ahead, &self.responses);
        } else {
            let own = &self.raised_of_input;
            let carried = self.kept.carry(layout, ahead, own, &mut self.responses);
            if !carried {
                return;
            }
        }
        self.combine();
    }
}

/// The markers' positions among the coupling outputs of each subsystem.
fn positions_of(layout: &Layout) -> Vec<Vec<Position>> {
    let mut positions = vec![Vec::new(); layout.outputs.len()];
    for end in layout.joints.iter().flat_map(|joint| &joint.ends) {
        positions[end.subsystem].extend(end.sized(Level::Position));
    }
    positions
}

/// For each input whether it is the coordinate of a marker, and whether a moment.
fn kinds_of(layout: &Layout) -> Vec<[bool; 2]> {
    let inputs = layout.inputs.iter();
    let kind = |input| [layout.is_length(input), layout.is_moment(input)];
    inputs.map(kind).collect()
}
