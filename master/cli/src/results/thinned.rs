//! A series in bounded memory.

use serde::{Deserialize, Serialize};

/// Items of a long run at equal distances: when there are too many, every second one is dropped and from then on only
/// every second one is taken. The first one always stays.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Thinned<T> {
    items: Vec<T>,
    most: usize,
    stride: usize,
    skipped: usize,
}

impl<T> Thinned<T> {
    /// An empty series that will keep at most `most` items, at least 2.
    pub fn at_most(most: usize) -> Self {
        Self {
            items: Vec::new(),
            most: most.max(2),
            stride: 1,
            skipped: 0,
        }
    }

    /// Takes the next item, or leaves it out.
    pub fn push(&mut self, item: impl FnOnce() -> T) {
        if self.skipped > 0 {
            self.skipped -= 1;
            return;
        }
        if self.items.len() == self.most {
            let was_odd = self.items.len() % 2 == 1;
            self.halve();
            self.stride *= 2;
            if was_odd {
                // The last one that was kept is only half the new distance away.
                self.skipped = self.stride / 2 - 1;
                return;
            }
        }
        self.items.push(item());
        self.skipped = self.stride - 1;
    }

    fn halve(&mut self) {
        let mut place = 0;
        self.items.retain(|_| {
            place += 1;
            place % 2 == 1
        });
    }

    /// What is kept, in the order in which it came.
    pub fn items(&self) -> &[T] {
        &self.items
    }

    /// Of how many items one is kept.
    pub fn stride(&self) -> usize {
        self.stride
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_series_stays_bounded_and_evenly_spaced() {
        for most in [2, 3, 7, 600, 601] {
            let mut series = Thinned::at_most(most);
            for i in 0..10_007_usize {
                series.push(|| i);
            }
            let kept = series.items();
            assert!(kept.len() > most / 2 && kept.len() <= most, "{most}");
            let expected = (0..kept.len()).map(|place| place * series.stride());
            assert!(kept.iter().copied().eq(expected), "{most}: {kept:?}");
        }
    }

    #[test]
    fn a_short_series_stays_whole() {
        let mut series = Thinned::at_most(5);
        for i in 0..5 {
            series.push(|| i);
        }
        assert_eq!((series.items(), series.stride()), (&[0, 1, 2, 3, 4][..], 1));
    }
}
