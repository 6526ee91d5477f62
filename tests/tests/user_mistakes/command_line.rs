//! Mistakes on the command line, and what help there is.

use std::io::Read;
use std::process::Stdio;
use std::time::Duration;

use crate::{check, exists, run, workshop};

#[test]
fn settings_that_are_none() {
    let workshop = workshop(&[]);
    let with = |setting| run(&["--set", setting]);
    workshop
        .run(&with("coupling.degree"))
        .fails(2, &["\"coupling.degree\"", "write KEY=VALUE"]);
    workshop
        .run(&with("coupling.degre=1"))
        .fails(2, &["--set coupling.degre=1", "`degree`"]);
    workshop
        .run(&with("subsystem.mas1.parameters.m=1"))
        .fails(2, &["mas1", "did you mean `mass1`?"]);
    workshop
        .run(&with("subsystem.mass1.parameters.m=-1"))
        .fails(2, &["--set", "greater than 0"]);
    workshop
        .run(&with("coupling.degree=[1"))
        .fails(2, &["--set coupling.degree=[1", "TOML"]);
    workshop
        .run(&with("degree=1"))
        .fails(2, &["\"degree\"", "SECTION.KEY"]);
    workshop
        .run(&with("run.deadline=1e300"))
        .fails(2, &["run.deadline", "at most 1e6 s"]);
    assert!(!exists(&workshop, "out/results.csv"));
}

#[test]
fn without_arguments_the_commands_are_shown() {
    let nothing: [&str; 0] = [];
    let workshop = workshop(&[]);
    let outcome = workshop.run(&nothing);
    outcome.fails(
        2,
        &[
            "run",
            "check",
            "worker",
            "describe",
            "Examples:",
            "Exit codes",
        ],
    );
}

#[test]
fn every_command_has_help_with_examples() {
    let workshop = workshop(&[]);
    let overview = workshop.run(&["--help"]);
    let commands: Vec<&str> = overview
        .stdout
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .take_while(|line| !line.is_empty())
        // Descriptions that are too long for a line go on further to the right.
        .filter_map(|line| line.strip_prefix("  ")?.split(' ').next())
        .filter(|command| !["", "help"].contains(command))
        .collect();
    assert!(commands.len() >= 4, "{overview}");
    for command in commands {
        let example = format!("linchpin {command} ");
        workshop
            .run(&[command, "--help"])
            .succeeds()
            .prints(&["Examples:", &example, "Usage:"]);
    }
}

#[test]
fn commands_and_flags_that_do_not_exist() {
    let workshop = workshop(&[]);
    workshop.run(&["runn"]).fails(2, &["runn", "'run'"]);
    workshop
        .run(&run(&["--treads"]))
        .fails(2, &["--treads", "'--threads'"]);
    workshop
        .run(&run(&["--threads"]))
        .fails(2, &["--in-process"]);
    workshop
        .run(&["run"])
        .fails(2, &["<SCENE>", "linchpin run"]);
    workshop
        .run(&["--log", "linchpin=loud", "check", "scene.toml"])
        .fails(
            2,
            &["--log", "\"loud\"", "off, error, warn, info, debug, trace"],
        );
    workshop
        .run(&["--log", "info,linchpn_master=debug", "check", "scene.toml"])
        .fails(
            2,
            &["--log", "\"linchpn_master\"", "linchpin_master", "tonic"],
        );
}

#[test]
fn folders_that_cannot_be_written_to() {
    let workshop = workshop(&[]);
    workshop.write("file", "");
    for folder in ["file", "file/below"] {
        let outcome = workshop.run(&["run", "scene.toml", "--out", folder]);
        outcome.fails(1, &["cannot write to", folder, "--out"]);
    }
}

#[test]
fn a_pipe_gets_plain_text_and_no_progress_bar() {
    let workshop = workshop(&[]);
    let outcome = workshop.run(&run(&[]));
    outcome
        .succeeds()
        .prints(&["reached t = 1 s", "results in out"]);
    assert_eq!(outcome.stderr, "", "{outcome}");
    let plain = |text: &str| !text.contains(['\u{1b}', '\r']);
    assert!(plain(&outcome.stdout), "{outcome}");
    let outcome = workshop.run(&check(&["--set", "coupling.degree=9"]));
    assert!(plain(&outcome.stderr), "{outcome}");
}

#[test]
fn quiet_means_quiet() {
    let workshop = workshop(&[]);
    let outcome = workshop.run(&run(&["--quiet"]));
    outcome.succeeds();
    assert_eq!(
        (outcome.stdout.as_str(), outcome.stderr.as_str()),
        ("", ""),
        "{outcome}"
    );
}

#[test]
fn a_reader_that_has_enough_is_no_error() {
    let workshop = workshop(&[]);
    let mut command = workshop.command(&run(&["--in-process"]));
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let mut said = String::new();
    child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut said)
        .unwrap();
    assert_eq!((child.wait().unwrap().code(), said.as_str()), (Some(0), ""));
    assert!(exists(&workshop, "out/run.json"));
}

#[test]
fn an_output_that_is_full_is_an_error() {
    let workshop = workshop(&[]);
    let mut command = workshop.command(&run(&["--in-process"]));
    let full = std::fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let output = command
        .stdout(full)
        .stderr(Stdio::piped())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("cannot write to the standard output"),
        "{said}"
    );
}

#[test]
fn describe_without_a_worker() {
    let workshop = workshop(&[]);
    let nobody = workshop.run(&["describe", "http://127.0.0.1:9", "--timeout", "0.2"]);
    nobody.fails(
        1,
        &["http://127.0.0.1:9", "refused", "is the worker running"],
    );
    nobody.takes_less_than(Duration::from_secs(2));
    let nobody = workshop.run(&["describe", "unix:/nowhere.sock", "--timeout", "0.2"]);
    nobody.fails(1, &["unix:/nowhere.sock", "is the worker running"]);
    for address in ["127.0.0.1:9", "tcp://127.0.0.1:9", "unix:relative", ""] {
        let refused = workshop.run(&["describe", address]);
        refused
            .fails(2, &["http://HOST:PORT or unix:/PATH"])
            .takes_less_than(Duration::from_secs(2));
    }
    workshop
        .run(&["describe", "http://127.0.0.1:9", "--timeout=-1"])
        .fails(2, &["--timeout"]);
}
