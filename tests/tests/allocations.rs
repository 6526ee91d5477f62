//! The macro step keeps its memory: once a run is under way it allocates nothing.

#![allow(clippy::unwrap_used)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use linchpin::connect::{Connector, Place};
use linchpin_master::CoSimulation;
use linchpin_master::scene::{Override, Scene, parse};
use linchpin_master::setup::Options;
use linchpin_proto::contract::Contract;
use linchpin_proto::v1;
use linchpin_proto::version::PROTOCOL;
use linchpin_tests::chain::scene_text;
use linchpin_worker::Host;

const SCENE: &str = include_str!("../../scenes/oscillator.toml");

/// Steps until all memory has been taken: histories are full, replies have gone around once.
const WARM_UP: usize = 20;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

// SAFETY: every call is passed on unchanged to the system's allocator.
#[allow(unsafe_code, reason = "an allocator cannot be written without")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations_per_100_steps(scene: &str, overrides: &[&str]) -> usize {
    let overrides: Vec<Override> = overrides.iter().map(|text| text.parse().unwrap()).collect();
    let scene = parse(scene, "scene.toml", &overrides).unwrap();
    let connector = Connector::new(Place::InProcess);
    let mut connect = |scene: &Scene, subsystem: &_| connector.connect(scene, subsystem);
    let mut simulation = CoSimulation::start(&scene, &mut connect, &Options::default()).unwrap();
    for _ in 0..WARM_UP {
        assert!(simulation.macro_step().unwrap());
    }
    let before = ALLOCATIONS.get();
    assert!(before > 0, "the counter does not count");
    for _ in 0..100 {
        assert!(simulation.macro_step().unwrap());
    }
    ALLOCATIONS.get() - before
}

#[test]
fn a_macro_step_allocates_nothing() {
    for method in [
        &["coupling.degree=0"][..],
        &[
            "coupling.method=weighted",
            "coupling.degree=1",
            "coupling.index=1",
            "coupling.jacobian=every-step",
            "coupling.tolerance=1e-8",
        ],
        &[
            "coupling.method=weighted",
            "coupling.index=1",
            "coupling.degree=automatic",
            "coupling.jacobian=every-step",
            "coupling.tolerance=1e-8",
            "coupling.macro_step=1e-4",
            "coupling.greatest_step=1e-4",
        ],
        &[
            "coupling.method=weighted",
            "coupling.index=1",
            "coupling.degree=automatic",
            "coupling.jacobian=every-step",
        ],
        &["coupling.method=hermite"],
        &[
            "coupling.method=hermite",
            "coupling.degree=3",
            "coupling.macro_step=5e-3",
            "scene.t_end=1",
        ],
        &["coupling.method=hermite", "coupling.jacobian=every-step"],
        &[
            "coupling.method=hermite",
            "coupling.jacobian=every-step",
            "coupling.tolerance=1e-10",
        ],
        &[
            "coupling.method=baumgarte",
            "coupling.index=1",
            "coupling.beta=2H",
            "coupling.gamma=H^2",
            "coupling.degree=3",
        ],
        &[
            "coupling.method=weighted",
            "coupling.index=1",
            "coupling.degree=2",
        ],
        &["coupling.method=explicit", "coupling.mu=1e-2"],
        &[
            "coupling.method=penalty",
            "coupling.stiffness=1e5",
            "coupling.damping=10",
        ],
        &[
            "coupling.method=penalty",
            "coupling.order=gauss-seidel",
            "coupling.stiffness=1e5",
            "coupling.degree=2",
        ],
    ] {
        assert_eq!(allocations_per_100_steps(SCENE, method), 0, "{method:?}");
    }
}

/// Also with a sparse coupling system, and whatever the number of links: here the solver keeps its memory as well. Columns that
/// come now and then have messages of their own, so they come in every step.
#[test]
fn a_macro_step_of_a_chain_allocates_nothing() {
    let solver = "subsystem.*.solver={ kind = \"rk4\", step = 1e-3 }";
    for links in [2, 16, 64] {
        let scene = scene_text(links);
        let settings = [solver, "coupling.jacobian=every-step"];
        assert_eq!(allocations_per_100_steps(&scene, &settings), 0, "{links}");
    }
}

/// Impacts and resting contacts included: 100 macro steps of the mechanism, rigid and flexible, alone and under control.
#[test]
fn a_macro_step_with_impacts_allocates_nothing() {
    let alone = include_str!("../../scenes/s2/slider-crank.toml");
    let flexible = [
        "subsystem.mechanism.parameters.elements=4",
        "subsystem.mechanism.solver={ kind = \"ed-alpha\", step = 1e-5 }",
    ];
    let moreau = ["subsystem.mechanism.solver={ kind = \"moreau\", step = 1e-5 }"];
    for overrides in [&[][..], &flexible, &moreau] {
        assert_eq!(
            allocations_per_100_steps(alone, overrides),
            0,
            "{overrides:?}"
        );
    }
    let controlled = include_str!("../../scenes/s2/speed-control.toml");
    let every_step = ["coupling.jacobian=every-step"];
    assert_eq!(allocations_per_100_steps(controlled, &every_step), 0);
}

/// An instance of a model under a joint load that reads all of its partner's pose.
fn joined(model: &str, signals: [&[u32]; 3], axis: [f64; 3]) -> v1::InitializeRequest {
    let number = |value| v1::Value {
        kind: Some(v1::value::Kind::Number(value)),
    };
    let table = |names: &[&str]| {
        names
            .iter()
            .map(|&name| (name.into(), number(0.7)))
            .collect()
    };
    let load = v1::JointLoad {
        marker: "end".into(),
        law: v1::JointLaw::Inplane.into(),
        end: v1::JointEnd::B.into(),
        point_a: vec![0.3, 0.2, 0.0],
        point_b: vec![0.0; 3],
        axis_b: axis.to_vec(),
        multiplier: 0,
        partner_position: signals[0].to_vec(),
        partner_rotation: signals[1].to_vec(),
        partner_attitude: signals[2].to_vec(),
        ..v1::JointLoad::default()
    };
    v1::InitializeRequest {
        instance: 1,
        protocol: Some(PROTOCOL),
        model: model.into(),
        parameters: match model {
            "planar-body" => table(&["m", "inertia", "length"]),
            _ => table(&["m", "j1", "j2", "j3"]),
        },
        solver: Some(v1::Solver {
            kind: "rk4".into(),
            options: [("step".into(), number(1e-3))].into(),
        }),
        coupling_outputs: vec!["end_x".into(), "end_ax".into()],
        integrated_outputs: vec!["end_x".into(), "end_ax".into()],
        joint_inputs: (0..11).map(|input| input.to_string()).collect(),
        joint_loads: vec![load],
        ..v1::InitializeRequest::default()
    }
}

/// Steps and looks ahead, also with a perturbed multiplier, as often as told; every second step is taken again.
fn exchange(host: &Host, request: &mut v1::ExchangeRequest, turns: usize) {
    let mut reply = v1::ExchangeReply::default();
    let mut before = 0;
    for turn in 0..WARM_UP + turns {
        if turn == WARM_UP {
            before = ALLOCATIONS.get();
        }
        request.sequence += 1;
        request.go_back = turn % 2 == 1;
        host.exchange(request, &mut reply).unwrap();
    }
    assert_eq!(ALLOCATIONS.get() - before, 0, "{request:?}");
}

#[test]
fn joint_loads_allocate_nothing() {
    let planar = joined("planar-body", [&[1, 2], &[3], &[]], [0.6, 0.8, 0.0]);
    let spatial = joined(
        "spatial-body",
        [&[1, 2, 3], &[4, 5, 6], &[7, 8, 9, 10]],
        [0.6, 0.0, 0.8],
    );
    for instance in [planar, spatial] {
        let host = Host::new(linchpin_models::models());
        host.initialize(&instance).unwrap();
        let signals: Vec<v1::Signal> = { 0..11 }
            .map(|input| v1::Signal {
                input,
                nodes: vec![1e-2, 0.0],
                values: vec![0.1 * f64::from(input), 0.3],
            })
            .collect();
        let look = v1::Predict {
            t: 1e-2,
            signals: signals.clone(),
            perturbed: signals[..2].to_vec(),
            ..v1::Predict::default()
        };
        let mut request = v1::ExchangeRequest {
            instance: 1,
            advance: Some(v1::Advance {
                impacts: None,
                t: 0.0,
                step: 1e-2,
                signals: signals.clone(),
                samples: vec![3e-3, 8e-3],
                instants: vec![2e-3, 7e-3],
                integrals: 3,
            }),
            predict: Some(v1::Predict {
                step: 1e-2,
                instants: vec![2e-3, 7e-3],
                integrals: 3,
                ..look.clone()
            }),
            evaluate: Some(look),
            ..v1::ExchangeRequest::default()
        };
        exchange(&host, &mut request, 100);
    }
}

#[test]
fn directional_derivatives_allocate_nothing() {
    let number = |value| v1::Value {
        kind: Some(v1::value::Kind::Number(value)),
    };
    let host = Host::new(linchpin_models::models());
    let instance = v1::InitializeRequest {
        instance: 1,
        protocol: Some(PROTOCOL),
        model: "oscillator".into(),
        parameters: [("m".into(), number(1.3)), ("c".into(), number(170.0))].into(),
        inputs: vec!["f".into(), "partner_x".into()],
        coupling_outputs: vec!["x".into(), "a".into()],
        interior_outputs: vec!["x".into()],
        integrated_outputs: vec!["x".into(), "v".into()],
        ..v1::InitializeRequest::default()
    };
    host.initialize(&instance).unwrap();
    let signals: Vec<v1::Signal> = { 0..2 }
        .map(|input| v1::Signal {
            input,
            nodes: vec![1e-2, 0.0],
            values: vec![0.1, 0.3],
        })
        .collect();
    let look = v1::Predict {
        t: 1e-2,
        directions: signals.clone(),
        signals: signals.clone(),
        ..v1::Predict::default()
    };
    let mut request = v1::ExchangeRequest {
        instance: 1,
        advance: Some(v1::Advance {
            impacts: None,
            step: 1e-2,
            signals,
            instants: vec![2e-3, 7e-3],
            integrals: 3,
            ..v1::Advance::default()
        }),
        predict: Some(v1::Predict {
            step: 1e-2,
            instants: vec![2e-3, 7e-3],
            integrals: 3,
            ..look.clone()
        }),
        evaluate: Some(look),
        ..v1::ExchangeRequest::default()
    };
    exchange(&host, &mut request, 100);
}
