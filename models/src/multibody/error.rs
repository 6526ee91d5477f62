//! What can be wrong with a composition.

use linchpin_proto::readable::number;
use linchpin_worker::setup::SetupError;

/// A mistake in a composition. `field` is its place, e.g. `parameters.joint.hinge.a`.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CompositionError {
    /// A body or joint that is not there.
    #[error("there is no {what} {found:?}; there are: {known}")]
    UnknownName {
        /// Place.
        field: String,
        /// Body or joint.
        what: &'static str,
        /// The name.
        found: String,
        /// The names that there are, separated by commas.
        known: String,
    },
    /// A body with the name of the ground.
    #[error("the name \"ground\" is taken by the ground; choose another")]
    Ground {
        /// Place.
        field: String,
    },
    /// Both ends on one body.
    #[error(
        "both ends are on {body:?}; they must be on two bodies, of which one may be \"ground\""
    )]
    OneBody {
        /// Place.
        field: String,
        /// The body.
        body: String,
    },
    /// A point in neither or both of two ways.
    #[error(
        "give either `point` (inertial axes, at the start) or both `point_a` and `point_b` (axes of body a and body b)"
    )]
    Point {
        /// Place.
        field: String,
    },
    /// A motion with no or two targets.
    #[error("give either `joint`, or `body` with `direction` (and `point`)")]
    Target {
        /// Place.
        field: String,
    },
    /// A vector or quaternion of length 0.
    #[error("its length is 0; it must have a direction")]
    NoDirection {
        /// Place.
        field: String,
    },
    /// Axes of a universal joint that are not at right angles.
    #[error(
        "the angle to `axis` is {degrees} degrees; the two axes of a universal joint are at right angles"
    )]
    NotPerpendicular {
        /// Place.
        field: String,
        /// Angle between them (degrees).
        degrees: f64,
    },
    /// A moment of inertia that no body has.
    #[error(
        "{value} is greater than the sum {rest} of the other two moments of inertia, which no body has"
    )]
    Inertia {
        /// Place.
        field: String,
        /// The moment of inertia (kg m^2).
        value: f64,
        /// The other two together (kg m^2).
        rest: f64,
    },
    /// A spring or damper without direction.
    #[error(
        "both ends are at the same point at the start, so the force has no direction; move an end, or leave out damping and rest_length"
    )]
    NoLength {
        /// Place.
        field: String,
    },
    /// Something that only certain joints have.
    #[error("the joint {joint:?} is {kind}; this needs one of the kinds {allowed}")]
    WrongJoint {
        /// Place.
        field: String,
        /// The joint.
        joint: String,
        /// Its kind.
        kind: &'static str,
        /// The kinds that would do.
        allowed: &'static str,
    },
    /// A joint that is not closed at the start.
    #[error(
        "it is open by {residual} {unit} at the start; place the bodies or the points so that it is closed",
        residual = number(*residual)
    )]
    Open {
        /// Place.
        field: String,
        /// How far it is open.
        residual: f64,
        /// m, or 1 for the cosine of an angle that should be a right one.
        unit: &'static str,
    },
    /// A velocity that a joint does not allow.
    #[error(
        "the velocities at the start violate it by {residual} {unit}; give the bodies velocities that it allows",
        residual = number(*residual)
    )]
    Moving {
        /// Place.
        field: String,
        /// By how much.
        residual: f64,
        /// m/s or rad/s.
        unit: &'static str,
    },
    /// A condition that others imply.
    #[error(
        "at the start it repeats or contradicts what the other joints and motions already prescribe ({conditions}); its reaction would be undetermined. Take a kind that leaves more freedom, or remove it"
    )]
    Redundant {
        /// Place.
        field: String,
        /// The joints and motions looked at before.
        conditions: String,
    },
    /// A loop with minimal coordinates.
    #[error(
        "it closes a loop, which minimal coordinates cannot express; set formulation = \"absolute\", or remove a joint of the loop"
    )]
    Loop {
        /// Place.
        field: String,
    },
    /// A joint without minimal coordinates.
    #[error("an inline joint has no minimal coordinates; set formulation = \"absolute\"")]
    NoTreeJoint {
        /// Place.
        field: String,
    },
    /// A motion of a point with minimal coordinates.
    #[error(
        "minimal coordinates cannot prescribe the motion of a point; set formulation = \"absolute\", or prescribe that of a revolute or prismatic joint"
    )]
    PointMotion {
        /// Place.
        field: String,
    },
    /// Two motions of one joint.
    #[error(
        "the motion of the joint {joint:?} is prescribed already by {other}; remove one of them"
    )]
    DrivenTwice {
        /// Place.
        field: String,
        /// The joint.
        joint: String,
        /// Place of the other motion.
        other: String,
    },
    /// Two variables of one name.
    #[error("two outputs or inputs would be called {variable:?}; choose another name here")]
    SameVariable {
        /// Place.
        field: String,
        /// The name.
        variable: String,
    },
}

impl CompositionError {
    fn field(&self) -> &str {
        match self {
            Self::UnknownName { field, .. }
            | Self::Ground { field }
            | Self::OneBody { field, .. }
            | Self::Point { field }
            | Self::Target { field }
            | Self::NoDirection { field }
            | Self::NotPerpendicular { field, .. }
            | Self::Inertia { field, .. }
            | Self::NoLength { field }
            | Self::WrongJoint { field, .. }
            | Self::Open { field, .. }
            | Self::Moving { field, .. }
            | Self::Redundant { field, .. }
            | Self::Loop { field }
            | Self::NoTreeJoint { field }
            | Self::PointMotion { field }
            | Self::DrivenTwice { field, .. }
            | Self::SameVariable { field, .. } => field,
        }
    }
}

impl From<CompositionError> for SetupError {
    fn from(error: CompositionError) -> Self {
        Self::Refused {
            field: error.field().to_owned(),
            reason: error.to_string(),
        }
    }
}
