//! Instances whose first input is a load, requests to them, and the two routes that these take.

use std::sync::Arc;

use linchpin_master::connection::UnaryTurns;
use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{self, value::Kind};
use linchpin_tests::scripted::Scripted;

use crate::driver::{Driver, number, oscillator, tank, through};
use crate::peer::{Peer, Serve, host};

/// Length of a macro step (s).
pub const STEP: f64 = 1.7e-3;

/// A name for messages, and the request with which an instance starts.
pub type Subject = (&'static str, v1::InitializeRequest);

/// The subjects whose models a worker has.
pub fn subjects(serve: Serve) -> Vec<Subject> {
    let described = serve(host())
        .calls()
        .describe(&v1::DescribeRequest::default());
    let models = described.unwrap().models;
    let is_there = |name: &str| models.iter().any(|model| model.name == name);
    let mut subjects = all_subjects();
    subjects.retain(|(_, request)| is_there(&request.model));
    subjects
}

/// Exact, adaptive and fixed steps, minimal and absolute coordinates.
pub fn all_subjects() -> Vec<Subject> {
    vec![
        ("exact oscillator", oscillator(5, "exact")),
        ("adaptive oscillator", oscillator(5, "radau5")),
        ("oscillator with fixed steps", oscillator(5, "rk4")),
        ("pendulum in minimal coordinates", pendulum("minimal")),
        ("pendulum in absolute coordinates", pendulum("absolute")),
        ("tank", tank(5)),
    ]
}

/// A link on a hinge, as multibody model with the default solver; a force acts on its centre.
fn pendulum(formulation: &str) -> v1::InitializeRequest {
    let text = |text: &str| v1::Value {
        kind: Some(Kind::Text(text.into())),
    };
    let list = |values: &[f64]| v1::Value {
        kind: Some(Kind::Numbers(v1::NumberList {
            values: values.to_vec(),
        })),
    };
    let parameters = [
        ("formulation", text(formulation)),
        ("gravity", list(&[0.7, -9.3])),
        ("body.link.m", number(1.3)),
        ("body.link.inertia", number(0.17)),
        ("body.link.position", list(&[0.6, -0.8])),
        ("body.link.angle", number(0.3)),
        ("joint.hinge.kind", text("revolute")),
        ("joint.hinge.a", text("ground")),
        ("joint.hinge.b", text("link")),
        ("joint.hinge.point", list(&[0.0, 0.0])),
        ("marker.link.body", text("link")),
    ];
    v1::InitializeRequest {
        model: "planar-multibody".into(),
        parameters: parameters.map(|(name, value)| (name.into(), value)).into(),
        solver: None,
        inputs: vec!["link_fx".into()],
        coupling_outputs: vec!["link_x".into(), "link_vy".into()],
        recorded_outputs: vec!["link_ax".into()],
        ..oscillator(5, "radau5")
    }
}

/// How an exchange is carried out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Route {
    /// As one call (over gRPC: on the stream).
    Exchange,
    /// As unary calls.
    Unary,
}

pub const ROUTES: [Route; 2] = [Route::Exchange, Route::Unary];

impl Route {
    /// An instance of its own. `number` tells it from others on this route.
    pub fn drive(self, peer: &Peer, request: &v1::InitializeRequest, number: u64) -> Driver {
        let (calls, first): (Arc<dyn Contract>, u64) = match self {
            Self::Exchange => (peer.calls(), 100),
            Self::Unary => {
                let calls = Scripted::new(peer.calls());
                (Arc::new(UnaryTurns::new(calls)), 200)
            }
        };
        let request = v1::InitializeRequest {
            instance: first + number,
            ..request.clone()
        };
        Driver::initialize(calls, &request)
    }
}

/// A load that is not constant over the step, `end` at its end.
pub fn load(end: f64) -> v1::Signal {
    through(0, &[(STEP, end), (0.0, -17.9), (-STEP, 230.7)])
}

/// The macro step number `number` under a load.
pub fn advance(number: u32, end: f64) -> v1::Advance {
    v1::Advance {
        t: f64::from(number) * STEP,
        step: STEP,
        signals: vec![load(end)],
        ..v1::Advance::default()
    }
}

/// A look over the macro step number `number`, also with another load.
pub fn predict(number: u32, end: f64) -> v1::Predict {
    v1::Predict {
        t: f64::from(number) * STEP,
        step: STEP,
        signals: vec![load(end)],
        perturbed: vec![load(end + 0.1)],
        ..v1::Predict::default()
    }
}

/// An evaluation at the start of the macro step number `number`, also with another load.
pub fn evaluate(number: u32, end: f64) -> v1::Predict {
    v1::Predict {
        step: 0.0,
        signals: vec![through(0, &[(0.0, end)])],
        perturbed: vec![through(0, &[(0.0, end + 0.1)])],
        ..predict(number, end)
    }
}

/// All numbers of an answer with their places.
pub fn bits(reply: &v1::ExchangeReply) -> Vec<(&'static str, Vec<u64>)> {
    let one = |name, outputs: &Option<v1::Outputs>| (name, outputs.iter().cloned().collect());
    let lists: [(&'static str, Vec<v1::Outputs>); 8] = [
        one("advanced", &reply.advanced),
        one("evaluated", &reply.evaluated),
        one("predicted", &reply.predicted),
        ("samples", reply.samples.clone()),
        ("perturbed", reply.perturbed.clone()),
        ("derivatives", reply.derivatives.clone()),
        ("evaluated_perturbed", reply.evaluated_perturbed.clone()),
        ("evaluated_derivatives", reply.evaluated_derivatives.clone()),
    ];
    let numbers = lists.into_iter().flat_map(|(name, list)| {
        let bits = |outputs: v1::Outputs| outputs.values.into_iter().map(f64::to_bits).collect();
        list.into_iter().map(move |outputs| (name, bits(outputs)))
    });
    numbers.collect()
}
