//! Replies that belong to another request: one of them would shift all that follow by a step.

use std::sync::Arc;

use linchpin_models::models;
use linchpin_tests::process::{Outcome, Workshop};
use linchpin_tests::tampering::{Tamper, Tampering};
use linchpin_worker::Host;

use crate::{run, workshop};

/// Couplings of the oscillator scene: with a corrector, and without one, where nothing would notice.
const METHODS: [&str; 4] = [
    "method = \"baumgarte\"\nindex = 2\nbeta = 2e-3\ndegree = 0",
    "method = \"explicit\"\nmu = \"20H\"",
    "method = \"penalty\"\nstiffness = 1e5\ndamping = 10.0",
    "method = \"hermite\"",
];

fn scene_with(method: &str) -> Workshop {
    workshop(&[
        ("t_end = 1.0", "t_end = 0.3"),
        ("\nindex = 2", "\n#"),
        ("\nbeta = 2e-3", "\n#"),
        ("\ndegree = 0", "\n#"),
        ("method = \"baumgarte\"", &format!("{method} #")),
    ])
}

/// The folder lives as long as its outcome is looked at.
fn tampered(method: &str, tamper: Tamper, at: u64, more: &[&str]) -> (Workshop, Outcome) {
    let workshop = scene_with(method);
    let host = Arc::new(Host::new(models()));
    let address = Tampering::new(host, at, tamper).serve(&workshop);
    let served = format!("subsystem.mass2.address={address}");
    // Long enough for a busy machine to start a worker, and waited for only where a reply never comes.
    let settings = [
        "--set",
        &served,
        "--set=run.deadline=4",
        "--set=run.recoveries=0",
    ];
    let outcome = workshop.run(&run(&[&settings[..], more].concat()));
    (workshop, outcome)
}

#[test]
fn a_true_worker_is_believed() {
    for method in METHODS {
        tampered(method, Tamper::Repeat, u64::MAX, &[]).1.succeeds();
        let unary = [
            "--set",
            "subsystem.mass2.calls=unary",
            "--set",
            "scene.t_end=0.1",
        ];
        tampered(method, Tamper::Repeat, u64::MAX, &unary)
            .1
            .succeeds();
    }
}

#[test]
fn a_reply_that_is_repeated_or_late() {
    for method in METHODS {
        for (at, tamper, asked, found) in [
            (7, Tamper::Repeat, "8", "7"),
            (213, Tamper::Repeat, "214", "213"),
            (31, Tamper::Delay, "31", "30"),
        ] {
            let found =
                format!("that of sequence number {found}, asked was sequence number {asked}");
            tampered(method, tamper, at, &[]).1.fails(
                1,
                &[
                    "\"mass2\"",
                    "t = ",
                    "the reply to Exchange is",
                    &found,
                    "results.csv",
                ],
            );
        }
    }
}

#[test]
fn a_reply_of_another_instance() {
    for method in METHODS {
        let (_workshop, outcome) = tampered(method, Tamper::OtherInstance, 19, &[]);
        outcome.fails(
            1,
            &["\"mass2\"", "the reply to Exchange is that of instance "],
        );
    }
}

#[test]
fn a_reply_that_is_missing() {
    for method in METHODS {
        let (_workshop, outcome) = tampered(method, Tamper::Drop, 12, &[]);
        outcome.fails(1, &["\"mass2\"", "no answer within 4 s", "run.deadline"]);
    }
}

#[test]
fn replies_to_unary_calls() {
    for (tamper, words) in [
        (
            Tamper::Delay,
            "the reply to Step is that of sequence number",
        ),
        (
            Tamper::OtherInstance,
            "the reply to Step is that of instance",
        ),
        (Tamper::Drop, "no answer within 4 s"),
    ] {
        for method in METHODS {
            let unary = ["--set", "subsystem.mass2.calls=unary"];
            tampered(method, tamper, 40, &unary)
                .1
                .fails(1, &["\"mass2\"", words]);
        }
    }
}
