//! Inertia answers the shapes 1, s and s^2 of a load.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::{Comparison, rounding};
use crate::conformance::inputs::Inputs;
use crate::conformance::instance::{Instance, Kept};
use crate::conformance::measured::{
    COARSE_SHARE, Freedom, Mobility, allowed, halves, in_the_limit, over_longer, resolves_longer,
};
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Responses of position and velocity to load shapes are those of inertia.
pub struct LoadShapes;

/// Share of the response by which it may differ from that of inertia.
const SHARE: f64 = 0.02;

impl Check for LoadShapes {
    fn about(&self) -> About {
        About {
            name: "load-shapes",
            title: "loads 1, s and s^2 move their marker as inertia does",
            equation: "v: H A (1, 1/2, 1/3), r: H^2 A (1/2, 1/6, 1/12), s = t/H, A = d(acceleration)/d(load)",
            tolerance: "0.02 of the response, and the solver's tolerance; more where the motion is fast against H and resolved; a warning up to 0.15, \
                        and where a step and its halves differ less over a step 16 times as long",
            look_at: "whether Step applies the whole load, at every internal step and at its own time; the solver's internal step against H",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let mut instance = bench.in_motion()?;
        let start = instance.keep()?;
        let mobility = Mobility::measure(bench, &instance)?;
        let told = told(bench, &mobility);
        if told.is_empty() {
            return Err(Stop::not_applicable(
                "no marker of the model takes loads and tells velocity and acceleration",
            ));
        }
        let mut shapes = Shapes {
            bench,
            instance: &mut instance,
            start,
            mobility: &mobility,
            told: &told,
        };
        let constant = in_the_limit(bench.step(), |step| shapes.all(step, 0))?;
        if !constant.comparison.holds() && !constant.is_hidden {
            let grade = match shapes.is_coarse()? {
                true => Grade::Warn,
                false => bench.grade_of_motion(),
            };
            let text = "a constant load moves its marker otherwise than its acceleration says";
            constant.judge(verdict, grade, text);
            if grade == Grade::Fail {
                return Ok(());
            }
        }
        for &step in bench.steps() {
            for power in 0..=bench.subject.highest_degree().min(2) {
                shapes.examine(step, power, verdict)?;
            }
        }
        Ok(())
    }
}

/// A freedom that is not held, with the outputs of its velocity and, if there is one, its position.
struct Told {
    freedom: usize,
    velocity: usize,
    position: Option<usize>,
}

fn told(bench: &Bench<'_>, mobility: &Mobility) -> Vec<Told> {
    let of = |(place, own): (usize, &Freedom)| {
        let marker = &bench.subject.markers[own.marker];
        let has_plain_position =
            own.component < marker.translations() || marker.quaternion().is_none();
        let position = marker.position.get(own.component).copied();
        Some(Told {
            freedom: place,
            velocity: *marker.velocity.get(own.component)?,
            position: position.filter(|_| has_plain_position),
        })
    };
    let freedoms = mobility.freedoms.iter().enumerate();
    freedoms
        .filter(|(place, _)| mobility.is_free(*place))
        .filter_map(of)
        .collect()
}

struct Shapes<'a, 'b, 'i> {
    bench: &'a Bench<'b>,
    instance: &'a mut Instance<'i>,
    start: Kept,
    mobility: &'a Mobility,
    told: &'a [Told],
}

impl Shapes<'_, '_, '_> {
    /// Whether few internal steps of a solver of low order are why a constant load does not move its marker as its acceleration says:
    /// over longer steps it does, or step and halves differ less.
    fn is_coarse(&mut self) -> Result<bool, Stop> {
        let step = self.bench.step();
        let longer = over_longer(step, |step| self.all(step, 0));
        if longer.is_some_and(|own| own.ratio() * SHARE <= COARSE_SHARE) {
            return Ok(true);
        }
        let inputs = self.all_loaded(0);
        let from = (&mut *self.instance, &self.start);
        let of_halves = halves(self.bench, from, step, &inputs)?;
        let from = (&mut *self.instance, &self.start);
        Ok(!of_halves.holds() && resolves_longer(self.bench, from, step, &inputs, &of_halves))
    }

    /// Every load that is looked at, in one shape.
    fn all_loaded(&self, power: usize) -> Inputs {
        let add = |inputs: Inputs, own: &Told| {
            let load = self.mobility.freedoms[own.freedom].load;
            inputs.plus(load, self.bench.sizes[load], power)
        };
        self.told.iter().fold(self.bench.unloaded(), add)
    }

    /// The response to one shape, and the reason where it is not that of inertia.
    fn examine(&mut self, step: f64, power: usize, verdict: &mut Verdict) -> Result<(), Stop> {
        let comparison = self.all(step, power)?;
        let place = format!("over {step} s under the load shape s^{power}");
        if comparison.holds() {
            verdict.judge(comparison, Grade::Pass, place);
            return Ok(());
        }
        // Whether the motion or the solver is the reason: the halves of the step tell.
        let inputs = self.all_loaded(power);
        let of_halves = halves(self.bench, (self.instance, &self.start), step, &inputs)?;
        if of_halves.holds() {
            verdict.note(format!(
                "{place} the response is not that of inertia alone, and resolved: the model has motions that are fast against the step"
            ));
            return Ok(());
        }
        let ratio = comparison.ratio() * SHARE;
        let from = (&mut *self.instance, &self.start);
        if ratio <= COARSE_SHARE || resolves_longer(self.bench, from, step, &inputs, &of_halves) {
            let text = format!(
                "{place} the response is off by {:.0} %: few internal steps of a solver of low order fall into the macro step; methods that \
                 meet position and velocity at its end need longer macro steps or shorter internal ones",
                100.0 * ratio
            );
            verdict.judge(comparison, Grade::Warn, text);
        } else {
            let text = format!("{place} the response is not that of inertia");
            verdict.judge(comparison, self.bench.grade_of_motion(), text);
        }
        Ok(())
    }

    /// Responses of every marker to each of its loads, per unit of the load.
    fn all(&mut self, step: f64, power: usize) -> Result<Comparison, Stop> {
        let unloaded = self.bench.unloaded();
        self.instance.go_back(&self.start)?;
        let rest = self.instance.step(step, &unloaded)?;
        let mut comparison = Comparison::default();
        for driven in self.told {
            let column = &self.mobility.freedoms[driven.freedom];
            let size = self.bench.sizes[column.load];
            self.instance.go_back(&self.start)?;
            let inputs = unloaded.clone().plus(column.load, size, power);
            let moved = self.instance.step(step, &inputs)?;
            for own in self.told {
                let row = &self.mobility.freedoms[own.freedom];
                if row.marker == column.marker {
                    let places = [own.freedom, driven.freedom];
                    let response = |output: usize| Response {
                        place: format!(
                            "{} per {} s^{power}",
                            self.bench.subject.outputs[output], column.names[1]
                        ),
                        found: (moved[output] - rest[output]) / size,
                        floor: (4.0 * self.bench.tolerance
                            + rounding(&[moved[output], rest[output]]))
                            / size,
                    };
                    let k = power as f64;
                    let by_velocity = step / (k + 1.0);
                    self.compare(response(own.velocity), places, by_velocity, &mut comparison);
                    if let Some(position) = own.position {
                        let by_position = step * by_velocity / (k + 2.0);
                        self.compare(response(position), places, by_position, &mut comparison);
                    }
                }
            }
        }
        Ok(comparison)
    }

    /// Compares a response with `factor` times the entry of the mobility; it is as large as that factor times `sqrt(A_ii A_jj)`.
    fn compare(
        &self,
        response: Response,
        [row, column]: [usize; 2],
        factor: f64,
        comparison: &mut Comparison,
    ) {
        let size = factor * self.mobility.own[row] * self.mobility.own[column];
        if let Some(allowed) = allowed(SHARE, size, response.floor) {
            let expected = factor * self.mobility.matrix[(row, column)];
            comparison.near(response.place, response.found, expected, allowed);
        }
    }
}

/// The change of an output per unit of a load.
struct Response {
    place: String,
    found: f64,
    floor: f64,
}
