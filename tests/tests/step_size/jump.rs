//! Degrees that follow the estimates where a load sets in inside a macro step.

use linchpin::connect::Place;
use linchpin_tests::runs::try_run;
use linchpin_tests::traces::with_steps_of;

use super::hard_scenes::{LOAD_STEP, LOADED_FROM};

/// The tolerance is met, at less cost than with any fixed degree; the run with its lengths and degrees has equal bits.
#[test]
fn the_degree_falls_at_a_jump_and_rises_again() {
    let mut found_jumps = 0;
    for method in ["weighted", "baumgarte"] {
        for tolerance in [1e-4, 1e-6] {
            let run = |degree: &str| {
                LOAD_STEP.run(
                    &format!("method={method} degree={degree} jacobian=every-step"),
                    tolerance,
                )
            };
            let own = run("automatic");
            let (found, context) = (&own.trajectory, &own.context);
            let (t, degrees) = (found.column("t"), found.column("degree"));
            let before = t.iter().rposition(|t| *t < LOADED_FROM - 0.03).unwrap();
            let after = t.iter().position(|t| *t > LOADED_FROM + 0.03).unwrap();
            assert_eq!(degrees[before], 3.0, "{context}");
            let around = &degrees[before..after];
            let lowest = around.iter().copied().fold(3.0, f64::min);
            assert!(lowest <= 1.0, "{context}: {around:?}");
            if let Some(fall) = around.iter().position(|degree| *degree == 0.0) {
                found_jumps += 1;
                assert_eq!(around[fall..fall + 2], [0.0; 2], "{context}");
            }
            assert!(degrees[after..].contains(&3.0), "{context}");
            for degree in ["1", "2", "3"] {
                let fixed = run(degree).trajectory.integrations;
                assert!(
                    found.integrations < fixed,
                    "{context}: {} {degree} {fixed}",
                    found.integrations
                );
            }
            let expected = try_run(&own.scene, Place::InProcess, &with_steps_of(found)).unwrap();
            assert!(found.bits() == expected.bits(), "{context}");
        }
    }
    // Where two attempts at one step tell of the jump.
    assert!(found_jumps > 0);
}
