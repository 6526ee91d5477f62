//! The tasks of a new user in `tests/tasks`: shell scripts with the commands of the book, each in the place where a user types
//! them, and the files that the user writes for them.

use std::fs;
use std::path::PathBuf;

use crate::python::in_repository;

/// A script of `tests/tasks`.
#[derive(Debug, Clone)]
pub struct Task {
    /// Where the script is.
    pub path: PathBuf,
    /// Its file name without the end, such as `01-first-scene`.
    pub name: String,
    /// Page of the book that its commands are from, with its path in the repository.
    pub page: String,
    /// What the user types, line by line.
    pub commands: Vec<String>,
    /// What the user writes.
    pub files: Vec<Written>,
}

/// A file that a user writes.
#[derive(Debug, Clone)]
pub struct Written {
    /// Its name.
    pub name: String,
    /// Its lines.
    pub lines: Vec<String>,
}

impl Task {
    /// Number of lines of the files that the user writes.
    pub fn lines(&self) -> usize {
        self.files.iter().map(|file| file.lines.len()).sum()
    }

    fn read(path: PathBuf) -> Self {
        let text = fs::read_to_string(&path).unwrap();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let mut task = Self {
            path,
            name,
            page: String::new(),
            commands: Vec::new(),
            files: Vec::new(),
        };
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            task.take(line, &mut lines);
        }
        task
    }

    fn take<'a>(&mut self, line: &str, rest: &mut impl Iterator<Item = &'a str>) {
        let opened = line.strip_prefix("cat >");
        if let Some(name) = opened.and_then(|line| line.strip_suffix(" <<'END'")) {
            let written = rest.take_while(|line| *line != "END");
            self.files.push(Written {
                name: name.to_owned(),
                lines: written.map(str::to_owned).collect(),
            });
        } else if let Some(page) = line.strip_prefix("# docs/") {
            let page = page.split(',').next().unwrap();
            self.page = format!("docs/{page}");
        } else if !line.starts_with('#') && line != "set -e" && !is_interruption(line) {
            self.commands.push(line.to_owned());
        }
    }
}

/// Stands for what happens to the user, who does not type it.
fn is_interruption(line: &str) -> bool {
    line.starts_with("until ") || line.starts_with("kill ")
}

/// All tasks, in their order.
pub fn tasks() -> Vec<Task> {
    let entries = fs::read_dir(in_repository("tests/tasks")).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.into_iter().map(Task::read).collect()
}
