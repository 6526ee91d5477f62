//! The coupling methods, a folder each, all behind one trait.
//!
//! * `definition`: a method as a scene has it: parameters and what follows from them;
//! * `method`: the trait: what a method does in a macro step;
//! * `registry`: how the list of all methods below is read;
//! * `condition`: the equations in the multipliers that several of them share;
//! * `saved`: what a method remembers, as bytes.

mod condition;
mod definition;
mod method;
mod registry;
mod saved;

pub use condition::SingularRow;
pub(crate) use definition::{DEGREE, EXCHANGED_DEGREE};
pub use definition::{Given, Instability, Lacking, OwnCurves, Parameters, Served, WantedInside};
pub use method::{Built, Corrected, CouplingMethod, LoadErrors, Order, Reached};
pub(crate) use registry::Entry;
pub use saved::{Saved, Unreadable};

pub use hermite::Variant;
pub use penalty::Spring;
pub use semi_implicit::Index;

registry::registry! {
    hermite { Hermite: "Polynomials of their own on every macro step." }
    semi_implicit {
        Baumgarte: "Schweizer & Lu, method 1: g + beta g' + gamma g'' = 0.",
        Weighted: "Schweizer & Lu, method 2: weighted multipliers of position, velocity and acceleration."
    }
    explicit { Explicit: "The explicit index-1 method of Gu & Asada: (mu d/dt + 1)^2 g = 0." }
    penalty { Penalty: "Force of a spring and damper in place of the multiplier, on both ends." }
    #[cfg(test)] tests { #[cfg(test)] Held: "Of the tests: a spring whose force is held over the step." }
}
