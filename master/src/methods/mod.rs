//! The coupling methods, a folder each, all behind one trait.
//!
//! * `definition`: a method as a scene has it: parameters and what follows from them;
//! * `method`: the trait: what a method does in a macro step;
//! * `registry`: the list of all methods;
//! * `semi_implicit`, `hermite`: multipliers of rigid joints, predicted and corrected;
//! * `explicit`: multipliers of rigid joints at the start of the step;
//! * `penalty`: springs in place of the joints, for comparison;
//! * `condition`: the equations in the multipliers that several of them share;
//! * `saved`: what a method remembers, as bytes.

mod condition;
mod definition;
mod explicit;
mod hermite;
mod method;
mod penalty;
mod registry;
mod saved;
mod semi_implicit;

pub use condition::SingularRow;
pub use definition::{Given, Instability, Lacking, OwnCurves, Parameters};
pub use explicit::Explicit;
pub use hermite::{Hermite, Variant};
pub use method::{Built, Corrected, CouplingMethod, LoadErrors, Order, Reached};
pub use penalty::{Penalty, Spring};
pub(crate) use registry::Entry;
pub use registry::Method;
pub use saved::{Saved, Unreadable};
pub use semi_implicit::{Baumgarte, Index, Weighted};
