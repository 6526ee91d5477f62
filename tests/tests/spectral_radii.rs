//! Spectral radii of random linear oscillator pairs, by the macro-step map of the co-simulation itself.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin_models::oscillator::OscillatorParameters;
use linchpin_tests::evidence;
use linchpin_tests::random_pairs::{Pair, Tally, Verdict};

const SEED: u64 = 7;

/// Index 3 with k = 0 is stable whatever the pair; nothing of it is out of reach.
#[test]
fn index_3_is_stable_for_all_pairs() {
    let tally = Tally::of("method=baumgarte index=3 degree=0", SEED, 2000);
    assert!(
        tally.unstable.is_empty() && tally.out_of_reach.is_empty(),
        "{tally:?}"
    );
}

/// Whatever masses, springs, dampers and H are, and to 1e-9: the default variant on all pairs of the documentation.
#[test]
fn hermite_coupling_is_stable_for_all_pairs() {
    for (variant, pairs) in [("apv", 10_000), ("c0pv", 1000)] {
        let tally = Tally::of(&format!("method=hermite variant={variant}"), SEED, pairs);
        assert!(
            tally.unstable.is_empty() && tally.out_of_reach.is_empty(),
            "{variant}: {tally:?}"
        );
    }
}

/// S1's a = b = 1 with k = 2: the radius 1.13 for small H whatever the pair; what is far out of it is held by its own springs and
/// dampers.
#[test]
fn a_rule_that_is_broken_shows() {
    let tally = Tally::of("method=weighted a=1 b=1 degree=2", SEED, 100);
    assert!(tally.unstable.len() > 40, "{tally:?}");
    assert!(
        tally
            .unstable
            .iter()
            .any(|(_, radius)| (radius - 1.13).abs() < 0.005),
        "{tally:?}"
    );
}

/// Two free masses drift: the eigenvalue 1 of their map is double, and rounding splits it by far more than what is allowed.
/// Taken out exactly, nothing of the kind is left.
#[test]
fn the_drift_of_a_free_pair_is_no_instability() {
    let free = |m| OscillatorParameters {
        m,
        c: 0.0,
        d: 0.0,
        x0: 0.0,
        v0: 0.0,
    };
    let mut split: f64 = 0.0;
    for macro_step in [1e-4, 1.3e-3, 7e-3, 3e-2] {
        let pair = Pair {
            masses: [free(0.037), free(61.0)],
            macro_step,
        };
        for coupling in [
            "method=baumgarte index=1 degree=1",
            "method=weighted degree=1",
        ] {
            assert_eq!(
                pair.judge(coupling),
                Verdict::Stable,
                "{macro_step} {coupling}"
            );
            let radius = pair.map(coupling).unwrap().spectral_radius().unwrap();
            split = split.max(radius - 1.0);
        }
    }
    assert!(split > 1e-9, "{split:e}");
}

/// A drift that grows is told: the joint of this pair is torn open.
#[test]
fn an_unstable_free_pair_is_unstable() {
    let free = |m| OscillatorParameters {
        m,
        c: 0.0,
        d: 0.0,
        x0: 0.0,
        v0: 0.0,
    };
    let pair = Pair {
        masses: [free(1.3), free(0.7)],
        macro_step: 1e-3,
    };
    let verdict = pair.judge("method=baumgarte index=3 degree=1");
    assert!(
        matches!(verdict, Verdict::Unstable(radius) if radius > 3.0),
        "{verdict:?}"
    );
}

const COMMAND: &str =
    "cargo test --release -p linchpin-tests --test spectral_radii -- --ignored --nocapture";

/// 10,000 pairs.
#[test]
#[ignore = "prints a table of docs/evidence/methods.md, and writes it with LINCHPIN_WRITE=1"]
fn tallies() {
    let mut table = String::from(
        "| method | unstable | of these with H resolving both masses | out of reach |\n|---|---|---|---|\n",
    );
    for coupling in [
        "method=baumgarte beta=2H gamma=H^2 degree=0",
        "method=baumgarte beta=2H gamma=H^2 degree=1",
        "method=weighted a=2 b=2.6 degree=0",
        "method=weighted a=2 b=2.6 degree=1",
        "method=baumgarte index=3 degree=0",
        "method=hermite variant=apv",
        "method=hermite variant=c0pv",
    ] {
        let tally = Tally::of(coupling, SEED, 10_000);
        let resolved = tally
            .unstable
            .iter()
            .filter(|(pair, _)| pair.is_resolved())
            .count();
        table += &format!(
            "| `{coupling}` | {} | {resolved} | {} |\n",
            tally.unstable.len(),
            tally.out_of_reach.len()
        );
        for (pair, why) in tally.out_of_reach.iter().take(5) {
            println!("{coupling}: {why}\n    {pair:?}");
        }
    }
    evidence::show("methods.md", "random pairs", COMMAND, &table);
}
