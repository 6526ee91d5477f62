//! Which coupling methods there are: the only place that names them, a line for each.

use serde::Serialize;

use super::definition::{Definition, Parameters};
use super::{explicit, hermite, penalty, semi_implicit};
use crate::reading::formula::Steps;
use crate::reading::reader::{Problems, Section};

/// What a scene may know of a method before it has parameters.
pub(crate) struct Entry {
    /// Its name in a scene.
    pub name: &'static str,
    /// See [`Definition::KEYS`].
    pub keys: &'static [&'static str],
    /// See [`Definition::CORRECTS`].
    pub corrects: bool,
    /// See [`Definition::HIGHEST_DEGREE`].
    pub highest_degree: usize,
    /// See [`Definition::MAY_CHANGE_DEGREE`].
    pub may_change_degree: bool,
    /// See [`Definition::EXCHANGED_DEGREE`].
    pub exchanged_degree: Option<usize>,
    /// See [`Definition::read`].
    pub read: fn(&Section<'_>, Option<Steps>, &mut Problems<'_>) -> Option<Method>,
}

impl Entry {
    const fn of<T: Definition>(
        read: fn(&Section<'_>, Option<Steps>, &mut Problems<'_>) -> Option<Method>,
    ) -> Self {
        Self {
            name: T::NAME,
            keys: T::KEYS,
            corrects: T::CORRECTS,
            highest_degree: T::HIGHEST_DEGREE,
            may_change_degree: T::MAY_CHANGE_DEGREE,
            exchanged_degree: T::EXCHANGED_DEGREE,
            read,
        }
    }
}

macro_rules! methods {
    ($($(#[cfg($when:meta)])? $name:ident($parameters:ty): $doc:literal,)*) => {
        /// What is demanded of the joints at the macro points, and how the multipliers follow from it.
        ///
        /// Serialises with its name in a scene under `name`, and its parameters.
        #[derive(Clone, Copy, Debug, PartialEq, Serialize)]
        #[serde(tag = "name", rename_all = "kebab-case")]
        pub enum Method {
            $($(#[cfg($when)])? #[doc = $doc] $name($parameters),)*
        }

        impl Method {
            /// All methods.
            pub(crate) const ALL: &'static [Entry] = &[
                $($(#[cfg($when)])? Entry::of::<$parameters>(|section, steps, problems| {
                    <$parameters>::read(section, steps, problems).map(Self::$name)
                }),)*
            ];

            /// Whether it corrects its prediction.
            pub fn corrects(&self) -> bool {
                match self {
                    $($(#[cfg($when)])? Self::$name(_) => <$parameters>::CORRECTS,)*
                }
            }

            /// What follows from its parameters.
            pub fn parameters(&self) -> &dyn Parameters {
                match self {
                    $($(#[cfg($when)])? Self::$name(own) => own,)*
                }
            }
        }
    };
}

methods! {
    Hermite(hermite::Hermite): "Polynomials of their own on every macro step.",
    Baumgarte(semi_implicit::Baumgarte): "Schweizer & Lu, method 1: g + beta g' + gamma g'' = 0.",
    Weighted(semi_implicit::Weighted): "Schweizer & Lu, method 2: weighted multipliers of position, velocity and acceleration.",
    Explicit(explicit::Explicit): "The explicit index-1 method of Gu & Asada: (mu d/dt + 1)^2 g = 0.",
    Penalty(penalty::Penalty): "Force of a spring and damper in place of the multiplier, on both ends.",
}
