//! Resident memory of the master over the run.

use linchpin::connect::Place;

use crate::macro_steps::Running;

/// Prints the memory after so many macro steps. Steps of 1e-4 s: the chain goes on for 1 s.
pub fn print_table() {
    println!("\nResident memory of the master in kB\n");
    println!("| links | workers | after 1000 macro steps | after 10000 |");
    println!("|---|---|---|---|");
    for (links, place) in [(64, Place::Processes), (64, Place::InProcess)] {
        let settings = ["scene.t_end=2", "coupling.macro_step=1e-4"];
        let mut running = Running::start(links, place, &settings);
        running.steps(1000);
        let early = resident();
        running.steps(9000);
        println!("| {links} | {place:?} | {early} | {} |", resident());
    }
}

/// As the system tells it, in kB.
fn resident() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status
        .lines()
        .find(|line| line.starts_with("VmRSS:"))
        .unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}
