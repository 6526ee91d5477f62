//! What belongs to a marker: `tip_x`, `tip_vx`, `tip_fx`, ..., and models with markers.

use linchpin_proto::v1;

use super::describe::{input, output};
use super::solvers;

/// One component: the end of its name, its unit, what it is.
type Component = (&'static str, &'static str, &'static str);

/// The components of all markers of one kind, in the order of [`v1::Marker`].
#[derive(Debug, Clone, Copy)]
pub struct Form {
    kind: v1::MarkerKind,
    position: &'static [Component],
    velocity: &'static [Component],
    acceleration: &'static [Component],
    load: &'static [Component],
}

/// A point and an angle in the plane.
pub const PLANAR: Form = Form {
    kind: v1::MarkerKind::Planar,
    position: &[
        ("x", "m", "position in x"),
        ("y", "m", "position in y"),
        ("angle", "rad", "angle from the x axis"),
    ],
    velocity: &[
        ("vx", "m/s", "velocity in x"),
        ("vy", "m/s", "velocity in y"),
        ("rate", "rad/s", "rate of the angle"),
    ],
    acceleration: &[
        ("ax", "m/s^2", "acceleration in x under the present loads"),
        ("ay", "m/s^2", "acceleration in y under the present loads"),
        (
            "alpha",
            "rad/s^2",
            "angular acceleration under the present loads",
        ),
    ],
    load: &[
        ("fx", "N", "force in x"),
        ("fy", "N", "force in y"),
        ("moment", "N m", "moment about the point"),
    ],
};

/// A point and an orientation in space.
pub const SPATIAL: Form = Form {
    kind: v1::MarkerKind::Spatial,
    position: &[
        ("x", "m", "position in x"),
        ("y", "m", "position in y"),
        ("z", "m", "position in z"),
        ("qw", "1", "unit quaternion from body to space, real part"),
        ("qx", "1", "unit quaternion, x part"),
        ("qy", "1", "unit quaternion, y part"),
        ("qz", "1", "unit quaternion, z part"),
    ],
    velocity: &[
        ("vx", "m/s", "velocity in x"),
        ("vy", "m/s", "velocity in y"),
        ("vz", "m/s", "velocity in z"),
        ("omega_x", "rad/s", "angular velocity about x in space"),
        ("omega_y", "rad/s", "angular velocity about y in space"),
        ("omega_z", "rad/s", "angular velocity about z in space"),
    ],
    acceleration: &[
        ("ax", "m/s^2", "acceleration in x under the present loads"),
        ("ay", "m/s^2", "acceleration in y under the present loads"),
        ("az", "m/s^2", "acceleration in z under the present loads"),
        (
            "alpha_x",
            "rad/s^2",
            "angular acceleration about x in space under the present loads",
        ),
        (
            "alpha_y",
            "rad/s^2",
            "angular acceleration about y in space under the present loads",
        ),
        (
            "alpha_z",
            "rad/s^2",
            "angular acceleration about z in space under the present loads",
        ),
    ],
    load: &[
        ("fx", "N", "force in x"),
        ("fy", "N", "force in y"),
        ("fz", "N", "force in z"),
        (
            "moment_x",
            "N m",
            "moment about the point, around x in space",
        ),
        (
            "moment_y",
            "N m",
            "moment about the point, around y in space",
        ),
        (
            "moment_z",
            "N m",
            "moment about the point, around z in space",
        ),
    ],
};

impl Form {
    /// Number of outputs of a marker.
    pub const fn outputs_per_marker(&self) -> usize {
        self.position.len() + self.velocity.len() + self.acceleration.len()
    }

    /// The outputs of a marker: position, velocity, acceleration.
    pub fn outputs(&self, marker: &str) -> impl Iterator<Item = v1::Variable> {
        let components = [self.position, self.velocity, self.acceleration];
        variables(components.concat(), marker, output)
    }

    /// The inputs of a marker: its load.
    pub fn loads(&self, marker: &str) -> impl Iterator<Item = v1::Variable> {
        variables(self.load.to_vec(), marker, input)
    }

    /// A model with these markers and its own outputs behind theirs, as far as they and the solvers tell.
    pub fn model(
        &self,
        markers: [&str; 2],
        own_outputs: impl IntoIterator<Item = v1::Variable>,
    ) -> v1::Model {
        let outputs = markers.into_iter().flat_map(|marker| self.outputs(marker));
        v1::Model {
            inputs: { markers.into_iter() }
                .flat_map(|marker| self.loads(marker))
                .collect(),
            outputs: outputs.chain(own_outputs).collect(),
            markers: markers.map(|marker| self.marker(marker)).into(),
            solvers: solvers::descriptions(),
            capabilities: Some(solvers::capabilities()),
            ..v1::Model::default()
        }
    }

    /// The marker itself.
    pub fn marker(&self, name: &str) -> v1::Marker {
        let names = |components: &[Component]| {
            let suffixes = components.iter().map(|&(suffix, ..)| suffix);
            suffixes.map(|suffix| format!("{name}_{suffix}")).collect()
        };
        v1::Marker {
            name: name.to_owned(),
            kind: self.kind.into(),
            position: names(self.position),
            velocity: names(self.velocity),
            acceleration: names(self.acceleration),
            load: names(self.load),
        }
    }
}

fn variables(
    components: Vec<Component>,
    marker: &str,
    variable: fn(&str, &str, &str) -> v1::Variable,
) -> impl Iterator<Item = v1::Variable> {
    components.into_iter().map(move |(suffix, unit, meaning)| {
        let description = format!("marker \"{marker}\": {meaning}");
        variable(&format!("{marker}_{suffix}"), unit, &description)
    })
}
