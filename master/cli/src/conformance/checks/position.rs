//! Positions change by the velocities.

use nalgebra::{Quaternion, UnitQuaternion};

use super::velocity::BEFORE;
use super::{About, Check};
use crate::conformance::bench::{Bench, PRELUDE};
use crate::conformance::compare::{Comparison, rounding};
use crate::conformance::inputs::Inputs;
use crate::conformance::measured::{LIMIT_SHARE, Limit, allowed, in_the_limit};
use crate::conformance::subject::{Marker, Motion};
use crate::conformance::verdict::{Stop, Verdict};

/// The change of position over a short step is its length times the mean velocity; attitudes turn by the angular velocity.
pub struct Position;

/// A change of a component over a step.
struct Change {
    place: String,
    motion: Motion,
    /// Of position or rotation vector (m, rad).
    found: f64,
    /// By the mean velocity.
    expected: f64,
    /// By rounding.
    rounding: f64,
}

impl Check for Position {
    fn about(&self) -> About {
        About {
            name: "position",
            title: "positions change by the mean velocity, attitudes by the mean angular velocity",
            equation: "r(T + h) - r(T) = h (v(T) + v(T + h))/2 + O(h^3); in space the rotation vector of q(T + h) q(T)^-1 = h times the \
                       mean omega",
            tolerance: "1e-3 of the change, at the one of the steps h = H, H/4, .. that misses it least",
            look_at: "whether velocities are those of the point and in inertial axes, the order w, x, y, z of quaternions, whether they turn \
                      from the body to space and not back, and whether outputs are those of the end of the step",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let markers = &bench.subject.markers;
        if markers
            .iter()
            .all(|own| own.position.is_empty() || own.velocity.is_empty())
        {
            return Err(Stop::not_applicable(
                "no marker of the model tells position and velocity",
            ));
        }
        // Those that the prelude ends with: no solver has to notice a jump.
        let inputs = bench.prelude(PRELUDE);
        let limit = closest(bench, &inputs)?;
        limit.judge(
            verdict,
            bench.grade_of_motion(),
            "positions change otherwise",
        );
        Ok(())
    }
}

fn closest(bench: &Bench<'_>, inputs: &Inputs) -> Result<Limit, Stop> {
    let mut instance = bench.in_motion()?;
    let start = instance.keep()?;
    in_the_limit(bench.step(), |step| {
        instance.go_back(&start)?;
        for _ in 0..BEFORE {
            instance.step(step, inputs)?;
        }
        let before = instance.evaluate(&inputs.values(0.0))?;
        let after = instance.step(step, inputs)?;
        let names = &bench.subject.outputs;
        let changes: Vec<Change> = bench
            .subject
            .markers
            .iter()
            .flat_map(|marker| changes(marker, names, step, [&before, &after]))
            .collect();
        let size = |of: Motion| {
            let alike = changes.iter().filter(|own| own.motion == of);
            alike.fold(0.0_f64, |size, own| {
                size.max(own.found.abs()).max(own.expected.abs())
            })
        };
        let mut comparison = Comparison::default();
        for own in &changes {
            let floor = 4.0 * bench.tolerance + own.rounding;
            if let Some(allowed) = allowed(LIMIT_SHARE, size(own.motion), floor) {
                comparison.near(&own.place, own.found, own.expected, allowed);
            }
        }
        Ok(comparison)
    })
}

fn changes(
    marker: &Marker,
    names: &[String],
    step: f64,
    [before, after]: [&[f64]; 2],
) -> Vec<Change> {
    let by_velocity = |place: usize| step * (before[place] + after[place]) / 2.0;
    let plain = match marker.quaternion() {
        Some(_) => marker.translations(),
        None => marker.position.len(),
    };
    let places = marker
        .position
        .iter()
        .zip(&marker.velocity)
        .take(plain)
        .enumerate();
    let mut changes: Vec<Change> = places
        .map(|(component, (&position, &velocity))| Change {
            place: format!("change of {}", names[position]),
            motion: marker.motion(component),
            found: after[position] - before[position],
            expected: by_velocity(velocity),
            rounding: rounding(&[before[position], after[position]]),
        })
        .collect();
    let omega = marker.velocity.get(plain..).unwrap_or_default();
    let turned = marker
        .quaternion()
        .and_then(|places| turn(places, [before, after]));
    if let Some(turned) = turned {
        let components = omega.iter().zip(turned).zip(["x", "y", "z"]);
        changes.extend(components.map(|((&omega, found), axis)| Change {
            place: format!("rotation vector of marker \"{}\" about {axis}", marker.name),
            motion: Motion::Rotation,
            found,
            expected: by_velocity(omega),
            rounding: rounding(&[1.0]),
        }));
    }
    changes
}

/// The rotation vector of `q(T + h) q(T)^-1` (rad), in inertial axes; both signs of a quaternion are the same attitude.
fn turn(places: [usize; 4], states: [&[f64]; 2]) -> Option<[f64; 3]> {
    let [before, after] = states.map(|values| {
        let [w, x, y, z] = places.map(|place| values[place]);
        UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 0.0)
    });
    let vector = (after? * before?.inverse()).scaled_axis();
    Some([vector.x, vector.y, vector.z])
}
