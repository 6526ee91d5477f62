//! All that is known against a scene that is sound.

use super::warning::Warning;
use super::whole::Scene;
use super::{apart, stability_rules};

/// What is known against a sound scene: instabilities, and parts that nothing holds together; empty if nothing is known.
pub fn warnings(scene: &Scene) -> Vec<Warning> {
    let known = [apart::warning(scene), stability_rules::warning(scene)];
    known.into_iter().flatten().collect()
}
