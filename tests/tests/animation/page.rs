//! The page as its script reads it, against the table of results.

use std::collections::HashMap;
use std::f64::consts::TAU;

use linchpin_tests::process::Workshop;
use serde_json::Value;

/// The columns of a table by name.
pub fn columns(workshop: &Workshop, table: &str) -> HashMap<String, Vec<f64>> {
    let text = workshop.read(table);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names: Vec<String> = reader
        .headers()
        .unwrap()
        .iter()
        .map(str::to_owned)
        .collect();
    let mut columns: HashMap<String, Vec<f64>> = HashMap::new();
    for record in reader.records() {
        for (name, value) in names.iter().zip(&record.unwrap()) {
            columns
                .entry(name.clone())
                .or_default()
                .push(value.parse().unwrap());
        }
    }
    columns
}

/// What the script of a page reads.
pub fn film(page: &str) -> Value {
    let (_, rest) = page
        .split_once(r#"<script type="application/json" id="film">"#)
        .unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

pub fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|number| number.as_f64().unwrap())
        .collect()
}

/// Equal times; the JSON reader may miss the last bit.
pub fn assert_same_times(shown: &[f64], expected: &[f64]) {
    assert_eq!(shown.len(), expected.len());
    for (shown, expected) in shown.iter().zip(expected) {
        assert!(
            (shown - expected).abs() <= f64::EPSILON * expected,
            "{shown} {expected}"
        );
    }
}

/// A marker of a page: `SUBSYSTEM.MARKER` and its columns, each with the unit in which the page counts it.
fn decoded(film: &Value, marker: &Value) -> (String, Vec<(f64, Vec<f64>)>) {
    let text = |key: &str| marker[key].as_str().unwrap();
    let whole = |key: &str| marker[key].as_u64().unwrap() as usize;
    let unit = |key: &str| film[key].as_f64().unwrap();
    let (origin, motion) = (numbers(&film["origin"]), numbers(&marker["motion"]));
    let column = |place: usize| {
        let (unit, origin) = match place < whole("coordinates") {
            true => (unit("unit"), origin[place]),
            false => (unit("turn_unit"), 0.0),
        };
        let own = motion.iter().skip(place).step_by(whole("numbers"));
        (unit, own.map(|number| origin + unit * number).collect())
    };
    let name = format!("{}.{}", text("subsystem"), text("name"));
    (name, (0..whole("numbers")).map(column).collect())
}

/// Every number of every frame is that of one of `stride` rows of the table, to half of the unit in which the page
/// counts. `expected` has the markers in their order with the ends of the names of their columns.
pub fn assert_shows(
    film: &Value,
    table: &HashMap<String, Vec<f64>>,
    stride: usize,
    expected: &[(&str, &[&str])],
) {
    let of_rows =
        |column: &str| -> Vec<f64> { table[column].iter().copied().step_by(stride).collect() };
    assert_same_times(&numbers(&film["t"]), &of_rows("t"));
    let markers = film["markers"].as_array().unwrap();
    assert_eq!(markers.len(), expected.len());
    for (marker, (name, outputs)) in markers.iter().zip(expected) {
        let (shown_name, columns) = decoded(film, marker);
        assert_eq!((shown_name.as_str(), columns.len()), (*name, outputs.len()));
        let (subsystem, _) = name.split_once('.').unwrap();
        for ((unit, shown), output) in columns.iter().zip(*outputs) {
            let column = of_rows(&format!("{subsystem}.{output}"));
            assert_eq!(shown.len(), column.len());
            for (shown, value) in shown.iter().zip(column) {
                let full_turns = match output.ends_with("angle") {
                    true => TAU * ((shown - value) / TAU).round(),
                    false => 0.0,
                };
                let difference = (shown - value - full_turns).abs();
                assert!(difference <= 0.5001 * unit, "{name}.{output}: {difference}");
            }
        }
    }
}

/// The page counts in units finer than a ten-thousandth of `largest`, the largest motion in m, and of a radian.
pub fn assert_fine(film: &Value, largest: f64) {
    let unit = |key: &str| film[key].as_f64().unwrap();
    assert!(unit("unit") <= 1e-4 * largest && unit("turn_unit") <= 1e-4);
}

/// Largest less smallest value.
pub fn span(values: &[f64]) -> f64 {
    let largest = values.iter().copied().fold(f64::MIN, f64::max);
    largest - values.iter().copied().fold(f64::MAX, f64::min)
}
