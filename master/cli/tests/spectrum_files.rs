//! `linchpin spectrum`: what it writes, and what it says to wrong files.
#![allow(missing_docs, clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use linchpin_master::scene::is_spectrum;
use tempfile::TempDir;

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes");

const FILE: &str = r#"[spectrum]
name = "small"
from = 0.1
to = 1.0
points = 3

[[spectrum.curve]]
label = "Bathe"
scheme = { kind = "bathe" }

[[spectrum.curve]]
label = "HETS"
scheme = { kind = "hets" }
"#;

const REGION: &str = r#"
[spectrum.region]
alpha_m = { from = -1, to = 0.8, points = 10 }
alpha_f = { from = -0.5, to = 0.7, points = 7 }
[[spectrum.region.point]]
label = "B"
alpha_m = -1
alpha_f = 0
"#;

struct Workshop(TempDir);

impl Workshop {
    fn with(file: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("file.toml"), file).unwrap();
        Self(folder)
    }

    fn run(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_linchpin"));
        command.current_dir(self.0.path()).args(arguments);
        command.output().unwrap()
    }

    fn succeeds(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), told.as_str()), (Some(0), ""));
        String::from_utf8(output.stdout).unwrap()
    }

    #[track_caller]
    fn fails(&self, arguments: &[&str], code: i32, pieces: &[&str]) {
        let output = self.run(arguments);
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{told}");
        for piece in pieces {
            assert!(told.contains(piece), "{piece:?} is missing in\n{told}");
        }
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.path().join(name)).unwrap()
    }

    fn has(&self, name: &str) -> bool {
        self.0.path().join(name).exists()
    }
}

#[test]
fn tables_pictures_and_a_summary() {
    let workshop = Workshop::with(FILE);
    let told = workshop.succeeds(&["spectrum", "file.toml"]);
    let expected = "Bathe: spectral radius 0.6485 at dt / T = 1\n\
                    HETS: unstable from dt / T = 1.000 on\nresults in out/small\n";
    assert_eq!(told, expected);
    let table = workshop.read("out/small/spectrum.csv");
    let lines: Vec<&str> = table.lines().collect();
    let header = "curve,dt_over_period,spectral_radius,principal_modulus,relative_period_error,damping_ratio";
    assert_eq!((lines[0], lines.len()), (header, 7));
    assert!(lines[1].starts_with("Bathe,0.1,0.999493934337"), "{table}");
    assert!(lines[6].starts_with("HETS,1.0,37.45171655"), "{table}");
    assert!(lines[6].ends_with(",,,"), "{table}");
    for name in ["spectrum.svg", "spectrum.png"] {
        assert!(workshop.has(&format!("out/small/{name}")), "{name}");
    }
    assert!(!workshop.has("out/small/region.csv"));
}

#[test]
fn a_region_alone() {
    let head = &FILE[..FILE.find("[[spectrum.curve]]").unwrap()];
    let workshop = Workshop::with(&format!("{head}{REGION}"));
    let arguments = ["spectrum", "file.toml", "--out", "there", "--quiet"];
    assert_eq!(workshop.succeeds(&arguments), "");
    let table = workshop.read("there/region.csv");
    let header = "alpha_m,alpha_f,largest_radius,radius_at_infinity,verdict";
    assert_eq!(table.lines().next(), Some(header));
    assert_eq!(table.lines().count(), 71);
    for line in table.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let [alpha_m, alpha_f] = [0, 1].map(|field| fields[field].parse::<f64>().unwrap());
        // On the limits themselves the grid has rounding.
        let is_stable = alpha_m <= alpha_f + 1e-9 && alpha_f <= 0.5 + 1e-9;
        assert_eq!(fields[4] == "stable", is_stable, "{line}");
    }
    for name in ["region.svg", "region.png"] {
        assert!(workshop.has(&format!("there/{name}")), "{name}");
    }
    assert!(!workshop.has("there/spectrum.csv"));
}

#[test]
fn a_region_beside_curves_is_counted() {
    let workshop = Workshop::with(&format!("{FILE}{REGION}"));
    let told = workshop.succeeds(&["spectrum", "file.toml", "--out", "out"]);
    assert!(told.contains("region: "), "{told}");
    assert!(
        told.contains("of 70 points stable\nresults in out\n"),
        "{told}"
    );
}

#[test]
fn mistakes_in_the_file() {
    let workshop = Workshop::with(&FILE.replace("\"bathe\"", "\"bath\""));
    let pieces = [
        "error: file.toml:9:19: ",
        "no choice \"bath\"",
        "did you mean `bathe`?",
    ];
    workshop.fails(&["spectrum", "file.toml"], 2, &pieces);
    workshop.fails(&["check", "file.toml"], 2, &pieces);
    assert!(!workshop.has("out"));
    let pieces = ["there is no spectrum file nothing.toml", "check the path"];
    workshop.fails(&["spectrum", "nothing.toml"], 2, &pieces);
    let scene = format!("{SCENES}/oscillator.toml");
    let pieces = ["lacks `spectrum`", "for example [spectrum] with name"];
    workshop.fails(&["spectrum", &scene], 2, &pieces);
    workshop.fails(&["spectrum"], 2, &["<FILE>"]);
}

#[test]
fn a_folder_that_cannot_be_written_to() {
    let workshop = Workshop::with(FILE);
    let arguments = ["spectrum", "file.toml", "--out", "file.toml"];
    workshop.fails(&arguments, 1, &["cannot write to file.toml", "--out"]);
}

#[test]
fn commands_that_want_a_scene_name_the_right_one() {
    let workshop = Workshop::with(FILE);
    for command in ["run", "converge", "stability"] {
        let pieces = [
            "file.toml describes spectra",
            "give it to linchpin spectrum",
        ];
        workshop.fails(&[command, "file.toml"], 2, &pieces);
    }
    let told = workshop.succeeds(&["check", "file.toml"]);
    assert_eq!(told, "file.toml: ok\n");
    let arguments = ["check", "file.toml", "--set", "spectrum.points=2"];
    workshop.fails(
        &arguments,
        2,
        &["--set changes scenes", "change the file itself"],
    );
}

fn shipped() -> Vec<PathBuf> {
    let entries = fs::read_dir(Path::new(SCENES).join("s2")).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| is_spectrum(file));
    files.sort();
    files
}

/// The summary of every shipped file; explicit schemes alone become unstable.
#[test]
fn figures_of_the_paper() {
    let files = shipped();
    assert!(files.len() >= 7, "{files:?}");
    let workshop = Workshop::with("");
    for file in files {
        let file = file.to_str().unwrap();
        workshop.succeeds(&["check", file]);
        let told = workshop.succeeds(&["spectrum", file]);
        for line in told.lines() {
            let is_explicit = line.starts_with("Moreau") || line.starts_with("HETS");
            assert_eq!(line.contains("unstable"), is_explicit, "{file}: {line}");
        }
        // The name of the file is that of its folder of results.
        let name = Path::new(file).file_stem().unwrap().to_str().unwrap();
        assert!(
            told.ends_with(&format!("results in out/s2-{name}\n")),
            "{told}"
        );
    }
}
