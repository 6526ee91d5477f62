//! Describe and Initialize.

use linchpin_proto::v1::{self, ProtocolVersion, value::Kind};
use linchpin_proto::version::PROTOCOL;

use crate::both_ways;
use crate::driver::{Driver, assert_misuse, constant, failure, number, oscillator, tank};
use crate::in_python;
use crate::peer::{Serve, host};

both_ways!(
    describe_names_models_and_capabilities,
    another_major_version_is_refused_and_both_are_named,
    mistakes_are_named_and_leave_nothing_behind,
    defaults_of_the_description_are_used,
);

in_python!(
    another_major_version_is_refused_and_both_are_named,
    mistakes_are_named_and_leave_nothing_behind,
    defaults_of_the_description_are_used,
);

fn describe_names_models_and_capabilities(serve: Serve) {
    let peer = serve(host());
    let theirs = ProtocolVersion { major: 7, minor: 1 };
    let reply = peer
        .calls()
        .describe(&v1::DescribeRequest {
            protocol: Some(theirs),
            ..Default::default()
        })
        .unwrap();
    assert_eq!(reply.protocol, Some(PROTOCOL));
    let names: Vec<&str> = reply
        .models
        .iter()
        .map(|model| model.name.as_str())
        .collect();
    assert_eq!(
        names,
        [
            "block",
            "bouncing-ball",
            "dc-motor",
            "ground",
            "mass-chain",
            "oscillator",
            "pendulum",
            "pi-controller",
            "planar-body",
            "planar-multibody",
            "rod-slider",
            "slider-crank",
            "spatial-body",
            "spatial-multibody",
            "stand",
            "tank",
            "woodpecker"
        ]
    );
    // Loads that turn with their bodies are the master's to evaluate.
    let nonsmooth = [
        "block",
        "bouncing-ball",
        "mass-chain",
        "rod-slider",
        "slider-crank",
        "woodpecker",
    ];
    let without_joint_loads = [&nonsmooth[..], &["oscillator", "pi-controller", "tank"]].concat();
    for model in &reply.models {
        let repeats_step_sequence = !["stand", "tank"].contains(&model.name.as_str());
        let impacts = nonsmooth.contains(&model.name.as_str()) && model.name != "mass-chain";
        let expected = v1::Capabilities {
            exchange: true,
            repeats_step_sequence,
            max_input_degree: Some(7),
            exportable_snapshot: repeats_step_sequence,
            joint_loads: !without_joint_loads.contains(&model.name.as_str()),
            directional_derivatives: ["oscillator", "pi-controller"].contains(&model.name.as_str()),
            interior_outputs: true,
            output_integrals: ![&nonsmooth[..], &["stand", "tank"]]
                .concat()
                .contains(&model.name.as_str()),
            // A chain has a wall only if its parameters say so.
            impulses: !impacts && !["stand", "tank"].contains(&model.name.as_str()),
            impacts,
        };
        assert_eq!(model.capabilities, Some(expected), "{}", model.name);
    }
}

fn another_major_version_is_refused_and_both_are_named(serve: Serve) {
    let peer = serve(host());
    let with = |protocol| v1::InitializeRequest {
        protocol,
        ..tank(5)
    };
    for (theirs, shown) in [
        (Some(ProtocolVersion { major: 2, minor: 3 }), "2.3"),
        (Some(ProtocolVersion { major: 0, minor: 9 }), "0.9"),
        (None, "no version"),
    ] {
        let ours = format!("{}.{}", PROTOCOL.major, PROTOCOL.minor);
        let answer = failure(peer.calls().initialize(&with(theirs)));
        assert_misuse(answer, "protocol", &[&ours, shown]);
    }
    let newer = ProtocolVersion {
        minor: PROTOCOL.minor + 4,
        ..PROTOCOL
    };
    peer.calls().initialize(&with(Some(newer))).unwrap();
}

fn mistakes_are_named_and_leave_nothing_behind(serve: Serve) {
    let peer = serve(host());
    let good = oscillator(5, "exact");
    let check = |change: &dyn Fn(&mut v1::InitializeRequest), field: &str, words: &[&str]| {
        let mut request = good.clone();
        change(&mut request);
        assert_misuse(failure(peer.calls().initialize(&request)), field, words);
    };
    let set = |name: &'static str, value: v1::Value| {
        move |request: &mut v1::InitializeRequest| {
            request.parameters.insert(name.into(), value.clone());
        }
    };
    let text = v1::Value {
        kind: Some(Kind::Text("heavy".into())),
    };
    let solver = |kind: &'static str, option: &'static [(&'static str, f64)]| {
        move |request: &mut v1::InitializeRequest| {
            let options = option
                .iter()
                .map(|&(name, value)| (name.into(), number(value)));
            request.solver = Some(v1::Solver {
                kind: kind.into(),
                options: options.collect(),
            });
        }
    };
    check(
        &|request| request.model = "clockwork".into(),
        "model",
        &["clockwork", "oscillator"],
    );
    check(&set("mass", number(1.0)), "parameters.mass", &["m, c, d"]);
    check(
        &set("m", number(-1.25)),
        "parameters.m",
        &["-1.25", "greater than 0"],
    );
    check(
        &set("c", number(f64::NAN)),
        "parameters.c",
        &["NaN", "finite"],
    );
    check(&set("d", text), "parameters.d", &["a number"]);
    check(
        &set("d", v1::Value { kind: None }),
        "parameters.d",
        &["a number"],
    );
    check(
        &|request| drop(request.parameters.remove("m")),
        "parameters.m",
        &["missing"],
    );
    check(
        &solver("euler", &[]),
        "solver.kind",
        &["euler", "exact, radau5, rk4"],
    );
    check(
        &solver("radau5", &[("rtoll", 1e-8)]),
        "solver.rtoll",
        &["rtol, atol"],
    );
    check(
        &solver("radau5", &[("atol", 0.0)]),
        "solver.atol",
        &["0", "greater than 0"],
    );
    check(&solver("rk4", &[]), "solver.step", &["missing"]);
    check(
        &|request| request.t_start = f64::NEG_INFINITY,
        "t_start",
        &["-inf", "finite"],
    );
    check(
        &|request| request.inputs.push("force".into()),
        "inputs",
        &["force", "f, partner_x"],
    );
    check(
        &|request| request.inputs.push("f".into()),
        "inputs",
        &["f", "twice"],
    );
    check(
        &|request| request.coupling_outputs.push("y".into()),
        "coupling_outputs",
        &["y", "x, v, a"],
    );
    check(
        &|request| request.recorded_outputs.push("y".into()),
        "recorded_outputs",
        &["y", "x, v, a"],
    );
    let undriven = v1::InitializeRequest {
        inputs: vec!["leak".into()],
        ..tank(5)
    };
    assert_misuse(
        failure(peer.calls().initialize(&undriven)),
        "inputs",
        &["inflow", "driven"],
    );

    let driver = Driver {
        calls: peer.calls(),
        instance: 5,
        sequence: 0,
    };
    assert_misuse(
        driver.evaluate(vec![], &["x"]),
        "instance",
        &["0x5", "Initialize"],
    );
    peer.calls().initialize(&good).unwrap();
}

fn defaults_of_the_description_are_used(serve: Serve) {
    let peer = serve(host());
    let bare = v1::InitializeRequest {
        parameters: [("m".into(), number(2.0))].into(),
        solver: None,
        ..oscillator(5, "exact")
    };
    let driver = Driver::initialize(peer.calls(), &bare);
    let outputs = driver.evaluate(vec![constant(0, 3.0)], &["x", "v", "a"]);
    assert_eq!(outputs.unwrap(), [0.0, 0.0, 1.5]);
    let reply = peer.calls().initialize(&bare).unwrap();
    assert_eq!(reply.tolerance, None, "the default solver is the exact one");
}
