//! A method that nothing but the registry names: a spring in place of every condition, whose force is held over the step. What a new
//! method needs is in this file.

mod run;

use serde::{Deserialize, Serialize};

use super::condition::SingularRow;
use super::definition::{Definition, Given, Lacking, Parameters};
use super::method::{Built, CouplingMethod, Reached};
use super::saved::{Saved, Unreadable};
use crate::joint::Level;
use crate::layout::Layout;
use crate::reading::formula::Steps;
use crate::reading::key::{Key, POSITIVE, Takes};
use crate::reading::reader::{Problems, Section};
use crate::signal::{Curve, Curves, History, Lagrange};
use crate::system::{Outputs, motion_of};

/// Its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Held {
    /// N/m
    pub spring: f64,
}

const KEYS: [Key; 1] = [Key::new("spring", Takes::Number(POSITIVE))
    .required("spring = 1e3")
    .means("stiffness, N/m")];

impl Definition for Held {
    const NAME: &'static str = "held";
    const KEYS: &'static [Key] = &KEYS;
    const HIGHEST_DEGREE: usize = 0;

    fn read(
        section: &Section<'_>,
        _steps: Option<Steps>,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let [spring] = section.fields(&KEYS, problems);
        let spring = spring?.number(problems)?;
        Some(Self { spring })
    }
}

impl Parameters for Held {
    fn level(&self) -> Level {
        Level::Position
    }

    fn closes_joints(&self) -> bool {
        false
    }

    fn build(&self, mut given: Given<'_>) -> Result<Built, Lacking> {
        let (layout, outputs) = (given.layout, given.outputs);
        forces(self.spring, layout, outputs, &mut given.values);
        let method = HeldForces {
            spring: self.spring,
            ends: given.values.clone(),
            history: given.history(),
            length: 0.0,
        };
        Ok(Built {
            method: Box::new(method),
            end: None,
            point: None,
        })
    }
}

#[derive(Clone, Serialize, Deserialize)]
struct HeldForces {
    spring: f64,
    history: History,
    ends: Vec<f64>,
    length: f64,
}

impl CouplingMethod for HeldForces {
    fn predict(&mut self, length: f64) {
        self.length = length;
    }

    fn lend(&self, to: &mut dyn FnMut(&dyn Curves, &dyn Curves)) {
        let held = Lagrange {
            history: &self.history,
            curve: Curve::Extrapolated,
            length: self.length,
        };
        to(&held, &held);
    }

    fn ends(&self) -> &[f64] {
        &self.ends
    }

    fn reached(&mut self, reached: Reached<'_>) -> Result<(), SingularRow> {
        forces(self.spring, reached.layout, reached.outputs, &mut self.ends);
        self.history.push(self.length, &self.ends);
        Ok(())
    }

    fn multipliers(&self) -> &[f64] {
        self.history.newest()
    }

    fn multipliers_at(&self, _tau: f64, layout: &Layout, at: &dyn Outputs, into: &mut [f64]) {
        forces(self.spring, layout, at, into);
    }

    fn state(&self) -> Saved {
        Saved::new(Held::NAME, self)
    }

    fn resume(&mut self, state: &Saved) -> Result<(), Unreadable> {
        *self = state.read(Held::NAME)?;
        Ok(())
    }
}

fn forces(spring: f64, layout: &Layout, outputs: &dyn Outputs, forces: &mut [f64]) {
    for (force, row) in forces.iter_mut().zip(&layout.rows) {
        let motion = motion_of(layout, row.joint, |subsystem| outputs.of(subsystem));
        let condition = layout.joints[row.joint].joint.condition(row.condition);
        let g = condition.value(Level::Position, &motion);
        *force = -condition.load_power() * spring * g;
    }
}
