//! Connected signals that a macro step does not resolve: jumps, and vibrations whose whole periods are macro steps.

use std::f64::consts::TAU;

use linchpin::connect::Place;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;

/// The acceleration of the first mass, on which a load sets in, is the force on the second one.
const JUMP: &str = r#"
[scene]
name = "jump"
t_end = 1.0
[coupling]
method = "hermite"
[[subsystem]]
name = "m1"
model = "oscillator"
parameters = { m = 1.0 }
[[subsystem]]
name = "m2"
model = "oscillator"
parameters = { m = 1.0 }
[[connection]]
name = "s"
from = "m1.a"
to = "m2.f"
[output]
variables = ["m2.x"]
"#;

/// A mass that swings drives another one through a spring.
const SHAKER: &str = r#"
[scene]
name = "shaker"
t_end = 2.0
[coupling]
method = "hermite"
[[subsystem]]
name = "table"
model = "oscillator"
parameters = { m = 1.0 }
[[subsystem]]
name = "driven"
model = "oscillator"
parameters = { m = 1.0 }
[[connection]]
name = "x"
from = "table.x"
to = "driven.partner_x"
[output]
variables = ["driven.x"]
"#;

const METHODS: [&str; 6] = [
    "method=hermite",
    "method=hermite degree=3",
    "method=hermite degree=4",
    "method=hermite degree=automatic",
    "method=weighted index=1 degree=1",
    "method=weighted index=1 degree=2",
];

fn last(found: &Trajectory, name: &str) -> f64 {
    *found.column(name).last().unwrap()
}

/// `x_2 = F (t - t_0)^2 / (2 m_1 m_2)`.
#[test]
fn a_signal_that_jumps_is_passed() {
    for (m1, m2, load, from) in [(1.0, 1.0, 1.0, 0.505), (2.5, 0.4, -370.0, 0.3331)] {
        for method in METHODS {
            for tolerance in ["1e-3", "1e-6"] {
                let coupling = format!("{method} tolerance={tolerance}");
                let first = format!(
                    "subsystem.m1.parameters={{ m = {m1}, load = {load:?}, load_from = {from} }}"
                );
                let second = format!("subsystem.m2.parameters.m={m2:?}");
                let scene = with_settings(JUMP, &coupling, &[&first, &second]);
                let found = run(&scene, Place::InProcess);
                let exact = load * (1.0 - from) * (1.0 - from) / (2.0 * m1 * m2);
                let error = (last(&found, "m2.x") / exact - 1.0).abs();
                let steps = found.statistics.steps.unwrap();
                assert!(error < 1e-7, "{coupling} from {from}: {error:e}");
                assert_eq!(steps.jumps, 1, "{coupling} from {from}");
                assert!(found.rows.len() < 120, "{coupling}: {}", found.rows.len());
            }
        }
    }
}

/// With `y = Y sin(w t)` the driven mass, at rest at the start, moves as `Y W^2/(W^2 - w^2) (sin w t - w/W sin W t)`.
#[test]
fn whole_periods_are_not_jumped_over() {
    for (frequency, own) in [(50.0, 31.0), (17.3, 4.1)] {
        let [omega, natural] = [frequency, own].map(|one| TAU * one);
        let amplitude = 1e-3;
        let table = format!(
            "subsystem.table.parameters={{ m = 1.0, c = {:?}, v0 = {:?} }}",
            omega * omega,
            amplitude * omega
        );
        let driven = format!(
            "subsystem.driven.parameters={{ m = 1.0, partner_stiffness = {:?} }}",
            natural * natural
        );
        let exact = |t: f64| {
            let squares = [natural * natural, omega * omega];
            let gain = squares[0] / (squares[0] - squares[1]);
            amplitude * gain * ((omega * t).sin() - omega / natural * (natural * t).sin())
        };
        let size = amplitude * (natural / (natural - omega)).abs();
        // The others know signals at macro points alone.
        for method in METHODS.into_iter().filter(|one| one.contains("hermite")) {
            // The first step is two whole periods.
            let coupling = format!(
                "{method} tolerance=1e-3 absolute_tolerance=1e-9 macro_step={:?}",
                2.0 / frequency
            );
            let scene = with_settings(SHAKER, &coupling, &[&table, &driven]);
            let found = run(&scene, Place::InProcess);
            let points = found.column("t").into_iter().zip(found.column("driven.x"));
            let errors = points.map(|(t, x)| (x - exact(t)).abs() / size);
            let error = errors.fold(0.0, f64::max);
            println!(
                "{method}, {frequency} Hz: {error:.1e} in {} steps",
                found.rows.len() - 1
            );
            assert!(error < 1e-2, "{coupling}: {error:e}");
        }
    }
}
