//! Finds what the coupling reads inside a step.

use std::collections::BTreeSet;

use super::bound::Layout;
use super::exchanged::What;
use super::inside::{Inside, MomentsFrom};
use crate::joint::{End, Level};

/// Places of quaternions in the outputs of the subsystems.
type Quaternions = BTreeSet<(usize, usize)>;

impl Layout {
    /// Lets what the conditions are made of be told inside the step: for conditions that are linear in outputs of subsystems that all
    /// integrate them (`integrates`) by integrals with that many `weights`, for the others by positions at these `shares` of the step.
    pub fn read_inside(
        &mut self,
        shares: &[f64],
        weights: usize,
        integrates: &dyn Fn(usize) -> bool,
    ) {
        let quaternions = self.quaternions();
        let is_integrated = |condition: &Option<Vec<(usize, usize)>>| match condition {
            Some(outputs) if outputs.iter().all(|&(subsystem, _)| integrates(subsystem)) => {
                MomentsFrom::Integrals
            }
            _ => MomentsFrom::Instants,
        };
        let linear: Vec<_> = (0..self.variables())
            .map(|variable| self.linear_in(variable, &quaternions))
            .collect();
        let moments: Vec<_> = linear.iter().map(is_integrated).collect();
        let has = |kind| moments.contains(&kind);
        let mut inside = Inside {
            weights: if has(MomentsFrom::Integrals) {
                weights
            } else {
                0
            },
            shares: if has(MomentsFrom::Instants) {
                shares.to_vec()
            } else {
                Vec::new()
            },
            integrated: vec![Vec::new(); self.outputs.len()],
            places: vec![Vec::new(); self.outputs.len()],
            moments,
        };
        for (outputs, moments) in linear.iter().zip(&inside.moments) {
            if *moments == MomentsFrom::Integrals {
                for &(subsystem, place) in outputs.iter().flatten() {
                    add(&mut inside.integrated[subsystem], place);
                }
            }
        }
        self.add_at_instants(&mut inside);
        self.inside = inside;
    }

    /// The outputs that the condition of a coupling variable is made of, each by its subsystem and place, if it is linear in them: the condition
    /// of its integrals is then the integral of the condition. That is so for the distance of two points that are markers along a fixed
    /// direction, for scalar markers, and for exchanged outputs. Whatever turns with a body is not linear.
    fn linear_in(&self, variable: usize, quaternions: &Quaternions) -> Option<Vec<(usize, usize)>> {
        let Some(row) = self.rows.get(variable) else {
            let exchanged = self.exchanged_of(variable)?;
            return match exchanged.what {
                What::Output(place) => Some((exchanged.subsystem, place))
                    .filter(|output| !quaternions.contains(output))
                    .map(|output| vec![output]),
                What::Attitude { .. } => None,
            };
        };
        let joint = &self.joints[row.joint];
        let condition = joint.joint.condition(row.condition);
        if End::BOTH.iter().any(|&end| condition.reads(end).rotation) {
            return None;
        }
        let ends = joint.ends.iter();
        let outputs = ends.flat_map(|end| {
            let places = end.coordinates().iter();
            places.map(|&place| (end.subsystem, place))
        });
        Some(outputs.collect())
    }

    /// What is read of quaternions has to be one at every look.
    fn quaternions(&self) -> Quaternions {
        let of_joints = self
            .joints
            .iter()
            .flat_map(|joint| &joint.ends)
            .flat_map(|end| {
                let places = end.orientation(Level::Position).iter();
                places.map(|&place| (end.subsystem, place))
            });
        let of_exchanged = self.exchanged.iter().filter_map(|one| match one.what {
            What::Attitude { places, .. } => Some(places.map(|place| (one.subsystem, place))),
            What::Output(_) => None,
        });
        let of_frames = self.frames.iter().flat_map(|frame| {
            let places = frame.attitude.iter();
            places.map(|&place| (frame.subsystem, place))
        });
        of_joints
            .chain(of_exchanged.flatten())
            .chain(of_frames)
            .collect()
    }

    fn add_at_instants(&self, inside: &mut Inside) {
        let is_at_instants = |variables: std::ops::Range<usize>| {
            inside.moments[variables].contains(&MomentsFrom::Instants)
        };
        let mut first_row = 0;
        let joints = self.joints.iter().filter(|joint| {
            let rows = first_row..first_row + joint.joint.len();
            first_row = rows.end;
            is_at_instants(rows)
        });
        let of_joints = joints.flat_map(|joint| {
            let ends = joint.ends.iter();
            ends.flat_map(|end| end.positions().map(|place| (end.subsystem, place)))
        });
        let exchanged = self.exchanged.iter();
        let exchanged = exchanged.filter(|one| is_at_instants(one.first..one.first + one.size()));
        let of_exchanged = exchanged.flat_map(|one| {
            let places = match &one.what {
                What::Output(place) => std::slice::from_ref(place),
                What::Attitude { places, .. } => &places[..],
            };
            places.iter().map(|&place| (one.subsystem, place))
        });
        let found: Vec<_> = of_joints.chain(of_exchanged).collect();
        for (subsystem, place) in found {
            add(&mut inside.places[subsystem], place);
        }
        let of_frames = self.frames.iter().flat_map(|frame| {
            let places = frame.attitude.iter();
            places.map(|&place| (frame.subsystem, place))
        });
        for (subsystem, place) in of_frames {
            let own = &mut inside.places[subsystem];
            // The attitudes of a body tell how responses at the instants turn.
            if !own.is_empty() {
                add(own, place);
            }
        }
    }

    /// Names of the outputs that a subsystem tells at instants.
    pub fn interior_outputs(&self, subsystem: usize) -> Vec<String> {
        self.names_of(subsystem, &self.inside.places)
    }

    /// Names of the outputs that a subsystem integrates.
    pub fn integrated_outputs(&self, subsystem: usize) -> Vec<String> {
        self.names_of(subsystem, &self.inside.integrated)
    }

    fn names_of(&self, subsystem: usize, places: &[Vec<usize>]) -> Vec<String> {
        let places = places.get(subsystem).into_iter().flatten();
        places
            .map(|&place| self.outputs[subsystem][place].clone())
            .collect()
    }
}

fn add(known: &mut Vec<usize>, place: usize) {
    if !known.contains(&place) {
        known.push(place);
    }
}
