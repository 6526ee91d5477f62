//! Ties joints and connections to inputs and outputs.

use std::ops::Range;
use std::sync::Arc;

use linchpin_proto::joint_load::{End, Reads};

use super::border::Border;
use super::bound::{BoundJoint, Layout, Row};
use super::coupled::{Coupled, Lack, MarkedJoint, MarkerLacks};
use super::exchanged::{Exchanged, PoseVariables, Rates, Turning, What};
use super::input::{DrivenInput, Source};
use super::inside::Inside;
use super::marker::{BoundEnd, Parts, outputs_of};
use super::named_load::NamedLoad;
use crate::joint::Level;

/// A layout in the making.
pub(super) struct Binder<'a> {
    pub(super) layout: Layout,
    pub(super) coupled: &'a Coupled<'a>,
    pub(super) loads: Vec<NamedLoad>,
    has_rates: bool,
}

impl Layout {
    /// Ties joints and connections to inputs and outputs, reading up to `level`.
    ///
    /// # Errors
    /// The first marker that lacks something.
    pub fn new(coupled: &Coupled<'_>, level: Level) -> Result<Self, MarkerLacks> {
        Self::tied(coupled, level, false)
    }

    /// The same, but exchanged motion comes with its rates up to `level`.
    ///
    /// # Errors
    /// The first marker that lacks something.
    pub fn with_rates(coupled: &Coupled<'_>, level: Level) -> Result<Self, MarkerLacks> {
        Self::tied(coupled, level, true)
    }

    fn tied(coupled: &Coupled<'_>, level: Level, has_rates: bool) -> Result<Self, MarkerLacks> {
        let mut binder = Binder::new(coupled, level)?;
        binder.has_rates = has_rates;
        for row in 0..binder.layout.rows.len() {
            for end in End::BOTH {
                binder.load_end(row, end)?;
            }
        }
        for connection in coupled.connections {
            let (subsystem, output) = &connection.from;
            let variable = binder.exchange_output(*subsystem, output, None);
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
            subsystems: coupled.subsystems.iter().map(ToString::to_string).collect(),
            joints: Vec::with_capacity(coupled.joints.len()),
            rows: Vec::new(),
            exchanged: Vec::new(),
            inputs: Vec::new(),
            joint_loads: vec![Vec::new(); subsystems],
            frames: Vec::new(),
            outputs: vec![Vec::new(); subsystems],
            border: Border::default(),
            level,
            inside: Inside::default(),
            ranges: vec![0..0; subsystems],
        };
        let mut binder = Self {
            layout,
            coupled,
            loads: Vec::new(),
            has_rates: false,
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

    /// Exchanges what is read of the pose of a joint's marker.
    pub(super) fn exchange_pose(
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
            let names = marker.position.get(parts.position.clone()).ok_or(lacks)?;
            for (name, place) in names.iter().zip(parts.position) {
                let rates = self.rates(joint, end, place..place + 1)?;
                let variable = self.exchange_output(*subsystem, name, rates);
                poses.position.push(variable);
            }
        }
        if reads.rotation {
            let turning = Parts::of(marker.kind(), Level::Velocity).rotation;
            let rates = self.rates(joint, end, turning)?;
            poses.turning = match marker.position.get(parts.rotation).ok_or(lacks)? {
                [w, x, y, z] => {
                    self.exchange_attitude(*subsystem, &marker.name, [w, x, y, z], rates)
                }
                [angle] => Turning::Angle(self.exchange_output(*subsystem, angle, rates)),
                _ => return Err(lacks),
            };
        }
        Ok(poses)
    }

    /// Where the rates of a marker's motion stand, if they are exchanged with it; `places` in the lists of the marker.
    fn rates(
        &mut self,
        joint: usize,
        end: End,
        places: Range<usize>,
    ) -> Result<Option<Rates>, MarkerLacks> {
        if !self.has_rates {
            return Ok(None);
        }
        let (subsystem, marker) = &self.coupled.joints[joint].ends[end as usize];
        let level = self.layout.level;
        let outputs = &mut self.layout.outputs[*subsystem];
        let mut find = |of: Level| {
            if of > level {
                return Ok(Vec::new());
            }
            let names = outputs_of(marker, of).get(places.clone());
            let names = names.ok_or(MarkerLacks {
                joint,
                end: end as usize,
                what: Lack::Output(of),
            })?;
            Ok(names.iter().map(|name| place_of(outputs, name)).collect())
        };
        Ok(Some(Rates {
            speed: find(Level::Velocity)?,
            acceleration: find(Level::Acceleration)?,
        }))
    }

    /// The variable of an exchanged output, made if it is not there.
    fn exchange_output(&mut self, subsystem: usize, output: &str, rates: Option<Rates>) -> usize {
        let name = format!("{}.{output}", self.coupled.subsystems[subsystem]);
        let known = self.layout.exchanged.iter().find(|one| one.name == name);
        if let Some(known) = known {
            return known.first;
        }
        let place = place_of(&mut self.layout.outputs[subsystem], output);
        self.exchange(subsystem, name, What::Output(place), rates)
    }

    fn exchange_attitude(
        &mut self,
        subsystem: usize,
        marker: &str,
        quaternion: [&String; 4],
        rates: Option<Rates>,
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
        let first = self.exchange(subsystem, name, What::Attitude { places, attitude }, rates);
        Turning::Vector { first, attitude }
    }

    fn exchange(
        &mut self,
        subsystem: usize,
        name: String,
        what: What,
        rates: Option<Rates>,
    ) -> usize {
        let first = self.layout.variables();
        self.layout.exchanged.push(Exchanged {
            name,
            subsystem,
            first,
            what,
            rates,
        });
        first
    }

    /// Adds a term to a model's input.
    pub(super) fn drive(&mut self, subsystem: usize, name: &str, term: (usize, f64)) {
        self.input(subsystem, name, false).source.add_fixed(term);
    }

    /// Sends a variable to a subsystem as a joint input and tells its name.
    pub(super) fn drive_variable(&mut self, subsystem: usize, variable: usize) -> String {
        let name = format!("variable{variable}");
        self.drive_joint(subsystem, &name, Source::Sum(vec![(variable, 1.0)]));
        name
    }

    pub(super) fn drive_joint(&mut self, subsystem: usize, name: &str, source: Source) {
        self.input(subsystem, name, true).source = source;
    }

    pub(super) fn input(
        &mut self,
        subsystem: usize,
        name: &str,
        is_joint_input: bool,
    ) -> &mut DrivenInput {
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
                is_perturbed: false,
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
            for (place, input) in inputs[..own].iter_mut().enumerate() {
                input.place = place;
                input.is_perturbed = is_read && !matches!(input.source, Source::Attitude { .. });
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

/// The place of a name, which is added if it is not there.
pub(super) fn place_of(names: &mut Vec<String>, name: &str) -> usize {
    names
        .iter()
        .position(|known| known == name)
        .unwrap_or_else(|| {
            names.push(name.to_owned());
            names.len() - 1
        })
}
