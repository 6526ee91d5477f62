//! What is logged to the error output, and how it looks.

use std::fmt;
use std::io::IsTerminal;
use std::str::FromStr;

use tracing::level_filters::LevelFilter;
use tracing_subscriber::filter::Targets;
use tracing_subscriber::fmt::format::FmtSpan;
use tracing_subscriber::fmt::time::uptime;
use tracing_subscriber::prelude::*;

/// Target of everything that Linchpin itself logs: the names of its crates begin with it.
const ALL_OF_OURS: &str = "linchpin";

/// The crates of Linchpin that log.
const OURS: [&str; 3] = [ALL_OF_OURS, "linchpin_master", "linchpin_worker"];

/// Libraries that log what they do for messages between master and workers.
const LIBRARIES: [&str; 4] = ["h2", "hyper_util", "tonic", "tower"];

const LEVELS: &str = "off, error, warn, info, debug, trace";

/// What is logged: a level for Linchpin, or levels of single targets, separated by commas.
///
/// A library logs nothing unless it is named.
#[derive(Debug, Clone, PartialEq)]
pub struct Filter {
    targets: Targets,
    most: LevelFilter,
}

/// A filter that says nothing that could be logged.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FilterError {
    /// No level.
    #[error("\"{0}\" is no level; levels are {LEVELS}")]
    Level(String),
    /// No target.
    #[error("nothing named \"{0}\" logs; targets are {targets}", targets = Names)]
    Target(String),
}

/// All targets, for messages.
struct Names;

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}", OURS.join(", "), LIBRARIES.join(", "))
    }
}

impl FromStr for Filter {
    type Err = FilterError;

    fn from_str(text: &str) -> Result<Self, FilterError> {
        let mut filter = Self {
            targets: Targets::new(),
            most: LevelFilter::OFF,
        };
        for part in text.split(',').map(str::trim) {
            let (target, level) = match part.split_once('=') {
                Some((target, level)) => (target.trim(), level.trim()),
                None => (ALL_OF_OURS, part),
            };
            if !OURS.contains(&target) && !LIBRARIES.contains(&target) {
                return Err(FilterError::Target(target.into()));
            }
            let level = level_of(level)?;
            filter.most = filter.most.max(level);
            filter.targets = filter.targets.with_target(target, level);
        }
        Ok(filter)
    }
}

impl Filter {
    /// All that Linchpin logs at a level.
    pub fn of_level(level: LevelFilter) -> Self {
        Self {
            targets: Targets::new().with_target(ALL_OF_OURS, level),
            most: level,
        }
    }
}

/// A level by its name; the crate's own parser also takes numbers and the empty text.
fn level_of(name: &str) -> Result<LevelFilter, FilterError> {
    let is_name = LEVELS.split(", ").any(|level| level == name);
    let level = name.parse().ok().filter(|_| is_name);
    level.ok_or_else(|| FilterError::Level(name.into()))
}

/// Logs to the error output from now on. With `trace` the end of every span is logged too, with the time that it took.
pub fn begin(filter: &Filter) {
    let spans = match filter.most {
        LevelFilter::TRACE => FmtSpan::CLOSE,
        _ => FmtSpan::NONE,
    };
    let lines = tracing_subscriber::fmt::layer()
        .with_writer(std::io::stderr)
        .with_ansi(std::io::stderr().is_terminal())
        .with_timer(uptime())
        .with_span_events(spans);
    tracing_subscriber::registry()
        .with(lines)
        .with(filter.targets.clone())
        .init();
}

#[cfg(test)]
mod tests {
    use tracing::Level;

    use super::*;

    #[track_caller]
    fn filter(text: &str) -> Targets {
        text.parse::<Filter>().unwrap().targets
    }

    #[test]
    fn a_level_is_that_of_linchpin_and_of_no_library() {
        let filter = filter("debug");
        for target in ["linchpin", "linchpin_master::macro_step", "linchpin_worker"] {
            assert!(filter.would_enable(target, &Level::DEBUG), "{target}");
            assert!(!filter.would_enable(target, &Level::TRACE), "{target}");
        }
        for target in LIBRARIES.into_iter().chain(["hyper", "other"]) {
            assert!(!filter.would_enable(target, &Level::ERROR), "{target}");
        }
    }

    #[test]
    fn targets_have_levels_of_their_own() {
        let filter = filter("info, linchpin_master=trace,tonic=warn");
        assert!(filter.would_enable("linchpin_master::workers", &Level::TRACE));
        assert!(filter.would_enable("linchpin_worker", &Level::INFO));
        assert!(!filter.would_enable("linchpin_worker", &Level::DEBUG));
        assert!(filter.would_enable("tonic::transport", &Level::WARN));
        assert!(!filter.would_enable("h2", &Level::ERROR));
    }

    #[test]
    fn what_is_unknown_is_refused_by_name() {
        for level in [
            "",
            "loud",
            "5",
            "linchpin=",
            "linchpin=loud",
            "info,",
            "INFO ",
        ] {
            let error = level.parse::<Filter>().unwrap_err();
            assert!(matches!(error, FilterError::Level(_)), "{level}: {error}");
        }
        for target in [
            "linchpn=info",
            "=info",
            "info,serde=debug",
            "linchpin_proto=info",
        ] {
            let error = target.parse::<Filter>().unwrap_err();
            assert!(matches!(error, FilterError::Target(_)), "{target}: {error}");
        }
    }
}
