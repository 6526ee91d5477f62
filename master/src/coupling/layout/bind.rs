//! Ties joints and connections to inputs and outputs.

use std::sync::Arc;

use linchpin_proto::joint_load::{End, Pose, Reads};
use linchpin_proto::v1::{self, MarkerKind};

use super::exchanged::{Exchanged, PoseVariables, Turning, What};
use super::input::{DrivenInput, Load, Source, TurningLoad};
use super::marker::{BoundEnd, Parts};
use super::{
    BoundJoint, Coupled, Lack, Layout, LoadForm, MarkedJoint, MarkerLacks, Row, column_name,
};
use crate::joint::Level;

/// Components of force and moment that a marker of a kind takes, in the order of its load inputs: 0 to 2 the force, 3 to 5
/// the moment.
fn load_components(kind: MarkerKind) -> &'static [usize] {
    match kind {
        MarkerKind::Planar => &[0, 1, 5],
        MarkerKind::Spatial => &[0, 1, 2, 3, 4, 5],
        MarkerKind::Scalar | MarkerKind::Unspecified => &[0],
    }
}

/// A layout in the making.
pub(super) struct Binder<'a> {
    pub(super) layout: Layout,
    coupled: &'a Coupled<'a>,
    loads: Vec<NamedLoad>,
}

/// A joint load whose signals are known by name.
struct NamedLoad {
    subsystem: usize,
    message: v1::JointLoad,
    multiplier: String,
    position: Vec<String>,
    rotation: Vec<String>,
    attitude: Vec<String>,
}

impl Layout {
    /// Ties joints and connections to inputs and outputs, reading up to `level`.
    ///
    /// # Errors
    /// The first marker that lacks something.
    pub fn new(coupled: &Coupled<'_>, level: Level) -> Result<Self, MarkerLacks> {
        let mut binder = Binder::new(coupled, level)?;
        for row in 0..binder.layout.rows.len() {
            for end in End::BOTH {
                binder.load_end(row, end)?;
            }
        }
        for connection in coupled.connections {
            let (subsystem, output) = &connection.from;
            let variable = binder.exchange_output(*subsystem, output);
            let (subsystem, input) = &connection.to;
            binder.drive(*subsystem, input, (variable, 1.0));
        }
        Ok(binder.finish())
    }
}

impl<'a> Binder<'a> {
    /// Joints and rows, without loads.
    pub(super) fn new(coupled: &'a Coupled<'a>, level: Level) -> Result<Self, MarkerLacks> {
        let subsystems = coupled.subsystems.len();
        let layout = Layout {
            joints: Vec::with_capacity(coupled.joints.len()),
            rows: Vec::new(),
            exchanged: Vec::new(),
            inputs: Vec::new(),
            joint_loads: vec![Vec::new(); subsystems],
            outputs: vec![Vec::new(); subsystems],
            level,
            ranges: vec![0..0; subsystems],
        };
        let mut binder = Self {
            layout,
            coupled,
            loads: Vec::new(),
        };
        for (number, joint) in coupled.joints.iter().enumerate() {
            binder.bind_joint(number, joint)?;
        }
        Ok(binder)
    }

    fn bind_joint(&mut self, number: usize, joint: &MarkedJoint) -> Result<(), MarkerLacks> {
        let Layout { outputs, level, .. } = &mut self.layout;
        let mut bind = |end: End| {
            let (subsystem, marker) = &joint.ends[end as usize];
            let reads = joint.joint.reads(end);
            let place = |name: &str| place_of(&mut outputs[*subsystem], name);
            BoundEnd::new(*subsystem, marker, reads, *level, place).map_err(|level| MarkerLacks {
                joint: number,
                end: end as usize,
                what: Lack::Output(level),
            })
        };
        let ends = [bind(End::A)?, bind(End::B)?];
        let conditions = 0..joint.joint.len();
        self.layout.rows.extend(conditions.map(|condition| Row {
            joint: number,
            condition,
        }));
        self.layout.joints.push(BoundJoint {
            name: joint.name.clone(),
            joint: Arc::clone(&joint.joint),
            ends,
        });
        Ok(())
    }

    /// Lets multiplier number `row` load the marker at one end.
    pub(super) fn load_end(&mut self, row: usize, end: End) -> Result<(), MarkerLacks> {
        let Row { joint, condition } = self.layout.rows[row];
        let marked = &self.coupled.joints[joint];
        let (subsystem, marker) = &marked.ends[end as usize];
        let Some(law) = marked.joint.condition(condition).law() else {
            let sign = match end {
                End::A => 1.0,
                End::B => -1.0,
            };
            let name = self.load_input(joint, end, 0)?;
            self.drive(*subsystem, &name, (row, sign));
            return Ok(());
        };
        let depends = End::BOTH.map(|of| law.load_reads(end, of));
        if depends == [Reads::default(); 2] {
            let unit = law.unit_wrench(end, &[Pose::default(); 2]);
            for (place, &component) in load_components(marker.kind()).iter().enumerate() {
                let factor = unit.component(component);
                if factor != 0.0 {
                    let name = self.load_input(joint, end, place)?;
                    self.drive(*subsystem, &name, (row, factor));
                }
            }
            return Ok(());
        }
        match self.coupled.forms[*subsystem] {
            LoadForm::Joint => self.joint_load(row, end, depends[end.other() as usize]),
            LoadForm::Wrench { degree } => self.turning_load(row, end, depends, degree),
        }
    }

    /// The name of an input that takes part of a load.
    fn load_input(&self, joint: usize, end: End, place: usize) -> Result<String, MarkerLacks> {
        let (_, marker) = &self.coupled.joints[joint].ends[end as usize];
        let name = marker.load.get(place).cloned();
        name.ok_or(MarkerLacks {
            joint,
            end: end as usize,
            what: Lack::Load,
        })
    }

    /// A load that the subsystem evaluates itself, S1's form.
    fn joint_load(&mut self, row: usize, end: End, partner: Reads) -> Result<(), MarkerLacks> {
        let Row { joint, condition } = self.layout.rows[row];
        let marked = &self.coupled.joints[joint];
        let (subsystem, marker) = &marked.ends[end as usize];
        let Some(law) = marked.joint.condition(condition).law() else {
            return Ok(());
        };
        let last = load_components(marker.kind()).len() - 1;
        self.load_input(joint, end, last)?;
        let poses = self.exchange_pose(joint, end.other(), partner)?;
        let multiplier = column_name(&marked.name, "lambda", marked.joint.name(condition));
        self.drive_joint(*subsystem, &multiplier, Source::Sum(vec![(row, 1.0)]));
        let mut named = NamedLoad {
            subsystem: *subsystem,
            message: law.to_message(&marker.name, end),
            multiplier,
            position: Vec::new(),
            rotation: Vec::new(),
            attitude: Vec::new(),
        };
        for &variable in &poses.position {
            named
                .position
                .push(self.drive_variable(*subsystem, variable));
        }
        match poses.turning {
            Turning::None => {}
            Turning::Angle(angle) => named.rotation.push(self.drive_variable(*subsystem, angle)),
            Turning::Vector { first, attitude } => {
                for variable in first..first + 3 {
                    named
                        .rotation
                        .push(self.drive_variable(*subsystem, variable));
                }
                for part in 0..4 {
                    let name = format!("attitude{attitude}.{part}");
                    self.drive_joint(*subsystem, &name, Source::Attitude { attitude, part });
                    named.attitude.push(name);
                }
            }
        }
        self.loads.push(named);
        Ok(())
    }

    /// A load that the subsystem takes as force and moment.
    fn turning_load(
        &mut self,
        row: usize,
        end: End,
        depends: [Reads; 2],
        degree: usize,
    ) -> Result<(), MarkerLacks> {
        let Row { joint, condition } = self.layout.rows[row];
        let marked = &self.coupled.joints[joint];
        let (subsystem, marker) = &marked.ends[end as usize];
        let Some(&law) = marked.joint.condition(condition).law() else {
            return Ok(());
        };
        let poses = [
            self.exchange_pose(joint, End::A, depends[0])?,
            self.exchange_pose(joint, End::B, depends[1])?,
        ];
        let acts = law.acts_by(end);
        for (place, &component) in load_components(marker.kind()).iter().enumerate() {
            let is_there = if component < 3 {
                acts.force
            } else {
                acts.moment
            };
            if !is_there {
                continue;
            }
            let turning = TurningLoad {
                multiplier: row,
                law,
                end,
                poses: poses.clone(),
            };
            let name = self.load_input(joint, end, place)?;
            let input = self.input(*subsystem, &name, false);
            input.source.add_turning(component, degree, turning);
        }
        Ok(())
    }

    /// Exchanges what is read of the pose of a joint's marker.
    fn exchange_pose(
        &mut self,
        joint: usize,
        end: End,
        reads: Reads,
    ) -> Result<PoseVariables, MarkerLacks> {
        let (subsystem, marker) = &self.coupled.joints[joint].ends[end as usize];
        let parts = Parts::of(marker.kind(), Level::Position);
        let lacks = MarkerLacks {
            joint,
            end: end as usize,
            what: Lack::Output(Level::Position),
        };
        let mut poses = PoseVariables::default();
        if reads.position {
            let names = marker.position.get(parts.position).ok_or(lacks)?;
            for name in names {
                poses.position.push(self.exchange_output(*subsystem, name));
            }
        }
        if reads.rotation {
            poses.turning = match marker.position.get(parts.rotation).ok_or(lacks)? {
                [w, x, y, z] => self.exchange_attitude(*subsystem, &marker.name, [w, x, y, z]),
                [angle] => Turning::Angle(self.exchange_output(*subsystem, angle)),
                _ => return Err(lacks),
            };
        }
        Ok(poses)
    }

    /// The variable of an exchanged output, made if it is not there.
    fn exchange_output(&mut self, subsystem: usize, output: &str) -> usize {
        let name = format!("{}.{output}", self.coupled.subsystems[subsystem]);
        let known = self.layout.exchanged.iter().find(|one| one.name == name);
        if let Some(known) = known {
            return known.first;
        }
        let place = place_of(&mut self.layout.outputs[subsystem], output);
        self.exchange(subsystem, name, What::Output(place))
    }

    fn exchange_attitude(
        &mut self,
        subsystem: usize,
        marker: &str,
        quaternion: [&String; 4],
    ) -> Turning {
        let name = format!("{}.{marker}.rotation", self.coupled.subsystems[subsystem]);
        let known = self.layout.exchanged.iter().find(|one| one.name == name);
        if let Some(Exchanged {
            first,
            what: What::Attitude { attitude, .. },
            ..
        }) = known
        {
            return Turning::Vector {
                first: *first,
                attitude: *attitude,
            };
        }
        let attitude = self.layout.attitudes().count();
        let outputs = &mut self.layout.outputs[subsystem];
        let places = quaternion.map(|part| place_of(outputs, part));
        let first = self.exchange(subsystem, name, What::Attitude { places, attitude });
        Turning::Vector { first, attitude }
    }

    fn exchange(&mut self, subsystem: usize, name: String, what: What) -> usize {
        let first = self.layout.variables();
        self.layout.exchanged.push(Exchanged {
            name,
            subsystem,
            first,
            what,
        });
        first
    }

    /// Adds a term to a model's input.
    pub(super) fn drive(&mut self, subsystem: usize, name: &str, term: (usize, f64)) {
        self.input(subsystem, name, false).source.add_fixed(term);
    }

    /// Sends a variable to a subsystem as a joint input and tells its name.
    fn drive_variable(&mut self, subsystem: usize, variable: usize) -> String {
        let name = format!("variable{variable}");
        self.drive_joint(subsystem, &name, Source::Sum(vec![(variable, 1.0)]));
        name
    }

    fn drive_joint(&mut self, subsystem: usize, name: &str, source: Source) {
        self.input(subsystem, name, true).source = source;
    }

    fn input(&mut self, subsystem: usize, name: &str, is_joint_input: bool) -> &mut DrivenInput {
        let inputs = &mut self.layout.inputs;
        let known = inputs.iter().position(|input| {
            input.subsystem == subsystem
                && input.name == name
                && input.is_joint_input == is_joint_input
        });
        let place = known.unwrap_or_else(|| {
            inputs.push(DrivenInput {
                subsystem,
                place: 0,
                name: name.to_owned(),
                is_joint_input,
                perturbed: None,
                source: Source::Sum(Vec::new()),
            });
            inputs.len() - 1
        });
        &mut inputs[place]
    }

    /// Orders the inputs as the subsystems list them and numbers their signals.
    pub(super) fn finish(self) -> Layout {
        let mut layout = self.layout;
        layout
            .inputs
            .sort_by_key(|input| (input.subsystem, input.is_joint_input));
        let mut start = 0;
        for (subsystem, range) in layout.ranges.iter_mut().enumerate() {
            let inputs = &mut layout.inputs[start..];
            let own = inputs.partition_point(|input| input.subsystem <= subsystem);
            // A subsystem whose outputs nobody reads has no response to tell.
            let is_read = !layout.outputs[subsystem].is_empty();
            let mut perturbed = 0..;
            for (place, input) in inputs[..own].iter_mut().enumerate() {
                input.place = place;
                input.perturbed = match input.source {
                    Source::Attitude { .. } => None,
                    Source::Sum(_) | Source::Load(_) if !is_read => None,
                    Source::Sum(_) | Source::Load(_) => perturbed.next(),
                };
            }
            *range = start..start + own;
            start += own;
        }
        for load in self.loads {
            let message = load.message(layout.inputs_of(load.subsystem));
            layout.joint_loads[load.subsystem].push(message);
        }
        layout
    }
}

impl NamedLoad {
    fn message(&self, inputs: &[DrivenInput]) -> v1::JointLoad {
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

impl Source {
    fn add_fixed(&mut self, term: (usize, f64)) {
        match self {
            Self::Sum(combination) => combination.push(term),
            Self::Load(load) => load.fixed.push(term),
            Self::Attitude { .. } => {}
        }
    }

    fn add_turning(&mut self, component: usize, degree: usize, turning: TurningLoad) {
        if let Self::Sum(fixed) = self {
            *self = Self::Load(Box::new(Load {
                component,
                fixed: std::mem::take(fixed),
                turning: Vec::new(),
                degree,
            }));
        }
        if let Self::Load(load) = self {
            load.turning.push(turning);
        }
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
