//! The graph as a text for Graphviz.

use std::fmt::Write;

use super::Graph;

/// The graph in the language DOT: joints are plain lines, signals dashed arrows.
pub fn dot(graph: &Graph) -> String {
    let mut text = format!("digraph {} {{\n  rankdir=LR;\n", quoted(&graph.name));
    text += "  node [shape=box, style=rounded];\n";
    // Writing to a string does not fail.
    for node in &graph.nodes {
        let label = [std::slice::from_ref(&node.name), &node.lines].concat();
        let _ = writeln!(text, "  {} [label={}];", quoted(&node.name), lines(&label));
    }
    for edge in &graph.edges {
        let [from, to] = edge.ends.map(|end| quoted(&graph.nodes[end].name));
        let style = if edge.is_signal {
            "style=dashed"
        } else {
            "dir=none"
        };
        let _ = writeln!(
            text,
            "  {from} -> {to} [label={}, {style}];",
            lines(&edge.lines)
        );
    }
    text + "}\n"
}

fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"")
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", escaped(text))
}

fn lines(lines: &[String]) -> String {
    let lines: Vec<String> = lines.iter().map(|line| escaped(line)).collect();
    format!("\"{}\"", lines.join("\\n"))
}
