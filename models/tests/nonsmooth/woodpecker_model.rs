//! The woodpecker as a subsystem: strokes of its beak in the outputs, and contacts where they are drawn.

use super::common::Solver;
use super::common::body::Body;

fn toy(parameters: &[(&str, f64)]) -> Body {
    let solver = Solver("generalized-alpha", &[("step", 2e-5)]);
    Body::new("woodpecker", parameters, solver)
}

#[test]
fn it_pecks_with_its_published_period() {
    let mut toy = toy(&[]);
    let mut strokes = Vec::new();
    while toy.t < 0.9 {
        toy.advance(5e-4);
        let [impulse, y] = toy.read_all(["impulse_beak", "y"]);
        if impulse > 0.0 {
            strokes.push([toy.t, y]);
        }
    }
    assert_eq!(strokes.len(), 6, "{strokes:?}");
    for pair in strokes[2..].windows(2) {
        let [period, rise] = [0, 1].map(|i| pair[1][i] - pair[0][i]);
        assert!((period - 0.14598).abs() < 1.1e-3, "{period}");
        assert!((rise + 0.01944).abs() < 5e-4, "{rise}");
    }
    let [energy, impacts, friction] = toy.read_all(["energy", "impact_loss", "friction_loss"]);
    let start = self::toy(&[]).read_one("energy");
    let error = energy + impacts + friction - start;
    assert!(error.abs() < 1e-2 * (start - energy), "{error:e}");
}

/// The pole's surface is at its radius; gaps are the distances of the markers from it.
#[test]
fn gaps_are_those_of_the_markers() {
    let mut toy = toy(&[("pole_radius", 2.4e-3)]);
    for _ in 0..30 {
        toy.advance(5e-3);
        for name in ["beak", "lower", "upper"] {
            let names = [format!("{name}_x"), format!("gap_{name}")];
            let [x, gap] = toy.read(&names)[..] else {
                panic!("two values")
            };
            assert!((x - 2.4e-3 - gap).abs() < 1e-15, "{name}: {x} {gap}");
        }
    }
}

/// A force that carries its weight and a moment that carries the bird keep it where it is, sleeve and bird free.
#[test]
fn loads_hold_it() {
    let (bird, all, gravity) = (4.5e-3, 4.8e-3, 9.81);
    let start = ["phi_m0", "phi_s0", "vy0", "omega_s0"].map(|name| (name, 0.0));
    let mut toy = toy(&start);
    toy.drive("force", all * gravity);
    toy.drive("sleeve_moment", bird * gravity * 0.01);
    toy.drive("bird_moment", bird * gravity * 0.015);
    toy.advance(0.2);
    let state = toy.read(&["y", "phi_m", "phi_s", "vy", "omega_m", "omega_s"]);
    assert!(state.iter().all(|value| value.abs() < 1e-10), "{state:?}");
}
