//! `linchpin certificates`: for whom, once, and how mistakes are told.

use std::fs;
use std::os::unix::fs::MetadataExt;

use linchpin_tests::process::Workshop;
use rustix::process::{getgid, getuid};

use crate::{Worker, certified};

const OSCILLATOR: &str = include_str!("../../../scenes/oscillator.toml");

#[test]
fn every_worker_with_an_address_gets_its_own() {
    let workshop = Workshop::new();
    let at = |name: &str| {
        let second = format!("name = \"{name}\"\n");
        (
            second.clone(),
            format!("{second}address = \"https://{name}.example.org:50051\"\n"),
        )
    };
    let (line, served) = at("mass2");
    let scene =
        OSCILLATOR.replacen(&line, &served, 1) + "\n[security]\ncertificates = \"all/master\"\n";
    workshop.write("scene.toml", scene);
    let outcome = workshop.run(&[
        "certificates",
        "all",
        "scene.toml",
        "--worker",
        "extra=::1",
        "--days",
        "7",
    ]);
    outcome.succeeds().prints(&[
        "valid for 7 days",
        "all/master: the master",
        "all/workers/mass2: mass2.example.org, localhost, 127.0.0.1, ::1",
        "all/workers/extra: ::1, localhost, 127.0.0.1",
    ]);
    // The other one is started by the run.
    assert!(!workshop.path().join("all/workers/mass1").exists());
    // The authority is the same for all, and its key is nowhere.
    let authority = workshop.read("all/master/ca.crt");
    assert_eq!(authority, workshop.read("all/workers/mass2/ca.crt"));
    let keys = ["all/master", "all/workers/mass2", "all/workers/extra"]
        .map(|folder| workshop.read(&format!("{folder}/tls.key")));
    assert!(keys[0] != keys[1] && keys[1] != keys[2]);
    let files = fs::read_dir(workshop.path().join("all")).unwrap().count();
    assert_eq!(files, 2);
    // What it makes is good.
    let worker = Worker::start(&workshop.path().join("all/workers/extra"));
    let ask = ["health", &worker.address, "--certificates", "all/master"];
    workshop.run(&ask).exits_with(0);
}

#[test]
fn nothing_is_overwritten() {
    let workshop = certified();
    let key = workshop.read("certificates/workers/mass2/tls.key");
    let again = [
        "certificates",
        "certificates",
        "--worker",
        "mass2=127.0.0.1",
    ];
    workshop.run(&again).fails(
        1,
        &[
            "certificates/master/ca.crt",
            "is there already",
            "nothing was written",
        ],
    );
    let lazy = [&again[..], &["--if-missing"]].concat();
    workshop.run(&lazy).succeeds().prints(&["they are there"]);
    // One more worker is not there yet, and cannot be added.
    let more = [&lazy[..], &["--worker", "mass3=127.0.0.1"]].concat();
    workshop.run(&more).fails(1, &["is there already"]);
    assert_eq!(key, workshop.read("certificates/workers/mass2/tls.key"));
    workshop.write("certificates/master/tls.crt", "no certificate");
    workshop
        .run(&lazy)
        .fails(1, &["certificates/master/tls.crt", "remove the old ones"]);
}

#[test]
fn files_can_be_given_to_a_user() {
    let workshop = Workshop::new();
    let own = format!("{}:{}", getuid().as_raw(), getgid().as_raw());
    let make = ["certificates", "all", "--worker", "a=h", "--owner"];
    workshop.run(&[&make[..], &[&own]].concat()).succeeds();
    let key = workshop.path().join("all/workers/a/tls.key");
    assert_eq!(fs::metadata(&key).unwrap().uid(), getuid().as_raw());
    let elsewhere = Workshop::new();
    let given = elsewhere.run(&[&make[..], &["61234:61234"]].concat());
    if getuid().is_root() {
        given.succeeds();
        let key = elsewhere.path().join("all/workers/a/tls.key");
        assert_eq!(fs::metadata(&key).unwrap().uid(), 61234);
    } else {
        given.fails(1, &["cannot write", "all/master"]);
    }
}

#[test]
fn mistakes_are_told() {
    let workshop = Workshop::new();
    workshop.write("scene.toml", OSCILLATOR);
    workshop
        .run(&["certificates", "all"])
        .fails(2, &["there is no scene", "--worker NAME=HOST"]);
    workshop
        .run(&["certificates", "all", "scene.toml"])
        .fails(2, &["scene.toml", "https://HOST:PORT", "--worker"]);
    for wrong in ["mass1", "mass1=", "../a=h", "mass1=https://h"] {
        workshop
            .run(&["certificates", "all", "--worker", wrong])
            .fails(2, &[wrong, "NAME=HOST"]);
    }
    let make = ["certificates", "all", "--worker", "a=h"];
    workshop
        .run(&[&make[..], &["--days", "0"]].concat())
        .fails(2, &["--days"]);
    workshop
        .run(&[&make[..], &["--owner", "me"]].concat())
        .fails(2, &["me", "UID:GID"]);
    workshop.write("file", "");
    workshop
        .run(&["certificates", "file", "--worker", "a=h"])
        .fails(1, &["cannot write file/master"]);
    assert!(!workshop.path().join("all").exists());
}
