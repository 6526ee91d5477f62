//! What decides about a macro step: plain data in, a decision out.
//!
//! * [`iteration`]: how often a step is corrected, and when the columns of the coupling Jacobian are asked for afresh;
//! * [`columns`]: the workers' responses, measured, kept and carried along;
//! * [`norm`]: sizes of changes of variables that have unlike units;
//! * [`deferred_correction`]: what corrections with kept columns miss, foreseen;
//! * [`linearisation_check`]: what a correction promises, and what the workers make of it;
//! * [`step_size`]: the length of a variable macro step;
//! * [`singular_positions`]: where the joints do not determine their multipliers;
//! * [`degree`]: degrees of polynomials that follow the estimates.
//!
//! No policy knows a worker, a method, or how a macro step goes.

pub mod columns;
pub mod deferred_correction;
pub mod degree;
pub mod iteration;
pub mod linearisation_check;
pub mod norm;
pub mod singular_positions;
pub mod step_size;
