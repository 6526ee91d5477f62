//! When impacts happened, as far as the results tell.

use linchpin_master::results::Row;
use linchpin_master::scene::Scene;

/// Outputs of a subsystem with this name count its impacts in the last macro step.
const COUNT: &str = "impacts";

/// Outputs of this name are the time of the first of them (s).
const TIME: &str = "impact_time";

/// Parts of the run of which each keeps one impact: finer than what a picture shows.
const PARTS: usize = 4096;

/// Times of impacts in bounded memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Impacts {
    columns: Vec<Columns>,
    span: (f64, f64),
    /// The first impact in each part of the run.
    first: Vec<Option<f64>>,
}

/// Where a row tells of the impacts of a subsystem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Columns {
    count: usize,
    time: Option<usize>,
}

impl Impacts {
    /// No impacts yet of a run whose rows are like `row`.
    pub fn of(scene: &Scene, row: &Row) -> Self {
        let place = |subsystem: &str, output: &str| {
            let wanted = format!("{subsystem}.{output}");
            row.columns().iter().position(|column| *column == wanted)
        };
        let columns = scene.subsystems.iter().filter_map(|subsystem| {
            Some(Columns {
                count: place(&subsystem.name, COUNT)?,
                time: place(&subsystem.name, TIME),
            })
        });
        Self::in_columns(columns.collect(), (scene.t_start, scene.t_end))
    }

    fn in_columns(columns: Vec<Columns>, span: (f64, f64)) -> Self {
        let parts = if columns.is_empty() { 0 } else { PARTS };
        Self {
            columns,
            span,
            first: vec![None; parts],
        }
    }

    /// Takes the values of a row.
    pub fn record(&mut self, values: &[f64]) {
        for columns in &self.columns {
            if values[columns.count] > 0.0 {
                let t = columns.time.map_or(values[0], |time| values[time]);
                let share = (t - self.span.0) / (self.span.1 - self.span.0);
                let part = (share * PARTS as f64) as usize;
                let last = self.first.len().saturating_sub(1);
                if let Some(first) = self.first.get_mut(part.min(last)) {
                    first.get_or_insert(t);
                }
            }
        }
    }

    /// Times in s, not decreasing but for rounding.
    pub fn times(&self) -> impl Iterator<Item = f64> {
        self.first.iter().flatten().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recorded(time: Option<usize>, rows: &[[f64; 3]]) -> Vec<f64> {
        let columns = vec![Columns { count: 1, time }];
        let mut impacts = Impacts::in_columns(columns, (0.0, 2.0));
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
        assert_eq!(recorded(Some(2), &rows), [0.375, 1.75]);
        assert_eq!(recorded(None, &rows), [0.5, 2.0]);
    }

    #[test]
    fn impacts_without_number_take_no_more_room_than_some() {
        let row = |i: u32| [f64::from(i) * 2e-6, 3.0, 0.0];
        let rows: Vec<[f64; 3]> = (0..1_000_001).map(row).collect();
        let times = recorded(None, &rows);
        assert_eq!(times.len(), PARTS);
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
