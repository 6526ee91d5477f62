//! A token keeps other users of the machine away from a worker at a loopback address.

use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;

use linchpin_tests::process::Workshop;

use crate::{Worker, certified};

const SECRET: &str = "0123456789abcdef0123456789abcdef\n";

fn secret(workshop: &Workshop, name: &str, text: &str) -> String {
    let path = workshop.write(name, text);
    fs::set_permissions(&path, Permissions::from_mode(0o600)).unwrap();
    path.display().to_string()
}

#[test]
fn only_who_has_it_is_served() {
    let (keys, workshop) = (certified(), Workshop::new());
    let own = secret(&keys, "token", SECRET);
    let other = secret(&keys, "other", &SECRET.replace('0', "1"));
    let folder = keys.path().join("certificates/workers/mass1");
    let master = keys.path().join("certificates/master");
    let encrypted = ["--certificates", folder.to_str().unwrap(), "--token", &own];
    let with = ["--certificates", master.to_str().unwrap()];
    for (worker, more) in [
        (Worker::start_with(&["--token", &own]), &[][..]),
        (Worker::start_with(&encrypted), &with),
        (Worker::in_python_with(&["--token", &own]), &[]),
        (Worker::in_python_with(&encrypted), &with),
    ] {
        let ask = |token: &[&str]| {
            let ask = ["describe", &worker.address];
            workshop.run(&[&ask[..], more, token].concat())
        };
        ask(&["--token", &own]).exits_with(0);
        ask(&[]).fails(
            1,
            &[
                &worker.address,
                "demands a token",
                "--token",
                "security.token",
            ],
        );
        ask(&["--token", &other]).fails(1, &[&worker.address, "another token"]);
        // It needs no secret to ask for the health.
        let health = ["health", &worker.address];
        workshop.run(&[&health[..], more].concat()).exits_with(0);
    }
}

#[test]
fn runs_show_it() {
    let (keys, workshop) = (Workshop::new(), Workshop::new());
    let own = secret(&keys, "token", SECRET);
    workshop.write(
        "scene.toml",
        include_str!("../../../scenes/oscillator.toml"),
    );
    let flags = ["--token", &own];
    let (rust, python) = (Worker::start_with(&flags), Worker::in_python_with(&flags));
    for (worker, calls) in [
        (&rust, "automatic"),
        (&rust, "unary"),
        (&python, "automatic"),
        (&python, "unary"),
    ] {
        let address = format!("subsystem.mass1.address={}", worker.address);
        let calls = format!("subsystem.*.calls={calls}");
        let run = [
            "run",
            "scene.toml",
            "--quiet",
            "--set",
            "scene.t_end=0.05",
            "--set",
            &address,
            "--set",
            &calls,
        ];
        let setting = format!("security.token={own}");
        let shown = ["--set", &setting];
        workshop.run(&[&run[..], &shown].concat()).succeeds();
        workshop.run(&run).fails(1, &["mass1", "demands a token"]);
    }
}

#[test]
fn files_that_hold_none() {
    let workshop = Workshop::new();
    secret(&workshop, "short", "0123456789abcdef");
    secret(&workshop, "lines", "0123456789abcdef\n0123456789abcdef");
    let open = workshop.write("open", SECRET);
    fs::set_permissions(open, Permissions::from_mode(0o640)).unwrap();
    for (file, words) in [
        ("short", "holds no token"),
        ("lines", "one line of 32"),
        ("open", "chmod 600"),
        ("nowhere", "cannot read the token nowhere"),
    ] {
        let listen = ["worker", "--exit-with-stdin", "--token", file];
        workshop.run(&listen).fails(1, &[file, words]);
        let ask = ["describe", "http://127.0.0.1:9", "--token", file];
        workshop.run(&ask).fails(1, &[file, words]);
    }
}
