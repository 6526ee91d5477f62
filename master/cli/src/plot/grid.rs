use super::error::PlotError;
use super::scale::Scale;

/// What was found at one point of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Bounded: an open circle.
    Stable,
    /// Growing without bound: a small cross.
    Unstable,
    /// Neither could be shown: a triangle.
    Undecided,
}

impl Verdict {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Stable, Self::Unstable, Self::Undecided];

    /// One of the two that can be told.
    pub fn of(is_stable: bool) -> Self {
        match is_stable {
            true => Self::Stable,
            false => Self::Unstable,
        }
    }

    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Unstable => "unstable",
            Self::Undecided => "undecided",
        }
    }
}

/// One point of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapCell {
    /// What was found.
    pub verdict: Verdict,
    /// Growth factor of one step, neutral at 1, such as a spectral radius: drawn as the colour of the cell.
    pub growth: Option<f64>,
}

/// One of the two parameters of a map.
#[derive(Clone, Debug)]
pub struct MapAxis {
    /// Label, with the unit.
    pub label: String,
    /// Scale of the axis.
    pub scale: Scale,
    /// Increasing values, one for each column or row of cells.
    pub values: Vec<f64>,
}

/// One panel of a map.
#[derive(Clone, Debug)]
pub struct MapPanel {
    /// Title above the panel; an empty one takes no room.
    pub title: String,
    /// Parameter to the right: the columns.
    pub x: MapAxis,
    /// Parameter upwards: the rows.
    pub y: MapAxis,
    /// Cells row after row: the cell of `x.values[i]` and `y.values[j]` is `cells[j * x.values.len() + i]`.
    pub cells: Vec<MapCell>,
}

/// A cell with the rectangle that belongs to it.
pub(super) struct PlacedCell {
    pub centre: (f64, f64),
    /// Corners in the uniform coordinates of the axes.
    pub lower: (f64, f64),
    pub upper: (f64, f64),
    pub cell: MapCell,
}

impl MapPanel {
    pub(super) fn check(&self) -> Result<(), PlotError> {
        let (columns, rows) = (self.x.values.len(), self.y.values.len());
        if self.cells.len() != columns * rows {
            let (panel, cells) = (self.title.clone(), self.cells.len());
            return Err(PlotError::CellCount {
                panel,
                cells,
                columns,
                rows,
            });
        }
        self.x.check(&self.title)?;
        self.y.check(&self.title)
    }

    /// The cells whose both values have a place on their axes.
    pub(super) fn placed_cells(&self) -> Vec<PlacedCell> {
        let columns = self.x.intervals();
        let rows = self.y.intervals();
        let width = self.x.values.len();
        let pairs = rows
            .iter()
            .flat_map(|row| columns.iter().map(move |column| (row, column)));
        let placed = pairs.map(|(row, column)| PlacedCell {
            centre: (column.value, row.value),
            lower: (column.lower, row.lower),
            upper: (column.upper, row.upper),
            cell: self.cells[row.index * width + column.index],
        });
        placed.collect()
    }
}

/// The part of an axis that belongs to one grid value, in the uniform coordinate.
pub(super) struct Interval {
    pub index: usize,
    pub value: f64,
    pub lower: f64,
    pub upper: f64,
}

impl MapAxis {
    fn check(&self, panel: &str) -> Result<(), PlotError> {
        let previous = std::iter::once(f64::NEG_INFINITY).chain(self.values.iter().copied());
        let wrong = self
            .values
            .iter()
            .zip(previous)
            .position(|(value, before)| !(value.is_finite() && *value > before));
        match wrong {
            None => Ok(()),
            Some(index) => Err(PlotError::GridOrder {
                panel: panel.to_owned(),
                axis: self.label.clone(),
                index,
                value: self.values[index],
            }),
        }
    }

    /// Intervals around the values that have a place on the axis: they meet halfway between neighbours.
    pub(super) fn intervals(&self) -> Vec<Interval> {
        let held: Vec<(usize, f64)> = self
            .values
            .iter()
            .copied()
            .enumerate()
            .filter(|(_, value)| self.scale.holds(*value))
            .collect();
        let places: Vec<f64> = held
            .iter()
            .map(|(_, value)| self.scale.forward(*value))
            .collect();
        let edge = |left: usize| (places[left] + places[left + 1]) / 2.0;
        let last = places.len().saturating_sub(1);
        let interval = |(place, (index, value)): (usize, (usize, f64))| {
            let (lower, upper) = match (place, last) {
                (_, 0) => self.scale.range((value, value)),
                (0, _) => (2.0 * places[0] - edge(0), edge(0)),
                (place, last) if place == last => {
                    (edge(place - 1), 2.0 * places[place] - edge(place - 1))
                }
                (place, _) => (edge(place - 1), edge(place)),
            };
            Interval {
                index,
                value,
                lower,
                upper,
            }
        };
        held.into_iter().enumerate().map(interval).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edges(scale: Scale, values: &[f64]) -> Vec<(f64, f64)> {
        let axis = MapAxis {
            label: "c".into(),
            scale,
            values: values.to_vec(),
        };
        axis.intervals()
            .iter()
            .map(|interval| (interval.lower, interval.upper))
            .collect()
    }

    #[test]
    fn intervals_meet_halfway_in_the_scale_of_the_axis() {
        assert_eq!(
            edges(Scale::Linear, &[1.0, 2.0, 4.0]),
            [(0.5, 1.5), (1.5, 3.0), (3.0, 5.0)]
        );
        let logarithmic = edges(Scale::Logarithmic, &[-1.0, 0.0, 1.0, 100.0]);
        for (found, expected) in logarithmic.iter().zip([(-1.0, 1.0), (1.0, 3.0)]) {
            assert!((found.0 - expected.0).abs() < 1e-12 && (found.1 - expected.1).abs() < 1e-12);
        }
        assert_eq!(logarithmic.len(), 2);
    }
}
