//! Resident memory of the master over the run.

use linchpin::connect::Place;

use crate::macro_steps::Running;

/// Shows the memory after so many macro steps. Steps of 1e-4 s: the chain goes on for 1 s.
pub fn show() {
    let mut table =
        String::from("| 64 workers | after 1000 macro steps, MB | after 10,000 |\n|---|---|---|\n");
    for (where_they_are, place) in [
        ("in processes of their own", Place::Processes),
        (
            "in the process of the master, counted with it",
            Place::InProcess,
        ),
    ] {
        let settings = ["scene.t_end=2", "coupling.macro_step=1e-4"];
        let mut running = Running::start(64, place, &settings);
        running.steps(1000);
        let early = resident();
        running.steps(9000);
        table += &format!("| {where_they_are} | {early:.1} | {:.1} |\n", resident());
    }
    crate::show("memory", &table);
}

/// As the system tells it, in MB.
fn resident() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status
        .lines()
        .find(|line| line.starts_with("VmRSS:"))
        .unwrap();
    let kilobytes: f64 = line.split_whitespace().nth(1).unwrap().parse().unwrap();
    1e-3 * kilobytes
}
