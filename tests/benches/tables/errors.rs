//! Tables 4 and 6: errors over the step, bilateral and unilateral.

use std::fmt::Write;

use linchpin_models::nonsmooth::mechanics::Settings;
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism};
use linchpin_models::reference::GuidedSliderCrank;

use super::runs::{SCHEMES, SETTINGS, T_END, error, run, unilateral};

const STEPS: [f64; 3] = [1e-4, 1e-5, 1e-6];

/// Both tables.
pub fn tables() -> String {
    let mut text = String::new();
    bilateral(&mut text);
    unilateral_tables(&mut text);
    text
}

fn bilateral(text: &mut String) {
    let interval = 1e-4;
    let reference = GuidedSliderCrank::new(Mechanism::table_1());
    let count = (T_END / interval).round() as usize;
    let exact = reference.motion(150.0, interval, count).unwrap();
    let paper = [
        ["1.3e1", "1.3e0", "1.3e-1"],
        ["1e-1", "1e-3", "1e-5"],
        ["1e-1", "1e-3", "1e-5"],
        ["7e-2", "7e-4", "1.6e-5"],
        ["1.3e-1", "1.3e-3", "1.6e-5"],
    ];
    let _ = writeln!(
        text,
        "## Table 4: error of theta_2 over the step, without clearance\n\n\
         Norm of S2 eq. (92), samples every {interval:e} s, against the mechanism in its one coordinate (Radau IIA, 1e-13).\n\
         Without friction: with the friction of Table 1 the paper's figures do not come out.\n"
    );
    let guide = Guide::Bilateral { friction: 0.0 };
    rows(text, paper, |scheme, dt| {
        let run = run(guide, scheme, SETTINGS, dt, interval);
        error(&run.samples, exact.iter().map(|motion| motion.angles[1]))
    });
}

fn unilateral_tables(text: &mut String) {
    let interval = 1e-2;
    let (_, finest) = SCHEMES[4];
    let exact = run(unilateral(), finest, SETTINGS, 1e-7, interval).samples;
    let paper = [
        ["6.7e-2", "6.4e-3", "6.4e-4"],
        ["1.1e-3", "2.8e-5", "2.3e-6"],
        ["2.0e-3", "1.2e-4", "1.4e-5"],
        ["1.4e-3", "7.8e-5", "8.9e-6"],
        ["9.4e-4", "2.8e-5", "2.3e-6"],
    ];
    for (what, settings) in [
        (
            "accelerations found anew behind an impact (default)",
            SETTINGS,
        ),
        (
            "accelerations carried over impacts, as in the paper",
            Settings {
                restarts_after_impacts: false,
                has_consistent_start: false,
                holds_pressed_contacts: false,
                ..SETTINGS
            },
        ),
    ] {
        let _ = writeln!(
            text,
            "## Table 6: error of theta_2 over the step, with clearance, {what}\n\n\
             Norm of S2 eq. (92), samples every {interval:e} s, against ED-alpha (0) with dt = 1e-7 s.\n"
        );
        rows(text, paper, |scheme, dt| {
            let run = run(unilateral(), scheme, settings, dt, interval);
            error(&run.samples, exact.iter().map(|angles| angles[1]))
        });
    }
}

fn rows(
    text: &mut String,
    paper: [[&str; 3]; 5],
    error: impl Fn(linchpin_models::nonsmooth::schemes::SchemeKind, f64) -> f64,
) {
    let _ = writeln!(
        text,
        "| scheme | 1e-4 s | paper | 1e-5 s | paper | 1e-6 s | paper |\n|---|---|---|---|---|---|---|"
    );
    for ((name, scheme), paper) in SCHEMES.into_iter().zip(paper) {
        let _ = write!(text, "| {name} |");
        for (dt, paper) in STEPS.into_iter().zip(paper) {
            let _ = write!(text, " {:.2e} | {paper} |", error(scheme, dt));
        }
        let _ = writeln!(text);
    }
    let _ = writeln!(text);
}
