//! The models that take joint loads.

use linchpin_proto::v1;

use crate::common::Solver;
use crate::common::body::TIGHT;
use crate::common::cases::{CASES, Case};
use crate::joint::Space;

/// A model with its markers.
#[derive(Debug, Clone, Copy)]
pub struct Body {
    pub case: Case,
    pub space: Space,
    pub markers: &'static [&'static str],
}

pub const PENDULUM: Body = Body {
    case: CASES[1],
    space: Space::Planar,
    markers: &["tip"],
};

pub const LINK: Body = Body {
    case: CASES[2],
    space: Space::Planar,
    markers: &["start", "end"],
};

pub const SPATIAL: Body = Body {
    case: CASES[3],
    space: Space::Spatial,
    markers: &["start", "end"],
};

/// Multibody systems, with their markers that move.
pub const SYSTEMS: [Body; 4] = [
    Body {
        case: CASES[4],
        space: Space::Planar,
        markers: &["tip"],
    },
    Body {
        case: CASES[6],
        space: Space::Planar,
        markers: &["tip", "ball"],
    },
    Body {
        case: CASES[7],
        space: Space::Spatial,
        markers: &["tip"],
    },
    Body {
        case: CASES[9],
        space: Space::Spatial,
        markers: &["tip", "block"],
    },
];

pub const BODIES: [Body; 7] = [
    PENDULUM, LINK, SPATIAL, SYSTEMS[0], SYSTEMS[1], SYSTEMS[2], SYSTEMS[3],
];

/// Solvers whose error is below what is checked.
pub const SOLVERS: [Solver; 2] = [TIGHT, Solver("rk4", &[("step", 2.5e-4)])];

impl Body {
    pub fn description(&self) -> v1::Model {
        self.case.description()
    }

    pub fn outputs(&self) -> Vec<String> {
        let outputs = self.description().outputs.into_iter();
        outputs.map(|output| output.name).collect()
    }
}
