//! A model whose steps are known in closed form: `level' = inflow - leak`, with a solver that can fail and panic.

use std::time::Duration;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem};

/// Level at the start (m).
pub const START: f64 = 0.375;
/// Value of the input `leak` when nobody drives it (m/s).
pub const LEAK: f64 = 0.21;

/// The input `inflow` must be driven; `leak` has a default. A step that ends above the parameter `capacity` fails after
/// it has changed the level, one that ends below 0 panics. Every step sleeps for `pause` seconds. The output `repeated`
/// is 1 after a step that repeated the internal steps of the one before, otherwise 0.
pub struct Tank;

struct Filling {
    level: f64,
    capacity: f64,
    pause: Duration,
    steps: u64,
    repeated: bool,
}

const INFLOW: usize = 0;
const LEAK_INPUT: usize = 1;

impl Model for Tank {
    fn describe(&self) -> v1::Model {
        let variable = |name: &str, default| v1::Variable {
            name: name.into(),
            unit: "m/s".into(),
            default,
            ..Default::default()
        };
        let parameter = |name: &str, default| v1::Parameter {
            name: name.into(),
            default,
            ..Default::default()
        };
        v1::Model {
            name: "tank".into(),
            inputs: vec![variable("inflow", None), variable("leak", Some(LEAK))],
            outputs: ["level", "rate", "repeated"]
                .map(|name| variable(name, None))
                .into(),
            parameters: vec![parameter("capacity", None), parameter("pause", Some(0.0))],
            ..v1::Model::default()
        }
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        Ok(Box::new(Filling {
            level: START,
            capacity: setup.positive_parameter("capacity")?,
            pause: Duration::from_secs_f64(setup.non_negative_parameter("pause")?),
            steps: 0,
            repeated: false,
        }))
    }
}

impl Subsystem for Filling {
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        std::thread::sleep(self.pause);
        self.steps += 1;
        self.repeated = false;
        let volume = |input| {
            let powers = inputs.polynomial(input).powers(interval.length);
            let mean: f64 = (1u8..).zip(powers).map(|(n, a)| a / f64::from(n)).sum();
            mean * interval.length
        };
        self.level += volume(INFLOW) - volume(LEAK_INPUT);
        assert!(self.level >= 0.0, "the tank is empty");
        if self.level > self.capacity {
            return Err(StepFailure::Recoverable {
                t: interval.end(),
                message: format!("the tank overflows: {} m", self.level),
            });
        }
        Ok(())
    }

    fn perturbed_step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        let done = self.step(interval, inputs);
        self.repeated = true;
        done
    }

    fn outputs(
        &mut self,
        _t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        for (value, &output) in values.iter_mut().zip(wanted) {
            let rate = inputs[INFLOW] - inputs[LEAK_INPUT];
            let repeated = f64::from(u8::from(self.repeated));
            *value = [self.level, rate, repeated][output];
        }
        Ok(())
    }

    fn snapshot(&self, into: &mut Snapshot) {
        into.put(&[self.level]);
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        from.get(std::slice::from_mut(&mut self.level))
    }

    fn internal_steps(&self) -> u64 {
        self.steps
    }
}
