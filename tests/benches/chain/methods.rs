//! The macro step of a chain with one coupling method and the other.

use linchpin::connect::Place;

use crate::LINKS;
use crate::macro_steps::measure;

/// Names and settings; the first is what the others are compared with.
const METHODS: [(&str, &[&str]); 4] = [
    ("weighted", &[]),
    (
        "Hermite, p = 2",
        &["coupling.method=hermite", "coupling.degree=2"],
    ),
    ("p = 3", &["coupling.method=hermite", "coupling.degree=3"]),
    ("p = 4", &["coupling.method=hermite", "coupling.degree=4"]),
];

/// Shows what a macro step takes without the time in the solvers, and how many times that of the first method that is.
pub fn show() {
    let names: Vec<&str> = METHODS.iter().map(|&(name, _)| name).collect();
    let mut table = format!("| links | {} |\n|---|", names.join(" | "));
    table += &"---|".repeat(METHODS.len());
    for links in LINKS {
        table += &format!("\n| {links} |");
        let costs = METHODS.map(|(_, settings)| measure(links, Place::InProcess, settings).master);
        for cost in costs {
            table += &format!(" {cost:.0} ({:.2}) |", cost / costs[0]);
        }
    }
    table.push('\n');
    crate::show("methods", &table);
}
