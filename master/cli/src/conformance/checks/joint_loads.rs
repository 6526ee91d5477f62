//! Joint loads act as the same forces and moments do.

use linchpin_proto::joint_load::{End, JointLaw, Law, Pose, Wrench};
use linchpin_proto::v1::{self, MarkerKind};
use nalgebra::Vector3;

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::{Comparison, rounding};
use crate::conformance::inputs::Inputs;
use crate::conformance::instance::Instance;
use crate::conformance::measured::{LIMIT_SHARE, Limit, MOBILITY_SHARE, allowed, in_the_limit};
use crate::conformance::subject::Marker;
use crate::conformance::verdict::{Stop, Verdict};

/// Joint loads against the load inputs of their marker.
pub struct JointLoads;

/// A point of a joint away from its marker (m), in the marker's axes.
const POINT: [f64; 3] = [0.3, -0.2, 0.0];

/// The direction of an atpoint law, and its opposite side; unit vectors in the plane.
const DIRECTION: [f64; 3] = [0.6, 0.8, 0.0];

impl Check for JointLoads {
    fn about(&self) -> About {
        About {
            name: "joint-loads",
            title: "joint loads accelerate a marker as the same force and moment at its load inputs do",
            equation: "force d, moment T s x d at end a, the opposite at end b, for a multiplier of 1 under the law atpoint",
            tolerance: "1e-6 of the acceleration; over steps 1e-3 of the change of velocity, at the one of H, H/4, .. that misses it least",
            look_at: "the table of laws in docs/guide/own-worker.md: ends, signs, moments about the own marker, axes; and whether the right-hand \
                      side adds joint loads at every evaluation",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        if !bench.subject.capabilities.joint_loads {
            return Err(Stop::not_applicable(
                "the model evaluates no joint loads itself",
            ));
        }
        let takes = |marker: &&Marker| {
            let (position, load) = match marker.kind {
                MarkerKind::Planar => (3, 3),
                MarkerKind::Spatial => (7, 6),
                MarkerKind::Scalar | MarkerKind::Unspecified => return false,
            };
            marker.position.len() == position
                && marker.load.len() == load
                && !marker.acceleration.is_empty()
        };
        let markers: Vec<&Marker> = bench.subject.markers.iter().filter(takes).collect();
        if markers.is_empty() {
            return Err(Stop::not_applicable(
                "no marker of the model has a whole pose, all loads and accelerations",
            ));
        }
        for marker in markers {
            for end in End::BOTH {
                examine(bench, marker, end, verdict)?;
            }
        }
        Ok(())
    }
}

fn examine(
    bench: &Bench<'_>,
    marker: &Marker,
    end: End,
    verdict: &mut Verdict,
) -> Result<(), Stop> {
    let law = JointLaw {
        law: Law::AtPoint {
            direction: Vector3::from(DIRECTION),
        },
        points: [Vector3::from(POINT); 2],
    };
    let count = bench.subject.inputs.len();
    let message = v1::JointLoad {
        multiplier: count as u32,
        ..law.to_message(&marker.name, end)
    };
    let request = v1::InitializeRequest {
        joint_inputs: vec!["multiplier".to_owned()],
        joint_loads: vec![message],
        ..bench.request()
    };
    let mut instance = bench.driven(&request, &[0.0])?;
    let rest = bench.unloaded().and(&[0.0]);
    let poses = [pose(marker, &instance.evaluate(&rest.values(0.0))?); 2];
    let wrench = law.unit_wrench(end, &poses);
    let multiplier = size(bench, marker, &wrench);
    let by_joint = bench.unloaded().and(&[multiplier]);
    let mut by_inputs = rest.clone();
    for (component, &load) in marker.load.iter().enumerate() {
        by_inputs = by_inputs.plus(
            load,
            multiplier * component_of(marker, &wrench, component),
            0,
        );
    }
    let name = &marker.name;
    let found = accelerations(bench, marker, &instance, [&by_joint, &by_inputs, &rest])?;
    let text = format!("other accelerations of marker \"{name}\" at end {end:?}");
    verdict.judge(found, bench.grade_of_motion(), text);
    let cases = [&by_joint, &by_inputs, &rest];
    let limit = velocities(bench, marker, &mut instance, cases)?;
    let text = format!("other velocities of marker \"{name}\" at end {end:?}");
    limit.judge(verdict, bench.grade_of_motion(), &text);
    Ok(())
}

/// Accelerations under the joint load and under the same load at the inputs.
fn accelerations(
    bench: &Bench<'_>,
    marker: &Marker,
    instance: &Instance<'_>,
    cases: [&Inputs; 3],
) -> Result<Comparison, Stop> {
    let mut ends = Vec::new();
    for inputs in cases {
        ends.push(instance.evaluate(&inputs.values(0.0))?);
    }
    Ok(compare(
        bench,
        &marker.acceleration,
        &ends,
        (MOBILITY_SHARE, 0.0),
    ))
}

/// Velocities after a short step under the one and the other.
fn velocities(
    bench: &Bench<'_>,
    marker: &Marker,
    instance: &mut Instance<'_>,
    cases: [&Inputs; 3],
) -> Result<Limit, Stop> {
    let start = instance.keep()?;
    in_the_limit(bench.step(), |step| {
        let mut ends = Vec::new();
        for inputs in cases {
            instance.go_back(&start)?;
            ends.push(instance.step(step, inputs)?);
        }
        Ok(compare(
            bench,
            &marker.velocity,
            &ends,
            (LIMIT_SHARE, 4.0 * bench.tolerance),
        ))
    })
}

/// Compares outputs of the first state with those of the second; the third one has no load.
fn compare(
    bench: &Bench<'_>,
    outputs: &[usize],
    ends: &[Vec<f64>],
    (share, tolerance): (f64, f64),
) -> Comparison {
    let [found, expected, rest] = ends else {
        return Comparison::default();
    };
    let response: Vec<f64> = expected.iter().zip(rest).map(|(a, b)| a - b).collect();
    let sizes = bench.subject.sizes_of_groups(&response);
    let mut comparison = Comparison::default();
    for &output in outputs {
        let floor = tolerance + rounding(&[expected[output], rest[output]]);
        if let Some(allowed) = allowed(share, sizes[output], floor) {
            let name = &bench.subject.outputs[output];
            comparison.near(name, found[output], expected[output], allowed);
        }
    }
    comparison
}

fn pose(marker: &Marker, values: &[f64]) -> Pose {
    match (marker.quaternion(), &marker.position[..]) {
        (Some(attitude), &[x, y, z, ..]) => {
            let position = Vector3::new(values[x], values[y], values[z]);
            Pose::spatial(position, attitude.map(|place| values[place]))
        }
        (_, &[x, y, angle]) => Pose::planar(values[x], values[y], values[angle]),
        _ => Pose::default(),
    }
}

/// A component of a load in the order of the marker's inputs.
fn component_of(marker: &Marker, wrench: &Wrench, component: usize) -> f64 {
    let is_moment_in_plane = marker.kind == MarkerKind::Planar && component == 2;
    wrench.component(if is_moment_in_plane { 5 } else { component })
}

/// The multiplier whose load has no component that is larger than the size of its input.
fn size(bench: &Bench<'_>, marker: &Marker, wrench: &Wrench) -> f64 {
    let components = marker.load.iter().enumerate();
    let most = components.filter_map(|(component, &load)| {
        let own = component_of(marker, wrench, component).abs();
        (own > 0.0).then(|| bench.sizes[load] / own)
    });
    most.min_by(f64::total_cmp).unwrap_or(1.0)
}
