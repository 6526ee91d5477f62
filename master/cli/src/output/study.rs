//! `run.json` of a study: what it is about, which files it has written, and what is missing.

use std::path::{Path, PathBuf};

use linchpin_master::scene::Scene;
use serde::Serialize;

use super::{Ending, OutputFolder, Program, StatusFile};
use crate::commands::CommandError;
use crate::commands::common::SceneArguments;
use crate::interrupt;
use crate::study::StudyError;

/// What a study is about.
#[derive(Debug, Clone, Serialize)]
pub struct StudyAbout {
    study: &'static str,
    name: String,
    files: Vec<String>,
    /// The text of its scene; absent if it has several files.
    scene_text: Option<String>,
    overrides: Vec<String>,
}

impl StudyAbout {
    /// The study of a scene by a command of this name.
    pub fn of_scene(study: &'static str, scene: &Scene, arguments: &SceneArguments) -> Self {
        Self {
            scene_text: Some(scene.text().to_owned()),
            overrides: arguments.set.iter().map(ToString::to_string).collect(),
            ..Self::of_files(study, &scene.name, std::slice::from_ref(&arguments.scene))
        }
    }

    /// The study of files.
    pub fn of_files(study: &'static str, name: &str, files: &[PathBuf]) -> Self {
        let files = files.iter().map(|file| file.display().to_string());
        Self {
            study,
            name: name.to_owned(),
            files: files.collect(),
            scene_text: None,
            overrides: Vec::new(),
        }
    }
}

/// What a study tells on its way.
#[derive(Serialize)]
pub struct Told<'a> {
    #[serde(skip)]
    folder: &'a Path,
    /// Files of results: others in the folder are not of this study.
    results: Vec<String>,
    /// What is not among the results, since the study ended early.
    missing: Vec<String>,
}

impl Told<'_> {
    /// The path of a file that is written now.
    pub fn file(&mut self, name: &str) -> PathBuf {
        self.results.push(name.to_owned());
        self.folder.join(name)
    }

    /// The path of a picture that is drawn now, without its ending.
    pub fn picture(&mut self, stem: &str) -> PathBuf {
        let names = ["svg", "png"].map(|ending| format!("{stem}.{ending}"));
        self.results.extend(names);
        self.folder.join(stem)
    }

    /// Takes note of what is missing.
    pub fn missing(&mut self, missing: Vec<String>) {
        self.missing = missing;
    }
}

/// Carries out a study whose `run.json` says from the first moment on how it stands. `carry_out` writes what there is and says why
/// that is not all; signals ask it to end from now on.
///
/// # Errors
/// Those of the study; [`CommandError::Unwritable`].
pub fn study(
    folder: &OutputFolder,
    about: StudyAbout,
    carry_out: impl FnOnce(&mut Told<'_>) -> Result<Option<StudyError>, CommandError>,
) -> Result<(), CommandError> {
    interrupt::on_signals()?;
    let status = StatusFile::new(folder.path(), &Program::this(), about);
    status.running()?;
    let mut told = Told {
        folder: folder.path(),
        results: Vec::new(),
        missing: Vec::new(),
    };
    let outcome = match carry_out(&mut told) {
        Ok(None) => Ok(()),
        Ok(Some(error)) => Err(CommandError::from(error)),
        Err(error) => Err(error),
    };
    let ended = status.end(&Ending::of(&outcome), Some(told));
    outcome.and(ended)
}
