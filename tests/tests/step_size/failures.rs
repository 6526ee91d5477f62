//! Steps that a worker cannot take, where H may vary: repeated with a shorter H as long as nothing was committed.

use linchpin_master::RunError;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_proto::v1::Failure;
use linchpin_tests::errors::closed_form;
use linchpin_tests::scenes::{oscillator, oscillator_with};
use linchpin_tests::scripted::{Act, Scripted};
use linchpin_worker::{Inputs, Interval};

use crate::brittle::{Ended, Fate, Judge, Way, run_brittle, run_scripted};

const WAYS: [Way; 3] = [Way::Direct, Way::Threads, Way::Unary];

/// Longer than the error asks for almost everywhere.
const LONGEST: f64 = 2.3e-3;

const METHODS: [&str; 6] = [
    "method=weighted index=1 degree=1",
    "method=weighted index=1 degree=2 jacobian=reuse",
    "method=baumgarte index=1 beta=2H gamma=H^2 degree=1",
    "method=hermite",
    "method=hermite jacobian=every-step iterations={most=3}",
    "method=weighted index=1 degree=1 iterations={most=3,otherwise=\"reject\"}",
];

fn variable(coupling: &str) -> Scene {
    let coupling = format!("{coupling} tolerance=1e-2 macro_step=1e-2");
    oscillator_with(&coupling, &["scene.t_end=0.3"])
}

fn too_long(interval: Interval) -> bool {
    interval.length > LONGEST
}

/// The pull on the mass changes by too much within one step. Only passes look ahead with the inputs that the advance has; without them an
/// advance may fail that was not foreseen, and is taken in pieces.
fn pulled_too_much(interval: Interval, inputs: &Inputs) -> bool {
    let pull = |tau| inputs.value(0, tau);
    (pull(interval.length) - pull(0.0)).abs() > 70.0
}

const BY_INPUT: &str = "by its input";

const JUDGES: [(&str, Judge); 4] = [
    ("beyond some H", |interval, _| match too_long(interval) {
        true => Fate::Recoverable,
        false => Fate::Done,
    }),
    ("not a number", |interval, _| match too_long(interval) {
        true => Fate::NotANumber,
        false => Fate::Done,
    }),
    ("for some time", |interval, _| {
        match too_long(interval) && interval.start > 0.11 && interval.start < 0.17 {
            true => Fate::Recoverable,
            false => Fate::Done,
        }
    }),
    (BY_INPUT, |interval, inputs| {
        match pulled_too_much(interval, inputs) {
            true => Fate::Recoverable,
            false => Fate::Done,
        }
    }),
];

fn largest_error(scene: &Scene, ended: &Ended) -> f64 {
    let exact = closed_form(scene);
    let columns = linchpin_tests::runs::run(scene, linchpin::connect::Place::InProcess).columns;
    let place = columns.iter().position(|name| name == "mass1.x").unwrap();
    let error = |row: &Vec<f64>| (row[place] - exact("mass1.x", row[0]).unwrap()).abs();
    let size = ended
        .rows
        .iter()
        .fold(0.0_f64, |size, row| size.max(row[place].abs()));
    ended.rows.iter().map(error).fold(0.0, f64::max) / size
}

/// The workers stand where the accepted steps have led them, whatever was tried between: with these steps given, a run has equal bits.
#[test]
fn a_step_that_a_worker_cannot_take_is_repeated_and_leaves_no_trace() {
    for (name, judge) in JUDGES {
        for coupling in METHODS {
            // Of degree 2 the multipliers jump by as much over the shortest steps after some that were refused.
            if name == BY_INPUT && coupling.contains("degree=2") {
                continue;
            }
            let scene = variable(coupling);
            let found = run_brittle(&scene, judge, Way::Direct, &Options::default())
                .unwrap_or_else(|error| panic!("{name}, {coupling}: {error}"));
            let context = format!("{name}, {coupling}: {:?}", found.statistics.steps);
            let steps = found.statistics.steps.unwrap();
            let failed = steps.rejected_by_cause.failed;
            assert!(failed > 0, "{context}");
            assert!(steps.rejected >= failed, "{context}");
            assert!(8 * failed <= found.steps.len() as u64 + 24, "{context}");
            let error = largest_error(&scene, &found);
            assert!(error < 10.0 * 1e-2, "{context}: {error:e}");
            for way in WAYS {
                let own = run_brittle(&scene, judge, way, &Options::default()).unwrap();
                assert!(own.bits() == found.bits(), "{way:?} {context}");
            }
            if name == BY_INPUT && !coupling.contains("iterations") {
                // Advances in pieces are part of what steps that vary may meet.
                continue;
            }
            let options = Options {
                step_lengths: Some(found.steps.clone()),
                ..Options::default()
            };
            let direct = run_brittle(&scene, judge, Way::Direct, &options).unwrap();
            assert!(direct.bits() == found.bits(), "{context}");
        }
    }
}

/// Steps stay below the length that failed for a while, and are not tried in vain each time.
#[test]
fn steps_grow_again_where_the_worker_can_take_them() {
    let (_, for_some_time) = JUDGES[2];
    for coupling in METHODS {
        let scene = variable(coupling);
        let ended = run_brittle(&scene, for_some_time, Way::Direct, &Options::default()).unwrap();
        let longest = |from: f64, to: f64| {
            let starts = ended.rows.iter().map(|row| row[0]).zip(&ended.steps);
            let within = starts.filter(|(t, _)| *t > from && *t < to);
            within.map(|(_, step)| *step).fold(0.0, f64::max)
        };
        let [before, meanwhile, after] =
            [(0.0, 0.11), (0.11, 0.17), (0.17, 0.3)].map(|(from, to)| longest(from, to));
        assert!(meanwhile <= LONGEST, "{coupling}: {meanwhile:e}");
        assert!(
            before > 1.5 * LONGEST && after > 1.5 * LONGEST,
            "{coupling}: {before:e} {after:e}"
        );
    }
}

#[test]
fn no_step_is_short_enough() {
    let always: Judge = |interval, _| match interval.end() > 0.1 {
        true => Fate::Recoverable,
        false => Fate::Done,
    };
    let scene = oscillator("tolerance=1e-3 least_step=1e-5");
    for way in WAYS {
        let error = run_brittle(&scene, always, way, &Options::default());
        let shown = error.err().unwrap().to_string();
        for part in [
            "\"mass2\"",
            "Newton did not converge",
            "coupling.least_step",
            "t = 0.099",
            "H = 1e-5 s",
        ] {
            assert!(shown.contains(part), "{part}: {shown}");
        }
    }
}

#[test]
fn fixed_steps_stop_as_ever() {
    let scene = oscillator("macro_step=2.5e-3");
    for way in WAYS {
        let error = run_brittle(&scene, JUDGES[0].1, way, &Options::default());
        let error = error.err().unwrap();
        assert!(matches!(error, RunError::Worker { t: 0.0, .. }), "{error}");
        let error = run_brittle(&scene, JUDGES[1].1, way, &Options::default());
        assert!(matches!(error, Err(RunError::NotFinite { .. })));
    }
}

#[test]
fn what_a_shorter_step_does_not_cure_stops_the_run() {
    let torn: Judge = |interval, _| match interval.end() > 0.1 {
        true => Fate::Fatal,
        false => Fate::Done,
    };
    let scene = variable("method=weighted index=1 degree=1");
    for way in WAYS {
        let error = run_brittle(&scene, torn, way, &Options::default());
        let shown = error.err().unwrap().to_string();
        assert!(
            shown.contains("the mesh is torn") && !shown.contains("least_step"),
            "{shown}"
        );
    }
}

/// Exchange number 0 looks ahead from the start; with steps that are not repeated number 7 advances over step 7 and looks beyond it.
const FUSED: u64 = 7;

fn gentle() -> Scene {
    oscillator_with(
        "method=weighted index=1 degree=1 tolerance=1e-3 macro_step=1e-4",
        &["scene.t_end=0.05"],
    )
}

/// Only the look-ahead is lost: the worker that refused the exchange is asked for the advance alone.
#[test]
fn an_advance_stays_valid_when_the_look_ahead_beside_it_fails() {
    let failure = || Failure::recoverable(0.0, 0.0, "Newton did not converge");
    let true_run = run_scripted(&gentle(), |peer| peer).unwrap();
    let own = run_scripted(&gentle(), |peer| {
        peer.at_exchange(FUSED, Act::Fail(failure()))
    })
    .unwrap();
    let same = FUSED as usize + 1;
    assert_eq!(own.bits()[..same], true_run.bits()[..same]);
    let steps = own.statistics.steps.unwrap();
    assert_eq!(steps.rejected_by_cause.failed, 1);
    let share = own.steps[same - 1] / true_run.steps[same - 1];
    assert!((share - 0.25).abs() < 1e-6, "{share}");
}

/// Other workers have advanced already, so the worker takes the step in halves: the oscillator's exact solver ends where it would have ended.
#[test]
fn an_advance_that_fails_is_taken_in_pieces() {
    let failure = || Failure::recoverable(0.0, 0.0, "Newton did not converge");
    let failed_at = |exchanges: &'static [u64]| {
        let run = run_scripted(&gentle(), |peer| {
            let at = |peer: Scripted, exchange: &u64| {
                peer.at_exchange(FUSED + exchange, Act::Fail(failure()))
            };
            exchanges.iter().fold(peer, at)
        });
        run.unwrap()
    };
    let whole = failed_at(&[0]);
    // In two halves; in quarters after the first half was refused; after the second one was.
    for exchanges in [&[0, 1][..], &[0, 1, 2], &[0, 1, 3]] {
        let own = failed_at(exchanges);
        assert_eq!(own.steps[..8], whole.steps[..8], "{exchanges:?}");
        let same = FUSED as usize;
        assert_eq!(own.bits()[..same], whole.bits()[..same]);
        for (found, expected) in own.rows[same].iter().zip(&whole.rows[same]) {
            let off = (found - expected).abs() / expected.abs().max(1e-3);
            assert!(off < 1e-9, "{exchanges:?}: {found} {expected}");
        }
    }
}

/// A worker that does not take any piece is an end.
#[test]
fn an_advance_that_no_piece_brings_forward_stops_the_run() {
    let failure = || Failure::recoverable(0.0, 0.0, "Newton did not converge");
    let stopped = run_scripted(&gentle(), |peer| {
        let at = |peer: Scripted, exchange| peer.at_exchange(exchange, Act::Fail(failure()));
        (FUSED..FUSED + 20).fold(peer, at)
    });
    let error = stopped.err().unwrap();
    assert!(matches!(error, RunError::Worker { .. }), "{error}");
    let put = Act::Put {
        output: 0,
        value: f64::NAN,
    };
    let stopped = run_scripted(&gentle(), |peer| peer.at_exchange(FUSED, put.clone()));
    assert!(matches!(stopped, Err(RunError::NotFinite { .. })));
}
