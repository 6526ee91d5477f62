//! The values at one macro point.

use crate::joint::Level;
use crate::layout::Layout;
use crate::results::{Column, Quantity, StepDegrees};
use crate::system::motion_of;
use crate::time::{MacroStep, at_start};

/// The column of variable macro steps.
const STEP: &str = "step";

/// The columns of degrees that follow the estimates.
const DEGREE: &str = "degree";
const EXCHANGED_DEGREE: &str = "exchanged_degree";

/// The column of the errors that steps are estimated to make, as shares of the motion so far.
const ERROR: &str = "error_estimate";

/// The column of the attempts that were repeated with a shorter step, counted from the start of the run.
const REJECTED: &str = "rejected";

/// What a row tells of its macro step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct OfStep {
    /// Degrees of its polynomials, where they follow the estimates.
    pub degrees: StepDegrees,
    /// Its estimated error as a share of the motion so far; not known where the method has no corrector.
    pub error: Option<f64>,
    /// Attempts since the start of the run that were repeated with a shorter step; a column where steps vary.
    pub rejected: u64,
}

/// Time, outputs, multipliers and residuals at one macro point, in the order of the result columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    columns: Vec<String>,
    descriptions: Vec<Column>,
    values: Vec<f64>,
    first_outputs: Vec<usize>,
    positions: Vec<usize>,
    first_multiplier: usize,
    first_residual: usize,
    levels: usize,
    /// The first column that tells of the macro step itself.
    first_of_step: usize,
    shows_step: bool,
    /// The macro step that ends here.
    step: MacroStep,
}

impl Row {
    /// For the outputs of these `subsystems`, each with its name. `shows_step`: the length of the macro step is a column; so
    /// are the degrees and the error that there are.
    pub(crate) fn new<'a>(
        layout: &Layout,
        subsystems: impl Iterator<Item = (&'a str, &'a [String])>,
        shows_step: bool,
        OfStep { degrees, error, .. }: OfStep,
    ) -> Self {
        let mut columns = vec!["t".to_owned()];
        let mut first_outputs = Vec::new();
        for (subsystem, outputs) in subsystems {
            first_outputs.push(columns.len());
            let names = outputs.iter();
            columns.extend(names.map(|output| format!("{subsystem}.{output}")));
        }
        let first_multiplier = columns.len();
        let joints = &layout.joints;
        let ends = joints.iter().flat_map(|joint| &joint.ends);
        let positions = ends
            .flat_map(|end| {
                let first = first_outputs[end.subsystem];
                end.positions().map(move |place| first + place)
            })
            .collect();
        let rows = 0..layout.rows.len();
        columns.extend(rows.clone().map(|row| layout.column_name(row, "lambda")));
        let first_residual = columns.len();
        let levels = layout.level.up_to();
        for row in rows {
            let name =
                |level: &Level| layout.column_name(row, &format!("residual.{}", level.name()));
            columns.extend(levels.iter().map(name));
        }
        let first_of_step = columns.len();
        let of_step = [
            (shows_step, STEP),
            (degrees.multipliers.is_some(), DEGREE),
            (degrees.exchanged.is_some(), EXCHANGED_DEGREE),
            (error.is_some(), ERROR),
            (shows_step, REJECTED),
        ];
        let of_step = of_step.into_iter().filter(|(is_shown, _)| *is_shown);
        columns.extend(of_step.map(|(_, name)| name.to_owned()));
        Self {
            values: vec![0.0; columns.len()],
            columns,
            descriptions: Vec::new(),
            first_outputs,
            positions,
            first_multiplier,
            first_residual,
            levels: levels.len(),
            first_of_step,
            shows_step,
            step: at_start(0.0),
        }
    }

    /// Reads the values at the end of `step`, of which that is known; for a sample it lasts until there.
    /// `outputs(s)` are those of subsystem `s` at that time.
    pub(crate) fn read<'a>(
        &mut self,
        step: MacroStep,
        OfStep {
            degrees,
            error,
            rejected,
        }: OfStep,
        layout: &Layout,
        outputs: impl Fn(usize) -> &'a [f64],
        multipliers: &[f64],
    ) {
        self.step = step;
        self.values.clear();
        self.values.push(step.end);
        for subsystem in 0..self.first_outputs.len() {
            self.values.extend_from_slice(outputs(subsystem));
        }
        self.values.extend_from_slice(multipliers);
        for (number, joint) in layout.joints.iter().enumerate() {
            let motion = motion_of(layout, number, &outputs);
            for condition in joint.joint.conditions() {
                let values = condition.values(layout.level, &motion);
                self.values.extend_from_slice(&values[..self.levels]);
            }
        }
        if self.shows_step {
            self.values.push(step.length);
        }
        let degrees = [degrees.multipliers, degrees.exchanged];
        let degrees = degrees.into_iter().flatten();
        self.values.extend(degrees.map(|degree| degree as f64));
        self.values.extend(error);
        if self.shows_step {
            self.values.push(rejected as f64);
        }
    }

    /// Names of the columns: `t`, then `SUBSYSTEM.OUTPUT`, `JOINT.lambda`, `JOINT.residual.LEVEL`; `step` where it varies, the length
    /// of the macro step that ends here; `degree` and `exchanged_degree` where they follow the estimates, those of its polynomials;
    /// `error_estimate` where the method has a corrector, the error of the step as a share of the motion so far; `rejected` where
    /// the step varies, the attempts since the start of the run that were repeated with a shorter one.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// What every column shows, in their order.
    pub fn descriptions(&self) -> &[Column] {
        &self.descriptions
    }

    /// Takes what the columns show.
    pub(crate) fn describe(&mut self, descriptions: Vec<Column>) {
        self.descriptions = descriptions;
    }

    /// What the column at a place behind the residuals tells of the macro step, in words.
    pub(crate) fn of_step(&self, place: usize) -> Option<(Quantity, &'static str, &'static str)> {
        let name = self
            .columns
            .get(place)
            .filter(|_| place >= self.first_of_step)?;
        match name.as_str() {
            STEP => Some((
                Quantity::Step,
                "s",
                "length of the macro step that ends here",
            )),
            DEGREE => Some((
                Quantity::Degree,
                "1",
                "degree of the multipliers' polynomials in that step",
            )),
            EXCHANGED_DEGREE => Some((
                Quantity::Degree,
                "1",
                "degree of the polynomials of exchanged variables in that step",
            )),
            ERROR => Some((
                Quantity::ErrorEstimate,
                "1",
                "estimated error of the step as a share of the motion so far",
            )),
            REJECTED => Some((
                Quantity::Rejections,
                "1",
                "attempts since the start of the run that were repeated with a shorter step",
            )),
            _ => None,
        }
    }

    /// The columns of the outputs of a subsystem.
    pub(crate) fn outputs_of(&self, subsystem: usize) -> &[String] {
        let first = self.first_outputs[subsystem];
        let next = self.first_outputs.get(subsystem + 1);
        &self.columns[first..next.copied().unwrap_or(self.first_multiplier)]
    }

    /// The values, column by column.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Value of a column.
    pub fn get(&self, column: &str) -> Option<f64> {
        let place = self.columns.iter().position(|name| name == column)?;
        self.values.get(place).copied()
    }

    /// Whether the picture of a run shows a column, unless it is told what to show: positions of joined markers, multipliers,
    /// residuals on position level, and of a scene without joints all outputs; where the macro step varies its length and its error.
    pub fn is_drawn(&self, place: usize) -> bool {
        if place >= self.first_of_step {
            let shown = [STEP, ERROR];
            return self.shows_step && shown.contains(&self.columns[place].as_str());
        }
        if place >= self.first_residual {
            return (place - self.first_residual).is_multiple_of(self.levels);
        }
        let is_output = (1..self.first_multiplier).contains(&place);
        place >= self.first_multiplier
            || (is_output && self.rows() == 0)
            || self.positions.contains(&place)
    }

    /// Columns and values of outputs and multipliers: what may grow.
    pub(crate) fn states(&self) -> impl Iterator<Item = (&str, f64)> {
        let names = self.columns[1..self.first_residual]
            .iter()
            .map(String::as_str);
        names.zip(self.values[1..self.first_residual].iter().copied())
    }

    /// The macro step that ends here.
    pub(crate) fn step(&self) -> MacroStep {
        self.step
    }

    /// Output number `output` of a subsystem.
    pub(crate) fn output(&self, subsystem: usize, output: usize) -> f64 {
        self.values[self.first_outputs[subsystem] + output]
    }

    /// Residuals of a row of the coupling system, one for each level.
    pub(crate) fn residuals(&self, row: usize) -> &[f64] {
        &self.values[self.first_residual + row * self.levels..][..self.levels]
    }

    /// Number of rows of the coupling system.
    pub(crate) fn rows(&self) -> usize {
        self.first_residual - self.first_multiplier
    }
}
