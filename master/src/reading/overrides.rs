//! Settings given beside the file, such as `--set coupling.macro_step=5e-4`.

use std::fmt;
use std::str::FromStr;

/// A setting that replaces or adds one key of a scene.
///
/// The key is dotted; an entry of a list goes by its name, as in `subsystem.mass1.parameters.c`, and `*` is every
/// entry, as in `subsystem.*.parameters.c`. The value is TOML; a bare word or phrase is text.
///
/// An override of `coupling.method` also sets aside the parameters of other methods that the file gives, since the
/// method chosen has none of them; a parameter given in the same batch of overrides stays and is checked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// Dotted key.
    pub key: String,
    /// The value as TOML, or a bare word.
    pub value: String,
}

impl fmt::Display for Override {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.key, self.value)
    }
}

/// An override that is not `KEY=VALUE`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is not an override; write KEY=VALUE, for example coupling.macro_step=5e-4")]
pub struct NotAnOverride(String);

impl FromStr for Override {
    type Err = NotAnOverride;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.split_once('=') {
            Some((key, value)) if !key.trim().is_empty() => Ok(Self {
                key: key.trim().to_owned(),
                value: value.trim().to_owned(),
            }),
            _ => Err(NotAnOverride(text.to_owned())),
        }
    }
}
