//! The numbers of a stability map: as CSV and counted.

use std::fmt;

use serde::Serialize;

use super::{Agreement, CaseMap, Cell};
use crate::plot::Verdict;

/// One point as a row of `stability.csv`; what is not known is an empty field.
#[derive(Debug, Serialize)]
struct Record<'a> {
    x: f64,
    y: f64,
    case: &'a str,
    simulated: &'static str,
    growth: f64,
    steps: usize,
    spectral_radius: Option<f64>,
    agreement: &'static str,
}

/// A row of `stability.csv` for each point of each case.
pub fn rows(maps: &[CaseMap]) -> impl Iterator<Item = impl Serialize> {
    maps.iter()
        .flat_map(|map| map.cells.iter().map(|cell| record(&map.case, cell)))
}

fn record<'a>(case: &'a str, cell: &Cell) -> Record<'a> {
    Record {
        x: cell.x,
        y: cell.y,
        case,
        simulated: Verdict::of(cell.simulated.is_stable()).name(),
        growth: cell.simulated.growth,
        steps: cell.simulated.steps,
        spectral_radius: cell.radius,
        agreement: match cell.agreement() {
            Some(Agreement::Agree) => "agree",
            Some(Agreement::Undecided) => "undecided",
            Some(Agreement::Disagree) => "disagree",
            None => "",
        },
    }
}

/// How many points of a map are what.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Count {
    /// Stable by simulation.
    pub stable: usize,
    /// Unstable by simulation.
    pub unstable: usize,
    /// Simulation and spectral radius say the same.
    pub agree: usize,
    /// The simulation is too short to tell.
    pub undecided: usize,
    /// Simulation and spectral radius contradict each other.
    pub disagree: usize,
}

impl Count {
    /// Counts the points of a map.
    pub fn of(map: &CaseMap) -> Self {
        let mut count = Self::default();
        for cell in &map.cells {
            if cell.simulated.is_stable() {
                count.stable += 1;
            } else {
                count.unstable += 1;
            }
            match cell.agreement() {
                Some(Agreement::Agree) => count.agree += 1,
                Some(Agreement::Undecided) => count.undecided += 1,
                Some(Agreement::Disagree) => count.disagree += 1,
                None => {}
            }
        }
        count
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} stable, {} unstable", self.stable, self.unstable)?;
        if self.agree + self.undecided + self.disagree == 0 {
            return Ok(());
        }
        write!(
            f,
            "; with the spectral radius {} agree, {} are undecided, {} disagree",
            self.agree, self.undecided, self.disagree
        )
    }
}

/// One line for each case.
pub fn summary(maps: &[CaseMap]) -> String {
    let line = |map: &CaseMap| {
        let reason = map.no_radius.iter();
        let reason: String = reason
            .map(|reason| format!("\n  no spectral radius: {reason}"))
            .collect();
        let missing = match map.missing {
            0 => String::new(),
            missing => format!(", {missing} missing"),
        };
        format!("{}: {}{missing}{reason}\n", map.case, Count::of(map))
    };
    maps.iter().map(line).collect()
}
