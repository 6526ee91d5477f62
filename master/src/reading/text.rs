//! Reads the text of a file.

use std::io::ErrorKind;
use std::path::Path;

use super::error::{SceneError, SceneErrors};
use super::error_kind::SceneErrorKind;

/// The text of a file, which is called `document` in messages.
pub(crate) fn text_of(path: &Path, document: &'static str) -> Result<String, SceneErrors> {
    let bytes = std::fs::read(path).map_err(|source| {
        let path = path.to_owned();
        let kind = match source.kind() {
            ErrorKind::NotFound => SceneErrorKind::NotFound { document, path },
            _ => SceneErrorKind::Unreadable {
                document,
                path,
                source,
            },
        };
        SceneError::new(None, kind)
    })?;
    String::from_utf8(bytes).map_err(|error| {
        let kind = SceneErrorKind::NotUtf8 {
            document,
            path: path.to_owned(),
            offset: error.utf8_error().valid_up_to(),
        };
        SceneErrors::from(SceneError::new(None, kind))
    })
}
