//! The semi-implicit predictor/corrector methods of Schweizer & Lu (S1 Sects. 2 and 3.3).
//!
//! * `scene`, `index`, `weights`: their parameters;
//! * `stability`: which of them are known to be unstable;
//! * `coupling`: the methods in a macro step.

mod coupling;
mod index;
mod scene;
mod stability;
mod weights;

pub use index::Index;
pub use scene::{Baumgarte, Weighted};
