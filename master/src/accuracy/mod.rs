//! How large the error of a macro step is, and how large it may be.
//!
//! * `estimate`: the worst error of a step;
//! * `tolerance`: what is allowed of each quantity;
//! * `position_error`: errors of positions by those of the multipliers, and what a step leaves of the joints open;
//! * `step_errors`: the errors of all steps of a run, whatever chooses their lengths;
//! * `change`: sizes of corrections;
//! * `singular_position`: where errors do not fall with the length of a step;
//! * `attempts`: what several attempts at a step tell of variables without a past.

mod attempts;
mod change;
mod estimate;
mod position_error;
mod singular_position;
pub mod step_errors;
pub mod tolerance;

pub use attempts::{Attempts, CHORD_ORDER};
pub use change::{Change, MOST_LEFT};
pub use estimate::{Estimate, Suspect};
pub use position_error::{Correction, Difference, PositionErrors};
pub use singular_position::SingularPosition;
pub use step_errors::{RunErrors, StepErrors};
pub use tolerance::Tolerance;
