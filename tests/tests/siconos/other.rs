//! Runs of Siconos.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::SLOWEST;

/// A problem of run.py with what differs from its defaults.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    pub name: &'a str,
    pub settings: &'a [(&'a str, f64)],
    pub t_end: f64,
    /// At equal distances, after the start.
    pub samples: usize,
}

/// What a run tells.
#[derive(Debug)]
pub struct Other {
    /// Coordinates at the samples.
    pub samples: Vec<Vec<f64>>,
    /// Contact forces at the samples, normal and tangential one of every contact.
    pub forces: Vec<Vec<f64>>,
    /// Start of its step.
    pub first_impact: Option<f64>,
    /// Impacts faster than [`SLOWEST`].
    pub impacts: usize,
    pub loss: f64,
}

/// Runs a problem; `None` where Siconos or a compiler is missing.
pub fn run(problem: Problem<'_>, dt: f64) -> Option<Other> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("siconos/run.py");
    let mut command = Command::new("/usr/bin/python3");
    command
        .arg(script)
        .arg(problem.name)
        .args(["--dt", &dt.to_string()])
        .args(["--t-end", &problem.t_end.to_string()])
        .args(["--samples", &problem.samples.to_string()])
        .args(["--threshold", &SLOWEST.to_string()]);
    for (key, value) in problem.settings {
        command.args(["--set", &format!("{key}={value}")]);
    }
    let Ok(output) = command.output() else {
        println!("skipped: /usr/bin/python3 is missing");
        return None;
    };
    let complaint = String::from_utf8_lossy(&output.stderr);
    match output.status.code() {
        Some(0) => Some(read(&serde_json::from_slice(&output.stdout).unwrap())),
        Some(3) => {
            println!("skipped: {complaint}");
            None
        }
        code => panic!("siconos {problem:?} ended with {code:?}: {complaint}"),
    }
}

fn read(run: &Value) -> Other {
    let samples = &run["samples"].as_array().unwrap()[1..];
    let forces = |sample: &Value| {
        let contacts = sample["forces"].as_array().unwrap();
        contacts.iter().flat_map(numbers).collect()
    };
    Other {
        samples: samples.iter().map(|sample| numbers(&sample["q"])).collect(),
        forces: samples.iter().map(forces).collect(),
        first_impact: run["first_impact"].as_f64(),
        impacts: run["impact_count"].as_u64().unwrap() as usize,
        loss: run["energy_loss"].as_f64().unwrap(),
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap();
    list.iter().map(|number| number.as_f64().unwrap()).collect()
}
