//! What `--log` tells of a run, against what its report counts.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin_tests::process::{Outcome, Workshop};
use serde_json::Value;

/// A force sets in within a macro step: steps are rejected, the coupling Jacobian is refreshed.
const LOAD_STEP: &str = include_str!("../../scenes/hard/load-step.toml");

struct Logged {
    workshop: Workshop,
    outcome: Outcome,
}

impl Logged {
    /// Runs the scene with a log of this filter.
    #[track_caller]
    fn run(log: &str, more: &[&str]) -> Self {
        let workshop = Workshop::new();
        workshop.write("scene.toml", LOAD_STEP);
        let arguments = ["run", "scene.toml", "--in-process", "--quiet", "--log", log];
        let outcome = workshop.run(&[&arguments, more].concat());
        outcome.succeeds();
        Self { workshop, outcome }
    }

    fn lines<'a>(&'a self, words: &'a [&str]) -> impl Iterator<Item = &'a str> {
        let lines = self.outcome.stderr.lines();
        lines.filter(move |line| words.iter().all(|word| line.contains(word)))
    }

    fn statistics(&self) -> Value {
        let files = self.workshop.path().join("out/load-step/run.json");
        let report: Value = serde_json::from_str(&std::fs::read_to_string(files).unwrap()).unwrap();
        report["statistics"].clone()
    }

    fn results(&self) -> String {
        self.workshop.read("out/load-step/results.csv")
    }
}

#[test]
fn debug_has_a_line_for_every_decision() {
    let run = Logged::run("debug", &[]);
    let statistics = run.statistics();
    let count = |words: &[&str]| run.lines(words).count() as u64;
    assert_eq!(count(&[": accepted "]), statistics["macro_steps"]);
    let causes = &statistics["steps"]["rejected_by_cause"];
    assert!(causes["error"].as_u64().unwrap() > 2);
    assert_eq!(count(&["rejected: error above tolerance"]), causes["error"]);
    assert_eq!(count(&["rejected: "]), statistics["steps"]["rejected"]);
    // The first step begins with columns, which are no refresh; an attempt with columns may be rejected.
    let refreshes = count(&["Jacobian refresh", "because="]) + 1;
    let steps = statistics["corrections"]["steps_with_columns"]
        .as_u64()
        .unwrap();
    let rejected = statistics["steps"]["rejected"].as_u64().unwrap();
    assert!(
        (steps..=steps + rejected).contains(&refreshes),
        "{refreshes} {steps}"
    );
    let passes = &statistics["corrections"]["passes"];
    assert_eq!(count(&["corrected again", "rate="]), *passes);
}

/// The load sets in at 0.9137 s: the first step that is rejected passes it, and none that ends before is rejected.
#[test]
fn a_rejection_has_its_numbers() {
    let run = Logged::run("debug", &[]);
    let mut first = None;
    for line in run.lines(&["rejected: "]) {
        let number = |key: &str| -> f64 {
            let (_, value) = line.split_once(&format!(" {key}=")).unwrap();
            let end = value.find([' ', '}']).unwrap_or(value.len());
            value[..end].parse().unwrap()
        };
        assert!(number("error") > 1.0, "{line}");
        assert!(number("next_H") < number("H"), "{line}");
        assert!(number("t") + number("H") > 0.9137, "{line}");
        first.get_or_insert(number("t"));
    }
    assert!(first.unwrap() < 0.9137, "{first:?}");
}

#[test]
fn changes_of_degrees_are_told() {
    let run = Logged::run("debug", &["--set", "coupling.degree=automatic"]);
    let changes: Vec<_> = run.lines(&["degree changes", "Multipliers"]).collect();
    assert!(!changes.is_empty());
    assert!(
        changes.iter().all(|line| line.contains("error=")),
        "{changes:?}"
    );
}

#[test]
fn info_tells_a_story_of_one_screen() {
    let run = Logged::run("info", &[]);
    let lines: Vec<_> = run.lines(&[]).collect();
    assert!((4..25).contains(&lines.len()), "{}", run.outcome);
    assert!(
        lines[0].contains("coupled scene=\"load-step\""),
        "{}",
        run.outcome
    );
    let last = lines.last().unwrap();
    let steps = format!("steps={} ", run.statistics()["macro_steps"]);
    assert!(
        last.contains("finished t=2.0") && last.contains(&steps),
        "{last}"
    );
}

#[test]
fn trace_tells_what_every_part_of_a_step_takes() {
    let run = Logged::run("trace", &["--set", "scene.t_end=0.1"]);
    for span in ["macro_step{", "correction:", "exchange:", "look_ahead{"] {
        assert!(
            run.lines(&[span, "close time.busy="]).next().is_some(),
            "{span}"
        );
    }
}

#[test]
fn a_log_changes_no_result_and_silence_is_the_default() {
    let [silent, loud] = ["warn", "trace"].map(|log| Logged::run(log, &[]));
    assert_eq!(silent.outcome.stderr, "");
    assert!(silent.results() == loud.results());
}

#[test]
fn libraries_are_silent_unless_they_are_named() {
    let workshop = Workshop::new();
    workshop.write("scene.toml", LOAD_STEP);
    let run = |log| {
        let more = ["--quiet", "--set", "scene.t_end=0.01", "--log", log];
        workshop.run(&[&["run", "scene.toml"], &more[..]].concat())
    };
    let ours = run("trace");
    ours.succeeds();
    assert!(!ours.stderr.contains("h2::"), "{ours}");
    let named = run("h2=trace");
    named.succeeds();
    assert!(named.stderr.contains("h2::"), "{named}");
    assert!(!named.stderr.contains("linchpin_master"), "{named}");
}
