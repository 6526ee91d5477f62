//! The file of an exported scene.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::contents::FILE;
use super::description::Version;
use super::error::FmuExportError;
use super::variables::Exported;

/// The library beside the program.
const LIBRARY: &str = "liblinchpin_scene.so";

/// Writes the FMU.
///
/// # Errors
/// [`FmuExportError::NoLibrary`], [`FmuExportError::Unwritable`].
pub fn write(exported: &Exported, version: Version, path: &Path) -> Result<(), FmuExportError> {
    let library = library()?;
    let unwritable = |what: String| FmuExportError::Unwritable {
        path: path.to_owned(),
        what,
    };
    let contents = serde_json::to_vec_pretty(&exported.contents);
    let contents = contents.map_err(|error| unwritable(error.to_string()))?;
    let library = fs::read(library).map_err(|error| unwritable(error.to_string()))?;
    let description = version.describe(exported);
    let files = [
        ("modelDescription.xml".to_owned(), description.as_bytes()),
        (format!("resources/{FILE}"), &contents),
        (version.library(), &library),
    ];
    // A file that is there stays until the new one is whole.
    let unfinished = path.with_extension("fmu.unfinished");
    let written = zip(&unfinished, &files).and_then(|()| fs::rename(&unfinished, path));
    written.map_err(|error| {
        let _ = fs::remove_file(&unfinished);
        unwritable(error.to_string())
    })
}

fn zip(path: &Path, files: &[(String, &[u8])]) -> io::Result<()> {
    let mut archive = ZipWriter::new(File::create(path)?);
    for (name, content) in files {
        archive.start_file(
            name.as_str(),
            SimpleFileOptions::default().unix_permissions(0o644),
        )?;
        archive.write_all(content)?;
    }
    archive.finish()?.sync_all()
}

/// The library that runs a scene: beside the program, or where cargo leaves it for tests; the newer one of both.
fn library() -> Result<PathBuf, FmuExportError> {
    let program = std::env::current_exe().unwrap_or_default();
    let folder = program.parent().unwrap_or(Path::new("."));
    let places = [folder.join(LIBRARY), folder.join("deps").join(LIBRARY)];
    let there = places.iter().filter(|path| path.is_file());
    let age = |path: &&PathBuf| path.metadata().and_then(|own| own.modified()).ok();
    match there.max_by_key(age) {
        Some(path) => Ok(path.clone()),
        None => Err(FmuExportError::NoLibrary {
            path: places[0].clone(),
        }),
    }
}
