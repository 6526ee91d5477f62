//! The loads of joints on their markers: of fixed direction, evaluated by the subsystem, or sent as force and moment.

use linchpin_proto::joint_load::{End, Pose, Reads};
use linchpin_proto::v1::MarkerKind;

use super::bind::Binder;
use super::bound::{Row, column_name};
use super::coupled::{Lack, LoadForm, MarkerLacks};
use super::exchanged::Turning;
use super::input::{Source, TurningLoad};
use super::named_load::NamedLoad;

/// Components of force and moment that a marker of a kind takes, in the order of its load inputs: 0 to 2 the force, 3 to 5
/// the moment.
fn load_components(kind: MarkerKind) -> &'static [usize] {
    match kind {
        MarkerKind::Planar => &[0, 1, 5],
        MarkerKind::Spatial => &[0, 1, 2, 3, 4, 5],
        MarkerKind::Scalar | MarkerKind::Unspecified => &[0],
    }
}

impl Binder<'_> {
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
}
