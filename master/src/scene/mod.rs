//! The scene: what is coupled, how, and for how long.
//!
//! [`load`] reads a TOML file into a tree of values with their places (the file as written) and resolves it into a
//! [`Scene`]: defaults filled in, names followed, every value checked. All mistakes are reported together, each with its
//! place, the value found, what is allowed, and the nearest name. [`warnings`] tells which sound scenes are known to be
//! unstable.

mod apart;
mod assign;
mod connection;
mod coupling;
mod degree;
mod joint;
mod load;
mod monolithic;
mod output;
mod remedy;
mod resolve;
mod resolved;
mod run;
mod security;
mod spectrum;
mod stability_rules;
mod step_control;
mod study;
mod subsystem;
mod sweeps;
#[cfg(test)]
mod tests;
mod variants;
mod warning;
mod warnings;
mod whole;

pub use crate::reading::{
    Default, Formula, Key, Names, NotAnOverride, Override, Place, Range, SceneError,
    SceneErrorKind, SceneErrors, Takes, Unit,
};
pub use coupling::methods_with;
pub(crate) use coupling::{CLOSED, MOST_TOLERATED};
pub use load::{load, parse};
pub(crate) use resolve::GROUND;
pub use resolve::SCENE_KEYS;
pub use resolved::{
    Axis, Calls, Case, Connection, ConvergeSettings, Coupling, Degree, Geometry, ImpactsAtJoints,
    Increment, Index, Iterations, Jacobian, Joint, JointKind, Loads, Method, Monolithic, Order,
    Otherwise, Output, Over, Panel, Reference, RunSettings, Security, Served, Side, Spring,
    StabilitySettings, StepControl, Subsystem, Variant,
};
pub use spectrum::{
    RegionPoint, SPECTRUM_KEYS, SpectrumCurve, SpectrumFile, SpectrumRegion, SpectrumScheme,
    is_spectrum, load_spectrum, parse_spectrum,
};
pub(crate) use stability_rules::highest_stable_degree;
pub use study::{
    Measure, STUDY_KEYS, Settings, StudyFile, StudyScene, StudySetting, is_study, load_study,
    parse_study,
};
pub use warning::Warning;
pub use warnings::warnings;
pub use whole::Scene;
