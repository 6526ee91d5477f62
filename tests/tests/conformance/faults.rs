//! Every planted fault is found, and by the checks that should find it.

use std::sync::Arc;

use linchpin::conformance::peer::InProcess;
use linchpin::conformance::report::Report;
use linchpin::conformance::verdict::Grade;
use linchpin::conformance::{Settings, run};
use linchpin_models::planar_body::PlanarBody;
use linchpin_models::spatial_body::SpatialBody;
use linchpin_proto::contract::Contract;
use linchpin_worker::{Host, Model};
use serde_json::json;

use crate::planted::body::Body;
use crate::planted::{protocol, solver};
use crate::sound::undriven;
use crate::subjects::{built_in, examine, settings};

use protocol::Fault as Protocol;
use solver::Fault as Solver;

fn body(body: Body) -> Settings {
    let (model, parameters) = match body {
        Body::Planar => (
            "planar-body",
            json!({"m": 2.0, "inertia": 0.3, "length": 1.1, "angle0": 0.7, "rate0": 1.3, "vx0": 0.4}),
        ),
        Body::Spatial => (
            "spatial-body",
            json!({
                "m": 1.3, "j1": 0.021, "j2": 0.027, "j3": 0.034, "start_x": 0.1, "start_y": -0.05, "start_z": -0.17, "end_x": -0.2,
                "end_y": 0.07, "rx0": 0.75, "ry0": 0.27, "rz0": -0.95, "omega1_0": 1.0, "omega2_0": -2.0, "omega3_0": 0.5
            }),
        ),
    };
    settings(model, &parameters, "rk4 step=1e-4", &[1e-3])
}

/// Faults of solvers with a check that must find each.
fn of_solvers() -> Vec<(Body, Solver, &'static str)> {
    let both: Vec<(Solver, &str)> = vec![
        (Solver::NoMoment, "mobility"),
        (Solver::NoMomentInStep, "velocity"),
        (Solver::NoLoadInStep, "velocity"),
        (Solver::HalfLoadInStep, "load-shapes"),
        (Solver::HalfLoadEverywhere, "energy"),
        (Solver::BodyAxesLoad, "mobility"),
        (Solver::LoadAtTheCentre, "mobility"),
        (Solver::MomentSign, "mobility"),
        (Solver::ForceSign, "mobility"),
        (Solver::SwappedForces, "mobility"),
        (Solver::SwappedMarkers, "mobility"),
        (Solver::FrozenAtStart, "load-shapes"),
        (Solver::FrozenInTheMiddle, "load-shapes"),
        (Solver::FrozenAtEnd, "load-shapes"),
        (Solver::StraightLine, "load-shapes"),
        (Solver::TimeOfSignalsOff, "half-steps"),
        (Solver::NoGravityInAcceleration, "velocity"),
        (Solver::AccelerationIgnoresLoad, "velocity"),
        (Solver::VelocityOfTheCentre, "position"),
        (Solver::BodyAxesVelocity, "position"),
        (Solver::BodyAxesAcceleration, "mobility"),
        (Solver::RateSign, "position"),
        (Solver::ZeroOutputs, "response"),
        (Solver::ZeroVelocities, "position"),
        (Solver::StaleOutputs, "evaluate"),
        (Solver::HalfOldOutputs, "evaluate"),
        (Solver::HalfPositions, "position"),
        (Solver::WrongEnergy, "energy"),
        (Solver::RestoresNothing, "replay"),
        (Solver::RestoresHalf, "replay"),
        (Solver::HiddenHistory, "replay"),
        (Solver::SharedHistory, "parallel"),
        (Solver::EvaluateMoves, "evaluate"),
        (Solver::PerturbedStepMoves, "perturbed-steps"),
        (Solver::PerturbedStepIgnores, "perturbed-steps"),
        (Solver::RandomSolver, "replay"),
        (Solver::NaNAfterAWhile, "replay"),
    ];
    let planar = [
        (Solver::Degrees, "position"),
        (Solver::AccelerationOfTheCentre, "velocity"),
    ];
    let spatial = [
        (Solver::SwappedMoments, "mobility"),
        (Solver::BodyAxesRate, "position"),
        (Solver::ConjugateQuaternion, "position"),
        (Solver::RealPartLast, "position"),
        (Solver::QuaternionNotNormalised, "attitude"),
    ];
    let on = |body: Body, list: &[(Solver, &'static str)]| {
        list.iter()
            .map(|&(fault, check)| (body, fault, check))
            .collect::<Vec<_>>()
    };
    [
        on(Body::Planar, &both),
        on(Body::Planar, &planar),
        on(Body::Spatial, &both),
        on(Body::Spatial, &spatial),
    ]
    .concat()
}

/// Faults of the protocol, on the model that has what they concern.
fn of_protocol() -> Vec<(&'static str, Protocol, &'static str)> {
    let planar = "planar-body";
    let oscillator = "oscillator";
    vec![
        (planar, Protocol::RepeatedStepsTwice, "repeats"),
        (planar, Protocol::AnswersOtherContent, "repeats"),
        ("planar-multibody", Protocol::AnswersOtherContent, "repeats"),
        (planar, Protocol::TakesAnyNumber, "repeats"),
        (planar, Protocol::SnapshotPerRepeat, "repeats"),
        (planar, Protocol::OneSnapshot, "replay"),
        (planar, Protocol::ImportsNothing, "exported-states"),
        (planar, Protocol::ImportsDamaged, "exported-states"),
        (planar, Protocol::TakesUnknownOutputs, "refusals"),
        (planar, Protocol::TakesNaN, "refusals"),
        (planar, Protocol::CutsHighDegrees, "refusals"),
        (planar, Protocol::TakesZeroSteps, "refusals"),
        (planar, Protocol::DiesOfRefusals, "refusals"),
        (planar, Protocol::OwnOrderOfOutputs, "outputs"),
        (planar, Protocol::PerturbsTheNeighbour, "perturbed-steps"),
        (planar, Protocol::PerturbedBackwards, "perturbed-steps"),
        (oscillator, Protocol::DerivativesTimesStep, "directions"),
        (oscillator, Protocol::DirectionsAreConstant, "directions"),
        (oscillator, Protocol::NoFeedthrough, "directions"),
        (planar, Protocol::InteriorInterpolated, "instants"),
        (planar, Protocol::InteriorByOutput, "instants"),
        (planar, Protocol::InstantsFromTheEnd, "instants"),
        (planar, Protocol::IntegralsTimesStep, "integrals"),
        (planar, Protocol::IntegralsNotFromZero, "integrals"),
        (planar, Protocol::IntegralsWrongWeight, "integrals"),
        (planar, Protocol::JointLoadOtherEnd, "joint-loads"),
        (planar, Protocol::JointLoadWithoutMoment, "joint-loads"),
        (planar, Protocol::PredictionMoves, "exchange"),
        (planar, Protocol::KeepsNoWayBack, "exchange"),
        (planar, Protocol::PerturbedMissing, "exchange"),
        (planar, Protocol::EvaluatesLater, "exchange"),
        (planar, Protocol::SamplesAtTheEnd, "exchange"),
        (planar, Protocol::OneInstancePerStream, "parallel"),
        (planar, Protocol::MixesInstances, "parallel"),
        (planar, Protocol::ZeroTolerance, "description"),
        (planar, Protocol::LongMarker, "description"),
        (planar, Protocol::TwiceTheName, "description"),
    ]
}

#[test]
fn planted_faults_of_solvers_are_found() {
    let mut missed = Vec::new();
    for (body, fault, check) in of_solvers() {
        let worker = faulty_body(body, fault);
        let name = format!("{body:?} {fault:?}");
        look_for(
            &name,
            worker,
            &crate::faults::body(body),
            check,
            &mut missed,
        );
    }
    assert!(
        missed.is_empty(),
        "{} missed\n{}",
        missed.len(),
        missed.join("\n")
    );
}

#[test]
fn planted_faults_of_the_protocol_are_found() {
    let mut missed = Vec::new();
    for (model, fault, check) in of_protocol() {
        let settings = match model {
            "oscillator" => {
                let parameters = json!({"m": 2.0, "c": 1000.0, "d": 10.0, "v0": 1.0, "partner_stiffness": 100.0});
                settings(model, &parameters, "exact", &[1e-3])
            }
            "planar-multibody" => settings(model, &undriven(), "rk4 step=1e-4", &[1e-3]),
            _ => body(Body::Planar),
        };
        let worker = Arc::new(protocol::Faulty::new(built_in(), fault));
        look_for(&format!("{fault:?}"), worker, &settings, check, &mut missed);
    }
    assert!(
        missed.is_empty(),
        "{} missed\n{}",
        missed.len(),
        missed.join("\n")
    );
}

#[test]
fn the_wrappers_themselves_are_not_accused() {
    for body in [Body::Planar, Body::Spatial] {
        let worker = faulty_body(body, Solver::None);
        let report = examine(worker, &crate::faults::body(body));
        assert!(report.is_sound(), "{report}");
        let worker = Arc::new(protocol::Faulty::new(built_in(), Protocol::None));
        let report = examine(worker, &crate::faults::body(body));
        assert!(report.is_sound(), "{report}");
    }
}

#[test]
fn a_worker_with_useless_answers_gets_no_report() {
    let worker = protocol::Faulty::new(built_in(), Protocol::ForgetsAnOutput);
    let error = run(&InProcess(Arc::new(worker)), &body(Body::Planar), &|_| ()).unwrap_err();
    let text = error.to_string();
    assert!(text.contains("24 values where 25"), "{text}");
}

#[test]
fn a_refusal_as_a_fatal_failure_is_a_warning() {
    let worker = Arc::new(protocol::Faulty::new(built_in(), Protocol::RefusesAsFatal));
    let report = examine(worker, &body(Body::Planar));
    assert!(report.names(Grade::Warn).contains(&"refusals"), "{report}");
}

/// A built-in body with a fault, behind the SDK.
fn faulty_body(body: Body, fault: Solver) -> Arc<dyn Contract> {
    let inner: Box<dyn Model> = match body {
        Body::Planar => Box::new(PlanarBody),
        Body::Spatial => Box::new(SpatialBody),
    };
    let faulty = solver::Faulty::new(inner, body, fault);
    Arc::new(Host::new(vec![Box::new(faulty)]))
}

fn look_for(
    name: &str,
    worker: Arc<dyn Contract>,
    settings: &Settings,
    check: &str,
    missed: &mut Vec<String>,
) {
    let report: Report = examine(worker, settings);
    let found = report.names(Grade::Fail);
    println!("{name:<34}{}", found.join(" "));
    if !found.contains(&check) {
        missed.push(format!("{name} by {check}\n{report}"));
    }
}
