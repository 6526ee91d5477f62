//! The parameters of penalty coupling.

use serde::Serialize;

use super::coupling::{PenaltyCoupling, write_loads};
use super::spring::Spring;
use crate::joint::Level;
use crate::layout::Layout;
use crate::methods::definition::{DEGREE, Definition, Given, Lacking, Parameters};
use crate::methods::method::{Built, Order};
use crate::reading::formula::{Formula, Steps};
use crate::reading::key::{Key, NOT_NEGATIVE, POSITIVE, Takes, Unit, texts};
use crate::reading::reader::{Field, Problems, Section, choice};

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

const KEYS: [Key; 6] = [
    DEGREE,
    Key::new("order", Takes::Choice(&texts(&ORDERS)))
        .default_first()
        .means(
            "`\"jacobi\"`, all subsystems step at once; `\"gauss-seidel\"`, one after the other \
             as the scene lists them",
        ),
    LINEAR[0],
    LINEAR[1],
    ANGULAR[0],
    ANGULAR[1],
];

/// Stiffness and damping of the spring for lengths.
const LINEAR: [Key; 2] = [
    Key::new("stiffness", Takes::Formula(Unit::PerTimeSquared, POSITIVE))
        .required("stiffness = 1e6")
        .default("required for penalty if a joint holds lengths")
        .means("spring, N/m"),
    Key::new("damping", Takes::Formula(Unit::PerTime, NOT_NEGATIVE))
        .default_number(0.0)
        .means(
            "damper, N s/m; multiples of 1/H and 1/H^2 are masses, for one macro step \
             of the whole run",
        ),
];

/// The same of that for angles.
const ANGULAR: [Key; 2] = [
    Key::new(
        "angular_stiffness",
        Takes::Formula(Unit::PerTimeSquared, POSITIVE),
    )
    .required("angular_stiffness = 1e4")
    .default(
        "required for penalty if a joint holds angles (`perpendicular` and what is made of it)",
    )
    .means("spring, N m for an angle of 1 rad"),
    Key::new(
        "angular_damping",
        Takes::Formula(Unit::PerTime, NOT_NEGATIVE),
    )
    .default_number(0.0)
    .means("damper for angles, N m s"),
];

impl Definition for Penalty {
    const NAME: &'static str = "penalty";
    const KEYS: &'static [Key] = &KEYS;

    /// Springs for lengths and for angles. At least one is needed; which one the joints need is known when the models have
    /// described their markers.
    fn read(
        section: &Section<'_>,
        steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let steps = steps?;
        let [_, order, ..] = section.fields(&KEYS, problems);
        let order = choice(order, &ORDERS, problems);
        let has = |keys: &'static [Key; 2]| keys.iter().any(|key| section.get(key).is_some());
        let angles = match has(&ANGULAR) {
            true => read_spring(section, &ANGULAR, steps, problems).map(Some),
            false => Some(None),
        };
        let lengths = match has(&LINEAR) || !has(&ANGULAR) {
            true => read_spring(section, &LINEAR, steps, problems).map(Some),
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

fn read_spring(
    section: &Section<'_>,
    [stiffness, damping]: &'static [Key; 2],
    steps: Steps,
    problems: &mut Problems<'_>,
) -> Option<Spring> {
    let stiffness = section.require(stiffness, problems);
    let mut read = |field: Field<'_>| {
        let value = Formula::read(&field, problems)?.fixed(steps, &field.key);
        value.map_err(|kind| field.report(kind, problems)).ok()
    };
    let stiffness = stiffness.and_then(&mut read);
    let damping = section.get(damping).map_or(Some(0.0), read);
    Some(Spring {
        stiffness: stiffness?,
        damping: damping?,
    })
}
