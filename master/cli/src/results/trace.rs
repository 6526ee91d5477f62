//! A time series in bounded memory, for pictures.

use linchpin_master::results::Drawn;

/// Most points that are kept.
const MOST_POINTS: usize = 1 << 16;

/// Points `(t, y)` of a long run: when the memory is full, every second point is dropped and from then on only every
/// second one is taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Result column.
    pub name: String,
    /// What it shows.
    pub kind: Drawn,
    /// Times in s.
    pub t: Vec<f64>,
    /// Values.
    pub y: Vec<f64>,
    stride: usize,
    skipped: usize,
}

impl Trace {
    /// An empty series of a result column.
    pub fn new(name: &str, kind: Drawn) -> Self {
        Self {
            name: name.to_owned(),
            kind,
            t: Vec::new(),
            y: Vec::new(),
            stride: 1,
            skipped: 0,
        }
    }

    /// Takes the next point.
    pub fn push(&mut self, t: f64, y: f64) {
        if self.skipped > 0 {
            self.skipped -= 1;
            return;
        }
        if self.t.len() == MOST_POINTS {
            halve(&mut self.t);
            halve(&mut self.y);
            self.stride *= 2;
        }
        self.t.push(t);
        self.y.push(y);
        self.skipped = self.stride - 1;
    }
}

fn halve(values: &mut Vec<f64>) {
    let mut place = 0;
    values.retain(|_| {
        place += 1;
        place % 2 == 1
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_series_stays_bounded_and_evenly_spaced() {
        let mut trace = Trace::new("x", Drawn::Motion);
        for i in 0..1_000_000 {
            trace.push(f64::from(i), 2.0 * f64::from(i));
        }
        assert!(trace.t.len() > MOST_POINTS / 2 && trace.t.len() <= MOST_POINTS);
        let gaps: Vec<f64> = trace.t.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(gaps.iter().all(|gap| *gap == gaps[0]), "{gaps:?}");
        assert!(trace.t.iter().zip(&trace.y).all(|(t, y)| *y == 2.0 * t));
    }
}
