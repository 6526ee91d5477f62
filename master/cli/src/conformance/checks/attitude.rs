//! Quaternions have the length 1.

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// How far the length of a quaternion may be from 1 besides the solver's tolerance: rounding over many internal steps.
const ROUNDING: f64 = 1e-9;

/// Steps that are looked at.
const STEPS: usize = 10;

/// The attitude of every spatial marker is a unit quaternion.
pub struct Attitude;

impl Check for Attitude {
    fn about(&self) -> About {
        About {
            name: "attitude",
            title: "quaternions of markers have the length 1",
            equation: "w^2 + x^2 + y^2 + z^2 = 1",
            tolerance: "1e-9 and 4 times the solver's tolerance",
            look_at: "the order w, x, y, z of the position of spatial markers, and whether the quaternion is normalised",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let markers = &bench.subject.markers;
        if markers.iter().all(|marker| marker.quaternion().is_none()) {
            return Err(Stop::not_applicable(
                "the model has no spatial marker with an attitude",
            ));
        }
        let mut instance = bench.in_motion()?;
        let mut comparison = Comparison::default();
        for number in 0..STEPS {
            let values = instance.step(bench.step(), &bench.at_turn(number))?;
            for marker in markers {
                if let Some(places) = marker.quaternion() {
                    let length = places
                        .map(|place| values[place].powi(2))
                        .iter()
                        .sum::<f64>()
                        .sqrt();
                    let place = format!("length of the quaternion of marker \"{}\"", marker.name);
                    comparison.near(place, length, 1.0, ROUNDING + 4.0 * bench.tolerance);
                }
            }
        }
        verdict.judge(comparison, Grade::Fail, "not of length 1");
        Ok(())
    }
}
