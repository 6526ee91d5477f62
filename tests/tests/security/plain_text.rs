//! Plain text does not leave the machine unasked, and sockets are for their user alone.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use linchpin_tests::process::{Workshop, wait_until};

use crate::{Worker, certified};

const OSCILLATOR: &str = include_str!("../../../scenes/oscillator.toml");

#[test]
fn a_worker_does_not_offer_it_to_other_machines() {
    let workshop = certified();
    let listen = ["worker", "--exit-with-stdin", "--listen"];
    let run = |more: &[&str]| workshop.run(&[&listen[..], more].concat());
    run(&["0.0.0.0:0"]).fails(
        1,
        &["other machines", "--certificates FOLDER", "--plain-text"],
    );
    run(&["0.0.0.0:0", "--plain-text"]).exits_with(0);
    let own = ["--certificates", "certificates/workers/mass1"];
    run(&[&["0.0.0.0:0"], &own[..]].concat())
        .exits_with(0)
        .prints(&["listening on https://0.0.0.0:"]);
    run(&[&["0.0.0.0:0", "--plain-text"], &own[..]].concat()).exits_with(2);
    let socket = format!("unix:{}/own.sock", workshop.path().display());
    run(&[&[socket.as_str()], &own[..]].concat()).fails(
        1,
        &["own.sock", "takes no certificates", "--certificates away"],
    );
}

#[test]
fn a_master_does_not_speak_it_to_other_machines() {
    let workshop = Workshop::new();
    workshop.write("scene.toml", OSCILLATOR);
    // An address that no machine has: whoever tries takes long to fail.
    let remote = "subsystem.mass1.address=http://192.0.2.1:50051";
    for command in ["run", "check"] {
        workshop
            .run(&[command, "scene.toml", "--set", remote])
            .fails(
                2,
                &[
                    "http://192.0.2.1:50051",
                    "plain text",
                    "security.plain_text = true",
                ],
            );
    }
    let tls = "subsystem.mass1.address=https://192.0.2.1:50051";
    workshop.run(&["run", "scene.toml", "--set", tls]).fails(
        2,
        &[
            "https://192.0.2.1:50051",
            "no certificates",
            "security.certificates",
        ],
    );
    for command in ["health", "describe", "instances", "conformance"] {
        workshop
            .run(&[command, "http://192.0.2.1:50051"])
            .fails(
                1,
                &["http://192.0.2.1:50051", "--certificates", "--plain-text"],
            )
            .takes_less_than(Duration::from_secs(2));
    }
    let permitted = [
        "health",
        "http://192.0.2.1:50051",
        "--timeout",
        "0.3",
        "--plain-text",
    ];
    workshop
        .run(&permitted)
        .fails(1, &["is the worker running"]);
    // By name and on request it may.
    let plain = Worker::start_with(&[]);
    let address = plain.address.replace("127.0.0.1", "localhost");
    workshop.run(&["health", &address]).exits_with(0);
}

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().permissions().mode() & 0o777
}

/// A command under a umask that takes nothing away.
fn careless(command: Command) -> Command {
    let mut shell = Command::new("sh");
    shell
        .args(["-c", "umask 0; exec \"$0\" \"$@\""])
        .arg(command.get_program())
        .args(command.get_args())
        .current_dir(command.get_current_dir().unwrap())
        .process_group(0);
    for (name, value) in command.get_envs() {
        match value {
            Some(value) => shell.env(name, value),
            None => shell.env_remove(name),
        };
    }
    shell
}

#[test]
fn sockets_are_for_their_user_whatever_the_umask() {
    let workshop = Workshop::new();
    let socket = workshop.path().join("own.sock");
    let listen = format!("unix:{}", socket.display());
    let worker = careless(workshop.command(&["worker", "--listen", &listen]));
    let worker = workshop.start_command(worker);
    wait_until("a socket", || socket.exists());
    workshop.run(&["health", &listen]).exits_with(0);
    assert_eq!(mode(&socket), 0o600);
    drop(worker);

    let workshop = Workshop::new();
    workshop.write("scene.toml", OSCILLATOR);
    let long = ["run", "scene.toml", "--quiet", "--set", "scene.t_end=1000"];
    let mut running = workshop.start_command(careless(workshop.command(&long)));
    running.wait_for_rows("out/oscillator");
    let folders = fs::read_dir(workshop.path()).unwrap().flatten();
    let mut folders =
        folders.filter(|own| own.file_name().to_string_lossy().starts_with("linchpin-"));
    let folder = folders.next().unwrap().path();
    assert_eq!(mode(&folder), 0o700);
    for name in ["mass1", "mass2"] {
        assert_eq!(mode(&folder.join(format!("{name}.sock"))), 0o600);
    }
    running.press_ctrl_c();
    running.wait().exits_with(130);
}

#[test]
fn certificates_are_for_their_user_whatever_the_umask() {
    let workshop = Workshop::new();
    let make = ["certificates", "all", "--worker", "mass1=h"];
    let make = careless(workshop.command(&make));
    workshop.start_command(make).wait().exits_with(0);
    for folder in ["all", "all/master", "all/workers", "all/workers/mass1"] {
        assert_eq!(mode(&workshop.path().join(folder)), 0o700, "{folder}");
    }
    for file in ["ca.crt", "tls.crt", "tls.key"] {
        let file = workshop.path().join("all/workers/mass1").join(file);
        assert_eq!(mode(&file), 0o600);
    }
}
