//! How large the error of a macro step is, compared with what is allowed.

use serde::{Deserialize, Serialize};

use crate::layout::Layout;

/// The worst error of a macro step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Error over what is allowed: a step with more than 1 is too long.
    pub scaled: f64,
    /// The power of the macro step with which it falls.
    pub order: usize,
    /// What has it.
    pub suspect: Suspect,
    /// Whether it is known from this step alone: then it does not swing with the lengths of the steps before.
    pub is_of_step_alone: bool,
    /// Largest difference between a corrected and a predicted multiplier. Where the solution jumps it does not fall with the step.
    pub change: f64,
}

/// What an error belongs to.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Suspect {
    /// Nothing has an error.
    #[default]
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
        is_of_step_alone: false,
        change: 0.0,
    };

    /// Takes an error and what is allowed of it; no error is allowed everywhere.
    pub fn add_error(&mut self, error: f64, allowed: f64, order: usize, suspect: Suspect) {
        if error != 0.0 {
            self.add(error / allowed, order, suspect);
        }
    }

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
    pub fn suspect_name(&self, layout: &Layout) -> String {
        self.suspect.name(layout)
    }
}

impl Suspect {
    /// Its name; empty if there is none.
    pub fn name(self, layout: &Layout) -> String {
        match self {
            Self::None => String::new(),
            Self::Output { subsystem, output } => {
                let name = &layout.subsystems[subsystem];
                format!("{name}.{}", layout.outputs[subsystem][output])
            }
            Self::Variable(variable) => layout.variable_name(variable),
            Self::Opening(row) => layout.column_name(row, "residual.position"),
        }
    }
}
