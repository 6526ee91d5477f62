//! What requests say of impacts, and what answers do.

use linchpin_proto::v1;

use super::all::Workers;
use super::recovery::look;
use crate::error::RunError;
use crate::time::MacroStep;

impl Workers {
    /// The impacts that a subsystem has found in the last look-ahead over a step.
    pub(crate) fn found_impacts(&self, subsystem: usize) -> &[v1::Impact] {
        let found = self.subsystems[subsystem].reply.impacts.as_ref();
        found.map_or(&[], |found| &found.impacts)
    }

    /// Lets the look-ahead that is requested of a subsystem find impacts with this interface.
    pub(crate) fn let_find_impacts(&mut self, subsystem: usize, interface: v1::Interface) {
        if let Some(predict) = &mut self.subsystems[subsystem].request.predict {
            predict.interface = Some(interface);
        }
    }

    /// Lets the look-ahead that is requested of a subsystem, and all further steps over the same macro step, have these impacts.
    pub(crate) fn give_impacts(&mut self, subsystem: usize, impacts: v1::Impacts) {
        let subsystem = &mut self.subsystems[subsystem];
        if let Some(predict) = &mut subsystem.request.predict {
            predict.impacts = Some(impacts.clone());
        }
        subsystem.impacts = Some(impacts);
    }

    /// That a subsystem has told an impulse for each of its multipliers, all finite.
    pub(crate) fn check_impulses(
        &self,
        subsystem: usize,
        impulses: &[f64],
        expected: usize,
        step: MacroStep,
    ) -> Result<(), RunError> {
        self.subsystems[subsystem].check_impulses(impulses, expected, step)
    }

    /// The subsystems that are none of these.
    pub(crate) fn others(&self, subsystems: &[usize]) -> Vec<usize> {
        let all = 0..self.subsystems.len();
        all.filter(|number| !subsystems.contains(number)).collect()
    }

    /// Lets some subsystems look ahead as requested; the answers of the others stay.
    pub(crate) fn look_of(&mut self, numbers: &[usize], step: MacroStep) -> Result<(), RunError> {
        let subsystems = self.subsystems.iter_mut().enumerate();
        let some = subsystems.filter(|(number, _)| numbers.contains(number));
        let mut some: Vec<_> = some.map(|(_, subsystem)| subsystem).collect();
        look(&mut some, step)
    }
}
