//! A run at a macro point with the states of its workers: all that another process needs to go on from there.

use linchpin_proto::v1::ExportedState;
use prost::Message;
use serde::{Deserialize, Serialize};

use super::CoSimulation;
use super::state::RunState;
use crate::error::RunError;

/// A run at a macro point. Any serde format keeps it that keeps all bits of numbers, also of infinite ones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    run: RunState,
    /// The states of the workers, in the encoding of the contract.
    workers: Vec<Vec<u8>>,
}

impl CoSimulation {
    /// The run at the present macro point. A worker that is lost from now on is brought back to this point as well.
    ///
    /// # Errors
    /// [`RunError::NotExported`] if the state of a worker cannot be had.
    pub fn checkpoint(&mut self) -> Result<Checkpoint, RunError> {
        let t = self.t();
        let run = self.state();
        let mut workers = Vec::new();
        for subsystem in &mut self.run.workers.subsystems {
            let exported = subsystem.export();
            let state = exported.map_err(|source| RunError::NotExported {
                subsystem: subsystem.name().to_owned(),
                t,
                source: Box::new(source),
            })?;
            workers.push(state.encode_to_vec());
            subsystem.remember_state(state);
        }
        Ok(Checkpoint { run, workers })
    }

    /// Goes on from `checkpoint` in place of the start of the same scene: all results are those that the run that wrote it would have
    /// had, bit by bit.
    ///
    /// # Errors
    /// The checkpoint belongs to another scene or another method, a worker refuses its state, and what ends a run.
    pub fn resume(&mut self, checkpoint: Checkpoint) -> Result<(), RunError> {
        self.check(&checkpoint.run)?;
        let subsystems = &mut self.run.workers.subsystems;
        if subsystems.len() != checkpoint.workers.len() {
            return Err(RunError::OtherRun(format!(
                "it has {} subsystems where this run has {}",
                checkpoint.workers.len(),
                subsystems.len()
            )));
        }
        for (subsystem, state) in subsystems.iter_mut().zip(&checkpoint.workers) {
            let state = ExportedState::decode(&state[..]).map_err(|error| {
                let name = subsystem.name();
                RunError::OtherRun(format!("the state of \"{name}\" cannot be read: {error}"))
            })?;
            let imported = subsystem.import(&state);
            imported.map_err(|source| RunError::NotImported {
                subsystem: subsystem.name().to_owned(),
                source: Box::new(source),
            })?;
            subsystem.remember_state(state);
        }
        self.go_on(checkpoint.run)
    }
}
