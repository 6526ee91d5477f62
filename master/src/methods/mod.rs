//! The coupling methods, a file or folder each, all behind one trait.
//!
//! * `method`: the trait: what a method does in a macro step;
//! * `registry`: the list of all methods;
//! * `semi_implicit`, `hermite`: multipliers of rigid joints, predicted and corrected;
//! * `explicit`: multipliers of rigid joints at the start of the step;
//! * `penalty`: springs in place of the joints, for comparison;
//! * `condition`: the equations in the multipliers that several of them share;
//! * `saved`: what a method remembers, as bytes.

mod condition;
mod explicit;
mod hermite;
mod method;
mod penalty;
mod registry;
mod saved;
mod semi_implicit;

pub use condition::SingularRow;
pub use method::{Built, Corrected, LoadErrors, Method, Reached};
pub use registry::{Given, build, level_of};
pub use saved::{Saved, Unreadable};
