//! Pages of `docs/evidence`: where their numbers come from, and the tables that commands write into them.
//!
//! A command that makes a table prints it. It also writes it into its page with `--write`, or, as a test has no options of
//! its own, where the environment has `LINCHPIN_WRITE=1`.

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where the numbers of a table come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stamp {
    commit: String,
    machine: String,
    date: String,
    command: String,
}

const BEGIN: &str = "Measured at commit ";

impl Stamp {
    /// This commit, this machine, today.
    pub fn of(command: &str) -> Self {
        Self {
            commit: commit(),
            machine: machine(),
            date: output("date", &["+%Y-%m-%d"]),
            command: command.to_owned(),
        }
    }
}

impl fmt::Display for Stamp {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            commit,
            machine,
            date,
            command,
        } = self;
        write!(out, "{BEGIN}{commit}, on {machine}, {date}:\n`{command}`.")
    }
}

/// A text has at least one line with commit, machine and date.
pub fn is_stamped(text: &str) -> bool {
    text.lines().any(is_stamp)
}

fn is_stamp(line: &str) -> bool {
    let Some(rest) = line.strip_prefix(BEGIN) else {
        return false;
    };
    let commit = rest.split([',', ' ']).next().unwrap_or_default();
    let date = rest
        .strip_suffix(':')
        .and_then(|rest| rest.rsplit(", ").next());
    commit.len() >= 7
        && commit.chars().all(|letter| letter.is_ascii_hexdigit())
        && rest.contains(", on ")
        && date.is_some_and(is_date)
}

fn is_date(text: &str) -> bool {
    let parts: Vec<&str> = text.split('-').collect();
    let lengths: Vec<usize> = parts.iter().map(|part| part.len()).collect();
    lengths == [4, 2, 2] && parts.iter().all(|part| part.parse::<u32>().is_ok())
}

fn commit() -> String {
    let commit = output("git", &["rev-parse", "--short", "HEAD"]);
    match output("git", &["status", "--porcelain", "--untracked-files=no"]).is_empty() {
        true => commit,
        false => commit + " + changes",
    }
}

/// Model and number of the cores.
fn machine() -> String {
    let cores = std::thread::available_parallelism().unwrap();
    let described = fs::read_to_string("/proc/cpuinfo").unwrap();
    let model = described.lines().find_map(|line| {
        let (key, value) = line.split_once(':')?;
        (key.trim() == "model name").then(|| value.trim())
    });
    format!("{}, {cores} cores", model.unwrap_or("an unknown processor"))
}

/// What a program prints, in the repository.
fn output(program: &str, arguments: &[&str]) -> String {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(repository());
    let output = command.output().unwrap();
    assert!(output.status.success(), "{command:?}");
    String::from_utf8(output.stdout).unwrap().trim().to_owned()
}

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// The user wants the tables in their pages.
pub fn is_to_be_written() -> bool {
    std::env::args().any(|argument| argument == "--write")
        || std::env::var_os("LINCHPIN_WRITE").is_some()
}

/// Where a page of the evidence is.
pub fn path(page: &str) -> PathBuf {
    repository().join("docs/evidence").join(page)
}

/// Prints a table of a page, and writes it there if that is wanted.
pub fn show(page: &str, name: &str, command: &str, table: &str) {
    let text = format!("{}\n\n{}", Stamp::of(command), table.trim_end());
    println!("\n{text}");
    if is_to_be_written() {
        let path = path(page);
        let old = fs::read_to_string(&path).unwrap();
        fs::write(&path, with_table(&old, name, &text)).unwrap();
    }
}

/// A page with another text between `<!-- table: NAME -->` and `<!-- end -->`.
pub fn with_table(page: &str, name: &str, text: &str) -> String {
    let marker = format!("<!-- table: {name} -->\n");
    let Some((before, rest)) = page.split_once(&marker) else {
        panic!("the page has no {marker}");
    };
    let end = rest.find("<!-- end -->").unwrap();
    format!("{before}{marker}{text}\n{}", &rest[end..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stamp_has_commit_machine_and_date() {
        let stamp = Stamp {
            commit: "e588e81 + changes".into(),
            machine: "Some(R) Processor, 2 cores".into(),
            date: "2026-11-30".into(),
            command: "cargo bench".into(),
        };
        let text = stamp.to_string();
        assert_eq!(
            text,
            "Measured at commit e588e81 + changes, on Some(R) Processor, 2 cores, 2026-11-30:\n\
             `cargo bench`."
        );
        assert!(is_stamped(&text));
        assert!(is_stamped(&Stamp::of("cargo bench").to_string()));
        for wrong in [
            "Measured at commit yesterday, on a machine, 2026-11-30:",
            "Measured at commit e588e81, 2026-11-30:",
            "Measured at commit e588e81, on a machine, in November:",
        ] {
            assert!(!is_stamped(wrong), "{wrong}");
        }
    }

    #[test]
    fn a_table_is_replaced_and_nothing_else() {
        let page =
            "a\n<!-- table: x y -->\nold\n<!-- end -->\nb\n<!-- table: z -->\n<!-- end -->\n";
        assert_eq!(
            with_table(page, "x y", "new"),
            "a\n<!-- table: x y -->\nnew\n<!-- end -->\nb\n<!-- table: z -->\n<!-- end -->\n"
        );
    }
}
