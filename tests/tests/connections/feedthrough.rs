//! Controllers without integral part are gains without delay: chains and loops of them are algebraic.

use linchpin::connect::Place;
use linchpin_master::RunError;
use linchpin_master::scene::Scene;
use linchpin_master::setup::Options;
use linchpin_tests::runs::{Trajectory, try_run};
use linchpin_tests::scenes::with_settings;

/// `control = gain (setpoint - measured) + integral0`.
struct Gain {
    gain: f64,
    setpoint: f64,
    offset: f64,
}

/// Gains `g0`, `g1`, ... with the connections `from` control of one `to` an input of another.
fn text(gains: &[Gain], connections: &[(usize, usize, &str)]) -> String {
    let mut text = String::from(
        "[scene]\nname = \"gains\"\nt_end = 0.1\n[coupling]\nmethod = \"weighted\"\nmacro_step = 1e-2\n",
    );
    for (
        number,
        Gain {
            gain,
            setpoint,
            offset,
        },
    ) in gains.iter().enumerate()
    {
        text += &format!(
            "[[subsystem]]\nname = \"g{number}\"\nmodel = \"pi-controller\"\n\
             parameters = {{ proportional = {gain:?}, integral = 0.0, setpoint = {setpoint:?}, integral0 = {offset:?} }}\n"
        );
    }
    for (from, to, input) in connections {
        text += &format!(
            "[[connection]]\nname = \"c{from}{to}\"\nfrom = \"g{from}.control\"\nto = \"g{to}.{input}\"\n"
        );
    }
    text
}

fn scene(gains: &[Gain], connections: &[(usize, usize, &str)], coupling: &str) -> Scene {
    with_settings(&text(gains, connections), coupling, &[])
}

fn trajectory(gains: &[Gain], connections: &[(usize, usize, &str)], coupling: &str) -> Trajectory {
    let scene = scene(gains, connections, coupling);
    try_run(&scene, Place::InProcess, &Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

const COUPLINGS: [&str; 5] = [
    "method=weighted exchanged_degree=0",
    "method=weighted exchanged_degree=2",
    "method=baumgarte exchanged_degree=1",
    "method=baumgarte exchanged_degree=3",
    "method=explicit mu=10H",
];

/// A ramp that goes through two gains is there at the end at every macro point, without the delay of a step that the explicit
/// method has.
#[test]
fn a_chain_has_no_delay() {
    let rate = 7.0;
    let connections = [(0, 1, "measured"), (1, 2, "setpoint")];
    let gains = [
        Gain {
            gain: 0.0,
            setpoint: 1.0,
            offset: 0.3,
        },
        Gain {
            gain: -2.3,
            setpoint: 0.9,
            offset: 0.0,
        },
        Gain {
            gain: 40.0,
            setpoint: 0.0,
            offset: 1.1,
        },
    ];
    for &coupling in &COUPLINGS[..4] {
        let ramp = with_settings(
            &text(&gains, &connections),
            coupling,
            &[
                &format!("subsystem.g0.parameters.integral={rate:?}"),
                "output.variables=[\"g2.control\"]",
            ],
        );
        let chain = try_run(&ramp, Place::InProcess, &Options::default()).unwrap();
        for (t, end) in chain.column("t").iter().zip(chain.column("g2.control")) {
            let expected = 40.0 * -2.3 * (0.9 - (0.3 + rate * t)) + 1.1;
            assert!(
                (end - expected).abs() < 1e-8,
                "{coupling} {t}: {end} {expected}"
            );
        }
    }
}

/// `w0 = a (r0 - w1) + v0`, `w1 = b (r1 - w0) + v1`: one solution unless `a b = 1`, also where a simple iteration, which takes
/// one after the other, grows without bound.
#[test]
fn a_loop_is_solved_at_every_macro_point() {
    let connections = [(1, 0, "measured"), (0, 1, "measured")];
    for coupling in COUPLINGS {
        for (a, b) in [
            (0.5, -0.7),
            (-1.0, 1.0),
            (5.0, -3.0),
            (40.0, 2.0),
            (2.0, 0.55),
        ] {
            let gains = [
                Gain {
                    gain: a,
                    setpoint: 1.7,
                    offset: 0.4,
                },
                Gain {
                    gain: b,
                    setpoint: -0.6,
                    offset: 0.0,
                },
            ];
            let solved = trajectory(&gains, &connections, coupling);
            let (p, q) = (a * 1.7 + 0.4, b * -0.6);
            let expected = [(p - a * q) / (1.0 - a * b), (q - b * p) / (1.0 - a * b)];
            for (place, expected) in expected.into_iter().enumerate() {
                for found in solved.column(&format!("g{place}.control")) {
                    let error = (found - expected).abs() / expected.abs().max(1.0);
                    assert!(error < 1e-9, "{coupling} {a} {b}: {found} {expected}");
                }
            }
        }
    }
}

/// The loop of gains 1 and 2 has the gain 1; gain 0 drives it.
#[test]
fn a_loop_of_gain_one_is_refused_by_name() {
    let connections = [(0, 1, "setpoint"), (2, 1, "measured"), (1, 2, "measured")];
    for (a, b) in [(1.0, 1.0), (-3.0, -1.0 / 3.0), (1e4, 1e-4)] {
        for offset in [0.0, 0.3] {
            let gains = [
                Gain {
                    gain: 50.0,
                    setpoint: offset,
                    offset: 0.0,
                },
                Gain {
                    gain: a,
                    setpoint: 0.0,
                    offset,
                },
                Gain {
                    gain: b,
                    setpoint: 0.0,
                    offset: 0.0,
                },
            ];
            for coupling in COUPLINGS {
                let scene = scene(&gains, &connections, coupling);
                let refused = try_run(&scene, Place::InProcess, &Options::default());
                let Err(error @ RunError::Scene(_)) = refused else {
                    panic!("{coupling} {a} {b} {offset}: {refused:?}")
                };
                let shown = error.to_string();
                let names = ["connection.c12", "connection.c21"];
                assert!(names.iter().any(|name| shown.contains(name)), "{shown}");
                for word in ["gain around the loop is 1", "without delay", "test scene:"] {
                    assert!(shown.contains(word), "{word:?} is missing in {shown}");
                }
            }
        }
    }
}
