//! Integrals of outputs are integrals of outputs.

use linchpin_models::integrators::gauss;
use linchpin_proto::weights::legendre;

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::instance::Inside;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Integrals against quadrature of the ends of shorter steps.
pub struct Integrals;

/// Integrals that are asked for of each output.
const WEIGHTS: usize = 4;

/// Points of Gauss's rule: exact for an output of degree 5 under weights of degree 4.
const POINTS: usize = 5;

/// Share of an output's change over the step by which its integrals may be off.
const SHARE: f64 = 1e-3;

/// Larger shares for each integral, up to which the weights of a solver with few internal steps are coarse and not wrong: a rule
/// through three points misses the integral of a straight line under `L_3` by a sixth of its change, that of a parabola by more.
const COARSE: [f64; WEIGHTS] = [0.15, 0.2, 0.5, 0.5];

impl Check for Integrals {
    fn about(&self) -> About {
        About {
            name: "integrals",
            title: "integrals of outputs are those of the outputs under Legendre's polynomials",
            equation: "integral i = integral of y L_i ds over 0 <= s <= 1, by Gauss's rule through the ends of shorter steps",
            tolerance: "1e-3 of the change of the output over the step, the largest of its group, and 4 times the solver's tolerance; a warning up to 0.15 of it for \
                        number 0, 0.2 for number 1, 0.5 for others",
            look_at: "the weights L_0 = 1, L_1 = 2s - 1, .., that integrals begin at 0 with every step and are not multiplied by H, and their \
                      order: number 0 of all outputs first",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let subject = &bench.subject;
        if !subject.capabilities.output_integrals {
            return Err(Stop::not_applicable(
                "the model offers no integrals of outputs",
            ));
        }
        let (step, count) = (bench.step(), subject.outputs.len());
        let inputs = bench.loaded(3);
        let mut instance = bench.in_motion()?;
        let start = instance.keep()?;
        let inside = Inside {
            instants: &[],
            integrals: WEIGHTS,
        };
        // Twice: integrals of the step before must be gone.
        instance.step_inside(step, &inputs, inside)?;
        instance.go_back(&start)?;
        let found = instance.step_inside(step, &inputs, inside)?;

        let mut points = Vec::new();
        for [share, _] in gauss(POINTS) {
            instance.go_back(&start)?;
            points.push(instance.step_part([0.0, share], step, &inputs)?);
        }
        let [mut fine, mut coarse] = [(); 2].map(|()| Comparison::default());
        let largest = |output: usize| {
            let change = |own: &Vec<f64>| (own[output] - points[0][output]).abs();
            points.iter().map(change).fold(0.0, f64::max)
        };
        let changes: Vec<f64> = (0..count).map(largest).collect();
        let changes = subject.sizes_of_groups(&changes);
        for (output, name) in subject.outputs.iter().enumerate() {
            let (first, change) = (points[0][output], changes[output]);
            let floor = bench.floor(output, &[first, first + change]);
            for weight in 0..WEIGHTS {
                let expected = gauss(POINTS).zip(&points).map(|([share, part], own)| {
                    let mut values = [0.0; WEIGHTS];
                    legendre(share, &mut values);
                    part * values[weight] * own[output]
                });
                let place = format!("integral {weight} of {name}");
                let found = found[count * (1 + weight) + output];
                let expected: f64 = expected.sum();
                fine.near(&place, found, expected, SHARE * change + floor);
                coarse.near(place, found, expected, COARSE[weight] * change + floor);
            }
        }
        match coarse.holds() {
            true => verdict.judge(
                fine,
                Grade::Warn,
                "not as close to the quadrature as they should be: few internal steps of a solver of low order fall into the macro step",
            ),
            false => verdict.judge(coarse, bench.grade_of_motion(), "other values than the quadrature"),
        }
        Ok(())
    }
}
