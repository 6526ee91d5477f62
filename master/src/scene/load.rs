//! Reads a scene.

use std::path::Path;

use super::variants::resolve_checked;
use super::whole::Scene;
use crate::reading::error::SceneErrors;
use crate::reading::overrides::Override;
use crate::reading::text::text_of;
use crate::reading::written::Written;

/// What a scene is, for messages.
const SCENE_FILE: &str = "scene file";

/// Reads a scene file and puts overrides into it.
///
/// # Errors
/// All mistakes in the file, in its cases and studies, and in the overrides.
pub fn load(path: &Path, overrides: &[Override]) -> Result<Scene, SceneErrors> {
    let text = text_of(path, SCENE_FILE)?;
    parse(&text, &path.display().to_string(), overrides)
}

/// Like [`load`], for the text of a scene; `origin` names it in messages.
///
/// # Errors
/// All mistakes in the text, in its cases and studies, and in the overrides.
pub fn parse(text: &str, origin: &str, overrides: &[Override]) -> Result<Scene, SceneErrors> {
    let written = Written::parse(text, origin, SCENE_FILE)?;
    resolve_checked(written, overrides)
}
