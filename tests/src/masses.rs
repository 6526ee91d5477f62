//! Scenes of several oscillators with rigid links.

use std::fmt::Write;

use linchpin_models::oscillator::OscillatorParameters;

/// Text of a scene: `masses` are the subsystems `mass1`, `mass2`, ..., written in the order `order` (places in
/// `masses`), and the links `(a, b)` the joints `link1`, `link2`, ...
pub fn scene_text(
    masses: &[OscillatorParameters],
    links: &[(usize, usize)],
    order: &[usize],
) -> String {
    let mut text = String::from(
        "[scene]\nname = \"masses\"\nt_end = 0.5\n\n[coupling]\nmethod = \"weighted\"\nmacro_step = 1e-3\n",
    );
    for &place in order {
        let OscillatorParameters { m, c, d, x0, v0 } = masses[place];
        let number = place + 1;
        write!(
            text,
            "\n[[subsystem]]\nname = \"mass{number}\"\nmodel = \"oscillator\"\n\
             parameters = {{ m = {m:?}, c = {c:?}, d = {d:?}, x0 = {x0:?}, v0 = {v0:?} }}\n"
        )
        .unwrap();
    }
    for (place, (a, b)) in links.iter().enumerate() {
        let (number, a, b) = (place + 1, a + 1, b + 1);
        write!(
            text,
            "\n[[joint]]\nname = \"link{number}\"\nkind = \"rigid-link\"\na = \"mass{a}\"\nb = \"mass{b}\"\n"
        )
        .unwrap();
    }
    text
}

/// Four different oscillators that start alike.
pub const FOUR: [OscillatorParameters; 4] = [
    mass(1.0, 1000.0, 10.0),
    mass(2.7, 310.0, 41.0),
    mass(0.83, 2300.0, 3.0),
    mass(1.9, 770.0, 0.0),
];

const fn mass(m: f64, c: f64, d: f64) -> OscillatorParameters {
    OscillatorParameters {
        m,
        c,
        d,
        x0: 0.137,
        v0: 91.0,
    }
}
