//! What several checks measure.

mod halves;
mod limit;
mod mobility;

pub use halves::{COARSE_SHARE, HALVES_SHARE, LONGER, halves, resolves_longer};
pub use limit::{LIMIT_SHARE, Limit, allowed, in_the_limit, over_longer};
pub use mobility::{Freedom, MOBILITY_SHARE, Mobility};
