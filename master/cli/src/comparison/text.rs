//! The comparison for a reader.

use std::fmt;

use super::columns::Compared;
use super::{Comparison, RunComparison};

/// Most columns of one run that are shown.
const MOST_COLUMNS: usize = 20;

/// Most settings that are shown.
const MOST_SETTINGS: usize = 30;

/// Most names in a list.
const MOST_NAMES: usize = 8;

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "a = {}\nb = {}", self.a, self.b)?;
        for run in &self.runs {
            write_run(run, self.tolerance, f)?;
        }
        for (name, cases) in [("a", &self.cases_of_a), ("b", &self.cases_of_b)] {
            if !cases.is_empty() {
                writeln!(f, "only {name} has the run {}", listed(cases))?;
            }
        }
        Ok(())
    }
}

fn write_run(run: &RunComparison, tolerance: f64, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    if let Some(case) = &run.case {
        writeln!(f, "\ncase {case}")?;
    }
    match &run.settings {
        None => writeln!(
            f,
            "settings: not compared, this version cannot read one of the scenes"
        )?,
        Some(settings) if settings.is_empty() => writeln!(f, "settings: the same")?,
        Some(settings) => {
            writeln!(f, "settings that differ")?;
            for own in settings.iter().take(MOST_SETTINGS) {
                let [a, b] = [&own.a, &own.b].map(|value| value.as_deref().unwrap_or("not given"));
                writeln!(f, "  {:<32} {a} | {b}", own.key)?;
            }
            let more = settings.len().saturating_sub(MOST_SETTINGS);
            if more > 0 {
                writeln!(f, "  .. and {more} more; --json has all of them")?;
            }
        }
    }
    let grid = &run.grid;
    if !grid.is_whole {
        writeln!(
            f,
            "the runs do not cover the same time: compared from t = {} s to {} s",
            grid.from, grid.to
        )?;
    }
    if !grid.is_common {
        writeln!(
            f,
            "other times: {} rows of the coarser table against straight lines between those of the finer one;\n\
             what these may miss stands beside every difference",
            grid.rows
        )?;
    }
    for (name, columns) in [("a", &run.columns_of_a), ("b", &run.columns_of_b)] {
        if !columns.is_empty() {
            writeln!(f, "only {name} has the columns {}", listed(columns))?;
        }
    }
    let differing: Vec<&Compared> = { run.columns.iter() }
        .filter(|own| own.differs(tolerance))
        .collect();
    let equal = run.columns.len() - differing.len();
    let within = match tolerance {
        0.0 => "are the same".to_owned(),
        tolerance => format!("differ by at most {tolerance:e} of their size"),
    };
    if differing.is_empty() {
        return writeln!(f, "all {equal} columns {within}");
    }
    write_columns(&differing, grid.is_common, f)?;
    if equal > 0 {
        writeln!(f, "{equal} other columns {within}")?;
    }
    Ok(())
}

fn listed(names: &[String]) -> String {
    let shown = names[..names.len().min(MOST_NAMES)].join(", ");
    match names.len().saturating_sub(MOST_NAMES) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

fn write_columns(
    differing: &[&Compared],
    is_common: bool,
    f: &mut fmt::Formatter<'_>,
) -> fmt::Result {
    let shown = &differing[..differing.len().min(MOST_COLUMNS)];
    let width = |of: fn(&Compared) -> &str| {
        let widths = shown.iter().map(|own| of(own).chars().count());
        widths.max().unwrap_or_default()
    };
    let name = width(|own| &own.name).max("column".len());
    let unit = width(|own| &own.unit).max("unit".len());
    let missed = if is_common { "" } else { "   missed" };
    writeln!(
        f,
        "{:<name$}  {:<unit$}  {:>10}  {:>9}  {:>10}{missed}",
        "column", "unit", "difference", "of size", "at t in s"
    )?;
    for own in shown {
        write!(
            f,
            "{:<name$}  {:<unit$}  {:>10.3e}  {:>9.2e}  {:>10.6}",
            own.name, own.unit, own.largest, own.relative, own.t
        )?;
        if !is_common {
            write!(f, "  {:>7.1e}", own.interpolation)?;
        }
        writeln!(f)?;
    }
    let more = differing.len() - shown.len();
    if more > 0 {
        writeln!(
            f,
            ".. and {more} more columns with smaller differences; --json has all of them"
        )?;
    }
    Ok(())
}
