//! Energy grows by the work of the loads.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::{Comparison, rounding};
use crate::conformance::inputs::Inputs;
use crate::conformance::measured::{allowed, in_the_limit};
use crate::conformance::subject::Marker;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// The energy outputs answer loads by their work.
pub struct Energy;

/// Share of the work by which the change of an energy may differ from it, at the step where it does so least.
const SHARE: f64 = 1e-2;

/// Changes below this share of the work are none: the output is another energy, which the load does not feed at once.
const NONE: f64 = 1e-2;

impl Check for Energy {
    fn about(&self) -> About {
        About {
            name: "energy",
            title: "outputs in J answer loads by their work",
            equation: "(E under f - E under -f)/2 = h f . v + O(h^2), f at a marker that moves with v: what dissipates or feeds beside \
                       the load is the same under both",
            tolerance: "0.01 of the work, at the one of the steps h = H, H/4, .. that misses it least",
            look_at: "the energy output, the point that the load acts on, moments, and whether Step applies the whole load",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let subject = &bench.subject;
        let energies: Vec<usize> = (0..subject.outputs.len())
            .filter(|&output| subject.units[output] == "J")
            .collect();
        if energies.is_empty() {
            return Err(Stop::not_applicable("the model has no output in J"));
        }
        let is_usable = |marker: &&Marker| !marker.load.is_empty() && !marker.velocity.is_empty();
        let markers: Vec<&Marker> = subject.markers.iter().filter(is_usable).collect();
        if markers.is_empty() {
            return Err(Stop::not_applicable(
                "no marker of the model takes loads and tells its velocity",
            ));
        }
        for marker in markers {
            examine(bench, marker, &energies, verdict)?;
        }
        Ok(())
    }
}

fn examine(
    bench: &Bench<'_>,
    marker: &Marker,
    energies: &[usize],
    verdict: &mut Verdict,
) -> Result<(), Stop> {
    let names = &bench.subject.outputs;
    let mut instance = bench.in_motion()?;
    let start = instance.keep()?;
    let rest = instance.evaluate(&bench.subject.defaults)?;
    let mut forward = bench.unloaded();
    let mut backward = bench.unloaded();
    let mut power = 0.0;
    for (&velocity, &load) in marker.velocity.iter().zip(&marker.load) {
        // Along the velocity, so that all components do work.
        let size = bench.sizes[load] * rest[velocity].signum();
        forward = forward.plus(load, size, 0);
        backward = backward.plus(load, -size, 0);
        power += size * rest[velocity];
    }
    if power == 0.0 {
        verdict.note(format!(
            "marker \"{}\" does not move, so its loads do no work",
            marker.name
        ));
        return Ok(());
    }
    let mut ends = |step: f64| -> Result<[Vec<f64>; 2], Stop> {
        let mut end = |inputs: &Inputs| {
            instance.go_back(&start)?;
            instance.step(step, inputs)
        };
        Ok([end(&forward)?, end(&backward)?])
    };
    // The shortest step tells which outputs are fed by the load.
    let mut fed = vec![false; energies.len()];
    let (step, comparison) = in_the_limit(bench.step(), |step| {
        let work = step * power;
        let [forward, backward] = ends(step)?;
        let mut comparison = Comparison::default();
        for (&energy, fed) in energies.iter().zip(&mut fed) {
            let found = (forward[energy] - backward[energy]) / 2.0;
            *fed = found.abs() > NONE * work;
            let floor = 4.0 * bench.tolerance + rounding(&[forward[energy], backward[energy]]);
            if let Some(allowed) = allowed(SHARE, work, floor) {
                let expected = if *fed { work } else { 0.0 };
                let place = format!(
                    "{} under the loads of marker \"{}\"",
                    names[energy], marker.name
                );
                comparison.near(place, found, expected, allowed);
            }
        }
        Ok(comparison)
    })?;
    if comparison.compared == 0 {
        verdict.note(format!(
            "the work at marker \"{}\" is below the solver's tolerance",
            marker.name
        ));
    } else if !fed.contains(&true) {
        let text = format!(
            "no energy changes under the loads of marker \"{}\", which moves",
            marker.name
        );
        verdict.find(Grade::Warn, text);
    }
    let text = format!("another change than the work, also over {step:.1e} s");
    verdict.judge(comparison, bench.grade_of_motion(), text);
    Ok(())
}
