//! The parameters of penalty coupling.

use serde::Serialize;

use super::coupling::{PenaltyCoupling, write_loads};
use super::spring::Spring;
use crate::joint::Level;
use crate::layout::Layout;
use crate::methods::definition::{Definition, Given, Lacking, Parameters};
use crate::methods::method::{Built, Order};
use crate::reading::formula::{Formula, Steps, Unit};
use crate::reading::reader::{Problems, Section};

/// Force of a spring and damper in place of the multiplier, on both ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Penalty {
    /// Which subsystems know what others have reached; default Jacobi.
    pub order: Order,
    /// For conditions that are lengths.
    pub lengths: Option<Spring>,
    /// For conditions that are angles.
    pub angles: Option<Spring>,
}

/// In which order subsystems step.
const ORDERS: [(&str, Order); 2] = [
    ("jacobi", Order::Jacobi),
    ("gauss-seidel", Order::GaussSeidel),
];

impl Definition for Penalty {
    const NAME: &'static str = "penalty";
    const KEYS: &'static [&'static str] = &[
        "degree",
        "order",
        "stiffness",
        "damping",
        "angular_stiffness",
        "angular_damping",
    ];

    /// Springs for lengths and for angles. At least one is needed; which one the joints need is known when the models have
    /// described their markers.
    fn read(
        section: &Section<'_>,
        steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let steps = steps?;

        let order = section
            .get("order")
            .map_or(Some(Order::Jacobi), |field| field.choice(&ORDERS, problems));
        let has = |(stiffness, _, damping): SpringKeys| {
            section.get(stiffness).is_some() || section.get(damping).is_some()
        };
        let angles = match has(ANGULAR) {
            true => read_spring(section, ANGULAR, steps, problems).map(Some),
            false => Some(None),
        };
        let lengths = match has(LINEAR) || !has(ANGULAR) {
            true => read_spring(section, LINEAR, steps, problems).map(Some),
            false => Some(None),
        };
        Some(Self {
            order: order?,
            lengths: lengths?,
            angles: angles?,
        })
    }
}

impl Parameters for Penalty {
    fn level(&self) -> Level {
        Level::Velocity
    }

    fn build(&self, mut given: Given<'_>) -> Result<Built, Lacking> {
        let (layout, outputs) = (given.layout, given.outputs);
        let springs = springs_of(self.lengths, self.angles, layout)?;
        write_loads(&springs, layout, outputs, &mut given.values);
        let [_, degree] = given.degrees;
        let (order, degree) = (self.order, degree.highest());
        let history = given.history();
        Ok(PenaltyCoupling::build(
            order, springs, history, degree, layout, outputs,
        ))
    }

    fn closes_joints(&self) -> bool {
        false
    }

    /// One after the other, subsystems extrapolate outputs of degree above 0.
    fn remembered_points(&self, degree: usize, exchanged_degree: usize) -> Option<usize> {
        (self.order == Order::Jacobi || exchanged_degree == 0).then_some(degree + 1)
    }
}

/// The spring of each row: that for lengths or that for angles.
///
/// # Errors
/// The scene gives none of the kind that a joint needs.
fn springs_of(
    lengths: Option<Spring>,
    angles: Option<Spring>,
    layout: &Layout,
) -> Result<Vec<Spring>, Lacking> {
    let spring_of = |row: usize| {
        let bound = layout.joint_of(row);
        let condition = bound.joint.condition(layout.rows[row].condition);
        let (spring, key, example, what) = match condition.is_length() {
            true => (lengths, "stiffness", "1e6", "lengths"),
            false => (angles, "angular_stiffness", "1e4", "angles"),
        };
        spring.ok_or_else(|| {
            let message = format!(
                "joint \"{}\" holds {what}, but the penalty coupling has no spring for them",
                bound.name
            );
            let help = format!("add `{key} = {example}` to [coupling]");
            Lacking { message, help }
        })
    };
    (0..layout.rows.len()).map(spring_of).collect()
}

/// The keys of a spring: stiffness with an example, damping.
type SpringKeys = (&'static str, &'static str, &'static str);

const LINEAR: SpringKeys = ("stiffness", "stiffness = 1e6", "damping");

const ANGULAR: SpringKeys = (
    "angular_stiffness",
    "angular_stiffness = 1e4",
    "angular_damping",
);

fn read_spring(
    section: &Section<'_>,
    (stiffness, example, damping): SpringKeys,
    steps: Steps,
    problems: &mut Problems<'_>,
) -> Option<Spring> {
    let stiffness = section
        .require(stiffness, example, problems)
        .and_then(|field| {
            let formula = Formula::read_positive(&field, Unit::PerTimeSquared, problems)?;
            let value = formula.fixed(steps, &field.key);
            value.map_err(|kind| field.report(kind, problems)).ok()
        });
    let damping = section.get(damping).map_or(Some(0.0), |field| {
        let formula = Formula::read(&field, Unit::PerTime, problems)?;
        let value = formula.fixed(steps, &field.key);
        value.map_err(|kind| field.report(kind, problems)).ok()
    });
    Some(Spring {
        stiffness: stiffness?,
        damping: damping?,
    })
}
