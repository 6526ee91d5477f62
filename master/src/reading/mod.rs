//! Reading of what a user wrote: a tree of values with their places, all mistakes together.
//!
//! * `text`, `written`, `place`: a TOML file as it is written, with the place of every value;
//! * `settings`: all of it by dotted keys;
//! * `overrides`: values that the command line sets;
//! * `key`: the keys of a table, declared once; `reader`: sections and fields, checked by them;
//! * `lists`, `names`, `reference`: tables in lists, and names that refer to them;
//! * `formula`: numbers that may be multiples of the macro step;
//! * `error`, `error_kind`, `nearest`: mistakes, and what was probably meant.

pub(crate) mod error;
pub(crate) mod error_kind;
pub(crate) mod formula;
pub(crate) mod key;
pub(crate) mod lists;
pub(crate) mod names;
pub(crate) mod nearest;
pub(crate) mod overrides;
pub(crate) mod place;
pub(crate) mod reader;
pub(crate) mod reference;
mod settings;
pub(crate) mod text;
pub(crate) mod written;

pub use error::{SceneError, SceneErrors};
pub use error_kind::{Names, SceneErrorKind};
pub use formula::Formula;
pub use key::{Default, Key, Range, Takes, Unit};
pub use overrides::{NotAnOverride, Override};
pub use place::Place;
