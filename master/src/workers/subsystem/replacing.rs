//! Another worker in the place of one that was lost: it is made as the lost one was, goes to the last state that is known, repeats
//! the macro steps behind that, and answers the exchange in which the other was lost. Its bits are those of the other.

use std::time::{Duration, Instant};

use linchpin_proto::contract::CallError;
use linchpin_proto::v1;

use super::Subsystem;
use super::recovery::random_number;
use crate::connection::{NotRecovered, StartError};
use crate::error::RunError;
use crate::results::Recoveries;
use crate::time::MacroStep;

/// Pause before the second attempt; the following ones are longer by [`LENGTHENING`], up to [`LONGEST_PAUSE`].
const FIRST_PAUSE: Duration = Duration::from_millis(100);
const LENGTHENING: u32 = 3;
const LONGEST_PAUSE: Duration = Duration::from_secs(1);

impl Subsystem {
    /// Takes note of the advance that the worker has just committed, and has its state exported from time to time.
    pub(super) fn remember_advance(&mut self) {
        let Some(advance) = &mut self.request.advance else {
            return;
        };
        if self.recovery.settings.attempts == 0 || !self.connection.is_renewable() {
            return;
        }
        let subsystem = &self.name;
        if let Err(error) = self.recovery.journal.push(advance) {
            tracing::warn!(subsystem, %error, "its inputs cannot be kept in TMPDIR any more: its loss will end the run");
            self.recovery.settings.attempts = 0;
            return;
        }
        if !self.recovery.exports
            || self.recovery.journal.steps() < self.recovery.settings.export_every
        {
            return;
        }
        match self.export() {
            Ok(state) => self.remember_state(state),
            // A worker that is lost is found to be so in the next exchange.
            Err(error) if error.is_loss() => {}
            Err(error) => {
                tracing::warn!(subsystem, %error, "its states cannot be exported any more: another worker in its place repeats more steps");
                self.recovery.exports = false;
            }
        }
    }

    /// The state at the present macro point, as bytes.
    pub(crate) fn export(&self) -> Result<v1::ExportedState, CallError> {
        let request = v1::ExportStateRequest {
            instance: self.instance,
        };
        let reply = self.connection.contract().export_state(&request)?;
        let state = reply.state.unwrap_or_default();
        state.check(&self.model, &state.writer)?;
        Ok(state)
    }

    /// Lets recoveries begin from a state at the present macro point.
    pub(crate) fn remember_state(&mut self, state: v1::ExportedState) {
        if self.connection.is_renewable() {
            self.recovery.state = Some(state);
            self.recovery.journal.clear();
        }
    }

    /// How often another worker took the place of a lost one.
    pub(crate) fn recoveries(&self) -> Recoveries {
        self.recovery.done
    }

    /// Goes on counting where another run stopped, whose instance did `work`.
    pub(crate) fn go_on(&mut self, work: v1::Work, recoveries: Recoveries) {
        self.work = work;
        self.recovery.earlier = work.contacts;
        self.recovery.done = recoveries;
    }

    /// Goes to an exported state.
    pub(crate) fn import(&mut self, state: &v1::ExportedState) -> Result<(), CallError> {
        self.sequence += 1;
        let request = v1::ImportStateRequest {
            instance: self.instance,
            sequence: self.sequence,
            state: Some(state.clone()),
        };
        self.connection.contract().import_state(&request).map(drop)
    }

    /// Puts another worker in the place of the one that was `lost` during an exchange, and has the answer from that.
    pub(super) fn recover(&mut self, lost: CallError, step: MacroStep) -> Result<(), RunError> {
        let lost = self.failed(lost, step);
        let mut attempts = 0;
        let mut pause = Duration::ZERO;
        let mut last: Option<NotRecovered> = None;
        while attempts < self.recovery.settings.attempts && self.connection.is_renewable() {
            attempts += 1;
            let because: &dyn std::fmt::Display = match &last {
                Some(last) => last,
                None => &lost,
            };
            tracing::warn!(subsystem = %self.name, attempt = attempts, "another worker takes the place of a lost one: {because}");
            std::thread::sleep(pause);
            pause = (LENGTHENING * pause).clamp(FIRST_PAUSE, LONGEST_PAUSE);
            let began = Instant::now();
            last = Some(match self.replace() {
                Ok(Ok(())) => {
                    self.recovery.done.count(began.elapsed());
                    return Ok(());
                }
                Ok(Err(error)) if error.is_loss() => error.into(),
                Ok(Err(error)) => return Err(self.failed(error, step)),
                Err(NotRecovered::Start(StartError::Call(CallError::Interrupted))) => {
                    return Err(self.failed(CallError::Interrupted, step));
                }
                Err(because @ (NotRecovered::Journal(_) | NotRecovered::OtherBits { .. })) => {
                    last = Some(because);
                    break;
                }
                Err(because) => because,
            });
        }
        match last {
            None => Err(lost),
            Some(because) => Err(RunError::NotRecovered {
                lost: Box::new(lost),
                attempts,
                because: Box::new(because),
            }),
        }
    }

    /// Makes a worker anew, brings it to the present macro point and sends it the request once more: gives its answer, if it came so
    /// far.
    fn replace(&mut self) -> Result<Result<(), CallError>, NotRecovered> {
        self.connection.renew()?;
        // A worker that has lost nothing but its connection still has the old instance.
        let _ = self.terminate();
        self.instance = random_number(&self.name);
        self.sequence = 0;
        self.recovery.initialize.instance = self.instance;
        self.recovery.initialize.sequence = self.sequence;
        let initialize = &self.recovery.initialize;
        self.connection.contract().initialize(initialize)?;
        self.recovery.earlier = self.work.contacts;
        if let Some(state) = self.recovery.state.take() {
            let imported = self.import(&state);
            self.recovery.state = Some(state);
            imported?;
        }
        self.repeat_advances()?;
        self.label_request();
        let posted = self.connection.post(&self.request);
        Ok(posted.and_then(|()| self.connection.collect(&mut self.reply)))
    }

    /// Repeats the macro steps behind the last state that was exported. The last one must have the outputs that it had before.
    fn repeat_advances(&mut self) -> Result<(), NotRecovered> {
        let mut request = v1::ExchangeRequest {
            instance: self.instance,
            ..v1::ExchangeRequest::default()
        };
        let mut reply = v1::ExchangeReply::default();
        let steps = self.recovery.journal.steps();
        let mut work = v1::Work::default();
        let mut advances = self.recovery.journal.read()?;
        for _ in 0..steps {
            self.sequence += 1;
            request.sequence = self.sequence;
            request.advance = Some(advances.next()?);
            self.connection.post(&request)?;
            self.connection.collect(&mut reply)?;
            work += reply.work.unwrap_or_default();
        }
        drop(advances);
        self.work += self.recovery.whole(work);
        self.recovery.done.repeated_steps += steps;
        let reached = reply.advanced.unwrap_or_default().values;
        let named = self.output_names.iter().zip(&self.outputs);
        let other = named
            .zip(&reached)
            .find(|((_, expected), found)| expected.to_bits() != found.to_bits());
        match other {
            None => Ok(()),
            Some(((variable, &expected), &found)) => Err(NotRecovered::OtherBits {
                variable: variable.clone(),
                found,
                expected,
            }),
        }
    }
}
