//! The graph of a scene: subsystems, the joints that hold them together, and the signals between them.
//!
//! * [`dot`]: as a text for Graphviz;
//! * [`svg`]: as a picture.

mod dot;
mod svg;

pub use dot::dot;
pub use svg::svg;

use linchpin_master::scene::{Scene, Served, Side, Subsystem};

/// What a scene couples.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Graph {
    /// Name of the scene.
    pub name: String,
    /// Subsystems in the order of the scene; the ground too, if a joint has it.
    pub nodes: Vec<Node>,
    /// Joints, then signals, in the order of the scene.
    pub edges: Vec<Edge>,
}

/// A subsystem.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Its model, and who serves it, a line each.
    pub lines: Vec<String>,
}

/// A joint or a signal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Edge {
    /// Places of its ends in the nodes: a and b of a joint, from and to of a signal.
    pub ends: [usize; 2],
    /// What stands at it, a line each.
    pub lines: Vec<String>,
    /// Whether it is a signal.
    pub is_signal: bool,
}

impl Graph {
    /// The graph of a scene.
    pub fn of(scene: &Scene) -> Self {
        let settings = scene.settings();
        let joints = scene.joints.iter().map(|joint| {
            let kind = settings.get(&format!("joint.{}.kind", joint.name));
            let mut lines = vec![joint.name.clone()];
            lines.extend(kind.cloned());
            lines.extend(markers(&joint.a, &joint.b));
            Edge {
                ends: [joint.a.subsystem, joint.b.subsystem],
                lines,
                is_signal: false,
            }
        });
        let signals = scene.connections.iter().map(|own| {
            let ((from, output), (to, input)) = (&own.from, &own.to);
            Edge {
                ends: [*from, *to],
                lines: vec![format!("{output} \u{2192} {input}")],
                is_signal: true,
            }
        });
        Self {
            name: scene.name.clone(),
            nodes: scene.subsystems.iter().map(node).collect(),
            edges: joints.chain(signals).collect(),
        }
    }
}

fn node(subsystem: &Subsystem) -> Node {
    let served = match &subsystem.served {
        Served::BuiltIn => None,
        Served::Address(address) => Some(address.clone()),
        Served::Command(words) => Some(words.join(" ")),
        Served::Fmu(path) => path
            .file_name()
            .map(|name| name.to_string_lossy().into_owned()),
    };
    let model = subsystem
        .model
        .clone()
        .filter(|model| *model != subsystem.name);
    Node {
        name: subsystem.name.clone(),
        lines: model.into_iter().chain(served).collect(),
    }
}

/// The markers that a joint names.
fn markers(a: &Side, b: &Side) -> Option<String> {
    let named = |side: &Side| side.marker.clone();
    match (named(a), named(b)) {
        (None, None) => None,
        (a, b) => {
            let [a, b] = [a, b].map(|marker| marker.unwrap_or_else(|| "its marker".into()));
            Some(format!("{a} \u{2013} {b}"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use linchpin_master::scene::parse;

    fn drive() -> Graph {
        let text = include_str!("../../../../scenes/motor/driven-link.toml");
        Graph::of(&parse(text, "driven-link.toml", &[]).unwrap())
    }

    #[test]
    fn subsystems_joints_and_signals_are_there() {
        let graph = drive();
        let of = |name: &str| {
            graph
                .nodes
                .iter()
                .position(|node| node.name == name)
                .unwrap()
        };
        let signals: Vec<&Edge> = graph.edges.iter().filter(|edge| edge.is_signal).collect();
        assert!(
            !signals.is_empty() && signals.len() < graph.edges.len(),
            "{graph:?}"
        );
        for edge in &graph.edges {
            assert!(
                edge.ends.iter().all(|end| *end < graph.nodes.len()),
                "{edge:?}"
            );
        }
        assert!(
            graph.nodes[of("motor")]
                .lines
                .contains(&"dc-motor".to_owned())
        );
    }

    #[test]
    fn both_texts_hold_every_name() {
        let graph = drive();
        let (dot, svg) = (dot(&graph), svg(&graph));
        for name in graph.nodes.iter().map(|node| &node.name) {
            assert!(dot.contains(&format!("\"{name}\"")), "{name}\n{dot}");
            assert!(svg.contains(&format!(">{name}<")), "{name}\n{svg}");
        }
        for line in graph.edges.iter().flat_map(|edge| &edge.lines) {
            assert!(dot.contains(line) && svg.contains(line), "{line}");
        }
        let dashed = graph.edges.iter().filter(|edge| edge.is_signal).count();
        assert_eq!(dot.matches("style=dashed").count(), dashed);
        assert!(svg.matches("stroke-dasharray").count() >= dashed);
    }

    #[test]
    fn names_with_signs_of_the_formats_are_written_as_text() {
        let mut graph = drive();
        graph.nodes[0].name = "a\"<&>\\".into();
        assert!(dot(&graph).contains(r#""a\"<&>\\""#));
        assert!(svg(&graph).contains("a&quot;&lt;&amp;&gt;\\"));
    }
}
