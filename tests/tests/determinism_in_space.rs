//! Mechanisms with exchanged attitudes and loads that turn: the same scene gives the same bits in one process and across
//! several, over the stream and over single calls, and in any order of the subsystems and joints.

#![allow(clippy::unwrap_used, missing_docs)]

use std::collections::BTreeMap;

use linchpin::connect::Place;
use linchpin_tests::in_space::joints;
use linchpin_tests::in_space::pair::Pair;
use linchpin_tests::process::Workshop;
use linchpin_tests::runs::run;
use linchpin_tests::scenes::with_settings;

const MECHANISMS: [(&str, &str); 3] = [
    (
        "pendulum",
        include_str!("../../scenes/spatial/universal-pendulum.toml"),
    ),
    ("gimbal", include_str!("../../scenes/spatial/gimbal.toml")),
    ("four-bar", include_str!("../../scenes/four-bar.toml")),
];

/// Every kind of load and exchanged variable, with a macro step that does not divide the time.
const COUPLINGS: [&str; 5] = [
    "degree=1 macro_step=1e-3",
    "degree=2 exchanged_degree=3 macro_step=1e-3",
    "degree=1 macro_step=1e-3 loads=master",
    "method=baumgarte degree=0 macro_step=1e-3",
    "index=2 b=0 degree=0 macro_step=1e-3",
];

const T_END: &str = "scene.t_end=0.02043";

/// The same scene with its subsystems in the opposite order.
fn reversed(text: &str) -> String {
    let (before, from) = text.split_at(text.find("[[subsystem]]").unwrap());
    let (subsystems, after) = from.split_at(from.find("[[joint]]").unwrap());
    let mut subsystems: Vec<&str> = subsystems.split("[[subsystem]]").skip(1).collect();
    subsystems.reverse();
    let subsystems = subsystems.iter();
    let subsystems = subsystems.map(|subsystem| format!("[[subsystem]]{subsystem}\n"));
    [before, &subsystems.collect::<String>(), after].concat()
}

fn scenes() -> Vec<(&'static str, String)> {
    let mut scenes: Vec<_> = MECHANISMS
        .map(|(name, text)| (name, text.to_owned()))
        .into();
    for joint in joints::all() {
        scenes.push((joints::name(&joint), Pair::floating(joint).scene_text(0.03)));
    }
    scenes
}

#[test]
fn threads_single_calls_and_order_change_no_bit() {
    for (name, text) in scenes() {
        let turned = reversed(&text);
        assert_ne!(turned, text);
        for coupling in COUPLINGS {
            let scene = |text: &str, others: &[&str]| {
                let others = [others, &[T_END]].concat();
                with_settings(text, coupling, &others)
            };
            let expected = run(&scene(&text, &[]), Place::InProcess).bits();
            let unary = ["subsystem.*.calls=unary"];
            let runs = [
                ("again", run(&scene(&text, &[]), Place::InProcess)),
                ("threads", run(&scene(&text, &[]), Place::Threads)),
                ("single calls", run(&scene(&text, &unary), Place::InProcess)),
                (
                    "other order of subsystems",
                    run(&scene(&turned, &[]), Place::InProcess),
                ),
            ];
            for (what, run) in runs {
                assert!(run.bits() == expected, "{name}, {coupling}: {what}");
            }
        }
    }
}

/// Columns of a table of results by name.
fn columns(table: &str) -> BTreeMap<String, Vec<String>> {
    let mut lines = table.lines().map(|line| line.split(','));
    let names: Vec<&str> = lines.next().unwrap().collect();
    let mut columns = BTreeMap::new();
    for line in lines {
        for (name, value) in names.iter().zip(line) {
            let column: &mut Vec<String> = columns.entry((*name).to_owned()).or_default();
            column.push(value.to_owned());
        }
    }
    columns
}

#[test]
fn processes_write_the_same_table() {
    let workshop = Workshop::new();
    for (name, text) in MECHANISMS {
        let table = |text: &str, what: &str, others: &[&str]| {
            let (file, out) = (format!("{name}-{what}.toml"), format!("{name}-{what}"));
            workshop.write(&file, text);
            let all = [
                "run",
                &file,
                "--out",
                &out,
                "--no-plots",
                "--quiet",
                "--set",
                T_END,
            ];
            workshop.run(&[&all, others].concat()).succeeds();
            workshop.read(&format!("{out}/results.csv"))
        };
        let expected = table(text, "one-process", &["--in-process"]);
        assert_eq!(expected.lines().count(), 23, "{name}");
        assert!(table(text, "processes", &[]) == expected, "{name}");
        let turned = table(&reversed(text), "turned", &[]);
        assert!(
            turned != expected,
            "{name}: the columns stand in another order"
        );
        assert!(columns(&turned) == columns(&expected), "{name}");
    }
}
