//! The model `mass-chain`: three masses between springs with a stiff end or a constraint (S2 Sect. 2.8).

use std::sync::Arc;

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;

use super::face::{Coordinate, Face, FaceContact};
use super::keys::{Key, Parameters, absent, number};
use super::model::{NonsmoothModel, Seen, Started, started};
use super::observed::{Motion, Observer};
use crate::mechanics::describe::{input, output};
use crate::nonsmooth::system::MechanicalSystem;
use crate::nonsmooth::systems::masses::{End, Masses};

/// Three masses in a row.
pub const MASS_CHAIN: NonsmoothModel = NonsmoothModel {
    name: "mass-chain",
    what: "Three masses in a row between springs; the last one on a stiff spring or held by a constraint",
    keys: KEYS,
    seen,
    start,
};

const KEYS: &[Key] = &[
    number("m1", "kg", 1.0, "first mass, greater than 0"),
    number("m2", "kg", 1.0, "second mass, greater than 0"),
    number("m3", "kg", 1.0, "third mass, greater than 0"),
    number(
        "k1",
        "N/m",
        1.0,
        "spring from the wall to the first mass, 0 or greater",
    ),
    number(
        "k2",
        "N/m",
        1.0,
        "spring between the first and the second mass, 0 or greater",
    ),
    number(
        "k3",
        "N/m",
        1.0,
        "spring between the second and the third mass, 0 or greater",
    ),
    absent(
        "k0",
        "N/m",
        "spring from the third mass to the wall, 0 or greater; if absent the mass is held by a constraint",
    ),
    number(
        "gravity",
        "m/s^2",
        9.81,
        "acceleration along all coordinates",
    ),
];

fn seen(parameters: &Parameters<'_>) -> Seen {
    let system = masses(parameters)?;
    Ok((face(&system), system.contacts().to_vec()))
}

fn start(parameters: &Parameters<'_>, setup: &Setup) -> Started {
    let system = masses(parameters)?;
    let face = face(&system);
    let at_rest: [&[f64]; 2] = [&[0.0; 3], &[0.0; 3]];
    started(Arc::new(system), Accelerations, &face, at_rest, setup)
}

fn masses(parameters: &Parameters<'_>) -> Result<Masses, SetupError> {
    let positive = |name| parameters.positive(name);
    let spring = |name| parameters.non_negative(name);
    Ok(Masses {
        masses: [positive("m1")?, positive("m2")?, positive("m3")?],
        springs: [spring("k1")?, spring("k2")?, spring("k3")?],
        gravity: parameters.number("gravity")?,
        end: if parameters.has("k0") {
            End::Spring(spring("k0")?)
        } else {
            End::Constraint
        },
    })
}

fn face(system: &Masses) -> Face {
    let coordinate = |number: usize| {
        Coordinate::length(
            &format!("q{number}"),
            &format!("v{number}"),
            &format!("displacement of mass {number}"),
        )
    };
    let contacts = match system.end {
        End::Spring(_) => vec![],
        End::Constraint => vec![FaceContact::at_point("wall")],
    };
    let own = (1..=3).map(|number| {
        output(
            &format!("a{number}"),
            "m/s^2",
            &format!("acceleration of mass {number} as the scheme has it"),
        )
    });
    Face {
        coordinates: (1..=3).map(coordinate).collect(),
        contacts,
        inputs: (1..=3)
            .map(|number| {
                input(
                    &format!("f{number}"),
                    "N",
                    &format!("force on mass {number}"),
                )
            })
            .collect(),
        own: own.collect(),
        ..Face::default()
    }
}

/// Shows accelerations.
struct Accelerations;

impl Observer for Accelerations {
    fn own_output(&self, output: usize, motion: Motion<'_>) -> f64 {
        motion.a[output]
    }
}
