//! Golden data: trajectories of independent prototypes (`golden/s1/README.md`).

use std::collections::HashMap;
use std::path::Path;

/// One line of a CSV file by column.
pub type Record = HashMap<String, String>;

/// All lines of a file in `tests/golden/s1`.
pub fn records(file: &str) -> Vec<Record> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("golden/s1")
        .join(file);
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names = reader.headers().unwrap().clone();
    let record = |line: csv::StringRecord| {
        names
            .iter()
            .zip(&line)
            .map(|(name, value)| (name.to_owned(), value.to_owned()))
            .collect()
    };
    reader.records().map(|line| record(line.unwrap())).collect()
}

/// A number of a record.
pub fn number(record: &Record, name: &str) -> f64 {
    record[name].parse().unwrap()
}
