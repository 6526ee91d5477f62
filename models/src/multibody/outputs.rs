//! The outputs of a composition: motion of its markers, coordinates and reactions of its joints, energy.

use linchpin_proto::joint_load::Wrench;
use linchpin_proto::v1;

use super::dimension::Dimension;
use super::formulation::Dynamics;
use super::joint::{Joint, JointKind};
use super::kinematics::{Kinematics, Twist, moved_load};
use super::system::System;
use crate::mechanics::describe::output;

/// One output: what it tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Output {
    /// Component of a marker, in the order of the marker's form.
    Marker {
        /// Place of the marker.
        marker: usize,
        /// Which component.
        component: usize,
    },
    /// Angle or displacement of a joint.
    Coordinate(usize),
    /// Its rate.
    Rate(usize),
    /// Component of the joint's load on its body b.
    Reaction {
        /// Place of the joint.
        joint: usize,
        /// Which component.
        component: usize,
    },
    /// Energy of the system.
    Energy,
}

/// All outputs, in the order of the description.
pub fn outputs(system: &System) -> Vec<Output> {
    let components = system.dimension.form().outputs_per_marker();
    let markers = 0..system.markers.len();
    let markers = markers.flat_map(|marker| {
        (0..components).map(move |component| Output::Marker { marker, component })
    });
    let joints = system.joints.iter().enumerate();
    let joints = joints.flat_map(|(place, joint)| outputs_of(place, joint, system.dimension));
    markers.chain(joints).chain([Output::Energy]).collect()
}

fn outputs_of(place: usize, joint: &Joint, dimension: Dimension) -> Vec<Output> {
    let mut own = match joint.kind {
        JointKind::Revolute | JointKind::Prismatic => {
            vec![Output::Coordinate(place), Output::Rate(place)]
        }
        JointKind::Inline | JointKind::Weld | JointKind::Spherical | JointKind::Universal => {
            Vec::new()
        }
    };
    let reactions = 0..dimension.load_components();
    own.extend(reactions.map(|component| Output::Reaction {
        joint: place,
        component,
    }));
    own
}

/// Variables of all outputs, in the order of [`outputs`]; each with the place of what it belongs to.
pub fn variables(system: &System) -> Vec<(String, v1::Variable)> {
    let form = system.dimension.form();
    let markers = system.markers.iter().flat_map(|marker| {
        let place = format!("parameters.marker.{}", marker.name);
        form.outputs(&marker.name)
            .map(move |variable| (place.clone(), variable))
    });
    let joints = system.joints.iter().flat_map(|joint| {
        let variables = variables_of(joint, system.dimension).into_iter();
        variables.map(|variable| (joint.place.clone(), variable))
    });
    let energy = output(
        "energy",
        "J",
        "kinetic energy, potential energy above the origin and energy of the springs",
    );
    let all = markers.chain(joints);
    all.chain([("parameters".to_owned(), energy)]).collect()
}

fn variables_of(joint: &Joint, dimension: Dimension) -> Vec<v1::Variable> {
    let name = &joint.name;
    let own = |suffix: &str, unit: &str, what: &str| {
        let description = format!("joint \"{name}\": {what}");
        output(&format!("{name}_{suffix}"), unit, &description)
    };
    let mut variables = match joint.kind {
        JointKind::Revolute => vec![
            own("angle", "rad", "angle of b from a"),
            own("rate", "rad/s", "rate of the angle"),
        ],
        JointKind::Prismatic => vec![
            own(
                "displacement",
                "m",
                "displacement of b from a along the axis",
            ),
            own("speed", "m/s", "rate of the displacement"),
        ],
        JointKind::Inline | JointKind::Weld | JointKind::Spherical | JointKind::Universal => {
            Vec::new()
        }
    };
    variables.extend(dimension.form().loads(name).map(|load| v1::Variable {
        description: format!(
            "joint \"{name}\": its load on b at its point there, in inertial axes"
        ),
        default: None,
        ..load
    }));
    variables
}

impl Output {
    /// Whether its value needs [`Dynamics`].
    pub fn needs_dynamics(self, dimension: Dimension) -> bool {
        match self {
            Self::Marker { component, .. } => component >= first_acceleration(dimension),
            Self::Reaction { .. } => true,
            Self::Coordinate(_) | Self::Rate(_) | Self::Energy => false,
        }
    }

    /// Its value; not a number if it needs dynamics that are not there.
    pub fn value(
        self,
        system: &System,
        kinematics: &Kinematics,
        dynamics: Option<&Dynamics>,
    ) -> f64 {
        let dimension = system.dimension;
        match self {
            Self::Marker { marker, component } => {
                marker_value(system, marker, component, kinematics, dynamics)
            }
            Self::Coordinate(place) | Self::Rate(place) => {
                let joint = &system.joints[place];
                let pair = joint.bodies.map(|body| &kinematics.bodies[body]);
                let coordinate = joint.coordinate(pair, kinematics.angles[place]);
                match self {
                    Self::Rate(_) => coordinate.rate,
                    _ => coordinate.value,
                }
            }
            Self::Reaction { joint, component } => dynamics.map_or(f64::NAN, |dynamics| {
                let own = &system.joints[joint];
                let body = &kinematics.bodies[own.bodies[1]];
                let arm = -body.arm(&own.points[1]);
                let Wrench { force, moment } = moved_load(&dynamics.reactions[joint], &arm);
                let load = Twist {
                    linear: force,
                    angular: moment,
                };
                dimension.component(&load, component)
            }),
            Self::Energy => system.energy(kinematics),
        }
    }
}

fn first_acceleration(dimension: Dimension) -> usize {
    dimension.coordinates() + dimension.speeds()
}

fn marker_value(
    system: &System,
    marker: usize,
    component: usize,
    kinematics: &Kinematics,
    dynamics: Option<&Dynamics>,
) -> f64 {
    let (dimension, marker) = (system.dimension, &system.markers[marker]);
    let body = &kinematics.bodies[marker.body];
    let (velocity, acceleration) = (dimension.coordinates(), first_acceleration(dimension));
    if component < velocity {
        return marker.position(body)[component];
    }
    if component < acceleration {
        return dimension.component(&marker.velocity(body), component - velocity);
    }
    dynamics.map_or(f64::NAN, |dynamics| {
        let own = marker.acceleration(body, &dynamics.accelerations[marker.body]);
        dimension.component(&own, component - acceleration)
    })
}
