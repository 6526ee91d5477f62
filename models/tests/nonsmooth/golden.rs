//! Reads golden files.

use std::collections::BTreeMap;
use std::path::Path;

use linchpin_models::nonsmooth::schemes::SchemeKind;

/// A row: numbers by column, and its first column, which may be a name.
pub struct Row {
    pub name: String,
    numbers: BTreeMap<String, f64>,
    /// Fields that are lists: their first numbers.
    firsts: BTreeMap<String, f64>,
}

impl Row {
    pub fn get(&self, column: &str) -> f64 {
        *self
            .numbers
            .get(column)
            .unwrap_or_else(|| panic!("no column {column} in {:?}", self.numbers.keys()))
    }

    /// The first number of a list with semicolons; 0 if it is empty.
    pub fn first_of(&self, column: &str) -> f64 {
        self.firsts.get(column).copied().unwrap_or(0.0)
    }

    pub fn list(&self, columns: &[&str]) -> Vec<f64> {
        columns.iter().map(|column| self.get(column)).collect()
    }

    /// The scheme of the columns `scheme` and `rho`.
    pub fn scheme(&self) -> SchemeKind {
        let rho_inf = self.get("rho");
        match self.name.as_str() {
            "gen-alpha" => SchemeKind::GeneralizedAlpha { rho_inf },
            "Bathe" => SchemeKind::Bathe,
            "ED-alpha" => SchemeKind::EdAlpha {
                rho_inf,
                alpha_ar: 1.0 / 6.0,
            },
            "Moreau" => SchemeKind::Moreau,
            "HETS" => SchemeKind::Hets,
            other => panic!("no scheme {other}"),
        }
    }
}

/// The numbers of a row's columns, but for a share of the largest that these columns have in the run.
#[track_caller]
pub fn assert_near(run: &[Row], row: &Row, columns: &[&str], own: &[f64], tolerance: f64) {
    let values = run.iter().flat_map(|row| row.list(columns));
    let largest = values.fold(0.0, |a: f64, b| a.max(b.abs()));
    for (column, own) in columns.iter().zip(own) {
        let golden = row.get(column);
        assert!(
            (own - golden).abs() <= tolerance * largest,
            "{} {:?}: {column} = {own:e}, golden {golden:e}, largest {largest:e}",
            row.name,
            row.numbers,
        );
    }
}

/// All rows of a file; lines with # are comments.
pub fn rows(file: &str) -> Vec<Row> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/golden/s2");
    let text = std::fs::read_to_string(folder.join(file)).unwrap();
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            let numbers = header.iter().zip(&fields);
            let numbers =
                numbers.filter_map(|(name, field)| Some(((*name).to_owned(), field.parse().ok()?)));
            let firsts = header.iter().zip(&fields).filter_map(|(name, field)| {
                let first = field.split(';').next()?;
                Some(((*name).to_owned(), first.parse().ok()?))
            });
            Row {
                name: fields[0].to_owned(),
                firsts: firsts.collect(),
                numbers: numbers.collect(),
            }
        })
        .collect()
}

/// Rows that belong to one run: neighbours for which `key` is the same.
pub fn runs<K: PartialEq>(rows: Vec<Row>, key: impl Fn(&Row) -> K) -> Vec<Vec<Row>> {
    let mut runs: Vec<Vec<Row>> = Vec::new();
    for row in rows {
        match runs.last_mut() {
            Some(run) if key(&run[0]) == key(&row) => run.push(row),
            _ => runs.push(vec![row]),
        }
    }
    runs
}
