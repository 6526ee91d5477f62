//! Subsystems between which nothing is coupled.

use super::warning::Warning;
use super::whole::Scene;

/// A warning if joints and connections do not hold the subsystems of a scene together: then they run side by side, which may be
/// what is wanted, but is more often a joint that was forgotten. A scene of one subsystem has nothing to couple.
pub(super) fn warning(scene: &Scene) -> Option<Warning> {
    let groups = groups(scene);
    if groups.len() < 2 {
        return None;
    }
    let names = |group: &Vec<usize>| {
        let names = group
            .iter()
            .map(|number| scene.subsystems[*number].name.as_str());
        names.collect::<Vec<_>>().join(", ")
    };
    let shown: Vec<String> = groups.iter().map(names).collect();
    Some(Warning {
        key: "subsystem",
        place: scene.place("subsystem"),
        what: "the scene falls apart".to_owned(),
        rule: format!(
            "no joint or connection holds these {} groups of subsystems together: {}",
            groups.len(),
            shown.join(" | ")
        ),
        remedy:
            "add the [[joint]] or [[connection]] that is missing, or run a scene for each group"
                .to_owned(),
    })
}

/// Groups of subsystems that joints and connections hold together, each in the order of the scene.
fn groups(scene: &Scene) -> Vec<Vec<usize>> {
    let joints = scene.joints.iter();
    let joints = joints.map(|joint| [joint.a.subsystem, joint.b.subsystem]);
    let connections = scene.connections.iter();
    let connections = connections.map(|connection| [connection.from.0, connection.to.0]);
    let mut groups: Vec<Vec<usize>> = (0..scene.subsystems.len()).map(|own| vec![own]).collect();
    for ends in joints.chain(connections) {
        let place = |end: usize| groups.iter().position(|group| group.contains(&end));
        if let [Some(one), Some(other)] = ends.map(place)
            && one != other
        {
            let moved = groups.remove(one.max(other));
            groups[one.min(other)].extend(moved);
        }
    }
    groups.iter_mut().for_each(|group| group.sort_unstable());
    groups
}

#[cfg(test)]
mod tests {
    use crate::scene::{parse, warnings};

    fn warned(joints: &[(&str, &str)]) -> Vec<String> {
        let mut text = "[scene]\nname = \"x\"\nt_end = 1.0\n[coupling]\nmethod = \"weighted\"\nmacro_step = 0.1\n".to_owned();
        for name in ["p", "q", "r", "s"] {
            text += &format!("[[subsystem]]\nname = \"{name}\"\nmodel = \"oscillator\"\n");
        }
        for (number, (a, b)) in joints.iter().enumerate() {
            text += &format!(
                "[[joint]]\nname = \"j{number}\"\nkind = \"rigid-link\"\na = \"{a}\"\nb = \"{b}\"\n"
            );
        }
        let scene = parse(&text, "x.toml", &[]).unwrap();
        warnings(&scene).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn groups_that_nothing_holds_together_are_told() {
        let all = warned(&[]);
        assert!(
            all.len() == 1 && all[0].contains("4 groups") && all[0].contains("p | q | r | s"),
            "{all:?}"
        );
        let two = warned(&[("s", "p"), ("r", "q")]);
        assert!(
            two.len() == 1 && two[0].contains("2 groups") && two[0].contains("p, s | q, r"),
            "{two:?}"
        );
        assert!(warned(&[("s", "p"), ("r", "q"), ("q", "s")]).is_empty());
    }
}
