//! Studies in parts, each of which can be done by a process of its own.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// One part of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Share {
    /// Which one, from 1.
    number: usize,
    /// Of how many.
    of: usize,
}

/// Text that names no part.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("it must be I/N, part I of N, with I from 1 to N, such as 3/8")]
pub struct NoShare;

impl Share {
    /// All of it.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// The parts of a study that is done in so many.
    pub fn all(of: usize) -> impl Iterator<Item = Self> {
        (1..=of).map(move |number| Self { number, of })
    }

    /// In how many parts the study is done.
    pub fn of(self) -> usize {
        self.of
    }

    /// Whether the task at this place, from 0, belongs to it. Tasks are dealt like cards: neighbours, which take about as long,
    /// go to different parts.
    pub fn has(self, place: usize) -> bool {
        place % self.of == self.number - 1
    }

    /// How many of so many tasks belong to it.
    pub fn count(self, tasks: usize) -> usize {
        (0..tasks).filter(|place| self.has(*place)).count()
    }

    /// The folder that takes its results, under that of the study.
    pub fn folder(self) -> String {
        format!("parts/{}-of-{}", self.number, self.of)
    }
}

impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Share {
    type Err = NoShare;

    fn from_str(text: &str) -> Result<Self, NoShare> {
        let (number, of) = text.split_once('/').ok_or(NoShare)?;
        let read = |text: &str| text.parse().map_err(|_| NoShare);
        let (number, of) = (read(number)?, read(of)?);
        match (1..=of).contains(&number) {
            true => Ok(Self { number, of }),
            false => Err(NoShare),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_task_belongs_to_one_part() {
        for place in 0..100 {
            let having = Share::all(7).filter(|share| share.has(place));
            assert_eq!(having.count(), 1, "{place}");
        }
        let counts: Vec<usize> = Share::all(7).map(|share| share.count(30)).collect();
        assert_eq!(counts, [5, 5, 4, 4, 4, 4, 4]);
        assert_eq!(Share::WHOLE.count(30), 30);
    }

    #[test]
    fn a_part_is_read_as_it_is_written() {
        for share in Share::all(3) {
            assert_eq!(share.to_string().parse(), Ok(share));
        }
        for wrong in ["0/3", "4/3", "1/0", "0/0", "3", "1/2/3", "a/3", "-1/3", ""] {
            assert_eq!(wrong.parse::<Share>(), Err(NoShare), "{wrong}");
        }
    }
}
