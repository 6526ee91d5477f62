//! What the defaults gain over S2 as printed.

use linchpin_models::nonsmooth::contact::{ContactSettings, Jacobian};
use linchpin_models::nonsmooth::mechanics::{Level, Settings};
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::systems::masses::{End, Masses};

use super::slider::examples;
use super::stand::{AS_PRINTED, Stand, order};

/// The model problem (b) of S2 Sect. 2.8: amplitude of what the force does to and fro, and the largest velocity of the
/// mass that is held, both over the second of two seconds.
fn unrest(scheme: SchemeKind, settings: Settings) -> [f64; 2] {
    let system = Masses {
        springs: [10.0; 3],
        ..Masses::of_paper(End::Constraint)
    };
    let mut stand = Stand::new(system, scheme, settings, [&[0.0; 3], &[0.0; 3]]);
    stand.steps(200, 5e-3);
    let mut forces = Vec::new();
    let mut velocity: f64 = 0.0;
    for _ in 0..200 {
        stand.step(5e-3);
        forces.push(stand.integrator.state.forces[0]);
        velocity = velocity.max(stand.v()[2].abs());
    }
    let teeth = forces
        .windows(3)
        .map(|f| (f[0] - 2.0 * f[1] + f[2]).abs() / 4.0);
    [teeth.fold(0.0, f64::max), velocity]
}

#[test]
fn a_consistent_start_takes_the_sawtooth_away() {
    // S2 Figs. 17, 18: the force of the printed start goes to and fro with m g.
    let scheme = SchemeKind::GeneralizedAlpha { rho_inf: 1.0 };
    let [printed, _] = unrest(scheme, AS_PRINTED);
    let [own, _] = unrest(scheme, Settings::default());
    assert!((printed / 9.81 - 1.0).abs() < 1e-3, "{printed}");
    assert!(own < 1e-3, "{own}");
}

#[test]
fn a_consistent_start_takes_the_drift_of_the_acceleration_level_away() {
    let scheme = SchemeKind::GeneralizedAlpha { rho_inf: 0.8 };
    let level = |settings: Settings| Settings {
        level: Level::Acceleration,
        ..settings
    };
    let [_, printed] = unrest(scheme, level(AS_PRINTED));
    let [_, own] = unrest(scheme, level(Settings::default()));
    // g dt / 2.
    assert!((printed / 0.024525 - 1.0).abs() < 1e-9, "{printed:e}");
    assert!(own < 1e-12, "{own:e}");
}

#[test]
fn a_restart_behind_impacts_keeps_the_order() {
    // The first example shortly behind its first impact, which all schemes note in the same step. HETS carries nothing
    // over.
    let [example, _] = examples();
    let run = |scheme: SchemeKind, restarts: bool, dt: f64| {
        let settings = Settings {
            restarts_after_impacts: restarts,
            ..Settings::default()
        };
        let start: [&[f64]; 2] = [&[0.0; 3], &example.v];
        let mut stand = Stand::new(example.system.clone(), scheme, settings, start);
        stand.steps((4e-3 / dt).round() as usize, dt);
        stand.q()[0]
    };
    for scheme in [
        SchemeKind::GeneralizedAlpha { rho_inf: 0.8 },
        SchemeKind::Bathe,
    ] {
        let errors = [4e-5, 1e-5].map(|dt| {
            let reference = run(SchemeKind::Hets, true, dt);
            [true, false].map(|restarts| (run(scheme, restarts, dt) - reference).abs())
        });
        let [restarted, carried] = [0, 1].map(|kind| order(errors[0][kind], errors[1][kind]) / 2.0);
        assert!(restarted > 1.7, "{scheme:?}: {errors:?}");
        assert!(
            carried < 1.3 && errors[1][1] > 5.0 * errors[1][0],
            "{scheme:?}: {errors:?}"
        );
    }
}

#[test]
fn the_full_jacobian_saves_iterations() {
    let [_, example] = examples();
    let iterations = |jacobian: Jacobian| {
        let settings = Settings {
            contact: ContactSettings {
                jacobian,
                ..ContactSettings::default()
            },
            ..Settings::default()
        };
        let start: [&[f64]; 2] = [&[0.0; 3], &example.v];
        let mut stand = Stand::new(example.system.clone(), SchemeKind::Bathe, settings, start);
        stand.steps(5000, 1e-5);
        let counters = stand.integrator.mechanics.counters;
        let problems: u64 = counters.contact_problems.iter().sum();
        counters.contact_iterations as f64 / problems as f64
    };
    let [full, printed] = [Jacobian::Full, Jacobian::AsPrinted].map(iterations);
    assert!(full < 1.2 && printed > 3.0 * full, "{full} {printed}");
}
