//! Planar bodies with hinges between them in any arrangement, without a run: for the size of their coupling system.

use std::sync::Arc;

use linchpin_master::joint::Level;
use linchpin_master::joint::composite::{Kind, PlanarFrame, in_plane};
use linchpin_master::layout::{Coupled, Layout, LoadForm, MarkedJoint};
use linchpin_master::system::System;
use linchpin_master::system::pattern::Pattern;
use linchpin_master::system::unknowns::Unknowns;
use linchpin_proto::v1;
use nalgebra::Vector3;

/// Bodies one after the other.
pub fn chain(bodies: usize) -> Vec<[usize; 2]> {
    (1..bodies).map(|body| [body - 1, body]).collect()
}

/// A chain whose ends are hinged together.
pub fn ring(bodies: usize) -> Vec<[usize; 2]> {
    (0..bodies)
        .map(|body| [body, (body + 1) % bodies])
        .collect()
}

/// A tree in which every body carries two others.
pub fn tree(bodies: usize) -> Vec<[usize; 2]> {
    (1..bodies).map(|body| [(body - 1) / 2, body]).collect()
}

/// All bodies on the first one.
pub fn star(bodies: usize) -> Vec<[usize; 2]> {
    (1..bodies).map(|body| [0, body]).collect()
}

/// Pattern of the coupling Jacobian of `bodies` bodies with hinges from the end of one to the start of the other.
pub fn pattern(bodies: usize, hinges: &[[usize; 2]]) -> Pattern {
    let names: Vec<String> = (0..bodies).map(|body| format!("body{body}")).collect();
    let joints: Vec<MarkedJoint> = hinges.iter().map(hinge).collect();
    let coupled = Coupled {
        subsystems: names.iter().map(String::as_str).collect(),
        forms: vec![LoadForm::Joint; bodies],
        joints: &joints,
        connections: &[],
    };
    let layout = Layout::new(&coupled, Level::Acceleration).unwrap();
    let unknowns = Unknowns::ends(&layout);
    System::new(&layout, unknowns).pattern().clone()
}

fn hinge([a, b]: &[usize; 2]) -> MarkedJoint {
    let frame = PlanarFrame {
        points: [Vector3::zeros(); 2],
        axes: [Vector3::x(); 2],
        angle: 0.0,
    };
    MarkedJoint {
        name: format!("hinge{a}-{b}"),
        joint: Arc::new(in_plane(Kind::AtPoint, &frame).unwrap()),
        ends: [(*a, marker("end")), (*b, marker("start"))],
    }
}

fn marker(name: &str) -> v1::Marker {
    let signals = |parts: [&str; 3]| parts.map(|part| format!("{name}_{part}")).to_vec();
    v1::Marker {
        name: name.to_owned(),
        kind: v1::MarkerKind::Planar.into(),
        position: signals(["x", "y", "angle"]),
        velocity: signals(["vx", "vy", "rate"]),
        acceleration: signals(["ax", "ay", "alpha"]),
        load: signals(["fx", "fy", "moment"]),
    }
}
