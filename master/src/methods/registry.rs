//! Which coupling methods there are: the only place that knows the types of all of them.

use super::condition::Condition;
use super::explicit::Explicit;
use super::hermite::Hermite;
use super::method::Built;
use super::penalty::{Penalty, springs_of, write_loads};
use super::semi_implicit::SemiImplicit;
use crate::joint::Level;
use crate::layout::Layout;
use crate::scene::{Index, Method, Scene, SceneErrors};
use crate::signal::{History, Variables};
use crate::system::Outputs;

use nalgebra::UnitQuaternion;

/// The first macro point.
pub struct Given<'a> {
    /// What is coupled.
    pub layout: &'a Layout,
    /// The coupling outputs.
    pub outputs: &'a dyn Outputs,
    /// Values of all coupling variables.
    pub values: Vec<f64>,
    /// Attitudes to which rotation vectors are relative.
    pub attitudes: Vec<UnitQuaternion<f64>>,
    /// Values at past macro points, newest first, where a study gives them.
    pub established: Option<&'a [Vec<f64>]>,
}

impl Given<'_> {
    /// The history of the variables, with the degrees of the scene.
    fn history(self, scene: &Scene) -> History {
        let coupling = &scene.coupling;
        let variables = self.layout.describe_variables(
            coupling.degree.highest(),
            coupling.exchanged_degree.highest(),
        );
        match self.established {
            Some(values) => {
                History::established(variables, coupling.macro_step, values, self.attitudes)
            }
            None => History::new(variables, &self.values, self.attitudes),
        }
    }
}

/// Highest level of the conditions that a method needs.
pub fn level_of(method: &Method) -> Level {
    match method {
        Method::Baumgarte { index, .. } | Method::Weighted { index, .. } => match index {
            Index::Three => Level::Position,
            Index::Two => Level::Velocity,
            Index::One => Level::Acceleration,
        },
        Method::Hermite { variant } => variant.level(),
        Method::Explicit { .. } => Level::Acceleration,
        Method::Penalty { .. } => Level::Velocity,
    }
}

/// Makes the method of a scene at the first macro point.
///
/// # Errors
/// What the scene lacks.
pub fn build(scene: &Scene, mut given: Given<'_>) -> Result<Built, SceneErrors> {
    let coupling = &scene.coupling;
    let layout = given.layout;
    Ok(match coupling.method {
        Method::Baumgarte { beta, gamma, .. } => {
            let condition = Condition::Baumgarte { beta, gamma };
            SemiImplicit::build(condition, given.history(scene), layout)
        }
        Method::Weighted { a, b, .. } => {
            let condition = Condition::Weighted { a, b };
            SemiImplicit::build(condition, given.history(scene), layout)
        }
        Method::Hermite { variant } => {
            let variables = Variables {
                degrees: vec![coupling.exchanged_degree.highest(); layout.variables()],
                rotations: Vec::new(),
            };
            let start = given.established.and_then(|values| values.first());
            let values = start.map_or(&given.values[..layout.variables()], |start| start);
            let history = History::new(variables, values, given.attitudes);
            Hermite::build(variant, history, layout, given.outputs)
        }
        Method::Explicit { mu } => {
            given.established = None;
            Explicit::build(mu, given.history(scene), layout)
        }
        Method::Penalty {
            order,
            lengths,
            angles,
        } => {
            let springs = springs_of(scene, lengths, angles, layout)?;
            let outputs = given.outputs;
            write_loads(&springs, layout, outputs, &mut given.values);
            let degree = coupling.exchanged_degree.highest();
            Penalty::build(
                order,
                springs,
                given.history(scene),
                degree,
                layout,
                outputs,
            )
        }
    })
}
