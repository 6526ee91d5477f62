//! Functions by their names.

use std::path::Path;

use libloading::Library;

use crate::FmuError;

/// Where functions are looked up, and what messages call it.
pub(super) struct Symbols<'a> {
    pub library: &'a Library,
    pub path: &'a Path,
    pub version: &'static str,
}

impl Symbols<'_> {
    /// The function `name`, which every FMU must have.
    ///
    /// # Safety
    /// `T` is the type that the standard gives this function.
    pub(super) unsafe fn needed<T: Copy>(&self, name: &str) -> Result<T, FmuError> {
        // SAFETY: the caller answers for the type.
        unsafe { self.find(name, None) }
    }

    /// The function `name`, if the FMU says by `flag` that it has it.
    ///
    /// # Safety
    /// As [`Symbols::needed`].
    pub(super) unsafe fn flagged<T: Copy>(
        &self,
        name: &str,
        (flag, is_set): (&str, bool),
    ) -> Result<Option<T>, FmuError> {
        if !is_set {
            return Ok(None);
        }
        // SAFETY: the caller answers for the type.
        unsafe { self.find(name, Some(flag)) }.map(Some)
    }

    /// # Safety
    /// As [`Symbols::needed`].
    unsafe fn find<T: Copy>(&self, name: &str, flag: Option<&str>) -> Result<T, FmuError> {
        // SAFETY: the caller answers for the type. The pointer outlives the symbol because whoever keeps it keeps the library.
        let found = unsafe { self.library.get::<T>(name) };
        found.map(|symbol| *symbol).map_err(|_| FmuError::Function {
            path: self.path.to_owned(),
            function: name.to_owned(),
            version: self.version,
            flag: flag.map(str::to_owned),
        })
    }
}
