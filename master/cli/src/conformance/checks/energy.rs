//! Energy grows by the work of the loads.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::{Comparison, rounding};
use crate::conformance::instance::{Instance, Kept};
use crate::conformance::measured::{COARSE_SHARE, allowed, in_the_limit, over_longer};
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
            equation: "(E under f - E under -f)/2 = h f . v + O(h^2) with the mean velocity, f at a marker that moves with v: what dissipates or feeds beside \
                       the load is the same under both",
            tolerance: "0.01 of the work, at the one of the steps h = H, H/4, .. that misses it least; a warning up \
                        to 0.15 over longer steps",
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
    let mut instance = bench.in_motion()?;
    let start = instance.keep()?;
    let rest = instance.evaluate(&bench.subject.defaults)?;
    let mut work = Work {
        bench,
        marker,
        energies,
        start,
        rest: &rest,
        fed: vec![false; energies.len()],
    };
    if work.sizes().all(|(velocity, _, _)| rest[velocity] == 0.0) {
        verdict.note(format!(
            "marker \"{}\" does not move, so its loads do no work",
            marker.name
        ));
        return Ok(());
    }
    let limit = in_the_limit(bench.step(), |step| work.over(&mut instance, step))?;
    let mut grade = bench.grade_of_motion();
    if !limit.comparison.holds() {
        let longer = over_longer(bench.step(), |step| work.over(&mut instance, step));
        if longer.is_some_and(|own| own.ratio() * SHARE <= COARSE_SHARE) {
            grade = Grade::Warn;
        }
    } else if limit.comparison.compared > 0 && !work.fed.contains(&true) {
        let text = format!(
            "no energy changes under the loads of marker \"{}\", which moves",
            marker.name
        );
        verdict.find(Grade::Warn, text);
    }
    limit.judge(
        verdict,
        grade,
        "energies change by something else than the work of the loads",
    );
    Ok(())
}

/// Loads at one marker, along its velocity and against it.
struct Work<'a, 'b> {
    bench: &'a Bench<'b>,
    marker: &'a Marker,
    energies: &'a [usize],
    start: Kept,
    rest: &'a [f64],
    /// Which energies the loads have changed over the last step.
    fed: Vec<bool>,
}

impl Work<'_, '_> {
    /// Output of the velocity, input of the load, and a load that does positive work.
    fn sizes(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let pairs = self.marker.velocity.iter().zip(&self.marker.load);
        pairs.map(|(&velocity, &load)| {
            (
                velocity,
                load,
                self.bench.sizes[load] * self.rest[velocity].signum(),
            )
        })
    }

    /// Half the differences of energies against half that of the works of the loads, which is `step` times the power at the mean of
    /// all velocities.
    fn over(&mut self, instance: &mut Instance<'_>, step: f64) -> Result<Comparison, Stop> {
        let mut end = |sign: f64| {
            let mut inputs = self.bench.unloaded();
            for (_, load, size) in self.sizes() {
                inputs = inputs.plus(load, sign * size, 0);
            }
            instance.go_back(&self.start)?;
            instance.step(step, &inputs)
        };
        let (forward, backward) = (end(1.0)?, end(-1.0)?);
        let power = |(velocity, _, size): (usize, usize, f64)| {
            let mean = (forward[velocity] + backward[velocity] + 2.0 * self.rest[velocity]) / 4.0;
            size * mean
        };
        let work = step * self.sizes().map(power).sum::<f64>();
        let mut comparison = Comparison::default();
        let mut fed = Vec::new();
        for &energy in self.energies {
            let found = (forward[energy] - backward[energy]) / 2.0;
            let is_fed = found.abs() > NONE * work.abs();
            fed.push(is_fed);
            let floor = 4.0 * self.bench.tolerance + rounding(&[forward[energy], backward[energy]]);
            if let Some(allowed) = allowed(SHARE, work.abs(), floor) {
                let name = &self.bench.subject.outputs[energy];
                let place = format!("{name} under the loads of marker \"{}\"", self.marker.name);
                comparison.near(place, found, if is_fed { work } else { 0.0 }, allowed);
            }
        }
        self.fed = fed;
        Ok(comparison)
    }
}
