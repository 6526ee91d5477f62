//! Faults at random times, again and again: every result has the bits of the undisturbed run. A failure prints its seed;
//! `LINCHPIN_SEED=N` repeats it.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::time::{Duration, Instant};

use linchpin_tests::chain::scene_text;
use linchpin_tests::process::{Running, Workshop};
use rustix::process::{Pid, Signal, kill_process};

use crate::{DOUBLE_PENDULUM, OSCILLATOR, run, undisturbed, with_python_worker, workshop};

/// Random numbers that a seed decides.
struct Dice {
    seed: u64,
    thrown: u64,
}

impl Dice {
    /// From 0 to 1.
    fn throw(&mut self) -> f64 {
        self.thrown += 1;
        let mut hasher = DefaultHasher::new();
        (self.seed, self.thrown).hash(&mut hasher);
        (hasher.finish() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.throw() * limit as f64) as usize
    }
}

/// What was done to a run.
#[derive(Debug, Default)]
struct Faults {
    killed: usize,
    stopped: usize,
    masters: usize,
}

impl Faults {
    fn count(&self) -> usize {
        self.killed + self.stopped + self.masters
    }
}

/// Runs the scene to its end with a fault every now and then, at most `most` of them.
#[track_caller]
fn disturb(
    workshop: &Workshop,
    settings: &[&str],
    dice: &mut Dice,
    time: Duration,
    most: usize,
) -> Faults {
    let mut faults = Faults::default();
    let folder = workshop.path().join("out");
    let _ = std::fs::remove_dir_all(&folder);
    let mut words = run("out", settings);
    let mut running = workshop.start(&words);
    loop {
        let pause = time.mul_f64(0.05 + 0.4 * dice.throw());
        if ends_within(&mut running, pause) {
            running.wait().exits_with(0).leaves_no_process();
            return faults;
        }
        if faults.count() >= most {
            continue;
        }
        match dice.below(5) {
            0 => {
                running.send(Signal::KILL);
                running.wait().leaves_no_process();
                faults.masters += 1;
                words = run("out", settings);
                if folder.join("checkpoint").exists() || folder.join("checkpoint.previous").exists()
                {
                    words.push("--resume".into());
                }
                running = workshop.start(&words);
            }
            // A worker that hangs at the start ends the run: nothing is computed yet, and it may be the user's mistake.
            1 if !folder.join("results.csv").exists() => {}
            1 => faults.stopped += usize::from(hit(&running, dice, Signal::STOP)),
            _ => faults.killed += usize::from(hit(&running, dice, Signal::KILL)),
        }
    }
}

/// Sends a signal to some worker, if there is one.
fn hit(running: &Running, dice: &mut Dice, signal: Signal) -> bool {
    let workers = running.workers(".sock");
    if workers.is_empty() {
        return false;
    }
    let worker = workers[dice.below(workers.len())];
    // It may have ended by itself.
    kill_process(Pid::from_raw(worker).unwrap(), signal).is_ok()
}

fn ends_within(running: &mut Running, time: Duration) -> bool {
    let give_up = Instant::now() + time;
    while Instant::now() < give_up {
        if running.has_ended() {
            return true;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    false
}

/// Disturbs runs of a scene until so many faults were injected.
fn assert_survives(scene: &str, settings: &[&str], seed: u64, faults: usize) {
    let workshop = workshop(scene);
    let settings = [
        settings,
        &[
            "run.deadline=1",
            "run.recoveries=10",
            "run.export_every=25",
            "run.checkpoint_steps=40",
        ],
    ]
    .concat();
    let began = Instant::now();
    let expected = undisturbed(&workshop, &settings);
    let time = began.elapsed();
    let mut injected = 0;
    let first = std::env::var("LINCHPIN_SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    for seed in first.unwrap_or(seed).. {
        println!("LINCHPIN_SEED={seed}");
        let mut dice = Dice { seed, thrown: 0 };
        let done = disturb(&workshop, &settings, &mut dice, time, faults);
        println!("{done:?}");
        assert!(
            workshop.read("out/results.csv") == expected,
            "other bits: {done:?}"
        );
        injected += done.count();
        if injected >= faults {
            return;
        }
    }
}

#[test]
fn the_oscillator_survives() {
    assert_survives(OSCILLATOR, &["scene.t_end=4"], 1, 20);
}

#[test]
fn the_double_pendulum_survives() {
    assert_survives(DOUBLE_PENDULUM, &["coupling.macro_step=4e-4"], 1000, 15);
}

#[test]
fn a_chain_of_eight_survives() {
    assert_survives(&scene_text(8), &[], 2000, 15);
}

/// No checkpoints here: its states do not leave the Python process, so only workers are hit.
#[test]
fn a_python_worker_survives() {
    let workshop = workshop(&with_python_worker());
    let settings = ["run.deadline=2", "run.recoveries=10"];
    let expected = undisturbed(&workshop, &settings);
    for seed in 0..5 {
        println!("LINCHPIN_SEED={seed}");
        let mut dice = Dice { seed, thrown: 0 };
        let _ = std::fs::remove_dir_all(workshop.path().join("out"));
        let mut running = workshop.start(&run("out", &settings));
        running.wait_for_rows("out");
        for _ in 0..2 {
            hit(&running, &mut dice, Signal::KILL);
            std::thread::sleep(Duration::from_millis(300));
        }
        running.wait().exits_with(0);
        assert!(workshop.read("out/results.csv") == expected);
    }
}

#[test]
#[ignore = "half an hour: 500 faults; cargo test --release --workspace --test recovery -- --ignored --nocapture"]
fn five_hundred_faults() {
    assert_survives(OSCILLATOR, &["scene.t_end=4"], 10_000, 200);
    assert_survives(DOUBLE_PENDULUM, &["coupling.macro_step=4e-4"], 20_000, 150);
    assert_survives(&scene_text(8), &[], 30_000, 150);
}
