//! Reads the nested tables of a composition: `body.crank.m` is the key `m` of the entry `crank` of the table `body`.

use std::collections::{BTreeMap, BTreeSet};

use linchpin_proto::v1::{self, value::Kind};
use linchpin_worker::setup::{SetupError, Values};
use nalgebra::{Quaternion, Vector3};

use super::dimension::Dimension;
use super::error::CompositionError;
use super::kinematics::Orientation;

/// All tables, with their entries in the order of their names.
#[derive(Debug)]
pub struct Entries<'a> {
    dimension: Dimension,
    parameters: &'a BTreeMap<String, v1::Value>,
    tables: BTreeMap<&'a str, BTreeMap<&'a str, BTreeSet<&'a str>>>,
}

/// One entry of a table.
#[derive(Debug)]
pub struct Entry<'a> {
    dimension: Dimension,
    parameters: &'a BTreeMap<String, v1::Value>,
    /// Its name; empty for the plain keys.
    pub name: &'a str,
    /// Its dotted name with a dot behind, `joint.hinge.`.
    prefix: String,
}

impl<'a> Entries<'a> {
    /// Sorts parameters by table and entry.
    ///
    /// # Errors
    /// [`SetupError::Unknown`]: a table or key that a composition does not have.
    pub fn new(
        dimension: Dimension,
        parameters: &'a BTreeMap<String, v1::Value>,
    ) -> Result<Self, SetupError> {
        let mut tables: BTreeMap<_, BTreeMap<_, BTreeSet<_>>> = BTreeMap::new();
        for dotted in parameters.keys() {
            let parts: Vec<&str> = dotted.split('.').collect();
            let (table, entry, key) = match parts[..] {
                [key] => ("", "", key),
                [table, entry, key] if !table.is_empty() && !entry.is_empty() => {
                    (table, entry, key)
                }
                _ => return Err(unknown(dotted, dotted_names(dimension))),
            };
            let known = dimension.keys_of(table);
            if known.is_empty() || (table.is_empty() && !known.contains(&key)) {
                return Err(unknown(dotted, dotted_names(dimension)));
            }
            if !known.contains(&key) {
                return Err(unknown(dotted, known.join(", ")));
            }
            let entries = tables.entry(table).or_default();
            entries.entry(entry).or_default().insert(key);
        }
        Ok(Self {
            dimension,
            parameters,
            tables,
        })
    }

    /// The entries of a table.
    pub fn of(&self, table: &str) -> impl Iterator<Item = Entry<'a>> {
        let names = self.tables.get(table).into_iter().flat_map(BTreeMap::keys);
        names.map(move |name| Entry {
            dimension: self.dimension,
            parameters: self.parameters,
            name,
            prefix: format!("{table}.{name}."),
        })
    }

    /// The plain keys.
    pub fn plain(&self) -> Entry<'a> {
        Entry {
            dimension: self.dimension,
            parameters: self.parameters,
            name: "",
            prefix: String::new(),
        }
    }
}

impl<'a> Entry<'a> {
    /// Place of a key.
    pub fn field(&self, key: &str) -> String {
        format!("parameters.{}{key}", self.prefix)
    }

    /// Place of the entry.
    pub fn place(&self) -> String {
        self.field("").trim_end_matches('.').to_owned()
    }

    /// Whether a key is given.
    pub fn has(&self, key: &str) -> bool {
        self.parameters.contains_key(&self.dotted(key))
    }

    /// Refuses keys that this kind of entry does not have.
    pub fn allow_only(&self, allowed: &[&str]) -> Result<(), SetupError> {
        let own = self.parameters.range(self.prefix.clone()..);
        let own = own.map_while(|(dotted, _)| dotted.strip_prefix(&self.prefix));
        match own.into_iter().find(|key| !allowed.contains(key)) {
            Some(key) => Err(unknown(&self.dotted(key), allowed.join(", "))),
            None => Ok(()),
        }
    }

    /// A text.
    pub fn text(&self, key: &str) -> Result<&'a str, SetupError> {
        self.values().text(&self.dotted(key))
    }

    /// A text among choices.
    pub fn choice<T: Copy>(&self, key: &str, choices: &[(&str, T)]) -> Result<T, SetupError> {
        let found = self.text(key)?;
        let choice = choices.iter().find(|(word, _)| *word == found);
        choice.map(|(_, choice)| *choice).ok_or_else(|| {
            let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
            SetupError::UnknownText {
                field: self.field(key),
                value: found.to_owned(),
                known: words.join(", "),
            }
        })
    }

    /// Place in a list of the thing that a text names.
    pub fn place_of<'n>(
        &self,
        key: &str,
        what: &'static str,
        mut names: impl Iterator<Item = &'n str> + Clone,
    ) -> Result<usize, SetupError> {
        let found = self.text(key)?;
        let known = names.clone();
        names.position(|name| name == found).ok_or_else(|| {
            let known: Vec<&str> = known.collect();
            let error = CompositionError::UnknownName {
                field: self.field(key),
                what,
                found: found.to_owned(),
                known: if known.is_empty() {
                    "none".to_owned()
                } else {
                    known.join(", ")
                },
            };
            error.into()
        })
    }

    /// A number, or `absent`.
    pub fn number_or(&self, key: &str, absent: f64) -> Result<f64, SetupError> {
        if self.has(key) {
            self.values().number(&self.dotted(key))
        } else {
            Ok(absent)
        }
    }

    /// A number greater than 0.
    pub fn positive(&self, key: &str) -> Result<f64, SetupError> {
        let is_allowed = |value| value > 0.0;
        self.values()
            .number_in(&self.dotted(key), "it must be greater than 0", is_allowed)
    }

    /// A number that is 0 or greater, or `absent`.
    pub fn non_negative_or(&self, key: &str, absent: f64) -> Result<f64, SetupError> {
        if !self.has(key) {
            return Ok(absent);
        }
        let is_allowed = |value| value >= 0.0;
        self.values()
            .number_in(&self.dotted(key), "it must be 0 or greater", is_allowed)
    }

    /// A list of this many numbers.
    pub fn list<const N: usize>(&self, key: &str) -> Result<[f64; N], SetupError> {
        let numbers = self.values().numbers(&self.dotted(key))?;
        <[f64; N]>::try_from(numbers).map_err(|_| SetupError::WrongType {
            field: self.field(key),
            expected: match N {
                2 => "a list of 2 numbers",
                3 => "a list of 3 numbers",
                _ => "a list of 4 numbers",
            },
        })
    }

    /// A vector of as many components as the dimension has.
    pub fn vector(&self, key: &str) -> Result<Vector3<f64>, SetupError> {
        match self.dimension {
            Dimension::Plane => self.list(key).map(|[x, y]| Vector3::new(x, y, 0.0)),
            Dimension::Space => self.list::<3>(key).map(Vector3::from),
        }
    }

    /// A vector, or zeros.
    pub fn vector_or_zeros(&self, key: &str) -> Result<Vector3<f64>, SetupError> {
        if self.has(key) {
            self.vector(key)
        } else {
            Ok(Vector3::zeros())
        }
    }

    /// A vector brought to unit length.
    pub fn direction(&self, key: &str) -> Result<Vector3<f64>, SetupError> {
        let vector = self.vector(key)?;
        let longest = vector.amax();
        if longest == 0.0 {
            return Err(self.no_direction(key));
        }
        Ok((vector / longest).normalize())
    }

    /// A turn, or none: `angle` in the plane, `attitude` in space.
    pub fn orientation(&self) -> Result<Orientation, SetupError> {
        match self.dimension {
            Dimension::Plane => self.number_or("angle", 0.0).map(Orientation::Angle),
            Dimension::Space if !self.has("attitude") => Ok(self.dimension.unturned()),
            Dimension::Space => {
                let [w, x, y, z] = self.list("attitude")?;
                let attitude = Quaternion::new(w, x, y, z);
                let longest = attitude.coords.amax();
                if longest == 0.0 {
                    return Err(self.no_direction("attitude"));
                }
                Ok(Orientation::Attitude((attitude / longest).normalize()))
            }
        }
    }

    /// Whether the value of a key is a list.
    pub fn is_list(&self, key: &str) -> bool {
        let value = self.parameters.get(&self.dotted(key));
        value.is_some_and(|value| matches!(value.kind, Some(Kind::Numbers(_))))
    }

    fn no_direction(&self, key: &str) -> SetupError {
        let field = self.field(key);
        CompositionError::NoDirection { field }.into()
    }

    fn values(&self) -> Values<'a> {
        Values::parameters(self.parameters)
    }

    fn dotted(&self, key: &str) -> String {
        format!("{}{key}", self.prefix)
    }
}

fn unknown(dotted: &str, known: String) -> SetupError {
    SetupError::Unknown {
        field: format!("parameters.{dotted}"),
        known,
    }
}

fn dotted_names(dimension: Dimension) -> String {
    let names: Vec<String> = dimension.keys().map(|key| key.dotted(None)).collect();
    names.join(", ")
}
