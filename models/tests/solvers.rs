//! What holds for every solver of every model.

#![allow(clippy::unwrap_used)]

mod common;

use common::body::{Body, model, solver};
use common::cases::{CASES, Case, SHAKEN};
use common::{Solver, build_values, interval, polynomial, snapshot};
use linchpin_proto::v1;
use linchpin_proto::v1::value::Kind;
use linchpin_worker::{Inputs, Snapshot, StepFailure, Subsystem};

/// A model with one of its solvers.
#[derive(Debug, Clone, Copy)]
struct Subject {
    case: Case,
    solver: Solver,
}

fn subjects() -> Vec<Subject> {
    let of_case = |case: Case| {
        let kinds = model(case.model).describe().solvers;
        let solvers: Vec<_> = kinds.iter().map(solver).collect();
        solvers
            .into_iter()
            .map(move |solver| Subject { case, solver })
    };
    CASES.into_iter().chain(SHAKEN).flat_map(of_case).collect()
}

impl Subject {
    fn build(&self) -> Box<dyn Subsystem> {
        Body::of(self.case, self.solver).run
    }

    fn is_smooth(&self) -> bool {
        let outputs = self.case.description().outputs;
        outputs.iter().all(|output| output.name != "impacts")
    }

    fn number_of_inputs(&self) -> usize {
        self.case.description().inputs.len()
    }

    /// Loads that jump from step to step, as a master's do.
    fn inputs(&self, step: u32, length: f64) -> Inputs {
        let inputs = self.number_of_inputs();
        let mut all = Inputs::constant(&vec![0.0; inputs]);
        for input in 0..inputs {
            let level = self.case.load * (f64::from(step) * 0.7 + input as f64).cos();
            let coefficients = [level, -6.0 * self.case.load, 300.0 * self.case.load];
            all.replace(input, polynomial(&coefficients, length));
        }
        all
    }

    fn run(&self, subsystem: &mut dyn Subsystem, steps: std::ops::Range<u32>) {
        let length = 1.3e-3;
        for step in steps {
            let start = f64::from(step) * length;
            let inputs = self.inputs(step, length);
            subsystem.step(interval(start, length), &inputs).unwrap();
        }
    }

    /// All outputs.
    fn outputs(&self, subsystem: &mut dyn Subsystem) -> Vec<f64> {
        let outputs = self.case.description().outputs.len();
        let mut values = vec![0.0; outputs];
        let wanted: Vec<_> = (0..outputs).collect();
        let inputs = vec![0.1; self.number_of_inputs()];
        subsystem
            .outputs(0.0, &inputs, &wanted, &mut values)
            .unwrap();
        values
    }

    /// All outputs to the bit, and what the next step depends on.
    fn bits(&self, subsystem: &mut dyn Subsystem) -> (Vec<u64>, Snapshot) {
        let outputs = self.outputs(subsystem);
        (
            outputs.into_iter().map(f64::to_bits).collect(),
            snapshot(subsystem),
        )
    }
}

#[test]
fn every_built_in_model_has_a_case() {
    for model in linchpin_models::models() {
        let v1::Model { name, solvers, .. } = model.describe();
        // What has no solver, the ground, is at rest.
        if solvers.is_empty() {
            continue;
        }
        assert!(CASES.iter().any(|case| case.model == name), "{name}");
    }
}

#[test]
fn a_restored_run_goes_on_bit_by_bit() {
    for subject in subjects() {
        let mut subsystem = subject.build();
        subject.run(&mut *subsystem, 0..7);
        let kept = snapshot(&*subsystem);
        subject.run(&mut *subsystem, 7..12);
        let first = subject.bits(&mut *subsystem);

        subject.run(&mut *subsystem, 30..33);
        subsystem.restore(&kept).unwrap();
        assert_eq!(snapshot(&*subsystem), kept, "{subject:?}");
        subject.run(&mut *subsystem, 7..12);
        assert_eq!(subject.bits(&mut *subsystem), first, "{subject:?}");

        let mut elsewhere = subject.build();
        elsewhere
            .restore(&Snapshot::from_bytes(kept.bytes().to_vec()))
            .unwrap();
        subject.run(&mut *elsewhere, 7..12);
        assert_eq!(
            subject.bits(&mut *elsewhere),
            first,
            "{subject:?} elsewhere"
        );
    }
}

#[test]
fn a_perturbed_step_without_perturbation_gives_the_same_bits() {
    for subject in subjects() {
        let mut subsystem = subject.build();
        subject.run(&mut *subsystem, 0..5);
        let kept = snapshot(&*subsystem);
        let (span, inputs) = (interval(6.5e-3, 0.021), subject.inputs(5, 0.021));
        subsystem.step(span, &inputs).unwrap();
        let (expected, _) = subject.bits(&mut *subsystem);
        subsystem.restore(&kept).unwrap();
        subsystem.perturbed_step(span, &inputs).unwrap();
        assert_eq!(subject.bits(&mut *subsystem).0, expected, "{subject:?}");
    }
}

#[test]
fn a_perturbed_step_over_another_interval_is_an_ordinary_step() {
    for subject in subjects() {
        let mut subsystem = subject.build();
        subject.run(&mut *subsystem, 0..5);
        let kept = snapshot(&*subsystem);
        let inputs = subject.inputs(3, 0.011);
        subsystem.step(interval(0.0, 0.013), &inputs).unwrap();
        subsystem.restore(&kept).unwrap();
        let span = interval(0.0, 0.011);
        subsystem.perturbed_step(span, &inputs).unwrap();
        let perturbed = subject.bits(&mut *subsystem);
        subsystem.restore(&kept).unwrap();
        subsystem.step(span, &inputs).unwrap();
        assert_eq!(subject.bits(&mut *subsystem), perturbed, "{subject:?}");
    }
}

/// The result is a smooth function of the inputs, where there are no impacts: second differences over an increment of 1e-6 of the load vanish to
/// rounding, far below the tolerance of 1e-8 that a solver with step-size control has.
#[test]
fn perturbed_steps_are_smooth_in_the_perturbation() {
    let length = 0.02;
    for subject in subjects().into_iter().filter(Subject::is_smooth) {
        let mut subsystem = subject.build();
        subject.run(&mut *subsystem, 0..5);
        let kept = snapshot(&*subsystem);
        let mut inputs = subject.inputs(5, length);
        let span = interval(6.5e-3, length);
        subsystem.step(span, &inputs).unwrap();
        let middle = subject.outputs(&mut *subsystem);
        let number_of_inputs = subject.number_of_inputs();
        for input in 0..number_of_inputs {
            let mut outputs_at = |change: f64| {
                let raised = polynomial(&[subject.case.load * change], length);
                let own = inputs.replace(input, raised);
                subsystem.restore(&kept).unwrap();
                subsystem.perturbed_step(span, &inputs).unwrap();
                inputs.replace(input, own);
                subject.outputs(&mut *subsystem)
            };
            let (low, here, high) = (outputs_at(-1e-6), outputs_at(0.0), outputs_at(1e-6));
            for i in 0..middle.len() {
                let second = (low[i] - 2.0 * here[i] + high[i]).abs();
                let rounding = 1e-12 * (1.0 + here[i].abs());
                assert!(second < rounding, "{subject:?} {input} {i}: {second:e}");
            }
        }
    }
}

#[test]
fn a_snapshot_of_another_length_is_refused_and_changes_nothing() {
    for subject in subjects() {
        let mut subsystem = subject.build();
        subject.run(&mut *subsystem, 0..3);
        let before = snapshot(&*subsystem);
        let right = before.bytes().len();
        for wrong in [0, right - 1, right - 8, right + 8] {
            let refused = subsystem.restore(&Snapshot::from_bytes(vec![0; wrong]));
            assert!(
                matches!(refused, Err(StepFailure::Fatal { .. })),
                "{subject:?}"
            );
        }
        assert_eq!(snapshot(&*subsystem), before);
    }
}

#[test]
fn an_output_that_does_not_exist_is_refused() {
    for subject in subjects() {
        let mut subsystem = subject.build();
        let outputs = subject.outputs(&mut *subsystem).len();
        let inputs = vec![0.0; subject.number_of_inputs()];
        let unknown = subsystem.outputs(0.0, &inputs, &[0, outputs], &mut [0.0; 2]);
        let Err(StepFailure::Fatal { message }) = unknown else {
            panic!("{subject:?}: {unknown:?}")
        };
        assert!(message.contains(&outputs.to_string()), "{message}");
    }
}

#[test]
fn a_step_that_overflows_fails_at_its_time_and_changes_nothing() {
    for subject in subjects() {
        let mut parameters = subject.case.values();
        for (name, value) in &mut parameters {
            let last = name.rsplit('.').next().unwrap();
            match (last, &mut value.kind) {
                ("m" | "inertia" | "j1" | "j2" | "j3", Some(Kind::Number(value))) => *value = 1e-9,
                ("inertia", Some(Kind::Numbers(list))) => list.values.fill(1e-9),
                ("c" | "d", Some(Kind::Number(value))) => *value = 0.0,
                _ => {}
            }
        }
        let model = model(subject.case.model);
        let mut subsystem = build_values(&*model, parameters, subject.solver).unwrap();
        let before = snapshot(&*subsystem);
        let mut inputs = Inputs::constant(&vec![0.0; subject.number_of_inputs()]);
        inputs.replace(0, polynomial(&[1.7e308], 0.7));
        let failure = subsystem.step(interval(2.5, 0.7), &inputs).unwrap_err();
        let StepFailure::Recoverable { t, .. } = &failure else {
            panic!("{subject:?}: {failure:?}")
        };
        assert!((2.5..=3.2).contains(t), "{subject:?}: {failure}");
        assert_eq!(snapshot(&*subsystem), before, "{subject:?}");
    }
}
