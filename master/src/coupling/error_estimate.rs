//! How large the error of a macro step is, compared with what is allowed.

use crate::layout::{Layout, What};
use crate::scene::StepControl;
use crate::workers::Parts;

/// The worst error of a macro step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Error over what is allowed: a step with more than 1 is too long.
    pub scaled: f64,
    /// The power of the macro step with which it falls.
    pub order: usize,
    /// What has it.
    pub suspect: Suspect,
    /// Largest difference between a corrected and a predicted multiplier. Where the solution jumps it does not fall with the step.
    pub change: f64,
}

/// What an error belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Suspect {
    /// Nothing has an error.
    None,
    /// A coupling output of a subsystem.
    Output {
        /// Place of the subsystem.
        subsystem: usize,
        /// Place among its coupling outputs.
        output: usize,
    },
    /// A coupling variable.
    Variable(usize),
    /// The opening of the joint with this row of the coupling system.
    Opening(usize),
}

impl Estimate {
    /// No error at all.
    pub const NONE: Self = Self {
        scaled: 0.0,
        order: 1,
        suspect: Suspect::None,
        change: 0.0,
    };

    /// Takes a part of the error; one that is no number counts as infinite.
    pub fn add(&mut self, scaled: f64, order: usize, suspect: Suspect) {
        let scaled = if scaled.is_nan() {
            f64::INFINITY
        } else {
            scaled
        };
        if scaled > self.scaled {
            self.scaled = scaled;
            self.order = order;
            self.suspect = suspect;
        }
    }

    /// Name of what has the error, for messages.
    pub fn suspect_name(&self, parts: &Parts) -> String {
        match self.suspect {
            Suspect::None => String::new(),
            Suspect::Output { subsystem, output } => {
                let subsystem = &parts.subsystems[subsystem];
                format!("{}.{}", subsystem.name(), subsystem.output_names[output])
            }
            Suspect::Variable(variable) => parts.layout.variable_name(variable),
            Suspect::Opening(row) => parts.layout.column_name(row, "residual.position"),
        }
    }
}

/// What error of a step is allowed of each quantity that the coupling watches: the absolute tolerance and the relative one times the
/// largest size so far, both divided by one more than the path so far in sizes; but not less than the tolerance that the subsystem's solver reports.
///
/// Errors of the phase add up along the path: with `tolerance / (1 + path)` for each piece of it, an oscillation that goes on collects `tolerance
/// ln(1 + path)`, whatever its frequency.
///
/// The coordinates of both markers of a joint have one size in m, their angles one in rad, which is 1 at most: a wheel that has turned
/// often is not less accurate for it. Every connected signal has its own.
pub struct ErrorScales {
    relative: f64,
    absolute: f64,
    sizes: Vec<Size>,
    /// For each subsystem the error that its solver allows itself: less cannot be told.
    solvers: Vec<f64>,
    /// For each subsystem and coupling output what it belongs to, if it is watched.
    watched: Vec<Vec<Option<Watched>>>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Size {
    largest: f64,
    most: f64,
    path: f64,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Watched {
    size: usize,
    /// Value at the last macro point.
    last: f64,
}

impl ErrorScales {
    /// For the quantities of `layout`, at a start whose outputs are known.
    pub fn new(control: &StepControl, parts: &Parts) -> Self {
        let layout = &parts.layout;
        let watched = layout
            .outputs
            .iter()
            .map(|outputs| vec![None; outputs.len()]);
        let mut scales = Self {
            relative: control.tolerance,
            absolute: control.absolute_tolerance,
            sizes: Vec::new(),
            solvers: parts
                .subsystems
                .iter()
                .map(|subsystem| subsystem.tolerance.unwrap_or_default())
                .collect(),
            watched: watched.collect(),
        };
        for joint in &layout.joints {
            let length = scales.add_size(f64::INFINITY);
            let angle = scales.add_size(1.0);
            for end in &joint.ends {
                for place in end.positions() {
                    let is_length = end.coordinates().contains(&place);
                    scales.watch(end.subsystem, place, if is_length { length } else { angle });
                }
            }
        }
        for exchanged in &layout.exchanged {
            if let What::Output(place) = exchanged.what {
                let own = scales.add_size(f64::INFINITY);
                scales.watch(exchanged.subsystem, place, own);
            }
        }
        scales.begin(parts);
        scales
    }

    fn add_size(&mut self, most: f64) -> usize {
        self.sizes.push(Size {
            largest: 0.0,
            most,
            path: 0.0,
        });
        self.sizes.len() - 1
    }

    fn watch(&mut self, subsystem: usize, output: usize, size: usize) {
        let last = 0.0;
        self.watched[subsystem][output].get_or_insert(Watched { size, last });
    }

    fn begin(&mut self, parts: &Parts) {
        self.observe(parts);
        for size in &mut self.sizes {
            size.path = 0.0;
        }
    }

    /// Takes the values at a macro point that is reached.
    pub fn observe(&mut self, parts: &Parts) {
        for (subsystem, watched) in parts.subsystems.iter().zip(&mut self.watched) {
            for (&value, watched) in subsystem.coupling_values().iter().zip(watched) {
                let Some(watched) = watched else {
                    continue;
                };
                let size = &mut self.sizes[watched.size];
                size.largest = size.largest.max(value.abs()).min(size.most);
                if size.largest > 0.0 {
                    size.path += (value - watched.last).abs() / size.largest;
                }
                watched.last = value;
            }
        }
    }

    /// The error that is allowed of a coupling output.
    pub fn allowed_of_output(&self, subsystem: usize, output: usize) -> f64 {
        let allowed = match self.watched[subsystem][output] {
            Some(watched) => {
                let Size { largest, path, .. } = self.sizes[watched.size];
                (self.absolute + self.relative * largest) / (1.0 + path)
            }
            None => self.absolute,
        };
        allowed.max(self.solvers[subsystem])
    }

    /// How far a joint may be open in one row: as far as its markers may be off.
    pub fn allowed_of_opening(&self, layout: &Layout, row: usize) -> f64 {
        let joint = layout.joint_of(row);
        let condition = joint.joint.condition(layout.rows[row].condition);
        let end = &joint.ends[0];
        let mut positions = end.positions();
        let is_length = |place: &usize| end.coordinates().contains(place);
        let like = positions.find(|place| is_length(place) == condition.is_length());
        like.map_or(self.absolute, |place| {
            self.allowed_of_output(end.subsystem, place)
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
