//! Loads that the subsystems evaluate themselves, before their inputs have places.

use linchpin_proto::v1;

use super::input::DrivenInput;

/// A joint load whose signals are known by name.
pub(super) struct NamedLoad {
    pub(super) subsystem: usize,
    pub(super) message: v1::JointLoad,
    pub(super) multiplier: String,
    pub(super) position: Vec<String>,
    pub(super) rotation: Vec<String>,
    pub(super) attitude: Vec<String>,
}

impl NamedLoad {
    /// As the subsystem takes it, with the places of its signals.
    pub(super) fn message(&self, inputs: &[DrivenInput]) -> v1::JointLoad {
        let place = |name: &String| {
            let mut own = inputs.iter().filter(|input| input.is_joint_input);
            own.find(|input| &input.name == name)
                .map_or(0, |input| input.place as u32)
        };
        v1::JointLoad {
            multiplier: place(&self.multiplier),
            partner_position: self.position.iter().map(place).collect(),
            partner_rotation: self.rotation.iter().map(place).collect(),
            partner_attitude: self.attitude.iter().map(place).collect(),
            ..self.message.clone()
        }
    }
}
