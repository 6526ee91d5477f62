//! Impacts within steps: handed to a solver that finds such itself; at any other one steps are cut there, and loads have impulses.

use linchpin_proto::exchange::{check_impacts, check_interface, is_until};
use linchpin_proto::v1::{self, Failure};

use super::{Motion, tell};
use crate::{Impact, Impacts, Interface, Interval};

/// How the steps that follow treat impacts.
pub(super) struct Treated {
    finds: bool,
    takes_impulses: bool,
    /// Whether the solver has been told anything but to find them alone.
    is_told: bool,
    /// Impulses at a solver that finds none itself, in the order of their instants.
    pub(super) strikes: Vec<Impact>,
    /// The impacts that are given to a solver that finds such.
    given: Option<Vec<Impact>>,
    /// Those that it has found in the parts of a step that is cut.
    found: Vec<Impact>,
    /// Memory of answers with more impacts.
    spare: Vec<v1::Impact>,
}

/// Impacts of a macro step, and contacts of an impact, for which there is memory from the first answer on.
const PREPARED: usize = 8;

/// Gives a list another length; what it does without keeps its memory in `spare`.
pub(in crate::instance) fn resize(
    list: &mut Vec<v1::Impact>,
    length: usize,
    spare: &mut Vec<v1::Impact>,
) {
    if list.capacity() == 0 {
        list.reserve(PREPARED);
        spare.extend((0..PREPARED).map(|_| v1::Impact {
            contacts: Vec::with_capacity(PREPARED),
            ..v1::Impact::default()
        }));
        spare.reserve(PREPARED);
    }
    while list.len() > length {
        spare.extend(list.pop());
    }
    while list.len() < length {
        list.push(spare.pop().unwrap_or_default());
    }
}

impl Treated {
    /// As the model offers it.
    pub(super) fn new(model: &v1::Model) -> Self {
        let capabilities = model.capabilities.unwrap_or_default();
        Self {
            finds: capabilities.impacts,
            takes_impulses: capabilities.impulses,
            is_told: false,
            strikes: Vec::new(),
            given: None,
            found: Vec::new(),
            spare: Vec::new(),
        }
    }
}

impl Motion {
    /// Lets the steps that follow, `length` (s) long, have the impacts of a request.
    pub(in crate::instance) fn treat_impacts(
        &mut self,
        length: f64,
        impacts: Option<&v1::Impacts>,
        interface: Option<&v1::Interface>,
    ) -> Result<(), Failure> {
        self.treated.strikes.clear();
        self.treated.given = None;
        self.treated.found.clear();
        if impacts.is_none() && interface.is_none() && !self.treated.is_told {
            return Ok(());
        }
        if let Some(impacts) = impacts {
            check_impacts(impacts, length, self.signals.len())?;
        }
        if let Some(interface) = interface {
            check_interface(interface, self.signals.len())?;
        }
        let how = match (impacts, interface) {
            (Some(_), Some(_)) => {
                let message = "impacts that are given need no interface: leave one of them out";
                return Err(Failure::misuse("interface", message.to_owned()));
            }
            (None, None) => Impacts::Alone,
            (None, Some(interface)) => Impacts::Coupled(self.interface(interface)),
            (Some(given), None) => {
                let given = given.impacts.iter();
                Impacts::Given(given.map(|impact| self.given(impact)).collect())
            }
        };
        if self.treated.finds {
            self.treated.is_told = how != Impacts::Alone;
            let told = self.subsystem.treat_impacts(&how);
            if let Impacts::Given(given) = how {
                self.treated.given = Some(given);
            }
            return told.map_err(|failure| Failure::misuse("impacts", failure.to_string()));
        }
        match how {
            Impacts::Given(strikes) if self.treated.takes_impulses => {
                self.treated.strikes = strikes;
                Ok(())
            }
            Impacts::Alone => Ok(()),
            Impacts::Given(_) => {
                let message =
                    "this model takes no impulses of loads: its capabilities do not say impulses";
                Err(Failure::misuse("impacts", message.to_owned()))
            }
            Impacts::Coupled(_) => {
                let message = "this model finds no impacts: its capabilities do not say impacts";
                Err(Failure::misuse("interface", message.to_owned()))
            }
        }
    }

    /// Lets the solver have those of its impacts that are in a part of the step, from and to these times after its start.
    pub(super) fn begin_part(&mut self, [from, to]: [f64; 2]) -> Result<(), Failure> {
        let Some(given) = &self.treated.given else {
            return Ok(());
        };
        let is_inside = |impact: &&Impact| {
            is_until(impact.at, to) && (from == 0.0 || !is_until(impact.at, from))
        };
        let own = given.iter().filter(is_inside).map(|impact| Impact {
            at: (impact.at - from).max(0.0),
            ..impact.clone()
        });
        let told = self.subsystem.treat_impacts(&Impacts::Given(own.collect()));
        told.map_err(|failure| Failure::misuse("impacts", failure.to_string()))
    }

    /// Keeps the impacts that the solver has found in a part of the step that began at this time after its start.
    pub(super) fn end_impacts_of_part(&mut self, from: f64) {
        if self.treated.finds {
            let found = self.subsystem.impacts().iter().map(|impact| Impact {
                at: from + impact.at,
                ..impact.clone()
            });
            self.treated.found.extend(found);
        }
    }

    /// Whether loads have impulses within the steps that follow.
    pub(super) fn is_struck(&self) -> bool {
        !self.treated.strikes.is_empty()
    }

    /// Whether the steps that follow are cut, at `instants` or where loads have impulses.
    pub(in crate::instance) fn is_cut(&self, instants: &[f64]) -> bool {
        !instants.is_empty() || self.is_struck()
    }

    /// Tells the impacts of the last step, cut at `instants` or not; nothing of a model that finds none.
    pub(in crate::instance) fn tell_impacts(
        &mut self,
        instants: &[f64],
        into: &mut Option<v1::Impacts>,
    ) {
        if !self.treated.finds {
            *into = None;
            return;
        }
        let found = match instants {
            [] => self.subsystem.impacts(),
            _ => &self.treated.found,
        };
        let told = &mut into.get_or_insert_default().impacts;
        resize(told, found.len(), &mut self.treated.spare);
        for (told, impact) in told.iter_mut().zip(found) {
            told.at = impact.at;
            told.contacts.clear();
            let contacts = impact.contacts.iter().map(|&number| number as u32);
            told.contacts.extend(contacts);
            told.multipliers.clone_from(&impact.multipliers);
        }
    }

    /// Lets the velocities jump by these impulses, at the end of a part of a step.
    pub(super) fn strike(
        &mut self,
        interval: Interval,
        at: f64,
        impulses: &[f64],
    ) -> Result<(), Failure> {
        let inputs = self.signals.values_at(at);
        if impulses.is_empty() {
            return Ok(());
        }
        self.subsystem
            .impulse(interval.start + at, inputs, impulses)
            .map_err(|failure| tell(failure, interval.start, interval.length))
    }

    /// A number for each input from those for each signal.
    fn spread(&self, of_signals: &[f64]) -> Vec<f64> {
        let mut of_inputs = vec![0.0; self.signals.inputs().len()];
        for (signal, &value) in of_signals.iter().enumerate() {
            if let Some(input) = self.signals.input(signal) {
                of_inputs[input] = value;
            }
        }
        of_inputs
    }

    fn given(&self, impact: &v1::Impact) -> Impact {
        let loads = match impact.loads.is_empty() {
            true => Vec::new(),
            false => self.spread(&impact.loads),
        };
        Impact {
            at: impact.at,
            contacts: impact
                .contacts
                .iter()
                .map(|&number| number as usize)
                .collect(),
            loads,
            multipliers: Vec::new(),
        }
    }

    fn interface(&self, interface: &v1::Interface) -> Interface {
        let signals = self.signals.len().max(1);
        let rows = interface.directions.chunks(signals);
        Interface {
            directions: rows.map(|row| self.spread(row)).collect(),
            mobility: interface.mobility.clone(),
        }
    }
}
