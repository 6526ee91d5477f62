//! What error of a macro step is allowed.

use serde::{Deserialize, Serialize};

use crate::layout::{Layout, What};
use crate::system::Outputs;

/// What error of a step is allowed of each quantity that the coupling watches: the absolute tolerance and the relative one times the
/// largest size so far, both divided by one more than the path so far in sizes; but not less than the tolerance that the subsystem's solver reports.
///
/// Errors of the phase add up along the path: with `tolerance / (1 + path)` for each piece of it, an oscillation that goes on collects `tolerance
/// ln(1 + path)`, whatever its frequency.
///
/// The coordinates of both markers of a joint have one size in m, their angles one in rad, which is 1 at most: a wheel that has turned
/// often is not less accurate for it. Every connected signal has its own.
pub struct Tolerance {
    relative: f64,
    /// Of what is no length.
    absolute: f64,
    /// Whether sizes are displacements from the start, and errors are not shared out along the path.
    is_of_motion: bool,
    state: State,
    /// For each subsystem the error that its solver allows itself: less cannot be told.
    solvers: Vec<f64>,
}

/// Positions are rounded by this share of them, and by some steps.
const ROUNDING: f64 = 1e-13;

/// The sizes of all quantities so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Lengths are at least so long as this radius in m times the angles, once it is known.
    lever: Option<f64>,
    sizes: Vec<Size>,
    /// For each subsystem and coupling output what it belongs to, if it is watched.
    watched: Vec<Vec<Option<Watched>>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Size {
    /// What is allowed whatever the size.
    absolute: f64,
    largest: f64,
    /// What it may become in the present attempt at a step.
    ahead: f64,
    most: f64,
    path: f64,
    /// Number of values that the path goes through.
    points: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Watched {
    size: usize,
    start: f64,
    /// Value at the last macro point.
    last: f64,
}

impl Tolerance {
    /// With the tolerance relative to sizes and the absolute ones, of lengths in m and of all else, for the quantities of `layout` at a start with
    /// these `outputs`; `solvers` are the tolerances of the subsystems' solvers.
    pub fn new(
        relative: f64,
        absolute: [f64; 2],
        layout: &Layout,
        solvers: Vec<f64>,
        outputs: &dyn Outputs,
    ) -> Self {
        Self::of((relative, absolute), false, layout, solvers, outputs)
    }

    /// A share of the motion: of the largest displacement from a start with these `outputs`, one in m and one in rad for all joints.
    /// It is not less than the tolerances of the `solvers` and than the rounding of the positions: motion so small is rest.
    pub fn of_motion(
        share: f64,
        layout: &Layout,
        solvers: Vec<f64>,
        outputs: &dyn Outputs,
    ) -> Self {
        let mut own = Self::of((share, [0.0; 2]), true, layout, solvers, outputs);
        for subsystem in 0..own.solvers.len() {
            for output in 0..own.state.watched[subsystem].len() {
                if let Some(group) = own.group_of_output(subsystem, output) {
                    let rounding = ROUNDING * outputs.of(subsystem)[output].abs();
                    let least = own.solvers[subsystem].max(rounding) / share;
                    let size = &mut own.state.sizes[group];
                    size.largest = size.largest.max(least).min(size.most);
                }
            }
        }
        own
    }

    fn of(
        (relative, absolute): (f64, [f64; 2]),
        is_of_motion: bool,
        layout: &Layout,
        solvers: Vec<f64>,
        outputs: &dyn Outputs,
    ) -> Self {
        let watched = layout
            .outputs
            .iter()
            .map(|outputs| vec![None; outputs.len()]);
        let [lengths, others] = absolute;
        let mut tolerance = Self {
            relative,
            absolute: others,
            is_of_motion,
            state: State {
                lever: None,
                sizes: Vec::new(),
                watched: watched.collect(),
            },
            solvers,
        };
        let mut sizes = None;
        for joint in &layout.joints {
            // Motion is that of the whole scene: a joint may stay where it is.
            let known = sizes.filter(|_| is_of_motion);
            let [length, angle] = known.unwrap_or_else(|| {
                let groups = [(f64::INFINITY, lengths), (1.0, others)];
                groups.map(|(most, absolute)| tolerance.add_size(most, absolute))
            });
            sizes = Some([length, angle]);
            for end in &joint.ends {
                for place in end.positions() {
                    let is_length = end.coordinates().contains(&place);
                    tolerance.watch(end.subsystem, place, if is_length { length } else { angle });
                }
            }
        }
        // A body on a pin moves although the pin does not.
        if let Some([_, angle]) = sizes.filter(|_| is_of_motion) {
            for frame in &layout.frames {
                for &place in &frame.attitude {
                    tolerance.watch(frame.subsystem, place, angle);
                }
            }
        }
        for exchanged in &layout.exchanged {
            if let What::Output(place) = exchanged.what {
                let own = tolerance.add_size(f64::INFINITY, others);
                tolerance.watch(exchanged.subsystem, place, own);
            }
        }
        tolerance.begin(outputs);
        tolerance
    }

    fn add_size(&mut self, most: f64, absolute: f64) -> usize {
        self.state.sizes.push(Size {
            absolute,
            largest: 0.0,
            ahead: 0.0,
            most,
            path: 0.0,
            points: 0.0,
        });
        self.state.sizes.len() - 1
    }

    fn watch(&mut self, subsystem: usize, output: usize, size: usize) {
        let new = Watched {
            size,
            start: 0.0,
            last: 0.0,
        };
        self.state.watched[subsystem][output].get_or_insert(new);
    }

    fn begin(&mut self, outputs: &dyn Outputs) {
        if self.is_of_motion {
            for (subsystem, watched) in self.state.watched.iter_mut().enumerate() {
                for (&value, watched) in outputs.of(subsystem).iter().zip(watched) {
                    if let Some(watched) = watched {
                        watched.start = value;
                    }
                }
            }
        }
        self.observe(outputs);
        for size in &mut self.state.sizes {
            (size.path, size.points) = (0.0, 0.0);
        }
    }

    /// Takes the values at a macro point that is reached.
    pub fn observe(&mut self, outputs: &dyn Outputs) {
        for (subsystem, watched) in self.state.watched.iter_mut().enumerate() {
            for (&value, watched) in outputs.of(subsystem).iter().zip(watched) {
                let Some(watched) = watched else {
                    continue;
                };
                let size = &mut self.state.sizes[watched.size];
                size.largest = size
                    .largest
                    .max((value - watched.start).abs())
                    .min(size.most);
                if size.largest > 0.0 {
                    size.path += (value - watched.last).abs() / size.largest;
                    size.points += 1.0;
                }
                watched.last = value;
            }
        }
    }

    /// Takes values that may be reached in the present attempt at a step.
    pub fn foresee(&mut self, outputs: &dyn Outputs) {
        for size in &mut self.state.sizes {
            size.ahead = 0.0;
        }
        for subsystem in 0..self.state.watched.len() {
            // What is told inside the step stands behind the outputs at its end.
            let number = self.state.watched[subsystem].len();
            for (output, &value) in outputs.of(subsystem).iter().enumerate().take(number) {
                if let Some(watched) = self.state.watched[subsystem][output] {
                    self.foresee_size(subsystem, output, (value - watched.start).abs());
                }
            }
        }
    }

    /// Takes a size of one output that its group may have in the present attempt at a step.
    pub fn foresee_size(&mut self, subsystem: usize, output: usize, size: f64) {
        if let Some(group) = self
            .group_of_output(subsystem, output)
            .filter(|_| size.is_finite())
        {
            let own = &mut self.state.sizes[group];
            own.ahead = own.ahead.max(size).min(own.most);
        }
    }

    /// Number of groups of quantities that have one size.
    pub fn sizes(&self) -> usize {
        self.state.sizes.len()
    }

    /// Gives the radius in m by which angles are compared with lengths.
    pub fn set_lever(&mut self, lever: f64) {
        self.state.lever = Some(lever);
    }

    /// Size of a group so far.
    pub fn size(&self, group: usize) -> f64 {
        let sizes = &self.state.sizes;
        let own = |size: &Size| size.largest.max(size.ahead);
        let turned = match (self.state.lever, sizes.as_slice()) {
            (Some(lever), [_, angle, ..]) if group == 0 && lever > 0.0 => lever * own(angle),
            _ => 0.0,
        };
        own(&sizes[group]).max(turned)
    }

    /// The group of a coupling output, if it is watched.
    pub fn group_of_output(&self, subsystem: usize, output: usize) -> Option<usize> {
        self.state.watched[subsystem][output].map(|watched| watched.size)
    }

    /// The group of the positions that a joint closes in one row.
    pub fn group_of_opening(&self, layout: &Layout, row: usize) -> Option<usize> {
        let [subsystem, output] = output_like(layout, row)?;
        self.group_of_output(subsystem, output)
    }

    /// What is remembered, to be written.
    pub fn state(&self) -> State {
        self.state.clone()
    }

    /// Goes on from what was written.
    pub fn resume(&mut self, state: State) {
        self.state = state;
    }

    /// The error that is allowed of a coupling output.
    pub fn allowed_of_output(&self, subsystem: usize, output: usize) -> f64 {
        let allowed = match self.state.watched[subsystem][output] {
            Some(watched) => {
                let largest = self.size(watched.size);
                let Size { absolute, path, .. } = self.state.sizes[watched.size];
                let path = if self.is_of_motion { 0.0 } else { path };
                (absolute + self.relative * largest) / (1.0 + path)
            }
            None => self.absolute,
        };
        allowed.max(self.solvers[subsystem])
    }

    /// The error that is allowed of an exchanged variable in one step, where errors of all steps add up: that of a piece of the path as long as
    /// its size, shared among the steps that it takes on the average.
    pub fn allowed_in_step(&self, subsystem: usize, what: What) -> f64 {
        let share = match what {
            _ if self.is_of_motion => 1.0,
            What::Output(output) => self.state.watched[subsystem][output].map_or(1.0, |watched| {
                let Size { path, points, .. } = self.state.sizes[watched.size];
                if path < points { path / points } else { 1.0 }
            }),
            What::Attitude { .. } => 1.0,
        };
        let share = if share > 0.0 { share } else { 1.0 };
        (share * self.allowed_of_variable(subsystem, what)).max(self.solvers[subsystem])
    }

    /// How far a joint may be open in one row: as far as its markers may be off.
    pub fn allowed_of_opening(&self, layout: &Layout, row: usize) -> f64 {
        output_like(layout, row).map_or(self.absolute, |[subsystem, output]| {
            self.allowed_of_output(subsystem, output)
        })
    }

    /// The error that is allowed of an exchanged variable.
    pub fn allowed_of_variable(&self, subsystem: usize, what: What) -> f64 {
        match what {
            What::Output(output) => self.allowed_of_output(subsystem, output),
            What::Attitude { .. } => self.absolute + self.relative,
        }
    }
}

/// The first marker's coordinate or angle that a joint closes in one row: its subsystem and output.
fn output_like(layout: &Layout, row: usize) -> Option<[usize; 2]> {
    let joint = layout.joint_of(row);
    let condition = joint.joint.condition(layout.rows[row].condition);
    let end = &joint.ends[0];
    let is_length = |place: &usize| end.coordinates().contains(place);
    let like = end
        .positions()
        .find(|place| is_length(place) == condition.is_length());
    like.map(|output| [end.subsystem, output])
}
