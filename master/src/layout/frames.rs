//! Axes of the bodies, in which responses to loads hardly change while the bodies turn.

use linchpin_proto::v1::{Marker, MarkerKind};

use super::bind::place_of;
use super::bound::{Frame, Layout};
use super::coupled::Coupled;
use super::input::DrivenInput;
use super::marker::{Parts, outputs_of};
use crate::joint::Level;

/// A joint drives only a part of a force or moment, so the responses in other directions are not known.
struct Partial;

impl Layout {
    /// Finds the frames of the markers that joints hold, and lets their attitudes be read. A subsystem of which a force or
    /// moment is driven only in part gets none.
    pub fn add_frames(&mut self, coupled: &Coupled<'_>) {
        for subsystem in 0..self.outputs.len() {
            let ends = coupled.joints.iter().flat_map(|joint| &joint.ends);
            let own = ends.filter(|(of, _)| *of == subsystem);
            let mut markers: Vec<&Marker> = Vec::new();
            for (_, marker) in own {
                if markers.iter().all(|known| known.name != marker.name) {
                    markers.push(marker);
                }
            }
            let inputs: Result<Vec<_>, Partial> = markers
                .iter()
                .map(|marker| self.vector_inputs(subsystem, marker))
                .collect();
            let is_read = !self.outputs[subsystem].is_empty();
            for (marker, inputs) in markers.iter().zip(inputs.into_iter().flatten()) {
                if is_read {
                    let frame = self.frame(subsystem, marker, inputs);
                    self.frames.extend(frame);
                }
            }
        }
    }

    fn frame(
        &mut self,
        subsystem: usize,
        marker: &Marker,
        inputs: Vec<Vec<usize>>,
    ) -> Option<Frame> {
        let kind = marker.kind();
        let rotation = Parts::of(kind, Level::Position).rotation;
        let names = marker.position.get(rotation)?;
        if names.is_empty() {
            return None;
        }
        let outputs = &mut self.outputs[subsystem];
        let attitude = names.iter().map(|name| place_of(outputs, name)).collect();
        let mut vectors = Vec::new();
        for &level in self.level.up_to() {
            let names = outputs_of(marker, level);
            let Parts { position, rotation } = Parts::of(kind, level);
            let turns = kind == MarkerKind::Spatial && level != Level::Position;
            for part in [Some(position), turns.then_some(rotation)]
                .into_iter()
                .flatten()
            {
                let places = names.get(part).unwrap_or_default().iter();
                let places = places.map(|name| outputs.iter().position(|known| known == name));
                vectors.extend(places.collect::<Option<Vec<_>>>());
            }
        }
        vectors.retain(|places| !places.is_empty());
        Some(Frame {
            subsystem,
            attitude,
            vectors,
            inputs,
        })
    }

    /// Inputs that turn with the marker.
    fn vector_inputs(&self, subsystem: usize, marker: &Marker) -> Result<Vec<Vec<usize>>, Partial> {
        let parts: &[(usize, usize)] = match marker.kind() {
            MarkerKind::Planar => &[(0, 2)],
            MarkerKind::Spatial => &[(0, 3), (3, 6)],
            MarkerKind::Scalar | MarkerKind::Unspecified => &[],
        };
        let range = self.input_range(subsystem);
        let find = |is_wanted: &dyn Fn(&DrivenInput) -> bool| {
            let found = range
                .clone()
                .find(|&number| is_wanted(&self.inputs[number]));
            found.filter(|&number| self.inputs[number].is_perturbed)
        };
        let mut vectors = Vec::new();
        for &(first, end) in parts {
            let part = first..end;
            let names = marker.load.get(part.clone()).unwrap_or_default().iter();
            let driven: Vec<usize> = names
                .filter_map(|name| find(&|input| !input.is_joint_input && input.name == *name))
                .collect();
            match driven.len() {
                0 => {}
                all if all == part.len() => vectors.push(driven),
                _ => return Err(Partial),
            }
        }
        let loads = self.joint_loads[subsystem].iter();
        for load in loads.filter(|load| load.marker == marker.name) {
            for places in [&load.partner_position, &load.partner_rotation] {
                let numbers = places.iter().filter_map(|&place| {
                    find(&|input| input.is_joint_input && input.place == place as usize)
                });
                let numbers: Vec<usize> = numbers.collect();
                if numbers.len() > 1 && !vectors.contains(&numbers) {
                    vectors.push(numbers);
                }
            }
        }
        Ok(vectors)
    }
}
