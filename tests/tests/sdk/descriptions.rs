//! Descriptions that depend on parameters, and parameters that are no numbers.

use std::collections::BTreeMap;

use linchpin_proto::contract::Contract;
use linchpin_proto::v1::{self, value::Kind};

use crate::both_ways;
use crate::driver::{assert_misuse, failure, number};
use crate::in_python;
use crate::joint_loads::stand;
use crate::peer::{Serve, host};
use crate::stand::at_pose;

both_ways!(
    a_named_model_is_described_with_its_parameters,
    mistakes_in_a_description_are_named,
    texts_and_lists_are_checked,
    an_instance_has_the_variables_of_its_parameters,
);

in_python!(
    texts_and_lists_are_checked,
    an_instance_has_the_variables_of_its_parameters,
);

fn describe(
    peer: &dyn Contract,
    model: &str,
    parameters: BTreeMap<String, v1::Value>,
) -> Result<v1::DescribeReply, v1::Failure> {
    failure(peer.describe(&v1::DescribeRequest {
        model: Some(model.into()),
        parameters,
        ..v1::DescribeRequest::default()
    }))
}

fn a_named_model_is_described_with_its_parameters(serve: Serve) {
    let peer = serve(host());
    let calls = peer.calls();
    for (marker, kind, outputs) in [
        ("planar", v1::MarkerKind::Planar, 9),
        ("spatial", v1::MarkerKind::Spatial, 19),
    ] {
        let reply = describe(&*calls, "stand", at_pose(marker, &[])).unwrap();
        let [model] = &reply.models[..] else {
            panic!("{} models", reply.models.len());
        };
        assert_eq!(model.name, "stand");
        assert_eq!(model.markers[0].kind(), kind);
        assert_eq!(model.outputs.len(), outputs);
        let capabilities = model.capabilities.unwrap();
        assert!(capabilities.exchange && capabilities.joint_loads);
    }
    // The same whatever the parameters are.
    let all = failure(calls.describe(&v1::DescribeRequest::default())).unwrap();
    let own = all.models.into_iter().find(|model| model.name == "tank");
    let tank = describe(&*calls, "tank", [("capacity".into(), number(1.0))].into());
    assert_eq!(tank.unwrap().models, [own.unwrap()]);
}

fn mistakes_in_a_description_are_named(serve: Serve) {
    let peer = serve(host());
    let calls = peer.calls();
    assert_misuse(
        describe(&*calls, "clockwork", BTreeMap::new()),
        "model",
        &["clockwork", "oscillator, pendulum, pi-controller"],
    );
    assert_misuse(
        describe(&*calls, "stand", BTreeMap::new()),
        "parameters.marker",
        &["missing"],
    );
    assert_misuse(
        describe(&*calls, "stand", at_pose("round", &[])),
        "parameters.marker",
        &["round", "planar, planar-point"],
    );
}

fn texts_and_lists_are_checked(serve: Serve) {
    let peer = serve(host());
    let check = |name: &str, kind: Option<Kind>, field: &str, words: &[&str]| {
        let mut request = stand(5);
        request.parameters.insert(name.into(), v1::Value { kind });
        assert_misuse(failure(peer.calls().initialize(&request)), field, words);
    };
    let list = |values: &[f64]| {
        Some(Kind::Numbers(v1::NumberList {
            values: values.to_vec(),
        }))
    };
    check(
        "marker",
        Some(Kind::Number(3.0)),
        "parameters.marker",
        &["a text"],
    );
    check("marker", None, "parameters.marker", &["a text"]);
    check(
        "pose",
        Some(Kind::Number(3.0)),
        "parameters.pose",
        &["a list of numbers"],
    );
    check(
        "pose",
        Some(Kind::Flag(true)),
        "parameters.pose",
        &["a list of numbers"],
    );
    check("pose", None, "parameters.pose", &["a list of numbers"]);
    check(
        "pose",
        list(&[0.3, f64::INFINITY, 1.1]),
        "parameters.pose[1]",
        &["inf", "finite"],
    );
    check(
        "pose",
        list(&[0.3]),
        "parameters.pose",
        &["as many numbers"],
    );
    let mut request = stand(5);
    request.parameters.remove("pose");
    let answer = failure(peer.calls().initialize(&request));
    assert_misuse(answer, "parameters.pose", &["missing"]);
}

fn an_instance_has_the_variables_of_its_parameters(serve: Serve) {
    let peer = serve(host());
    let request = v1::InitializeRequest {
        parameters: at_pose("spatial", &[0.0; 7]),
        ..stand(5)
    };
    let answer = failure(peer.calls().initialize(&request));
    assert_misuse(answer, "inputs", &["moment", "fx, fy, fz, mx"]);
}
