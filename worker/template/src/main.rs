//! A template: put your solver in the place of the free mass.

use std::error::Error;
use std::sync::Arc;

use linchpin_proto::v1;
use linchpin_worker::server::{Address, Reach, Server, runtime};
use linchpin_worker::setup::SetupError;
use linchpin_worker::{
    Cancel, Host, Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem,
};

/// Longest internal step in s.
const INTERNAL_STEP: f64 = 1e-3;

/// A free mass: m a = f.
struct Mine {
    m: f64,
    x: f64,
    v: f64,
}

impl Subsystem for Mine {
    /// Integrates over the step under inputs that are polynomials of time since its start.
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        let steps = (interval.length / INTERNAL_STEP).ceil().max(1.0);
        let h = interval.length / steps;
        let cancel = Cancel::current();
        for number in 0..steps as u64 {
            let start = number as f64 * h;
            // Nobody may wait for a long step any more.
            cancel.check(interval.start + start)?;
            let f = |tau: f64| inputs.value(0, tau);
            let (first, middle, last) = (f(start), f(start + h / 2.0), f(start + h));
            self.x += h * self.v + h * h / 6.0 * (first + 2.0 * middle) / self.m;
            self.v += h / 6.0 * (first + 4.0 * middle + last) / self.m;
        }
        Ok(())
    }

    /// The wanted outputs, by their places in the description, under the inputs at that time.
    fn outputs(
        &mut self,
        _t: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        let all = [self.x, self.v, inputs[0] / self.m];
        for (value, &output) in values.iter_mut().zip(wanted) {
            *value = all[output];
        }
        Ok(())
    }

    /// The whole state: whatever decides about the next step.
    fn snapshot(&self, into: &mut Snapshot) {
        into.put(&[self.x, self.v]);
    }

    /// Goes back to it. The same step must then give the same bits.
    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        let mut state = [0.0; 2];
        from.get(&mut state)?;
        [self.x, self.v] = state;
        Ok(())
    }
}

/// What a scene can ask for.
struct Masses;

impl Model for Masses {
    fn describe(&self) -> v1::Model {
        let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        v1::Model {
            name: "mine".into(),
            description: "a free mass: m a = f".into(),
            inputs: vec![variable("f", "N", "force on the mass", Some(0.0))],
            outputs: vec![
                variable("x", "m", "position", None),
                variable("v", "m/s", "velocity", None),
                variable("a", "m/s^2", "acceleration", None),
            ],
            parameters: vec![
                parameter("m", "kg", "mass, greater than 0", None),
                parameter("v0", "m/s", "velocity at the start", Some(0.0)),
            ],
            // Where joints hold: which outputs are the motion of the place, and which inputs take the load.
            markers: vec![v1::Marker {
                name: "mass".into(),
                kind: v1::MarkerKind::Scalar.into(),
                position: names(&["x"]),
                velocity: names(&["v"]),
                acceleration: names(&["a"]),
                load: names(&["f"]),
            }],
            solvers: vec![v1::SolverKind {
                name: "fixed-steps".into(),
                description: "exact for forces that are quadratic over an internal step".into(),
                ..Default::default()
            }],
            // True for fixed steps, and for a state that is written as numbers.
            capabilities: Some(v1::Capabilities {
                repeats_step_sequence: true,
                exportable_snapshot: true,
                ..Default::default()
            }),
            ..Default::default()
        }
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        Ok(Box::new(Mine {
            m: setup.positive_parameter("m")?,
            x: 0.0,
            v: setup.parameter("v0")?,
        }))
    }
}

fn variable(name: &str, unit: &str, description: &str, default: Option<f64>) -> v1::Variable {
    v1::Variable {
        name: name.into(),
        unit: unit.into(),
        description: description.into(),
        default,
    }
}

fn parameter(name: &str, unit: &str, description: &str, default: Option<f64>) -> v1::Parameter {
    v1::Parameter {
        name: name.into(),
        unit: unit.into(),
        description: description.into(),
        default,
    }
}

/// Serves at the address behind `--listen`, which the master gives, until it is ended.
fn main() -> Result<(), Box<dyn Error>> {
    runtime(1)?.block_on(serve())
}

async fn serve() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip_while(|own| own != "--listen").skip(1);
    let address: Address = arguments.next().unwrap_or("127.0.0.1:0".into()).parse()?;
    let host = Arc::new(Host::new(vec![Box::new(Masses)]));
    let server = Server::bind(host, address, Reach::Local).await?;
    println!("listening on {}", server.address());
    server.serve(std::future::pending()).await?;
    Ok(())
}
