//! What to try when a run stops, by the keys that its method has.

use super::resolved::Coupling;
use crate::error::RunError;
use crate::methods::Method;

/// Keys of methods that can keep a run from diverging, and how.
const REMEDIES: [(&str, &str); 7] = [
    (
        "iterations",
        "more corrections for light parts under heavy loads (coupling.iterations)",
    ),
    ("degree", "a lower coupling.degree"),
    ("index", "a lower coupling.index"),
    (
        "beta",
        "larger damping of the constraint (beta = \"2H\", gamma = \"H^2\")",
    ),
    ("a", "larger damping of the constraint (a = 2, b = 2.6)"),
    ("mu", "a larger coupling.mu"),
    ("stiffness", "a softer coupling.stiffness"),
];

impl Coupling {
    /// What to try after an error of a run, if a setting of the coupling may help: only keys that its method has.
    pub fn remedy(&self, error: &RunError) -> Option<String> {
        let shorter = match self.step_control {
            None => "a smaller coupling.macro_step",
            Some(_) => "a smaller coupling.tolerance",
        };
        match error {
            RunError::Diverged { .. } | RunError::Grown { .. } => {
                let others = self.remedies().map(|words| format!(", {words}"));
                Some(format!("try {shorter}{}", others.collect::<String>()))
            }
            RunError::NotFinite { .. } => Some(format!(
                "the solver has probably diverged: try {shorter} or tighter solver tolerances"
            )),
            RunError::Worker { source, step, .. } if source.is_recoverable() && *step > 0.0 => {
                Some(format!("{shorter} may help"))
            }
            _ => None,
        }
    }

    fn remedies(&self) -> impl Iterator<Item = &'static str> {
        let own = { Method::ALL.iter() }.find(|entry| entry.name == self.method.name());
        let fitting = REMEDIES.into_iter().filter(move |(key, _)| {
            let has_key = own.is_some_and(|entry| entry.has(key));
            let has_choice = own.is_some_and(|entry| entry.lowest_degree < entry.highest_degree);
            has_key && (*key != "degree" || has_choice)
        });
        fitting.map(|(_, words)| words)
    }
}

#[cfg(test)]
mod tests {
    use crate::error::RunError;
    use crate::reading::Override;
    use crate::scene::parse;

    fn advice(settings: &[(&str, &str)]) -> String {
        let text = "[scene]\nname = \"x\"\nt_end = 1.0\n[[subsystem]]\nname = \"m\"\nmodel = \"oscillator\"\n";
        let settings = settings.iter().map(|(key, value)| Override {
            key: format!("coupling.{key}"),
            value: (*value).to_owned(),
        });
        let scene = parse(text, "x.toml", &settings.collect::<Vec<_>>()).unwrap();
        let grown = RunError::Grown {
            t: 0.5,
            step: 0.1,
            variable: "m.x".into(),
            value: 1e9,
            growth: 1e8,
        };
        scene.coupling.remedy(&grown).unwrap()
    }

    #[test]
    fn advice_names_keys_that_the_method_has() {
        let fixed = ("macro_step", "0.1");
        let all = [
            "degree",
            "index",
            "beta",
            "a = 2",
            "coupling.mu",
            "stiffness",
        ];
        for (method, more, named) in [
            (
                "baumgarte",
                &[("index", "2"), ("beta", "0.2")][..],
                &["degree", "index", "beta"][..],
            ),
            ("weighted", &[], &["degree", "index", "a = 2"]),
            ("hermite", &[], &["degree"]),
            ("explicit", &[("mu", "1.0")], &["coupling.mu"]),
            ("penalty", &[("stiffness", "1e3")], &["degree", "stiffness"]),
        ] {
            let method = [("method", method), fixed];
            let advice = advice(&[&method[..], more].concat());
            assert!(advice.contains("smaller coupling.macro_step"), "{advice}");
            for word in all {
                assert_eq!(advice.contains(word), named.contains(&word), "{advice}");
            }
        }
        let varying = advice(&[("method", "hermite"), ("tolerance", "1e-4")]);
        assert!(
            varying.contains("coupling.tolerance") && !varying.contains("macro_step"),
            "{varying}"
        );
    }
}
