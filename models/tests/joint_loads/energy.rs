//! With a constant multiplier and a partner at rest, a joint load has the potential `-lambda g`.

use linchpin_proto::joint_load::Pose;
use nalgebra::Vector3;

use crate::bodies::{BODIES, Body, SOLVERS};
use crate::common::Solver;
use crate::joint::{Joint, Partner, Space, all_joints, pose, pose_outputs};
use crate::run::Run;

const MULTIPLIER: f64 = 6.7;

fn partner(space: Space) -> Partner {
    let turn: fn(f64) -> Vector3<f64> = match space {
        Space::Planar => |_| Vector3::new(0.0, 0.0, 0.7),
        Space::Spatial => |_| Vector3::new(0.4, 0.7, -0.2),
    };
    Partner {
        space,
        position: |_| Vector3::new(0.4, -0.2, 0.3),
        turn,
        reference: match space {
            Space::Planar => [1.0, 0.0, 0.0, 0.0],
            Space::Spatial => [0.3, 0.5, -0.2, 0.7],
        },
    }
}

/// Largest change of the energy of a body and its joints over a hundred steps, over the largest change of the body's.
fn drift(body: Body, joints: &[Joint], solver: Solver) -> f64 {
    let partner = partner(body.space);
    let mut run = Run::new(body.case, &[], solver, partner.request(joints));
    let energies = |run: &Run| {
        partner.signals(
            |_| MULTIPLIER,
            |signals| {
                let [own] = run.read_all(signals, ["energy"]);
                let condition = |joint: &Joint| {
                    let outputs = pose_outputs(body.space, joint.marker);
                    let marker: Pose = pose(&run.read(signals, &outputs));
                    joint.condition(&marker, &partner.pose(0.0))
                };
                (
                    own,
                    own - MULTIPLIER * joints.iter().map(condition).sum::<f64>(),
                )
            },
        )
    };
    let (start, conserved) = energies(&run);
    let (mut largest, mut exchanged): (f64, f64) = (0.0, 0.0);
    for _ in 0..100 {
        partner.signals(|_| MULTIPLIER, |signals| run.step(0.013, signals));
        let (own, total) = energies(&run);
        largest = largest.max((total - conserved).abs());
        exchanged = exchanged.max((own - start).abs());
    }
    assert!(exchanged > 0.1, "the loads did no work: {exchanged} J");
    largest / exchanged
}

#[test]
fn every_joint_load_keeps_the_energy_with_its_potential() {
    for body in BODIES {
        let markers = body.markers.iter();
        for joint in markers.flat_map(|marker| all_joints(body.space, marker)) {
            for solver in SOLVERS {
                let drift = drift(body, &[joint], solver);
                assert!(
                    drift < 1e-10,
                    "{} {joint:?} {solver:?}: {drift:e}",
                    body.case.model
                );
            }
        }
    }
}

#[test]
fn loads_at_one_marker_and_at_several_add_up() {
    for body in BODIES {
        let markers = body.markers.iter();
        let joints = markers.flat_map(|marker| all_joints(body.space, marker));
        let joints: Vec<Joint> = joints.collect();
        for solver in SOLVERS {
            let drift = drift(body, &joints, solver);
            println!("{} {solver:?}: {drift:.1e}", body.case.model);
            assert!(drift < 1e-10, "{} {solver:?}: {drift:e}", body.case.model);
        }
    }
}
