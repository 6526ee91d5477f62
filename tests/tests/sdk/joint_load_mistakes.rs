//! Joint loads that cannot be evaluated are refused when the instance is made.

use linchpin_proto::contract::Contract;
use linchpin_proto::joint_load::{End, JointLaw, Law};
use linchpin_proto::v1;
use nalgebra::Vector3;

use crate::all_ways;
use crate::driver::{assert_misuse, failure, oscillator, tank};
use crate::joint_loads::stand;
use crate::peer::{Serve, host};
use crate::stand::{at_pose, named};

all_ways!(
    models_without_the_capability_say_what_to_do,
    wrong_laws_are_named,
    wrong_places_are_named,
    markers_that_do_not_fit_are_named,
    markers_need_no_more_than_the_load_does,
    nothing_in_the_plane_points_out_of_it,
    joint_inputs_have_one_name_each,
);

fn check(serve: Serve, cases: &[(v1::InitializeRequest, &str, &[&str])]) {
    let peer = serve(host());
    for (request, field, words) in cases {
        assert_misuse(failure(peer.calls().initialize(request)), field, words);
    }
    peer.calls().initialize(&stand(5)).unwrap();
}

/// The load of the stand with a change, behind one that is right.
fn changed(change: impl FnOnce(&mut v1::JointLoad)) -> v1::InitializeRequest {
    let mut request = stand(5);
    let mut load = request.joint_loads[0].clone();
    change(&mut load);
    request.joint_loads.push(load);
    request
}

fn models_without_the_capability_say_what_to_do(serve: Serve) {
    let words = ["joint_loads", "forces and moments"];
    let load = v1::InitializeRequest {
        joint_loads: vec![v1::JointLoad::default()],
        ..oscillator(5, "exact")
    };
    let input = v1::InitializeRequest {
        joint_inputs: named(&["lambda"]),
        ..tank(5)
    };
    check(
        serve,
        &[
            (load, "joint_loads", &[&words[..], &["oscillator"]].concat()),
            (input, "joint_inputs", &[&words[..], &["tank"]].concat()),
        ],
    );
}

fn wrong_laws_are_named(serve: Serve) {
    check(
        serve,
        &[
            (
                changed(|load| load.law = 9),
                "joint_loads[1].law",
                &["law 9", "2 (inplane)"],
            ),
            (
                changed(|load| load.end = 0),
                "joint_loads[1].end",
                &["end 0", "1 (a) and 2 (b)"],
            ),
            (
                changed(|load| load.axis_b = vec![0.0, 0.5, 0.0]),
                "joint_loads[1].axis_b",
                &["joint_loads[1]", "length 0.5", "unit vector"],
            ),
            (
                changed(|load| load.point_a = vec![0.0, 0.5]),
                "joint_loads[1].point_a",
                &["joint_loads[1]", "point_a", "three finite numbers"],
            ),
        ],
    );
}

fn wrong_places_are_named(serve: Serve) {
    let spatial = |change: fn(&mut v1::JointLoad)| {
        let mut request = changed(|load| load.partner_position = vec![2, 3, 4]);
        request.joint_loads.remove(0);
        let load = &mut request.joint_loads[0];
        load.partner_rotation = vec![3, 4, 5];
        load.partner_attitude = vec![2, 3, 4, 5];
        change(load);
        v1::InitializeRequest {
            parameters: at_pose("spatial", &[0.3, -0.7, 0.2, 1.0, 0.0, 0.0, 0.0]),
            inputs: named(&["mz", "fx"]),
            coupling_outputs: Vec::new(),
            recorded_outputs: Vec::new(),
            ..request
        }
    };
    failure(host().initialize(&spatial(|_| ()))).unwrap();
    check(
        serve,
        &[
            (
                changed(|load| load.multiplier = 6),
                "joint_loads[1].multiplier",
                &["no signal 6", "list 6"],
            ),
            (
                changed(|load| load.partner_rotation = vec![17]),
                "joint_loads[1].partner_rotation",
                &["no signal 17"],
            ),
            (
                changed(|load| load.partner_position = vec![3]),
                "joint_loads[1].partner_position",
                &["the length 1", "needs 2"],
            ),
            (
                changed(|load| load.partner_position.clear()),
                "joint_loads[1].partner_position",
                &["the length 0", "needs 2"],
            ),
            (
                changed(|load| load.partner_rotation = vec![3, 4, 5]),
                "joint_loads[1].partner_rotation",
                &["the length 3", "needs 1"],
            ),
            (
                changed(|load| load.partner_attitude = vec![2, 3, 4, 5]),
                "joint_loads[1].partner_attitude",
                &["the length 4", "must be empty", "planar"],
            ),
            (
                changed(|load| {
                    load.end = v1::JointEnd::A.into();
                    load.partner_position.push(5);
                }),
                "joint_loads[1].partner_position",
                &["the length 3", "2 or none"],
            ),
            (
                spatial(|load| load.partner_position.truncate(2)),
                "joint_loads[0].partner_position",
                &["the length 2", "needs 3"],
            ),
            (
                spatial(|load| load.partner_rotation.truncate(1)),
                "joint_loads[0].partner_rotation",
                &["the length 1", "needs 3"],
            ),
            (
                spatial(|load| load.partner_attitude.clear()),
                "joint_loads[0].partner_attitude",
                &["the length 0", "needs 4"],
            ),
        ],
    );
}

/// A stand with another marker, and a load of a law with the joint's point at the marker or off it.
fn on_marker(
    marker: &str,
    pose: &[f64],
    law: Law,
    end: End,
    is_offset: bool,
) -> v1::InitializeRequest {
    let point = match is_offset {
        true => Vector3::new(0.4, 0.25, 0.0),
        false => Vector3::zeros(),
    };
    let law = JointLaw {
        law,
        points: [point; 2],
    };
    let (position, rotation, attitude) = match marker.starts_with("spatial") {
        true => (vec![1, 2, 3], vec![1, 2, 3], vec![0, 1, 2, 3]),
        false => (vec![1, 2], vec![3], Vec::new()),
    };
    let load = v1::JointLoad {
        multiplier: 0,
        partner_position: position,
        partner_rotation: rotation,
        partner_attitude: attitude,
        ..law.to_message("foot", end)
    };
    v1::InitializeRequest {
        parameters: at_pose(marker, pose),
        inputs: Vec::new(),
        coupling_outputs: Vec::new(),
        recorded_outputs: Vec::new(),
        joint_loads: vec![load],
        ..stand(5)
    }
}

const ALONG: Law = Law::AtPoint {
    direction: Vector3::new(0.6, 0.8, 0.0),
};
const PLANE: Law = Law::InPlane {
    normal: Vector3::new(0.6, 0.8, 0.0),
};
const AXES: Law = Law::Perpendicular {
    axes: [Vector3::new(0.6, 0.8, 0.0), Vector3::new(1.0, 0.0, 0.0)],
};

fn markers_that_do_not_fit_are_named(serve: Serve) {
    let cases = [
        (
            "planar-point",
            2,
            ALONG,
            End::A,
            true,
            ["position", "the length 2"],
        ),
        (
            "planar-point",
            2,
            PLANE,
            End::B,
            false,
            ["position", "needs 3"],
        ),
        (
            "planar-point",
            2,
            AXES,
            End::A,
            false,
            ["position", "needs 3"],
        ),
        ("planar-pushed", 3, ALONG, End::B, true, ["load", "needs 3"]),
        (
            "planar-pushed",
            3,
            PLANE,
            End::B,
            false,
            ["load", "needs 3"],
        ),
        (
            "planar-watched",
            3,
            PLANE,
            End::A,
            false,
            ["load", "needs 2"],
        ),
        (
            "placeless",
            0,
            PLANE,
            End::B,
            false,
            ["position", "needs 2"],
        ),
        (
            "spatial-point",
            3,
            AXES,
            End::B,
            false,
            ["position", "needs 7"],
        ),
        (
            "spatial-point",
            3,
            PLANE,
            End::A,
            true,
            ["position", "needs 7"],
        ),
        (
            "spatial-pushed",
            7,
            ALONG,
            End::A,
            true,
            ["load", "needs 6"],
        ),
        (
            "scalar",
            1,
            ALONG,
            End::A,
            false,
            ["planar nor spatial", "foot"],
        ),
    ];
    let cases = cases.map(|(marker, components, law, end, is_offset, words)| {
        let request = on_marker(marker, &vec![0.5; components], law, end, is_offset);
        (request, "joint_loads[0].marker", words)
    });
    let mut cases: Vec<_> = { cases.iter() }
        .map(|(request, field, words)| (request.clone(), *field, &words[..]))
        .collect();
    let unknown = changed(|load| load.marker = "hand".into());
    cases.push((unknown, "joint_loads[1].marker", &["hand", "it has: foot"]));
    check(serve, &cases);
}

fn markers_need_no_more_than_the_load_does(serve: Serve) {
    let peer = serve(host());
    let cases = [
        ("planar-point", 2, ALONG, End::A, false),
        ("planar-point", 2, PLANE, End::A, false),
        ("planar-pushed", 3, ALONG, End::B, false),
        ("planar-pushed", 3, PLANE, End::A, false),
        ("placeless", 0, ALONG, End::B, false),
        ("spatial-point", 3, PLANE, End::A, false),
        ("spatial-pushed", 7, ALONG, End::B, false),
    ];
    for (instance, (marker, components, law, end, is_offset)) in (5..).zip(cases) {
        let request = v1::InitializeRequest {
            instance,
            ..on_marker(marker, &vec![0.5; components], law, end, is_offset)
        };
        failure(peer.calls().initialize(&request)).unwrap();
    }
}

fn nothing_in_the_plane_points_out_of_it(serve: Serve) {
    let out = |field: &str| format!("joint_loads[1].{field}");
    let words: &[&str] = &["0.7", "planar", "must be 0"];
    let normal = vec![(1.0f64 - 0.49).sqrt(), 0.0, 0.7];
    check(
        serve,
        &[
            (
                changed(|load| load.point_a[2] = 0.7),
                &out("point_a"),
                words,
            ),
            (
                changed(|load| load.point_b[2] = 0.7),
                &out("point_b"),
                words,
            ),
            (
                changed(|load| load.axis_b = normal.clone()),
                &out("axis_b"),
                words,
            ),
            (
                changed(|load| {
                    load.law = v1::JointLaw::Perpendicular.into();
                    load.axis_a = normal;
                }),
                &out("axis_a"),
                words,
            ),
        ],
    );
}

fn joint_inputs_have_one_name_each(serve: Serve) {
    let mut twice = stand(5);
    twice.joint_inputs[3] = "lambda".into();
    check(serve, &[(twice, "joint_inputs", &["lambda", "twice"])]);
}
