//! Impacts across joints have the same bits everywhere, and after steps that were rejected.

use linchpin::connect::Place;
use linchpin_tests::process::assert_same_bytes_in_processes;
use linchpin_tests::runs::run;

use crate::{DRIVEN, PENDULUM, SPLIT, here, scene};

/// Fixed steps, and steps that are rejected with impacts in them; loads as forces and as wrenches of turning bodies.
fn cases() -> [(&'static str, Vec<&'static str>); 5] {
    [
        (SPLIT, vec!["scene.t_end=0.012"]),
        (SPLIT, vec!["scene.t_end=0.012", "output.interval=3.7e-5"]),
        (
            SPLIT,
            vec![
                "scene.t_end=0.03",
                "coupling.method=weighted",
                "coupling.index=1",
                "coupling.tolerance=1e-6",
            ],
        ),
        (DRIVEN, vec!["scene.t_end=0.01"]),
        (PENDULUM, vec!["scene.t_end=0.45"]),
    ]
}

#[test]
fn threads_and_single_calls_change_no_bit() {
    for (text, overrides) in cases() {
        let expected = here(text, &overrides);
        let struck = expected.statistics.corrections.steps_with_impacts;
        assert!(struck > 0, "{overrides:?}");
        let threads = run(&scene(text, &overrides), Place::Threads);
        assert!(threads.bits() == expected.bits(), "{overrides:?}");
        let unary = [&overrides[..], &["subsystem.*.calls=unary"]].concat();
        assert!(
            here(text, &unary).bits() == expected.bits(),
            "{overrides:?}"
        );
    }
}

#[test]
fn worker_processes_change_no_byte() {
    for (text, overrides) in cases() {
        assert_same_bytes_in_processes(text, &overrides);
    }
}

/// Steps were repeated, some of them with impacts.
#[test]
fn the_case_with_rejections_has_some() {
    let (text, overrides) = &cases()[2];
    assert!(here(text, overrides).rejected > 3);
}

/// Results at other times change no macro step.
#[test]
fn samples_change_no_macro_step() {
    let [(text, plain), (_, sampled), ..] = cases();
    let plain = here(text, &plain);
    let sampled = here(text, &sampled);
    let impacts = |run: &linchpin_tests::runs::Trajectory| {
        let contacts = run.statistics.subsystems[1].contacts.unwrap();
        let impulse = contacts.impulse.to_bits();
        (contacts.impacts, contacts.first_impact, impulse)
    };
    assert_eq!(impacts(&plain), impacts(&sampled));
    assert!(sampled.rows.len() > 2 * plain.rows.len());
}
