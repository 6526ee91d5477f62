//! Which outputs of which subsystem the joints read, and which inputs they load.

use linchpin_proto::v1;

use crate::joint::{End, Joint, Level, RigidLink};
use crate::scene::JointKind;

/// The joints of a scene tied to places in the subsystems' inputs and outputs.
pub struct Layout {
    /// Joints in the order of the scene; joint `r` has row and multiplier number `r`.
    pub joints: Vec<BoundJoint>,
    /// Driven inputs of all subsystems, subsystem by subsystem.
    pub inputs: Vec<DrivenInput>,
    /// For each subsystem the names of the outputs that the joints read, each once.
    pub outputs: Vec<Vec<String>>,
    /// Highest level of the conditions.
    pub level: Level,
}

/// A joint and its two ends.
pub struct BoundJoint {
    /// Name in the scene.
    pub name: String,
    /// Condition and load.
    pub law: Box<dyn Joint>,
    /// Ends a and b.
    pub ends: [BoundEnd; 2],
}

/// One end of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundEnd {
    /// Place of the subsystem in the scene.
    pub subsystem: usize,
    /// Place of position, velocity and acceleration of the marker in [`Layout::outputs`] of the subsystem, up to the
    /// level of the layout.
    pub outputs: Vec<usize>,
}

/// An input of a subsystem and what drives it.
#[derive(Debug, Clone, PartialEq)]
pub struct DrivenInput {
    /// Place of the subsystem in the scene.
    pub subsystem: usize,
    /// Place among the driven inputs of its subsystem.
    pub place: usize,
    /// Its name in the model.
    pub name: String,
    /// The input is `sum factor variable` over these (variable, factor); see the constructors of [`Layout`].
    pub combination: Vec<(usize, f64)>,
}

/// A joint of the scene with the markers that it holds, found in the models' descriptions.
pub struct MarkedJoint {
    /// Name in the scene.
    pub name: String,
    /// Kind of joint.
    pub kind: JointKind,
    /// Subsystem and marker of ends a and b.
    pub ends: [(usize, v1::Marker); 2],
}

/// A marker cannot take part in a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MarkerLacks {
    /// Number of the joint.
    pub joint: usize,
    /// 0 for end a, 1 for end b.
    pub end: usize,
    /// What is missing.
    pub what: Lack,
}

/// What a marker may lack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lack {
    /// An output on this level.
    Output(Level),
    /// A spring-damper to a partner.
    Spring,
}

impl Layout {
    /// Ties `joints` to the inputs and outputs of `subsystems` many subsystems, reading up to `level`. The loads of
    /// multiplier number `r` act on both ends of joint number `r`.
    ///
    /// # Errors
    /// The first marker that lacks something.
    pub fn new(
        joints: &[MarkedJoint],
        subsystems: usize,
        level: Level,
    ) -> Result<Self, MarkerLacks> {
        let mut layout = Self::bind(joints, subsystems, level)?;
        for (row, joint) in joints.iter().enumerate() {
            for (end, (subsystem, marker)) in End::BOTH.into_iter().zip(&joint.ends) {
                let factor = layout.joints[row].law.load(end);
                layout.drive(*subsystem, &marker.load, (row, factor));
            }
        }
        layout.sort_inputs();
        Ok(layout)
    }

    /// Ties `joints` that are replaced by spring-dampers inside the subsystem at end a (force/displacement coupling).
    /// Of the variables `(forces, positions of b, velocities of b)`, each with one entry for a joint, the force loads
    /// end b and the motion of b is an input at end a.
    ///
    /// # Errors
    /// The first marker that lacks something.
    pub fn with_springs(joints: &[MarkedJoint], subsystems: usize) -> Result<Self, MarkerLacks> {
        let mut layout = Self::bind(joints, subsystems, Level::Velocity)?;
        let rows = joints.len();
        for (row, joint) in joints.iter().enumerate() {
            let [(a, spring_end), (b, load_end)] = &joint.ends;
            let spring = spring_end.spring.as_ref();
            let spring = spring.ok_or(MarkerLacks {
                joint: row,
                end: 0,
                what: Lack::Spring,
            })?;
            let factor = layout.joints[row].law.load(End::B);
            layout.drive(*a, &spring.partner_position, (rows + row, 1.0));
            layout.drive(*a, &spring.partner_velocity, (2 * rows + row, 1.0));
            layout.drive(*b, &load_end.load, (row, factor));
        }
        layout.sort_inputs();
        Ok(layout)
    }

    fn bind(joints: &[MarkedJoint], subsystems: usize, level: Level) -> Result<Self, MarkerLacks> {
        let mut layout = Self {
            joints: Vec::with_capacity(joints.len()),
            inputs: Vec::new(),
            outputs: vec![Vec::new(); subsystems],
            level,
        };
        for (row, joint) in joints.iter().enumerate() {
            let law = match joint.kind {
                JointKind::RigidLink => Box::new(RigidLink),
            };
            let ends = [
                layout.bind_end(row, 0, joint)?,
                layout.bind_end(row, 1, joint)?,
            ];
            layout.joints.push(BoundJoint {
                name: joint.name.clone(),
                law,
                ends,
            });
        }
        Ok(layout)
    }

    fn bind_end(
        &mut self,
        row: usize,
        end: usize,
        joint: &MarkedJoint,
    ) -> Result<BoundEnd, MarkerLacks> {
        let (subsystem, marker) = &joint.ends[end];
        let mut outputs = Vec::new();
        for &level in self.level.up_to() {
            let lack = MarkerLacks {
                joint: row,
                end,
                what: Lack::Output(level),
            };
            let name = output_of(marker, level).ok_or(lack)?;
            outputs.push(place_of(&mut self.outputs[*subsystem], name));
        }
        Ok(BoundEnd {
            subsystem: *subsystem,
            outputs,
        })
    }

    fn drive(&mut self, subsystem: usize, name: &str, term: (usize, f64)) {
        let mut own = self
            .inputs
            .iter_mut()
            .filter(|input| input.subsystem == subsystem);
        if let Some(input) = own.find(|input| input.name == name) {
            input.combination.push(term);
            return;
        }
        self.inputs.push(DrivenInput {
            subsystem,
            place: self.inputs_of(subsystem).count(),
            name: name.to_owned(),
            combination: vec![term],
        });
    }

    fn sort_inputs(&mut self) {
        self.inputs
            .sort_by_key(|input| (input.subsystem, input.place));
    }

    /// The driven inputs of one subsystem.
    pub fn inputs_of(&self, subsystem: usize) -> impl Iterator<Item = &DrivenInput> {
        self.inputs
            .iter()
            .filter(move |input| input.subsystem == subsystem)
    }

    /// Number of rows, which is the number of multipliers.
    pub fn rows(&self) -> usize {
        self.joints.len()
    }
}

/// Name of the marker's output on a level; the empty name of an absent field counts as none.
pub fn output_of(marker: &v1::Marker, level: Level) -> Option<&str> {
    let name = match level {
        Level::Position => Some(&marker.position),
        Level::Velocity => marker.velocity.as_ref(),
        Level::Acceleration => marker.acceleration.as_ref(),
    };
    name.map(String::as_str).filter(|name| !name.is_empty())
}

fn place_of(names: &mut Vec<String>, name: &str) -> usize {
    names
        .iter()
        .position(|known| known == name)
        .unwrap_or_else(|| {
            names.push(name.to_owned());
            names.len() - 1
        })
}
