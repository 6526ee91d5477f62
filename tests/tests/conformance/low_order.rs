//! Sound workers whose solvers have a low order and fixed steps: two masses between springs, one of them stiff.

use std::sync::Arc;

use linchpin::conformance::Settings;
use linchpin::conformance::verdict::Grade;
use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Host, Inputs, Interval, Model, Setup, Snapshot, StepFailure, Subsystem};

use crate::subjects::examine;

/// Macro step (s).
const STEP: f64 = 1e-3;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Scheme {
    ExplicitEuler,
    SymplecticEuler,
    ImplicitEuler,
    Midpoint,
    /// Chung and Hulbert's, with the spectral radius at infinite frequency.
    GeneralizedAlpha(f64),
}

#[derive(Debug, Clone, Copy)]
struct Masses {
    scheme: Scheme,
    /// Longest internal step (s).
    dt: f64,
    /// Stiffness of the second spring (N/m).
    stiff: f64,
}

const MASSES: [f64; 2] = [1.5, 0.4];
const DAMPING: f64 = 0.3;

impl Model for Masses {
    fn describe(&self) -> v1::Model {
        let variable = |name: &str, unit: &str| v1::Variable {
            name: name.into(),
            unit: unit.into(),
            default: Some(0.0),
            ..Default::default()
        };
        let marker = |n: usize| v1::Marker {
            name: format!("mass{n}"),
            kind: v1::MarkerKind::Scalar.into(),
            position: vec![format!("x{n}")],
            velocity: vec![format!("v{n}")],
            acceleration: vec![format!("a{n}")],
            load: vec![format!("f{n}")],
        };
        let units = ["m", "m/s", "m/s^2"];
        let outputs = [1, 2].into_iter().flat_map(|n| {
            ["x", "v", "a"]
                .into_iter()
                .zip(units)
                .map(move |(kind, unit)| variable(&format!("{kind}{n}"), unit))
        });
        v1::Model {
            name: "masses".into(),
            inputs: vec![variable("f1", "N"), variable("f2", "N")],
            outputs: outputs.chain([variable("energy", "J")]).collect(),
            markers: vec![marker(1), marker(2)],
            ..v1::Model::default()
        }
    }

    fn initialize(&self, _: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        Ok(Box::new(Run {
            masses: *self,
            x: [0.01, -0.01],
            v: [0.5, -0.3],
            a: [0.0; 2],
        }))
    }
}

struct Run {
    masses: Masses,
    x: [f64; 2],
    v: [f64; 2],
    /// The acceleration-like variable of the generalised-alpha method.
    a: [f64; 2],
}

impl Run {
    fn acceleration(&self, x: [f64; 2], v: [f64; 2], f: [f64; 2]) -> [f64; 2] {
        let between = self.masses.stiff * (x[1] - x[0]) + DAMPING * (v[1] - v[0]);
        [
            (f[0] - 100.0 * x[0] + between) / MASSES[0],
            (f[1] - between) / MASSES[1],
        ]
    }

    /// One internal step; `force` tells the loads at a share of it.
    fn internal(&mut self, h: f64, force: impl Fn(f64) -> [f64; 2]) {
        let plus = |a: [f64; 2], s: f64, b: [f64; 2]| [a[0] + s * b[0], a[1] + s * b[1]];
        let (x, v) = (self.x, self.v);
        match self.masses.scheme {
            Scheme::ExplicitEuler => {
                self.x = plus(x, h, v);
                self.v = plus(v, h, self.acceleration(x, v, force(0.0)));
            }
            Scheme::SymplecticEuler => {
                self.v = plus(v, h, self.acceleration(x, v, force(0.0)));
                self.x = plus(x, h, self.v);
            }
            Scheme::ImplicitEuler => {
                // v = v0 + h a(x0 + h v, v): linear, by iteration to its fixed point.
                let next =
                    |own: [f64; 2]| plus(v, h, self.acceleration(plus(x, h, own), own, force(1.0)));
                self.v = fixed_point(v, next);
                self.x = plus(x, h, self.v);
            }
            Scheme::Midpoint => {
                let next = |own: [f64; 2]| {
                    let mean = plus(v, 1.0, own).map(|sum| sum / 2.0);
                    plus(
                        v,
                        h,
                        self.acceleration(plus(x, h / 2.0, mean), mean, force(0.5)),
                    )
                };
                self.v = fixed_point(v, next);
                self.x = plus(x, h / 2.0, plus(v, 1.0, self.v));
            }
            Scheme::GeneralizedAlpha(rho) => {
                let (am, af) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
                let gamma = 0.5 - am + af;
                let beta = (1.0 - am + af).powi(2) / 4.0;
                let old = self.a;
                let ends = |a: [f64; 2]| {
                    let x = plus(
                        plus(plus(x, h, v), h * h * (0.5 - beta), old),
                        h * h * beta,
                        a,
                    );
                    let v = plus(plus(v, h * (1.0 - gamma), old), h * gamma, a);
                    (x, v)
                };
                let next = |a: [f64; 2]| {
                    let (x1, v1) = ends(a);
                    let mix = |new: [f64; 2], old: [f64; 2]| {
                        plus(new.map(|own| (1.0 - af) * own), af, old)
                    };
                    let right =
                        self.acceleration(mix(x1, x), mix(v1, v), mix(force(1.0), force(0.0)));
                    plus(right, -am, old).map(|own| own / (1.0 - am))
                };
                self.a = fixed_point(old, next);
                (self.x, self.v) = ends(self.a);
            }
        }
    }
}

/// The fixed point of an affine map that contracts.
fn fixed_point(mut own: [f64; 2], next: impl Fn([f64; 2]) -> [f64; 2]) -> [f64; 2] {
    for _ in 0..60 {
        own = next(own);
    }
    own
}

impl Subsystem for Run {
    fn step(&mut self, interval: Interval, inputs: &Inputs) -> Result<(), StepFailure> {
        let parts = (interval.length / self.masses.dt - 1e-9).ceil().max(1.0);
        let h = interval.length / parts;
        for part in 0..parts as usize {
            self.internal(h, |share| {
                let tau = (part as f64 + share) * h;
                [inputs.value(0, tau), inputs.value(1, tau)]
            });
        }
        Ok(())
    }

    fn outputs(
        &mut self,
        _: f64,
        inputs: &[f64],
        wanted: &[usize],
        values: &mut [f64],
    ) -> Result<(), StepFailure> {
        let ([x1, x2], [v1, v2]) = (self.x, self.v);
        let [a1, a2] = self.acceleration(self.x, self.v, [inputs[0], inputs[1]]);
        let kinetic = (MASSES[0] * v1 * v1 + MASSES[1] * v2 * v2) / 2.0;
        let potential = (100.0 * x1 * x1 + self.masses.stiff * (x2 - x1).powi(2)) / 2.0;
        let all = [x1, v1, a1, x2, v2, a2, kinetic + potential];
        for (value, &output) in values.iter_mut().zip(wanted) {
            *value = all[output];
        }
        Ok(())
    }

    fn snapshot(&self, into: &mut Snapshot) {
        [self.x, self.v, self.a]
            .iter()
            .for_each(|own| into.put(own));
    }

    fn restore(&mut self, from: &Snapshot) -> Result<(), StepFailure> {
        let mut state = [0.0; 6];
        from.get(&mut state)?;
        let [x1, x2, v1, v2, a1, a2] = state;
        (self.x, self.v, self.a) = ([x1, x2], [v1, v2], [a1, a2]);
        Ok(())
    }
}

#[test]
fn sound_solvers_of_low_order_are_not_accused() {
    let schemes = [
        Scheme::ExplicitEuler,
        Scheme::SymplecticEuler,
        Scheme::ImplicitEuler,
        Scheme::Midpoint,
        Scheme::GeneralizedAlpha(0.8),
        Scheme::GeneralizedAlpha(0.0),
    ];
    let mut accused = Vec::new();
    for scheme in schemes {
        // Soft and stiff; as many internal steps as macro steps, a few, and many.
        for stiff in [50.0, 1e4] {
            for parts in [1.0, 4.0, 20.0] {
                let dt = STEP / parts;
                let worker = Arc::new(Host::new(vec![Box::new(Masses { scheme, dt, stiff })]));
                let settings = Settings {
                    steps: vec![STEP],
                    ..Settings::default()
                };
                let report = examine(worker, &settings);
                let name = format!("{scheme:?} {stiff} N/m, {parts} internal steps");
                println!("{name:<50}warnings {:?}", report.names(Grade::Warn));
                if !report.is_sound() {
                    accused.push(format!("{name}\n{report}"));
                }
            }
        }
    }
    assert!(
        accused.is_empty(),
        "{} accused\n{}",
        accused.len(),
        accused.join("\n")
    );
}
