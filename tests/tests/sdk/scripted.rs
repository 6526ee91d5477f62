//! The peer that plays a script.

use std::sync::Arc;
use std::time::{Duration, Instant};

use linchpin_proto::contract::CallError;
use linchpin_proto::v1::{self, Failure, ProtocolVersion};
use linchpin_tests::scripted::{Act, Scripted};

use crate::both_ways;
use crate::driver::{Driver, constant, tank};
use crate::peer::{Serve, host};
use crate::tank::START;

both_ways!(
    every_act_comes_at_its_exchange,
    a_put_goes_to_the_advanced_outputs_first,
    it_speaks_what_it_is_told_and_can_lack_the_stream,
);

fn scripted() -> Scripted {
    Scripted::new(host())
}

fn look() -> Option<v1::Predict> {
    let signals = vec![constant(0, 1.0), constant(1, 0.0)];
    Some(v1::Predict {
        step: 0.5,
        signals,
        ..v1::Predict::default()
    })
}

fn every_act_comes_at_its_exchange(serve: Serve) {
    let broken = Failure::recoverable(0.25, 0.5, "the pump stalls");
    let script = scripted()
        .at_exchange(1, Act::Fail(broken.clone()))
        .at_exchange(
            2,
            Act::Put {
                output: 1,
                value: f64::NEG_INFINITY,
            },
        )
        .at_exchange(3, Act::ForgetOutput)
        .at_exchange(4, Act::Wait(Duration::from_millis(80)));
    let peer = serve(Arc::new(script));
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let mut predicted = || {
        driver
            .exchange(None, look())
            .map(|reply| reply.predicted.unwrap().values)
    };
    let truth = [START + 0.5, 1.0];
    assert_eq!(predicted().unwrap(), truth);
    assert_eq!(predicted().unwrap_err(), broken);
    // The failure came from the script: the worker itself did not see that number.
    let skipped = predicted().unwrap_err();
    assert_eq!(skipped.field.as_deref(), Some("sequence"));
    driver.sequence = crate::driver::FIRST + 1;
    let mut predicted = || {
        driver
            .exchange(None, look())
            .map(|reply| reply.predicted.unwrap().values)
    };
    assert_eq!(predicted().unwrap(), truth[..1]);
    let started = Instant::now();
    assert_eq!(predicted().unwrap(), truth);
    assert!(started.elapsed() >= Duration::from_millis(80));
}

fn a_put_goes_to_the_advanced_outputs_first(serve: Serve) {
    let put = Act::Put {
        output: 0,
        value: f64::NAN,
    };
    let peer = serve(Arc::new(
        scripted().at_exchange(0, put.clone()).at_exchange(1, put),
    ));
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    let v1::Predict {
        t, step, signals, ..
    } = look().unwrap();
    let reply = driver
        .exchange(
            Some(v1::Advance {
                t,
                step,
                signals,
                ..v1::Advance::default()
            }),
            look(),
        )
        .unwrap();
    assert!(reply.advanced.unwrap().values[0].is_nan());
    assert_eq!(reply.predicted.unwrap().values[0], START + 1.0);
    let reply = driver.exchange(None, look()).unwrap();
    assert!(reply.predicted.unwrap().values[0].is_nan());
    assert_eq!(driver.level(), START + 0.5);
}

fn it_speaks_what_it_is_told_and_can_lack_the_stream(serve: Serve) {
    let spoken = ProtocolVersion { major: 3, minor: 2 };
    let peer = serve(Arc::new(scripted().speaking(spoken).only_unary()));
    let described = peer
        .calls()
        .describe(&v1::DescribeRequest::default())
        .unwrap();
    assert_eq!(described.protocol, Some(spoken));
    assert!(
        described
            .models
            .iter()
            .all(|model| !model.capabilities.unwrap().exchange)
    );
    let mut driver = Driver::initialize(peer.calls(), &tank(5));
    driver.step(0.0, 0.5, vec![constant(0, 1.0)]).unwrap();
    let request = driver.exchange_request(None, None);
    let error = driver
        .calls
        .exchange(&request, &mut v1::ExchangeReply::default())
        .unwrap_err();
    assert!(
        matches!(error, CallError::Unimplemented { .. }),
        "{error:?}"
    );
}
