//! How the list of all methods is read.

use super::definition::Definition;
use crate::reading::formula::Steps;
use crate::reading::key::Key;
use crate::reading::reader::{Problems, Section};

/// What a scene may know of a method before it has parameters.
pub(crate) struct Entry<M: 'static> {
    /// Its name in a scene.
    pub name: &'static str,
    /// See [`Definition::KEYS`].
    pub keys: &'static [Key],
    /// See [`Definition::CORRECTS`].
    pub corrects: bool,
    /// See [`Definition::LOWEST_DEGREE`].
    pub lowest_degree: usize,
    /// See [`Definition::HIGHEST_DEGREE`].
    pub highest_degree: usize,
    /// See [`Definition::MAY_CHANGE_DEGREE`].
    pub may_change_degree: bool,
    /// See [`Definition::EXCHANGED_DEGREE`].
    pub exchanged_degree: Option<usize>,
    /// See [`Definition::read`].
    pub read: fn(&Section<'_>, Option<Steps>, &mut Problems<'_>) -> Option<M>,
}

impl<M> Entry<M> {
    /// That of a method.
    pub(super) const fn of<T: Definition>(
        read: fn(&Section<'_>, Option<Steps>, &mut Problems<'_>) -> Option<M>,
    ) -> Self {
        Self {
            name: T::NAME,
            keys: T::KEYS,
            corrects: T::CORRECTS,
            lowest_degree: T::LOWEST_DEGREE,
            highest_degree: T::HIGHEST_DEGREE,
            may_change_degree: T::MAY_CHANGE_DEGREE,
            exchanged_degree: T::EXCHANGED_DEGREE,
            read,
        }
    }
}

/// Makes the folders of the methods modules, and the type `Method` of their parameters, any of them.
macro_rules! registry {
    ($($(#[cfg($when:meta)])? $folder:ident { $($(#[cfg($own:meta)])? $name:ident: $doc:literal),* })*) => {
        $($(#[cfg($when)])? mod $folder;)*
        $($(#[cfg($when)])? pub use $folder::{$($name),*};)*

        /// What is demanded of the joints at the macro points, and how the multipliers follow from it.
        ///
        /// Serialises with its name in a scene under `name`, and its parameters.
        #[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
        #[serde(tag = "name", rename_all = "kebab-case")]
        pub enum Method {
            $($($(#[cfg($own)])? #[doc = $doc] $name($name),)*)*
        }

        impl Method {
            /// All methods.
            pub(crate) const ALL: &'static [registry::Entry<Self>] = &[
                $($($(#[cfg($own)])? registry::Entry::of::<$name>(|section, steps, problems| {
                    <$name as definition::Definition>::read(section, steps, problems).map(Self::$name)
                }),)*)*
            ];

            /// Their names.
            pub(crate) const NAMES: &'static [&'static str] = &[
                $($($(#[cfg($own)])? <$name as definition::Definition>::NAME,)*)*
            ];

            /// Its name in a scene.
            pub fn name(&self) -> &'static str {
                match self {
                    $($($(#[cfg($own)])? Self::$name(_) => <$name as definition::Definition>::NAME,)*)*
                }
            }

            /// Whether it corrects its prediction.
            pub fn corrects(&self) -> bool {
                match self {
                    $($($(#[cfg($own)])? Self::$name(_) => <$name as definition::Definition>::CORRECTS,)*)*
                }
            }

            /// Lets a degree that follows the estimates end one lower; whether that is possible.
            pub(crate) fn lower_degree(&mut self) -> bool {
                match self {
                    $($($(#[cfg($own)])? Self::$name(own) => own.lower_degree(),)*)*
                }
            }

            /// What follows from its parameters.
            pub fn parameters(&self) -> &dyn Parameters {
                match self {
                    $($($(#[cfg($own)])? Self::$name(own) => own,)*)*
                }
            }
        }
    };
}

pub(super) use registry;
