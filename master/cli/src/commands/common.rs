//! Arguments that several commands share.

use std::fmt::Display;
use std::fs;
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use linchpin_master::Interrupt;
use linchpin_master::connection::{
    Access, Grpc, StartError, TimeLimits, WorkerAddress, new_runtime,
};
use linchpin_master::scene::{self, Override, Scene, SceneErrors, warnings};

use serde::Serialize;

use super::CommandError;
use crate::connect::access;
use crate::output::OutputFolder;
use crate::progress;

/// A scene with changes.
#[derive(Debug, Clone, clap::Args)]
pub struct SceneArguments {
    /// Scene file (TOML)
    pub scene: PathBuf,

    /// Change a setting of the scene, e.g. coupling.macro_step=5e-4 or subsystem.*.parameters.c=1e4
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<Override>,
}

impl SceneArguments {
    /// Reads the scene; warnings about known instabilities go to the error output.
    pub fn load(&self) -> Result<Scene, CommandError> {
        let other = match &self.scene {
            file if scene::is_spectrum(file) => Some((
                "describes spectra of integration schemes",
                "linchpin spectrum",
            )),
            file if scene::is_study(file) => Some(("is a study", "linchpin report")),
            _ => None,
        };
        if let Some((what, command)) = other {
            return Err(CommandError::NoScene {
                path: self.scene.clone(),
                what,
                command,
            });
        }
        let scene = scene::load(&self.scene, &self.set)?;
        for warning in warnings(&scene) {
            warn(warning);
        }
        Ok(scene)
    }

    /// The scene with more settings than those given by `--set`.
    pub fn with<'a>(&self, more: impl IntoIterator<Item = (&'a str, String)>) -> Self {
        let mut arguments = self.clone();
        let more = more.into_iter();
        arguments.set.extend(more.map(|(key, value)| Override {
            key: key.to_owned(),
            value,
        }));
        arguments
    }

    /// Everything that decides about the results of a study of `scene`, as this says it.
    pub fn identity(&self, study: &str, scene: &Scene) -> String {
        let set = self.set.iter().map(ToString::to_string);
        let parts = [study.to_owned(), scene.text().to_owned()];
        parts.into_iter().chain(set).collect::<Vec<_>>().join("\n")
    }

    /// A section of the scene that a study needs; `flags` do the same.
    pub fn section<'a, T>(
        &self,
        found: &'a Option<T>,
        section: &'static str,
        flags: &'static str,
    ) -> Result<&'a T, CommandError> {
        found.as_ref().ok_or_else(|| CommandError::NothingToStudy {
            path: self.scene.clone(),
            section,
            flags,
        })
    }
}

/// A running worker that is asked outside of any run.
#[derive(Debug, Clone, clap::Args)]
pub struct WorkerArguments {
    /// Address of the worker: https://HOST:PORT, http://HOST:PORT or unix:/PATH
    #[arg(value_parser = address)]
    address: String,

    #[command(flatten)]
    access: AccessArguments,

    /// Longest time for an answer, in s
    #[arg(long, value_name = "S", default_value_t = 5.0, value_parser = seconds)]
    timeout: f64,
}

/// By what right workers on other machines are called.
#[derive(Debug, Clone, clap::Args)]
pub struct AccessArguments {
    /// Folder with ca.crt, tls.crt and tls.key of this master, for https:// (linchpin certificates makes it)
    #[arg(long, value_name = "FOLDER")]
    certificates: Option<PathBuf>,

    /// Permit http:// to other machines; nothing is encrypted, and nobody proves who they are
    #[arg(long)]
    plain_text: bool,

    /// File with the token of workers that demand one
    #[arg(long, value_name = "FILE")]
    token: Option<PathBuf>,
}

impl AccessArguments {
    /// Reads the certificates.
    ///
    /// # Errors
    /// [`StartError::Certificates`], [`StartError::Token`].
    pub fn read(&self) -> Result<Access, StartError> {
        access(
            self.certificates.as_deref(),
            self.token.as_deref(),
            self.plain_text,
        )
    }
}

/// Reads the address of a worker.
pub fn address(text: &str) -> Result<String, String> {
    match WorkerAddress::parse(text) {
        Some(_) => Ok(text.to_owned()),
        None => Err("it must be https://HOST:PORT, http://HOST:PORT or unix:/PATH".into()),
    }
}

/// Reads a positive time in s.
pub fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if seconds > 0.0 && seconds <= 1e6 => Ok(seconds),
        _ => Err("it must be a number of seconds greater than 0 and at most 1e6".into()),
    }
}

impl WorkerArguments {
    /// Its address as given.
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Connects to it.
    ///
    /// # Errors
    /// [`CommandError::Start`] if nobody answers there; [`CommandError::System`].
    pub fn connect(&self) -> Result<Grpc, CommandError> {
        let (limits, access) = (self.limits(), self.access()?);
        let (runtime, interrupt) = (new_runtime()?, Interrupt::default());
        Grpc::connect(&self.address, limits, &access, runtime, interrupt)
            .map_err(|source| self.failed(source))
    }

    /// By what right it is called.
    ///
    /// # Errors
    /// [`CommandError::Start`]: the certificates cannot be used.
    pub fn access(&self) -> Result<Access, CommandError> {
        self.access.read().map_err(|source| self.failed(source))
    }

    /// The time that it has.
    pub fn limits(&self) -> TimeLimits {
        let limit = Duration::from_secs_f64(self.timeout);
        TimeLimits {
            start: limit,
            answer: limit,
        }
    }

    /// That a call to it failed.
    pub fn failed(&self, source: impl Into<StartError>) -> CommandError {
        CommandError::Start {
            address: self.address.clone(),
            source: Box::new(source.into()),
        }
    }
}

/// Where results go.
#[derive(Debug, Clone, clap::Args)]
pub struct OutputArguments {
    /// Folder for the results; made if it does not exist [default: out/NAME OF THE SCENE]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// No progress bar and no summary
    #[arg(long, short)]
    pub quiet: bool,
}

impl OutputArguments {
    /// Makes the folder for results of this name and takes it for this process, before any work is done.
    ///
    /// # Errors
    /// As for [`OutputFolder::claim`].
    pub fn claim(&self, name: &str) -> Result<OutputFolder, CommandError> {
        OutputFolder::claim(&self.folder(name))
    }

    /// The same for a folder within it.
    ///
    /// # Errors
    /// As for [`OutputFolder::claim`].
    pub fn claim_within(&self, name: &str, inner: &str) -> Result<OutputFolder, CommandError> {
        OutputFolder::claim(&self.folder(name).join(inner))
    }

    fn folder(&self, name: &str) -> PathBuf {
        let usual = || Path::new("out").join(name);
        self.out.clone().unwrap_or_else(usual)
    }

    /// Whether a progress bar may be shown: not between the lines of a log, which tells the progress itself.
    pub fn shows_progress(&self) -> bool {
        let is_logged = tracing::enabled!(tracing::Level::INFO);
        !self.quiet && !is_logged && std::io::stderr().is_terminal()
    }

    /// Does work of so many parts, called `unit`, under a progress bar; the work calls what it is given after each
    /// part.
    pub fn with_progress<T>(
        &self,
        parts: usize,
        unit: &str,
        work: impl FnOnce(&(dyn Fn() + Sync)) -> T,
    ) -> T {
        let template = format!("{{bar:40}} {{pos}}/{{len}} {unit}  {{per_sec}}  {{eta}} left");
        let bar = progress::bar(parts as u64, &template, self.shows_progress());
        let done = work(&|| bar.inc(1));
        bar.finish_and_clear();
        done
    }

    /// Prints a summary and where the results are.
    pub fn conclude(&self, summary: &str, results: &Path) -> Result<(), CommandError> {
        if self.quiet {
            return Ok(());
        }
        print(format_args!("{summary}results in {}\n", results.display()))
    }
}

/// Removes results of an earlier run that this one would not overwrite if it failed.
pub fn remove_stale(path: &Path) -> Result<(), CommandError> {
    match fs::remove_file(path) {
        Err(source) if source.kind() != ErrorKind::NotFound => {
            Err(CommandError::unwritable(path)(source))
        }
        _ => Ok(()),
    }
}

/// Writes to the standard output. That its reader has enough, as in `| head -1`, is no error.
pub fn print(text: impl Display) -> Result<(), CommandError> {
    let mut output = std::io::stdout();
    match write!(output, "{text}").and_then(|()| output.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CommandError::Output(error)),
        _ => Ok(()),
    }
}

/// Writes a document to the standard output as JSON.
pub fn print_json(document: &impl Serialize) -> Result<(), CommandError> {
    let text = serde_json::to_string_pretty(document).map_err(io::Error::from);
    print(text.map_err(CommandError::Output)? + "\n")
}

/// Writes a warning to the error output; whoever closed it is not told.
pub fn warn(text: impl Display) {
    let _ = writeln!(std::io::stderr(), "warning: {text}");
}

/// The folders that take the results of the cases of a scene, each its own.
///
/// # Errors
/// A name that gives no folder, or the folder of another case.
pub fn case_folders(scene: &Scene) -> Result<Vec<String>, SceneErrors> {
    let mut folders: Vec<String> = Vec::new();
    for case in &scene.cases {
        let refuse = |message| {
            let help = "choose a name that differs in letters, digits, - or _".to_owned();
            scene.error(&format!("case.{}.name", case.name), message, Some(help))
        };
        let folder = file_name(&case.name);
        if folder.is_empty() {
            return Err(refuse("no folder can be named after this case".to_owned()));
        }
        if let Some(earlier) = folders.iter().position(|taken| *taken == folder) {
            let earlier = &scene.cases[earlier].name;
            return Err(refuse(format!(
                "the results would go to the folder {folder}, as those of case \"{earlier}\" do"
            )));
        }
        folders.push(folder);
    }
    Ok(folders)
}

/// A name that can be part of a path: letters, digits, `-`, `_` and `.` stay, runs of anything else become one `-`.
fn file_name(name: &str) -> String {
    let mut safe = String::with_capacity(name.len());
    for character in name.chars() {
        if character.is_alphanumeric() || matches!(character, '-' | '_' | '.') {
            safe.push(character);
        } else if !safe.ends_with('-') {
            safe.push('-');
        }
    }
    safe.trim_matches(['-', '.']).to_owned()
}

#[cfg(test)]
mod tests {
    use super::file_name;

    #[test]
    fn names_become_parts_of_paths() {
        assert_eq!(file_name("index 1, k = 0"), "index-1-k-0");
        assert_eq!(file_name("../../etc"), "etc");
    }
}
