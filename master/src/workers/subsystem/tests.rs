//! What the master asks of an answer before it uses it.

use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{
    Advance, ExchangeReply, ExchangeRequest, InitializeReply, Outputs, Predict, Signal,
};

use super::*;
use crate::connection::Direct;

/// Answers every exchange with the same reply and offers nothing else.
struct Parrot(ExchangeReply);

fn unimplemented<T>(call: &'static str) -> Result<T, CallError> {
    Err(CallError::Unimplemented { call })
}

impl Contract for Parrot {
    fn describe(&self, _: &v1::DescribeRequest) -> Result<v1::DescribeReply, CallError> {
        unimplemented("Describe")
    }

    fn initialize(&self, _: &v1::InitializeRequest) -> Result<InitializeReply, CallError> {
        Ok(InitializeReply::default())
    }

    fn snapshot(&self, _: &v1::SnapshotRequest) -> Result<v1::SnapshotReply, CallError> {
        unimplemented("Snapshot")
    }

    fn restore(&self, _: &v1::RestoreRequest) -> Result<v1::RestoreReply, CallError> {
        unimplemented("Restore")
    }

    fn step(&self, _: &v1::StepRequest) -> Result<v1::StepReply, CallError> {
        unimplemented("Step")
    }

    fn perturbed_step(
        &self,
        _: &v1::PerturbedStepRequest,
    ) -> Result<v1::PerturbedStepReply, CallError> {
        unimplemented("PerturbedStep")
    }

    fn evaluate(&self, _: &v1::EvaluateRequest) -> Result<v1::EvaluateReply, CallError> {
        unimplemented("Evaluate")
    }

    fn terminate(&self, _: &v1::TerminateRequest) -> Result<v1::TerminateReply, CallError> {
        unimplemented("Terminate")
    }

    fn exchange(&self, _: &ExchangeRequest, reply: &mut ExchangeReply) -> Result<(), CallError> {
        reply.clone_from(&self.0);
        Ok(())
    }
}

fn outputs(values: &[f64]) -> Outputs {
    Outputs {
        values: values.to_vec(),
    }
}

/// The answer to a request with one of everything; x is a coupling output, a is recorded.
fn whole() -> ExchangeReply {
    ExchangeReply {
        advanced: Some(outputs(&[0.3, 0.7])),
        samples: vec![outputs(&[0.2, 0.6])],
        predicted: Some(outputs(&[0.4])),
        perturbed: vec![outputs(&[0.5])],
        derivatives: vec![outputs(&[1.1])],
        evaluated: Some(outputs(&[0.3])),
        evaluated_perturbed: vec![outputs(&[0.3])],
        evaluated_derivatives: vec![outputs(&[0.0])],
        ..ExchangeReply::default()
    }
}

/// Takes `reply` as the answer to a request with one of everything.
fn take(reply: ExchangeReply) -> (Subsystem, Result<(), RunError>) {
    let step = MacroStep {
        start: 0.25,
        length: 0.5,
        end: 0.75,
    };
    let mut subsystem = Subsystem::new(
        "mass",
        Box::new(Direct::new(std::sync::Arc::new(Parrot(reply)))),
        RecoverySettings::default(),
    );
    let request = v1::InitializeRequest {
        coupling_outputs: vec!["x".into()],
        recorded_outputs: vec!["a".into()],
        ..v1::InitializeRequest::default()
    };
    subsystem.initialize(request).unwrap();
    let look = Predict {
        perturbed: vec![Signal::default()],
        directions: vec![Signal::default()],
        ..Predict::default()
    };
    subsystem.request = ExchangeRequest {
        go_back: true,
        advance: Some(Advance {
            samples: vec![0.1],
            ..Advance::default()
        }),
        predict: Some(look.clone()),
        evaluate: Some(look),
        ..ExchangeRequest::default()
    };
    subsystem.post(step).unwrap();
    let taken = subsystem.collect(step);
    (subsystem, taken)
}

#[test]
fn a_whole_answer_is_taken() {
    let (subsystem, taken) = take(whole());
    taken.unwrap();
    assert_eq!(subsystem.outputs, [0.3, 0.7]);
}

#[test]
fn an_answer_without_a_part_is_refused() {
    type Drop = fn(&mut ExchangeReply);
    let parts: [(&str, Drop); 8] = [
        ("advanced outputs", |reply| reply.advanced = None),
        ("samples", |reply| reply.samples.clear()),
        ("predicted outputs", |reply| reply.predicted = None),
        ("perturbed steps", |reply| reply.perturbed.clear()),
        ("directional derivatives", |reply| reply.derivatives.clear()),
        ("evaluated outputs", |reply| reply.evaluated = None),
        ("perturbed evaluations", |reply| {
            reply.evaluated_perturbed.clear()
        }),
        ("directional derivatives of an evaluation", |reply| {
            reply.evaluated_derivatives.clear()
        }),
    ];
    for (part, drop) in parts {
        let mut reply = whole();
        drop(&mut reply);
        let error = take(reply).1.unwrap_err().to_string();
        assert!(
            error.contains("\"mass\"")
                && error.contains(&format!("answered with 0 {part} instead of")),
            "{error}"
        );
    }
}

#[test]
fn a_part_that_is_no_number_or_too_short_is_refused() {
    type Pick = fn(&mut ExchangeReply) -> &mut Outputs;
    let parts: [(&str, Pick); 5] = [
        ("sampled outputs", |reply| &mut reply.samples[0]),
        ("perturbed outputs", |reply| &mut reply.perturbed[0]),
        ("derivatives of predicted outputs", |reply| {
            &mut reply.derivatives[0]
        }),
        ("perturbed outputs", |reply| {
            &mut reply.evaluated_perturbed[0]
        }),
        ("derivatives of evaluated outputs", |reply| {
            &mut reply.evaluated_derivatives[0]
        }),
    ];
    for (part, pick) in parts {
        let mut reply = whole();
        pick(&mut reply).values[0] = f64::NAN;
        let error = take(reply).1.unwrap_err().to_string();
        assert!(
            error.contains("NaN for output \"x\"") && error.contains("t = 0.25"),
            "{part}: {error}"
        );

        let mut reply = whole();
        pick(&mut reply).values.clear();
        let error = take(reply).1.unwrap_err().to_string();
        assert!(
            error.contains(&format!("answered with 0 {part} instead of")),
            "{error}"
        );
    }
}

/// Takes an answer to a look-ahead with two integrals each of x and y, and x at one instant, in which the values of one part are changed.
fn look_inside(change: impl Fn(&mut Vec<f64>), part: usize) -> RunError {
    let told = [0.4, 0.1, 0.2, 0.3, 0.5, 0.6];
    let mut parts = [told.to_vec(), told.to_vec(), told.to_vec()];
    change(&mut parts[part]);
    let [predicted, perturbed, derivatives] = parts.map(|values| outputs(&values));
    let reply = ExchangeReply {
        predicted: Some(predicted),
        perturbed: vec![perturbed],
        derivatives: vec![derivatives],
        ..ExchangeReply::default()
    };
    let connection = Direct::new(std::sync::Arc::new(Parrot(reply)));
    let mut subsystem = Subsystem::new("mass", Box::new(connection), RecoverySettings::default());
    let request = v1::InitializeRequest {
        coupling_outputs: vec!["x".into()],
        integrated_outputs: vec!["x".into(), "y".into()],
        interior_outputs: vec!["z".into()],
        ..v1::InitializeRequest::default()
    };
    subsystem.initialize(request).unwrap();
    subsystem.request.predict = Some(Predict {
        perturbed: vec![Signal::default()],
        directions: vec![Signal::default()],
        instants: vec![0.1],
        integrals: 2,
        ..Predict::default()
    });
    let step = MacroStep {
        start: 0.25,
        length: 0.5,
        end: 0.75,
    };
    subsystem.post(step).unwrap();
    subsystem.collect(step).unwrap_err()
}

#[test]
fn integrals_that_are_no_numbers_or_too_few_are_refused_by_name() {
    let parts = [
        "predicted outputs",
        "perturbed outputs",
        "derivatives of predicted outputs",
    ];
    for (number, part) in parts.into_iter().enumerate() {
        for (place, name) in [
            (1, "integral 0 of x"),
            (2, "integral 0 of y"),
            (4, "integral 1 of y"),
            (5, "z"),
        ] {
            let error = look_inside(|values| values[place] = f64::NAN, number).to_string();
            let words = format!("sent NaN for output \"{name}\" in the macro step from t = 0.25 s");
            assert!(
                error.contains("\"mass\"") && error.contains(&words),
                "{part}: {error}"
            );
        }
        // Without integrals, with one more.
        for length in [2, 7] {
            let error = look_inside(|values| values.resize(length, 0.0), number).to_string();
            let words = format!("answered with {length} {part} instead of 6");
            assert!(
                error.contains("\"mass\"") && error.contains(&words),
                "{error}"
            );
        }
    }
}
