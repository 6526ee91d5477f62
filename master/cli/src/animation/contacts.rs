//! What the contacts of a run do: forces of the closed ones and impacts.

use linchpin_master::results::RecordedContact;

/// Numbers of a contact in a frame of the page.
pub(super) const NUMBERS_PER_FRAME: usize = 2;

/// Most rows with impacts that are told apart; more than there are frames.
const MOST_HITS: usize = 4096;

/// Forces below this share of the largest one are those of an open contact: rounding.
const ROUNDING: f64 = 1e-9;

/// Radii of the dots in pixels: of the least and of the largest force. The area grows with the force.
const RADII: (f64, f64) = (3.0, 11.0);

/// The ring that shows an impact: first and last radius in pixels, and for how many frames it is seen.
pub(super) const FLASH: (f64, f64, usize) = (7.0, 20.0, 12);

/// Strength of the flash of the least impact; that of the largest is 1.
const FAINTEST: f64 = 0.3;

/// A marker that is a contact.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Contact {
    /// Place of the marker.
    pub marker: usize,
    /// Largest normal force of all rows (N).
    pub largest_force: f64,
    force: usize,
    hit: Option<Hit>,
    hits: Hits,
}

/// The column that tells of impacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Hit {
    /// Impulses of this contact (N s).
    Impulse(usize),
    /// Number of impacts of its subsystem.
    Count(usize),
}

impl Contact {
    /// A contact before the first row; `marker` is its place among those that are shown.
    pub fn new(recorded: &RecordedContact, marker: usize) -> Self {
        let impulse = recorded.impulse.map(Hit::Impulse);
        Self {
            marker,
            largest_force: 0.0,
            force: recorded.force,
            hit: impulse.or(recorded.impacts.map(Hit::Count)),
            hits: Hits::default(),
        }
    }

    /// The size of the normal force in a row (N).
    pub fn force(&self, row: &[f64]) -> f64 {
        finite(row[self.force])
    }

    /// Takes the values of row number `number`. Impacts of the subsystem are also those of this contact if it
    /// `may_be_hit`.
    pub fn record(&mut self, number: usize, row: &[f64], may_be_hit: bool) {
        self.largest_force = self.largest_force.max(self.force(row));
        let size = match self.hit {
            Some(Hit::Impulse(column)) => finite(row[column]),
            Some(Hit::Count(column)) if may_be_hit => finite(row[column]),
            _ => 0.0,
        };
        if size > 0.0 {
            self.hits.add(number, size);
        }
    }

    /// Radius in pixels of the dot that shows a force; `None` if the contact is open.
    pub fn radius(&self, force: f64, largest: f64) -> Option<f64> {
        let grown = (RADII.1 - RADII.0) * (force / largest).sqrt();
        (force > ROUNDING * largest).then_some(RADII.0 + grown)
    }

    /// Strength of the flash, 0 to 1, in each of `count` frames that are one of `stride` rows; 0 without an impact
    /// since the frame before.
    pub fn flashes(&self, count: usize, stride: usize, largest_impulse: f64) -> Vec<f64> {
        let mut sums = vec![0.0; count];
        for &(row, size) in &self.hits.sums {
            let frame = row.div_ceil(stride).min(count.saturating_sub(1));
            if let Some(sum) = sums.get_mut(frame) {
                *sum += size;
            }
        }
        let strength = |sum: f64| match self.hit {
            Some(Hit::Impulse(_)) => {
                FAINTEST + (1.0 - FAINTEST) * (sum / largest_impulse).min(1.0).sqrt()
            }
            _ => 1.0,
        };
        let sums = sums.into_iter();
        sums.map(|sum| if sum > 0.0 { strength(sum) } else { 0.0 })
            .collect()
    }

    /// Largest impulse (N s), 0 if impulses are not known.
    pub fn largest_impulse(&self) -> f64 {
        match self.hit {
            Some(Hit::Impulse(_)) => self.hits.largest,
            _ => 0.0,
        }
    }
}

/// The size of a number; 0 for none.
fn finite(value: f64) -> f64 {
    if value.is_finite() { value.abs() } else { 0.0 }
}

/// Rows with impacts in bounded memory.
#[derive(Debug, Clone, PartialEq)]
struct Hits {
    /// Row, and the sum of the sizes there and in the rows since `grain` rows before.
    sums: Vec<(usize, f64)>,
    largest: f64,
    grain: usize,
}

impl Default for Hits {
    fn default() -> Self {
        Self {
            sums: Vec::new(),
            largest: 0.0,
            grain: 1,
        }
    }
}

impl Hits {
    fn add(&mut self, row: usize, size: f64) {
        self.largest = self.largest.max(size);
        self.merge(row, size);
        if self.sums.len() > MOST_HITS {
            self.grain *= 2;
            for (row, size) in std::mem::take(&mut self.sums) {
                self.merge(row, size);
            }
        }
    }

    fn merge(&mut self, row: usize, size: f64) {
        let row = row.next_multiple_of(self.grain);
        match self.sums.last_mut() {
            Some((last, sum)) if *last == row => *sum += size,
            _ => self.sums.push((row, size)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(impulse: Option<usize>) -> Contact {
        let recorded = RecordedContact {
            marker: 0,
            force: 0,
            impulse,
            impacts: Some(1),
        };
        Contact::new(&recorded, 0)
    }

    /// Rows between frames count for the frame that follows.
    #[test]
    fn no_impact_between_frames_is_lost() {
        let mut contact = contact(Some(2));
        for row in 0..10 {
            let impulse = if row == 3 || row == 8 { 0.5 } else { 0.0 };
            contact.record(row, &[0.0, 0.0, impulse], true);
        }
        let flashes = contact.flashes(4, 4, 0.5);
        assert_eq!(flashes, [0.0, 1.0, 1.0, 0.0]);
    }

    #[test]
    fn impacts_in_every_row_take_bounded_room() {
        let mut contact = contact(None);
        for row in 0..100_000 {
            contact.record(row, &[0.0, 1.0], true);
        }
        assert!(contact.hits.sums.len() <= MOST_HITS);
        let total: f64 = contact.hits.sums.iter().map(|(_, size)| size).sum();
        assert_eq!(total, 100_000.0);
    }

    #[test]
    fn the_area_of_a_dot_grows_with_the_force() {
        let contact = contact(None);
        let grown = |force| contact.radius(force, 8.0).map(|radius| radius - RADII.0);
        assert_eq!(grown(0.0), None);
        assert_eq!(grown(8.0), Some(RADII.1 - RADII.0));
        assert_eq!(grown(2.0), Some(0.5 * (RADII.1 - RADII.0)));
    }
}
