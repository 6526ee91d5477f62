//! Lines of the summary that are many where there are many subsystems: the worst of them.

use std::fmt::Write;

use linchpin_master::results::JointResiduals;

/// As many are shown all, in their order.
const MOST: usize = 12;

/// Of more these, the worst first.
const WORST: usize = 4;

/// What is shown of many.
pub(super) struct Worst<T> {
    /// All of few in their order; of many the worst ones, the worst first.
    pub shown: Vec<T>,
    /// How many are not shown.
    pub more: usize,
}

impl<T> Worst<T> {
    /// Of items that are the worse the larger `badness` is; what is no number counts as worst.
    pub fn of(items: impl IntoIterator<Item = T>, badness: impl Fn(&T) -> f64) -> Self {
        let mut shown: Vec<T> = items.into_iter().collect();
        let all = shown.len();
        if all > MOST {
            let rank = |item: &T| {
                let badness = badness(item);
                if badness.is_nan() {
                    f64::INFINITY
                } else {
                    badness
                }
            };
            shown.sort_by(|one, other| rank(other).total_cmp(&rank(one)));
            shown.truncate(WORST);
        }
        let more = all - shown.len();
        Self { shown, more }
    }
}

/// Says how many lines are left out, and what is true of them.
pub(super) fn write_more(more: usize, what: &str, text: &mut String) -> std::fmt::Result {
    match more {
        0 => Ok(()),
        more => writeln!(text, "  .. and {more} more {what}"),
    }
}

/// The largest residuals of all joints, of many those of every level apart, since they have other units.
pub(super) fn write_residuals(joints: &[JointResiduals], text: &mut String) -> std::fmt::Result {
    if joints.len() <= MOST {
        return joints.iter().try_for_each(|own| write_residual(own, text));
    }
    let mut levels: Vec<&str> = Vec::new();
    for own in joints {
        if !levels.contains(&own.level.as_str()) {
            levels.push(&own.level);
        }
    }
    for level in levels {
        let of_level = joints.iter().filter(|own| own.level == level);
        let worst = Worst::of(of_level, |own| own.largest);
        worst
            .shown
            .into_iter()
            .try_for_each(|own| write_residual(own, text))?;
        write_more(
            worst.more,
            &format!("residuals on {level} level, all smaller"),
            text,
        )?;
    }
    Ok(())
}

fn write_residual(own: &JointResiduals, text: &mut String) -> std::fmt::Result {
    let what = [&own.part[..], &own.level[..]].join(" ");
    let name = format!("{} ({})", own.joint, what.trim_start());
    writeln!(
        text,
        "  residual of {name:<19} {:>10.3e} largest",
        own.largest
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_stay_in_their_order_and_of_many_the_worst_come_first() {
        let few = Worst::of([3.0, 1.0, 2.0], |own| *own);
        assert_eq!((few.shown, few.more), (vec![3.0, 1.0, 2.0], 0));
        let many = Worst::of((0..64).map(|i| f64::from((i * 37) % 64)), |own| *own);
        assert_eq!((many.shown, many.more), (vec![63.0, 62.0, 61.0, 60.0], 60));
        let broken = Worst::of(
            (0..64).map(|i| if i == 5 { f64::NAN } else { 1.0 }),
            |own| *own,
        );
        assert!(broken.shown[0].is_nan());
    }

    #[test]
    fn residuals_of_many_joints_are_the_worst_of_every_level() {
        let residual = |number: usize, level: &str, largest: f64| JointResiduals {
            joint: format!("hinge{number}"),
            part: "x".into(),
            level: level.into(),
            largest,
        };
        let joints: Vec<JointResiduals> = (0..63)
            .flat_map(|number| {
                let largest = number as f64;
                [
                    residual(number, "position", 1e-9 * largest),
                    residual(number, "velocity", largest),
                ]
            })
            .collect();
        let mut text = String::new();
        write_residuals(&joints, &mut text).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 2 * (WORST + 1), "{text}");
        assert!(
            lines[0].contains("hinge62 (x position)") && lines[5].contains("hinge62 (x velocity)")
        );
        assert_eq!(
            lines[9],
            "  .. and 59 more residuals on velocity level, all smaller"
        );
    }
}
