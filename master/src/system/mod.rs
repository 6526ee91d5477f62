//! The coupling conditions `g` of the whole scene and their Jacobian `G`.
//!
//! * `equations`: both on every level, assembled from the joints (`residuals`, `jacobians`, `end_gradients`), the exchanged variables (`exchanged`)
//!   and the workers' columns (`column`), about a point (`point`);
//! * `moments`: the conditions inside a step, weighted;
//! * [`unknowns`]: what is solved for of every coupling variable;
//! * `entries`, [`pattern`]: which entries `G` has;
//! * [`solve`]: the linear solver;
//! * `answers`: what the workers have answered;
//! * `motion`: the motion of the joints' markers.

mod answers;
mod column;
mod end_gradients;
mod entries;
mod equations;
mod exchanged;
mod jacobians;
mod moments;
mod motion;
pub mod pattern;
mod point;
mod residuals;
pub mod solve;
pub mod unknowns;

pub use answers::{Differentiation, LookAhead, Outputs, Perturbation};
pub use column::{Column, Increment, Listening, Response, Sizes, moved};
pub use equations::{Moments, System, Weights};
pub use motion::motion_of;
pub use point::Point;
