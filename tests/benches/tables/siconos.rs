//! Runs of Siconos on the same mechanism, by `tests/siconos/run.py` with compiled callbacks.

use std::path::Path;
use std::process::Command;

/// A run.
pub struct Run {
    /// Seconds for a step of its loop.
    pub seconds_per_step: f64,
    /// Angles at the samples, the start left out.
    pub samples: Vec<[f64; 3]>,
}

/// Moreau-Jean with theta = 1/2 on Table 1; `None` if Siconos or a compiler is not there.
pub fn run(dt: f64, t_end: f64, samples: usize) -> Option<Run> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("siconos/run.py");
    let output = Command::new("/usr/bin/python3")
        .arg(script)
        .args([
            "slider-crank-1",
            "--dt",
            &dt.to_string(),
            "--t-end",
            &t_end.to_string(),
        ])
        .args(["--samples", &samples.to_string()])
        .output()
        .ok()?;
    match output.status.code() {
        Some(0) => {}
        Some(3) => return None,
        code => panic!(
            "siconos ended with {code:?}: {}",
            String::from_utf8_lossy(&output.stderr)
        ),
    }
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let angles =
        |sample: &serde_json::Value| [0, 1, 2].map(|place| sample["q"][place].as_f64().unwrap());
    Some(Run {
        seconds_per_step: json["seconds_per_step"].as_f64().unwrap(),
        samples: json["samples"]
            .as_array()
            .unwrap()
            .iter()
            .skip(1)
            .map(angles)
            .collect(),
    })
}
