//! Tells the program from which commit it is built.

use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo:rerun-if-env-changed=LINCHPIN_COMMIT");
    // Whoever builds without a repository, as in a container, may say it.
    let given = std::env::var("LINCHPIN_COMMIT").ok();
    let commit = given.or_else(|| git(&["rev-parse", "HEAD"]));
    println!(
        "cargo:rustc-env=LINCHPIN_COMMIT={}",
        commit.as_deref().unwrap_or("unknown")
    );
    // A file that is not there would make every build a new one.
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"])
        && Path::new(&log).exists()
    {
        println!("cargo:rerun-if-changed={log}");
    }
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let text = text.trim();
    (output.status.success() && !text.is_empty()).then(|| text.to_owned())
}
