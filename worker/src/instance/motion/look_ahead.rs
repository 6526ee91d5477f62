//! Looking ahead: steps and evaluations that leave the committed state.

use linchpin_proto::v1::{self, Failure};

use super::{Base, Motion, NOWHERE, find, tell};
use crate::Interval;

/// How far a prediction looks.
#[derive(Clone, Copy)]
pub(in crate::instance) enum Horizon {
    Step(Interval),
    Now(f64),
}

/// Which internal steps the solver takes.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::instance) enum Sequence {
    Own,
    Repeated,
}

impl Horizon {
    fn interval(self) -> Interval {
        match self {
            Self::Step(interval) => interval,
            Self::Now(start) => Interval { start, length: 0.0 },
        }
    }
}

impl Motion {
    /// Coupling outputs at the horizon under the present signals, and integrals over a step; the committed state stays.
    pub(in crate::instance) fn look_ahead(
        &mut self,
        base: Base,
        horizon: Horizon,
        sequence: Sequence,
        values: &mut Vec<f64>,
    ) -> Result<(), Failure> {
        self.go_to(base)?;
        if let Horizon::Step(interval) = horizon {
            self.integrate(interval, sequence)?;
        }
        self.read(horizon.interval(), v1::OutputSet::Coupling, values)?;
        match horizon {
            Horizon::Step(interval) => self.append_integrals(interval, values),
            Horizon::Now(_) => Ok(()),
        }
    }

    /// Looks ahead once for every perturbed signal, in place of the present signal of its input.
    pub(in crate::instance) fn look_ahead_perturbed(
        &mut self,
        base: Base,
        horizon: Horizon,
        perturbed: &[v1::Signal],
        outputs: &mut Vec<v1::Outputs>,
    ) -> Result<(), Failure> {
        outputs.resize_with(perturbed.len(), v1::Outputs::default);
        for (signal, outputs) in perturbed.iter().zip(outputs) {
            let replaced = self.signals.replace(signal)?;
            let done = self.look_ahead(base, horizon, Sequence::Repeated, &mut outputs.values);
            self.signals.put_back(replaced);
            done?;
        }
        Ok(())
    }

    /// Derivatives at the horizon under the present signals, one for each direction: of the outputs `wanted`, otherwise of the
    /// coupling outputs and of the integrals over a step.
    pub(in crate::instance) fn look_ahead_in_directions(
        &mut self,
        base: Base,
        horizon: Horizon,
        directions: &[v1::Signal],
        wanted: Option<&[usize]>,
        outputs: &mut Vec<v1::Outputs>,
    ) -> Result<(), Failure> {
        outputs.resize_with(directions.len(), v1::Outputs::default);
        for (direction, outputs) in directions.iter().zip(outputs) {
            self.signals.set_direction(direction)?;
            self.go_to(base)?;
            let interval = horizon.interval();
            self.begin_derivative(interval);
            let has_integrals = wanted.is_none() && interval.length > 0.0;
            let wanted = wanted.unwrap_or(&self.coupling_outputs);
            let values = &mut outputs.values;
            values.clear();
            values.resize(wanted.len(), 0.0);
            let (inputs, direction) = (self.signals.inputs(), self.signals.direction());
            self.subsystem
                .derivative(interval, inputs, direction, wanted, values)
                .map_err(|failure| tell(failure, interval.start, interval.length))?;
            if has_integrals {
                self.append_integrals(interval, values)?;
            }
        }
        Ok(())
    }

    /// Where the solver stands after it is not known, and it may have forgotten the internal steps of another step.
    fn begin_derivative(&mut self, interval: Interval) {
        if interval.length > 0.0 {
            self.derivatives += 1;
            let step = (interval, self.stands_at);
            self.last_step = self.last_step.filter(|last| *last == step);
        }
        self.stands_at = NOWHERE;
    }

    /// Outputs of the committed state by their names, and their derivatives in each direction.
    pub(in crate::instance) fn evaluate(
        &mut self,
        request: &v1::EvaluateRequest,
    ) -> Result<v1::EvaluateReply, Failure> {
        let t = request.t;
        if !t.is_finite() {
            return Err(Failure::misuse(
                "t",
                format!("t = {t}: it must be a finite number"),
            ));
        }
        let wanted = find(&self.outputs, &request.outputs, "outputs")?;
        self.signals.set(&request.signals)?;
        self.go_to(Base::Committed)?;
        let mut values = vec![0.0; wanted.len()];
        self.subsystem
            .outputs(t, self.signals.values_at(0.0), &wanted, &mut values)
            .map_err(|failure| tell(failure, t, 0.0))?;
        let mut derivatives = Vec::new();
        self.look_ahead_in_directions(
            Base::Committed,
            Horizon::Now(t),
            &request.directions,
            Some(&wanted),
            &mut derivatives,
        )?;
        Ok(v1::EvaluateReply {
            outputs: Some(v1::Outputs { values }),
            derivatives,
            ..v1::EvaluateReply::default()
        })
    }
}
