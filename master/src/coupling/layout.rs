//! Which outputs of which subsystem the joints read, and which inputs they load.

use std::ops::Range;

use linchpin_proto::v1;

use crate::joint::{End, Joint, Level};

/// The joints of a scene tied to places in the subsystems' inputs and outputs.
pub struct Layout {
    /// Joints in the order of the scene.
    pub joints: Vec<BoundJoint>,
    /// Rows of all joints in their order; row `r` has multiplier number `r`.
    pub rows: Vec<Row>,
    /// Driven inputs of all subsystems, subsystem by subsystem.
    pub inputs: Vec<DrivenInput>,
    /// For each subsystem the names of the outputs that the joints read, each once.
    pub outputs: Vec<Vec<String>>,
    /// Highest level of the conditions.
    pub level: Level,
}

/// One scalar condition of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Row {
    /// Number of the joint.
    pub joint: usize,
    /// Number of the condition in the joint.
    pub condition: usize,
}

/// A joint and its two ends.
pub struct BoundJoint {
    /// Name in the scene.
    pub name: String,
    /// Conditions and loads.
    pub law: Box<dyn Joint>,
    /// Ends a and b.
    pub ends: [BoundEnd; 2],
}

/// One end of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundEnd {
    /// Place of the subsystem in the scene.
    pub subsystem: usize,
    /// For each level up to that of the layout, the places in [`Layout::outputs`] of the components that the joint reads.
    pub outputs: Vec<Vec<usize>>,
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
    /// Makes the law.
    pub law: fn() -> Box<dyn Joint>,
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
    /// An input for the load.
    Load,
    /// A spring-damper to a partner.
    Spring,
}

impl Layout {
    /// Ties `joints` to the inputs and outputs of `subsystems` many subsystems, reading up to `level`. The loads of
    /// multiplier number `r` act on both ends of the joint of row `r`.
    ///
    /// # Errors
    /// The first marker that lacks something.
    pub fn new(
        joints: &[MarkedJoint],
        subsystems: usize,
        level: Level,
    ) -> Result<Self, MarkerLacks> {
        let mut layout = Self::bind(joints, subsystems, level)?;
        for row in 0..layout.rows.len() {
            for end in End::BOTH {
                layout.load_end(&joints[layout.rows[row].joint], row, end)?;
            }
        }
        layout.sort_inputs();
        Ok(layout)
    }

    /// Ties `joints` that are replaced by spring-dampers inside the subsystem at end a (force/displacement coupling).
    /// Of the variables `(forces, positions of b, velocities of b)`, each with one entry for a row, the force loads
    /// end b and the motion of b is an input at end a. Several joints with end a at one marker share its spring: their
    /// forces are those of one spring, [`springs_at`] times as stiff, to the mean of the partners.
    ///
    /// # Errors
    /// The first marker that lacks something.
    pub fn with_springs(joints: &[MarkedJoint], subsystems: usize) -> Result<Self, MarkerLacks> {
        let mut layout = Self::bind(joints, subsystems, Level::Velocity)?;
        let rows = layout.rows.len();
        for row in 0..rows {
            let joint = layout.rows[row].joint;
            let (a, marker) = &joints[joint].ends[0];
            let share = 1.0 / springs_at(joints, *a, marker);
            let spring = marker.spring.as_ref();
            let spring = spring.ok_or(MarkerLacks {
                joint,
                end: 0,
                what: Lack::Spring,
            })?;
            layout.drive(*a, &spring.partner_position, (rows + row, share));
            layout.drive(*a, &spring.partner_velocity, (2 * rows + row, share));
            layout.load_end(&joints[joint], row, End::B)?;
        }
        layout.sort_inputs();
        Ok(layout)
    }

    fn bind(joints: &[MarkedJoint], subsystems: usize, level: Level) -> Result<Self, MarkerLacks> {
        let mut layout = Self {
            joints: Vec::with_capacity(joints.len()),
            rows: Vec::new(),
            inputs: Vec::new(),
            outputs: vec![Vec::new(); subsystems],
            level,
        };
        for (number, joint) in joints.iter().enumerate() {
            let law = (joint.law)();
            let mut bind = |end| layout.bind_end(number, end, joint, law.reads());
            let ends = [bind(End::A)?, bind(End::B)?];
            let conditions = 0..law.rows().len();
            layout.rows.extend(conditions.map(|condition| Row {
                joint: number,
                condition,
            }));
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
        number: usize,
        end: End,
        joint: &MarkedJoint,
        reads: &[usize],
    ) -> Result<BoundEnd, MarkerLacks> {
        let (subsystem, marker) = &joint.ends[end as usize];
        let mut outputs = Vec::new();
        for &level in self.level.up_to() {
            let names = outputs_of(marker, level);
            let what = Lack::Output(level);
            let lack = MarkerLacks {
                joint: number,
                end: end as usize,
                what,
            };
            let mut places = Vec::with_capacity(reads.len());
            for &component in reads {
                let name = names.get(component).ok_or(lack)?;
                places.push(place_of(&mut self.outputs[*subsystem], name));
            }
            outputs.push(places);
        }
        Ok(BoundEnd {
            subsystem: *subsystem,
            outputs,
        })
    }

    /// Lets multiplier number `row` load the marker at one end.
    fn load_end(&mut self, joint: &MarkedJoint, row: usize, end: End) -> Result<(), MarkerLacks> {
        let Row {
            joint: number,
            condition,
        } = self.rows[row];
        let (subsystem, marker) = &joint.ends[end as usize];
        let law = &self.joints[number].law;
        let loads: Vec<(usize, f64)> = law
            .loads()
            .iter()
            .enumerate()
            .map(|(component, &place)| (place, law.load(condition, end, component)))
            .collect();
        for (place, factor) in loads.into_iter().filter(|(_, factor)| *factor != 0.0) {
            let lack = MarkerLacks {
                joint: number,
                end: end as usize,
                what: Lack::Load,
            };
            let name = marker.load.get(place).ok_or(lack)?;
            self.drive(*subsystem, name, (row, factor));
        }
        Ok(())
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

    /// Places of these in [`Layout::inputs`].
    pub fn input_range(&self, subsystem: usize) -> Range<usize> {
        let start = self
            .inputs
            .partition_point(|input| input.subsystem < subsystem);
        start
            ..self
                .inputs
                .partition_point(|input| input.subsystem <= subsystem)
    }

    /// The joint of a row.
    pub fn joint_of(&self, row: usize) -> &BoundJoint {
        &self.joints[self.rows[row].joint]
    }

    /// Name of a row in result columns: `JOINT.what`, with `.x` and the like if the joint has several rows.
    pub fn column_name(&self, row: usize, what: &str) -> String {
        let joint = self.joint_of(row);
        column_name(
            &joint.name,
            what,
            joint.law.rows()[self.rows[row].condition],
        )
    }
}

/// Name of the result column of one condition of a joint.
pub fn column_name(joint: &str, what: &str, part: &str) -> String {
    match part {
        "" => format!("{joint}.{what}"),
        part => format!("{joint}.{what}.{part}"),
    }
}

/// Number of joints that have end a at this marker.
pub fn springs_at(joints: &[MarkedJoint], subsystem: usize, marker: &v1::Marker) -> f64 {
    let ends = joints.iter().map(|joint| &joint.ends[0]);
    let here = ends.filter(|(a, other)| *a == subsystem && other.name == marker.name);
    here.count() as f64
}

/// Names of the marker's outputs on a level.
pub fn outputs_of(marker: &v1::Marker, level: Level) -> &[String] {
    match level {
        Level::Position => &marker.position,
        Level::Velocity => &marker.velocity,
        Level::Acceleration => &marker.acceleration,
    }
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
