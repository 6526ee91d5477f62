//! When impacts happened and macro steps were repeated, as far as the results tell.

use serde::{Deserialize, Serialize};

use super::ReportedColumn;

/// Outputs of a subsystem with this name count its impacts in the last macro step.
const COUNT: &str = ".impacts";

/// Outputs of this name are the time of the first of them (s).
const TIME: &str = ".impact_time";

/// Parts of the run of which each keeps one time: finer than what a picture shows.
const PARTS: usize = 4096;

/// Times in bounded memory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Times {
    span: (f64, f64),
    /// The first one in each part of the run.
    first: Vec<Option<f64>>,
}

impl Times {
    fn within(span: (f64, f64)) -> Self {
        Self {
            span,
            first: Vec::new(),
        }
    }

    fn add(&mut self, t: f64) {
        self.first.resize(PARTS, None);
        let share = (t - self.span.0) / (self.span.1 - self.span.0);
        let part = (share * PARTS as f64) as usize;
        self.first[part.min(PARTS - 1)].get_or_insert(t);
    }
}

/// Times of impacts in bounded memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Impacts {
    columns: Vec<Columns>,
    times: Times,
}

/// Where a row tells of the impacts of a subsystem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Columns {
    count: usize,
    time: Option<usize>,
}

impl Impacts {
    /// No impacts yet of a run over this time with these columns.
    pub fn of(columns: &[ReportedColumn], span: (f64, f64)) -> Self {
        let place = |name: &str| columns.iter().position(|column| column.name() == name);
        let counted = columns.iter().enumerate().filter_map(|(count, column)| {
            let subsystem = column.name().strip_suffix(COUNT)?;
            let time = place(&format!("{subsystem}{TIME}"));
            Some(Columns { count, time })
        });
        Self {
            columns: counted.collect(),
            times: Times::within(span),
        }
    }

    /// Takes the values of a row.
    pub fn record(&mut self, values: &[f64]) {
        for columns in &self.columns {
            if values[columns.count] > 0.0 {
                self.times
                    .add(columns.time.map_or(values[0], |time| values[time]));
            }
        }
    }

    /// Times in s, not decreasing but for rounding.
    pub fn times(&self) -> impl Iterator<Item = f64> {
        self.times.first.iter().flatten().copied()
    }
}

/// Ends of macro steps that were repeated with a shorter one before, in bounded memory.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Rejections {
    counted: u64,
    times: Times,
}

impl Rejections {
    /// Those at these times (s) of a run over a span of time.
    pub fn at(times: &[f64], span: (f64, f64)) -> Self {
        let mut own = Self {
            counted: 0,
            times: Times::within(span),
        };
        times.iter().for_each(|t| own.times.add(*t));
        own
    }

    /// Takes the end of a macro step and how many attempts were repeated since the start of the run.
    pub fn count(&mut self, t: f64, rejected: u64) {
        if rejected > self.counted {
            self.counted = rejected;
            self.times.add(t);
        }
    }

    /// Times in s, not decreasing.
    pub fn times(&self) -> impl Iterator<Item = f64> {
        self.times.first.iter().flatten().copied()
    }
}

#[cfg(test)]
mod tests {
    use linchpin_master::results::Quantity;

    use super::*;
    use crate::results::about::tests::column;

    fn recorded(names: &[&str], rows: &[[f64; 3]]) -> Vec<f64> {
        let columns: Vec<ReportedColumn> = names
            .iter()
            .map(|name| column(name, "1", Quantity::Output))
            .collect();
        let mut impacts = Impacts::of(&columns, (0.0, 2.0));
        rows.iter().for_each(|row| impacts.record(row));
        impacts.times().collect()
    }

    #[test]
    fn an_impact_is_where_its_time_says_or_at_its_row() {
        let rows = [
            [0.0, 0.0, 0.0],
            [0.5, 2.0, 0.375],
            [1.0, 0.0, 1.0],
            [2.0, 1.0, 1.75],
        ];
        let of = |name| recorded(&["t", "ball.impacts", name], &rows);
        assert_eq!(of("ball.impact_time"), [0.375, 1.75]);
        assert_eq!(of("block.impact_time"), [0.5, 2.0]);
    }

    #[test]
    fn impacts_without_number_take_no_more_room_than_some() {
        let row = |i: u32| [f64::from(i) * 2e-6, 3.0, 0.0];
        let rows: Vec<[f64; 3]> = (0..1_000_001).map(row).collect();
        let times = recorded(&["t", "ball.impacts", "ball.y"], &rows);
        assert_eq!(times.len(), PARTS);
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn steps_are_marked_where_more_attempts_were_repeated() {
        let mut rejections = Rejections::at(&[], (0.0, 2.0));
        for (t, rejected) in [(0.5, 0), (0.75, 2), (1.0, 2), (2.0, 3)] {
            rejections.count(t, rejected);
        }
        let times: Vec<f64> = rejections.times().collect();
        assert_eq!(times, [0.75, 2.0]);
        assert!(Rejections::at(&times, (0.0, 2.0)).times().eq(times));
    }
}
