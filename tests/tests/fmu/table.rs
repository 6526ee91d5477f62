//! Tables of results, and how far two of them are apart.

use std::collections::BTreeMap;

/// Columns by their names.
pub type Table = BTreeMap<String, Vec<f64>>;

/// Reads results.csv.
pub fn table(text: &str) -> Table {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names: Vec<String> = reader
        .headers()
        .unwrap()
        .iter()
        .map(str::to_owned)
        .collect();
    let mut table = Table::new();
    for row in reader.records() {
        for (name, value) in names.iter().zip(&row.unwrap()) {
            let column = table.entry(name.clone()).or_default();
            column.push(value.parse().unwrap());
        }
    }
    table
}

/// Largest difference of two columns as a share of the largest value of the second one.
pub fn difference(one: &[f64], other: &[f64]) -> f64 {
    assert_eq!(one.len(), other.len());
    let largest =
        |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |a: f64, b| a.max(b.abs()));
    largest(&mut one.iter().zip(other).map(|(a, b)| a - b)) / largest(&mut other.iter().copied())
}
