//! Columns of the coupling Jacobian by differences from radau5, at H = 1e-4 (design page, Sect. 5).
//!
//! The increment is that of S1, `1e-5 max(1, |f|)` at f = 333 N. It moves x by about `H^2 / 2m` times 3e-3 N, which is
//! 1.7e-11 m and far below the tolerance. Three ways to make the perturbed run:
//!
//! * *repeated*: `perturbed_step`, which repeats the internal steps of the first run;
//! * *controlled*: `step` from the same snapshot, with step-size control;
//! * *anew*: a solver that starts with the same x and v but without the step size of the first run, as one does that
//!   does not keep it in its snapshot.
//!
//! Where one internal step covers H, as on the soft oscillator of S1, all three are the same. A spring of 1e8 N/m
//! (omega H = 1) needs several internal steps. *Anew* then takes other steps, and the difference of two errors within
//! the tolerance, over the tiny increment, spoils the column. *Controlled* mostly takes the same steps as the first
//! run, because the step size is part of the snapshot and the interval is cut in equal parts; but there are states
//! at which the increment tips a decision of the control, and one such state is enough to spoil a macro step.

#![allow(clippy::unwrap_used)]

mod common;

use common::{EXACT, Solver, X, interval, oscillator, snapshot, state};
use linchpin_worker::{Inputs, Snapshot, Subsystem};

const LENGTH: f64 = 1e-4;
const FORCE: f64 = 333.0;
const INCREMENT: f64 = 1e-5 * FORCE;
const NORMAL: Solver = Solver("radau5", &[("rtol", 1e-8), ("atol", 1e-8)]);
const LOOSE: Solver = Solver("radau5", &[("rtol", 1e-6), ("atol", 1e-6)]);

/// A radau5 run at the point where a column is wanted.
struct Prepared {
    c: f64,
    solver: Solver,
    run: Box<dyn Subsystem>,
    kept: Snapshot,
}

/// What one run over H gives.
#[derive(Debug, Clone, Copy, PartialEq)]
struct End {
    x: f64,
    internal_steps: u64,
}

impl Prepared {
    fn new(c: f64, v0: f64, solver: Solver, macro_steps_before: u32) -> Self {
        let mut run = start(c, [0.0, v0], solver);
        for _ in 0..macro_steps_before {
            over_one_macro_step(&mut run, FORCE, false);
        }
        let kept = snapshot(&*run);
        Self {
            c,
            solver,
            run,
            kept,
        }
    }

    fn first(&mut self) -> End {
        self.controlled(FORCE)
    }

    fn repeated(&mut self, force: f64) -> End {
        self.first();
        self.run.restore(&self.kept).unwrap();
        over_one_macro_step(&mut self.run, force, true)
    }

    fn controlled(&mut self, force: f64) -> End {
        self.run.restore(&self.kept).unwrap();
        over_one_macro_step(&mut self.run, force, false)
    }

    fn anew(&mut self, force: f64) -> End {
        self.run.restore(&self.kept).unwrap();
        let mut run = start(self.c, state(&mut self.run), self.solver);
        over_one_macro_step(&mut run, force, false)
    }

    /// Relative error of the column dx/df that `perturbed` gives.
    fn column_error(&mut self, perturbed: impl Fn(&mut Self, f64) -> End) -> f64 {
        // From rest under a unit force: no difference of large numbers.
        let exact = over_one_macro_step(&mut start(self.c, [0.0; 2], EXACT), 1.0, false).x;
        let raised = perturbed(self, FORCE + INCREMENT).x;
        let column = (raised - self.first().x) / INCREMENT;
        (column / exact - 1.0).abs()
    }
}

fn start(c: f64, [x0, v0]: [f64; 2], solver: Solver) -> Box<dyn Subsystem> {
    oscillator(
        &[("m", 1.0), ("c", c), ("d", 10.0), ("x0", x0), ("v0", v0)],
        solver,
    )
}

fn over_one_macro_step(run: &mut Box<dyn Subsystem>, force: f64, is_perturbed: bool) -> End {
    let before = run.internal_steps();
    let (span, inputs) = (interval(0.0, LENGTH), Inputs::constant(&[force, 0.0, 0.0]));
    if is_perturbed {
        run.perturbed_step(span, &inputs).unwrap();
    } else {
        run.step(span, &inputs).unwrap();
    }
    End {
        x: state(run)[X],
        internal_steps: run.internal_steps() - before,
    }
}

#[test]
fn one_internal_step_needs_no_repetition() {
    let mut soft = Prepared::new(1e3, 100.0, NORMAL, 37);
    assert_eq!(soft.first().internal_steps, 1);
    for error in [
        soft.column_error(Prepared::repeated),
        soft.column_error(Prepared::controlled),
        soft.column_error(Prepared::anew),
    ] {
        // What is left is the rounding of x, 1e-17 of 0.37 over 1.7e-11.
        assert!(error < 1e-5, "{error:e}");
    }
}

#[test]
fn several_internal_steps_are_noise_unless_they_are_repeated() {
    for (solver, noise) in [(NORMAL, 1e-3), (LOOSE, 1e-1)] {
        let mut noisy = 0;
        for macro_steps_before in 1..=20 {
            let mut stiff = Prepared::new(1e8, 100.0, solver, macro_steps_before);
            assert!(stiff.first().internal_steps > 3);
            let repeated = stiff.column_error(Prepared::repeated);
            let anew = stiff.column_error(Prepared::anew);
            println!("{solver:?} {macro_steps_before}: repeated {repeated:.1e}, anew {anew:.1e}");
            assert!(repeated < 1e-6, "{solver:?}: {repeated:e}");
            noisy += usize::from(anew > noise);
        }
        assert!(
            noisy >= 10,
            "{solver:?}: only {noisy} of 20 columns are wrong by more than {noise}"
        );
    }
}

/// A start velocity at which the increment of the force changes the number of internal steps: the border between
/// two numbers, by bisection.
fn tipping() -> Prepared {
    let prepared = |v0: f64| Prepared::new(1e8, v0, LOOSE, 0);
    let steps = |v0: f64| prepared(v0).first().internal_steps;
    let (mut low, mut high) = (2.0, 10.0);
    let at_low = steps(low);
    assert_ne!(at_low, steps(high));
    while high - low > f64::EPSILON * high {
        let middle = 0.5 * (low + high);
        if steps(middle) == at_low {
            low = middle
        } else {
            high = middle
        }
    }
    let is_tipped = |v0: f64| {
        let mut near = prepared(v0);
        near.first().internal_steps != near.controlled(FORCE + INCREMENT).internal_steps
    };
    prepared([low, high].into_iter().find(|&v0| is_tipped(v0)).unwrap())
}

#[test]
fn an_increment_that_tips_the_control_is_noise_unless_the_steps_are_repeated() {
    let mut prepared = tipping();
    let first = prepared.first();
    assert_eq!(
        prepared.repeated(FORCE + INCREMENT).internal_steps,
        first.internal_steps
    );
    assert_ne!(
        prepared.controlled(FORCE + INCREMENT).internal_steps,
        first.internal_steps
    );
    let repeated = prepared.column_error(Prepared::repeated);
    let controlled = prepared.column_error(Prepared::controlled);
    println!("repeated {repeated:.1e}, controlled {controlled:.1e}");
    assert!(repeated < 1e-6, "{repeated:e}");
    assert!(controlled > 1e-2, "{controlled:e}");
}
