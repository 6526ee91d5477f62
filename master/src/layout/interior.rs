//! Finds what the coupling reads inside a step.

use super::bound::Layout;
use super::exchanged::What;
use super::inside::Inside;

impl Layout {
    /// Lets all positions that the conditions are made of be told at these shares of the step.
    pub fn read_inside(&mut self, shares: &[f64]) {
        self.inside = Inside {
            shares: shares.to_vec(),
            places: vec![Vec::new(); self.outputs.len()],
        };
        let ends = self.joints.iter().flat_map(|joint| &joint.ends);
        let of_joints = ends.flat_map(|end| end.positions().map(|place| (end.subsystem, place)));
        let of_exchanged = self.exchanged.iter().flat_map(|one| {
            let places = match &one.what {
                What::Output(place) => std::slice::from_ref(place),
                What::Attitude { places, .. } => &places[..],
            };
            places.iter().map(|&place| (one.subsystem, place))
        });
        let of_frames = self.frames.iter().flat_map(|frame| {
            let places = frame.attitude.iter();
            places.map(|&place| (frame.subsystem, place))
        });
        for (subsystem, place) in of_joints.chain(of_exchanged).chain(of_frames) {
            let known = &mut self.inside.places[subsystem];
            if !known.contains(&place) {
                known.push(place);
            }
        }
    }

    /// Names of the outputs that a subsystem tells inside a step.
    pub fn interior_outputs(&self, subsystem: usize) -> Vec<String> {
        let places = self.inside.places.get(subsystem).into_iter().flatten();
        places
            .map(|&place| self.outputs[subsystem][place].clone())
            .collect()
    }
}
