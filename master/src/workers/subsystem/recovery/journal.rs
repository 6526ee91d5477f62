//! The advances of a worker since a state that is known: what another one repeats to stand where it stood.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, Write};

use linchpin_proto::v1;
use prost::Message;

/// Bytes that stay in memory; what is more goes to a file without a name, which ends with the run.
const IN_MEMORY: usize = 1 << 20;

/// Advances one behind the other, each as its length (4 bytes) and its encoding.
#[derive(Default)]
pub struct Journal {
    steps: u64,
    /// The older ones, if they are many.
    file: Option<File>,
    /// The newer ones.
    bytes: Vec<u8>,
}

impl Journal {
    /// Number of advances.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Forgets all of them; the memory is kept.
    pub fn clear(&mut self) {
        self.steps = 0;
        self.file = None;
        self.bytes.clear();
    }

    /// Adds an advance without its samples, which decide about no state.
    pub fn push(&mut self, advance: &mut v1::Advance) -> io::Result<()> {
        let samples = std::mem::take(&mut advance.samples);
        let pushed = self.push_whole(advance);
        advance.samples = samples;
        pushed
    }

    fn push_whole(&mut self, advance: &v1::Advance) -> io::Result<()> {
        let length = advance.encoded_len() as u32;
        self.bytes.extend_from_slice(&length.to_le_bytes());
        // A Vec takes a message of any length.
        let _ = advance.encode(&mut self.bytes);
        self.steps += 1;
        if self.bytes.len() < IN_MEMORY {
            return Ok(());
        }
        let file = match &mut self.file {
            Some(file) => file,
            None => self.file.insert(tempfile::tempfile()?),
        };
        file.write_all(&self.bytes)?;
        self.bytes.clear();
        Ok(())
    }

    /// All advances from the first one on.
    pub fn read(&mut self) -> io::Result<Advances<'_>> {
        let older = match &mut self.file {
            Some(file) => {
                file.rewind()?;
                Some(BufReader::new(file))
            }
            None => None,
        };
        let older: Box<dyn Read> = match older {
            Some(older) => Box::new(older),
            None => Box::new(io::empty()),
        };
        Ok(Advances {
            bytes: Box::new(older.chain(&self.bytes[..])),
            message: Vec::new(),
        })
    }
}

/// The advances of a journal, one after the other. Reading all of them leaves its file at its end, where the next ones belong.
pub struct Advances<'a> {
    bytes: Box<dyn Read + 'a>,
    message: Vec<u8>,
}

impl Advances<'_> {
    /// The next one.
    pub fn next(&mut self) -> io::Result<v1::Advance> {
        let mut length = [0; 4];
        self.bytes.read_exact(&mut length)?;
        self.message.resize(u32::from_le_bytes(length) as usize, 0);
        self.bytes.read_exact(&mut self.message)?;
        Ok(v1::Advance::decode(&self.message[..])?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn advance(number: u64) -> v1::Advance {
        v1::Advance {
            t: number as f64 / 3.0,
            step: 0.1,
            signals: vec![v1::Signal {
                input: 3,
                nodes: vec![0.0, 0.05],
                values: vec![number as f64, f64::MIN_POSITIVE],
            }],
            instants: vec![0.07],
            integrals: 2,
            samples: Vec::new(),
            ..v1::Advance::default()
        }
    }

    /// More than stays in memory, read twice, and gone on with in between.
    #[test]
    fn a_long_journal_gives_back_every_advance_without_its_samples() {
        let mut journal = Journal::default();
        let mut number = 0;
        for part in 0..3 {
            for _ in 0..9000 {
                let mut sampled = v1::Advance {
                    samples: vec![0.02],
                    ..advance(number)
                };
                journal.push(&mut sampled).unwrap();
                assert_eq!(sampled.samples, [0.02]);
                number += 1;
            }
            assert_eq!(journal.steps(), number);
            assert_eq!(journal.file.is_some(), part > 0, "{}", journal.bytes.len());
            let mut advances = journal.read().unwrap();
            for expected in 0..number {
                assert_eq!(advances.next().unwrap(), advance(expected));
            }
            assert!(advances.next().is_err());
        }
        journal.clear();
        assert_eq!((journal.steps(), journal.bytes.len()), (0, 0));
    }
}
