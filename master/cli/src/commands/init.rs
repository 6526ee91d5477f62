//! `linchpin init`: writes a first scene, or a worker to start from.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ValueEnum;

use super::CommandError;
use super::common::print;

/// Write a first scene, or a worker of your own to start from
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  linchpin init first
  linchpin init --template python-worker my-worker
  linchpin init --template rust-worker my-worker

Writes a scene that runs as it is, and beside it, for a worker, a solver of a free mass that is coupled to a built-in model: put your
own in its place. README.md says what to type. Files that are there already are left alone, and nothing is written then.")]
pub struct Arguments {
    /// Folder; made if it does not exist
    #[arg(value_name = "DIR")]
    folder: PathBuf,

    /// What to write
    #[arg(long, value_enum, default_value_t = Template::Scene)]
    template: Template,

    /// A clone of Linchpin, which a Rust worker is built with [default: where this program was built]
    #[arg(long, value_name = "CLONE")]
    source: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Template {
    /// Two links on a hinge, built-in models
    Scene,
    /// A solver in Python, and a scene with it
    PythonWorker,
    /// A solver in Rust, and a scene with it
    RustWorker,
}

/// A file that is written: its path in the folder, and its text.
type File = (&'static str, String);

/// Writes the files.
pub fn execute(arguments: &Arguments) -> Result<(), CommandError> {
    let files = files(arguments)?;
    let folder = &arguments.folder;
    let there = files
        .iter()
        .map(|(name, _)| folder.join(name))
        .find(|path| path.exists());
    if let Some(path) = there {
        return Err(CommandError::FileThere { path });
    }
    for (name, text) in &files {
        write(&folder.join(name), text)?;
    }
    print(told(arguments.template, folder, &files))
}

fn files(arguments: &Arguments) -> Result<Vec<File>, CommandError> {
    Ok(match arguments.template {
        Template::Scene => vec![(
            "scene.toml",
            include_str!("../../assets/templates/scene.toml").into(),
        )],
        Template::PythonWorker => vec![
            (
                "scene.toml",
                include_str!("../../../../worker/python/template/scene.toml").into(),
            ),
            (
                "worker.py",
                include_str!("../../../../worker/python/template/worker.py").into(),
            ),
            (
                "README.md",
                include_str!("../../assets/templates/python-worker.md").into(),
            ),
        ],
        Template::RustWorker => vec![
            ("Cargo.toml", manifest(&source(arguments)?)),
            (
                "scene.toml",
                include_str!("../../../../worker/template/scene.toml").into(),
            ),
            (
                "src/main.rs",
                include_str!("../../../../worker/template/src/main.rs").into(),
            ),
            (
                "README.md",
                include_str!("../../assets/templates/rust-worker.md").into(),
            ),
        ],
    })
}

/// The manifest of the Rust worker with the paths of a clone.
fn manifest(clone: &Path) -> String {
    let text = include_str!("../../../../worker/template/Cargo.toml");
    let path = |folder: &str| format!("path = {:?}", clone.join(folder).display().to_string());
    text.replace("path = \"../../proto\"", &path("proto"))
        .replace("path = \"..\"", &path("worker"))
}

/// The clone that a Rust worker is built with.
fn source(arguments: &Arguments) -> Result<PathBuf, CommandError> {
    let built = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let clone = arguments.source.as_ref().unwrap_or(&built);
    let is_clone = ["proto", "worker"]
        .iter()
        .all(|part| clone.join(part).join("Cargo.toml").is_file());
    let found = clone.canonicalize().ok().filter(|_| is_clone);
    found.ok_or_else(|| CommandError::NoClone {
        path: clone.clone(),
    })
}

fn write(path: &Path, text: &str) -> Result<(), CommandError> {
    let unwritable = CommandError::unwritable(path);
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder.map_err(&unwritable)?;
    let file = fs::File::create_new(path);
    file.and_then(|mut file| file.write_all(text.as_bytes()))
        .map_err(&unwritable)
}

fn told(template: Template, folder: &Path, files: &[File]) -> String {
    let written: Vec<String> = files
        .iter()
        .map(|(name, _)| format!("{}\n", folder.join(name).display()))
        .collect();
    let folder = folder.display();
    let next = match template {
        Template::Scene => format!("run it: linchpin run {folder}/scene.toml --animate"),
        Template::PythonWorker => format!("next: cd {folder}, and README.md says how to run it"),
        Template::RustWorker => {
            format!("next: cd {folder} && cargo build --release && linchpin run scene.toml")
        }
    };
    written.concat() + &next + "\n"
}
