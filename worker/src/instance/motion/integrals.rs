//! Integrals of outputs over a step.
//!
//! They begin anew with every step, so they belong to no state: whoever goes back to one has nothing of them to restore.

use linchpin_proto::exchange::check_integrals;
use linchpin_proto::v1::{self, Failure};
use linchpin_proto::weights::add_part;

use super::{Motion, tell};
use crate::Interval;

/// The outputs that are integrated, and by how many weights at present.
pub(super) struct Integrated {
    outputs: Vec<usize>,
    weights: usize,
    /// Integrals over a part of a step.
    of_part: Vec<f64>,
}

impl Integrated {
    /// For outputs that a master has named.
    pub(super) fn new(outputs: Vec<usize>, model: &v1::Model) -> Result<Self, Failure> {
        let capabilities = model.capabilities.unwrap_or_default();
        if !outputs.is_empty() && !capabilities.output_integrals {
            return Err(Failure::misuse(
                "integrated_outputs",
                format!(
                    "the model {} does not offer integrals of outputs; leave integrated_outputs empty where the capabilities do not say \
                     output_integrals",
                    model.name
                ),
            ));
        }
        Ok(Self {
            outputs,
            weights: 0,
            of_part: Vec::new(),
        })
    }

    /// Number of integrals that a step is answered with.
    pub(super) fn values(&self) -> usize {
        self.outputs.len() * self.weights
    }
}

impl Motion {
    /// Lets the steps that follow have as many integrals of each output as a request wants.
    pub(in crate::instance) fn integrate_outputs(&mut self, integrals: u32) -> Result<(), Failure> {
        let weights = check_integrals(integrals)?;
        let own = &mut self.integrated;
        if own.outputs.is_empty() || weights == own.weights {
            return Ok(());
        }
        let wanted = self.subsystem.integrate_outputs(&own.outputs, weights);
        wanted.map_err(|failure| Failure::misuse("integrals", failure.to_string()))?;
        own.weights = weights;
        Ok(())
    }

    /// Appends the integrals over the step that was taken last.
    pub(super) fn append_integrals(
        &mut self,
        interval: Interval,
        values: &mut Vec<f64>,
    ) -> Result<(), Failure> {
        let at_end = values.len();
        values.resize(at_end + self.integrated.values(), 0.0);
        self.read_integrals(interval, &mut values[at_end..])
    }

    /// Adds what the part of a step that was taken last, between these times since its start, has to its integrals.
    pub(super) fn add_integrals_of_part(
        &mut self,
        interval: Interval,
        part: [f64; 2],
        whole: &mut [f64],
    ) -> Result<(), Failure> {
        if whole.is_empty() {
            return Ok(());
        }
        let mut of_part = std::mem::take(&mut self.integrated.of_part);
        of_part.clear();
        of_part.resize(whole.len(), 0.0);
        let read = self.read_integrals(interval, &mut of_part);
        if read.is_ok() {
            let shares = part.map(|time| time / interval.length);
            add_part(shares, self.integrated.outputs.len(), &of_part, whole);
        }
        self.integrated.of_part = of_part;
        read
    }

    fn read_integrals(&self, interval: Interval, values: &mut [f64]) -> Result<(), Failure> {
        if values.is_empty() {
            return Ok(());
        }
        let read = self.subsystem.integrals(values);
        read.map_err(|failure| tell(failure, interval.start, interval.length))
    }
}
