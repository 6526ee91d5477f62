//! The keys of a table, each declared once: what the reader takes, what its messages offer and what the reference says follow
//! from it.

/// A key of a table.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Its name.
    pub name: &'static str,
    /// What it may be.
    pub takes: Takes,
    /// What holds where it is absent.
    pub default: Default,
    /// A line that would do, for one that must be there, always or under a condition.
    pub example: &'static str,
    /// What it is, in Markdown with links from docs/reference.
    pub meaning: &'static str,
}

impl Key {
    /// A key that must be there, until something else is said.
    pub(crate) const fn new(name: &'static str, takes: Takes) -> Self {
        Self {
            name,
            takes,
            default: Default::None,
            example: "",
            meaning: "",
        }
    }

    /// It must be there; `example` is a line that would do.
    pub(crate) const fn required(self, example: &'static str) -> Self {
        Self { example, ..self }
    }

    /// Where it is absent, this holds.
    pub(crate) const fn default(self, words: &'static str) -> Self {
        let default = Default::Words(words);
        Self { default, ..self }
    }

    /// Where it is absent, it is this number.
    pub(crate) const fn default_number(self, number: f64) -> Self {
        let default = Default::Number(number);
        Self { default, ..self }
    }

    /// Where it is absent, it is the first of its choices.
    pub(crate) const fn default_first(self) -> Self {
        let default = Default::First;
        Self { default, ..self }
    }

    /// What it is.
    pub(crate) const fn means(self, meaning: &'static str) -> Self {
        Self { meaning, ..self }
    }
}

/// What holds where a key is absent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Default {
    /// It must be there.
    None,
    /// A number.
    Number(f64),
    /// The first of its choices.
    First,
    /// What these words say, in Markdown.
    Words(&'static str),
}

/// What a key may be.
#[derive(Clone, Copy, Debug)]
pub enum Takes {
    /// Whatever the model that it goes to takes.
    Any,
    /// `true` or `false`.
    Flag,
    /// A text.
    Text,
    /// A text of letters, digits, `_` and `-`.
    Name,
    /// One of these texts, the usual one first.
    Choice(&'static [&'static str]),
    /// A number.
    Number(Range),
    /// A number, or a text that says a multiple of a power of the macro step.
    Formula(Unit, Range),
    /// A whole number from the first to the second.
    Whole(usize, usize),
    /// A list, and how messages call it.
    List(&'static Takes, &'static str),
    /// A table with these keys.
    Table(fn() -> Vec<Key>),
    /// Tables with these keys, each headed `[[...]]`.
    Tables(fn() -> Vec<Key>),
    /// A table with these keys, and others that are not the master's.
    Open(&'static [Key]),
    /// One or the other.
    Either(&'static [Takes]),
}

impl Takes {
    /// What it may be, one by one.
    pub fn alternatives(&self) -> &[Self] {
        match self {
            Self::Either(all) => all,
            one => std::slice::from_ref(one),
        }
    }
}

/// Numbers that a key may have, all finite, and how messages call them.
#[derive(Clone, Copy, Debug)]
pub struct Range {
    /// In words.
    pub words: &'static str,
    /// They are greater than this one.
    pub above: f64,
    /// The least one.
    pub least: f64,
    /// The greatest one.
    pub most: f64,
}

impl Range {
    pub(crate) fn contains(&self, value: f64) -> bool {
        value.is_finite() && value > self.above && value >= self.least && value <= self.most
    }
}

pub(crate) const FINITE: Range = Range {
    words: "a finite number",
    above: f64::NEG_INFINITY,
    least: f64::NEG_INFINITY,
    most: f64::INFINITY,
};
pub(crate) const POSITIVE: Range = Range {
    words: "a finite number greater than 0",
    above: 0.0,
    ..FINITE
};
pub(crate) const NOT_NEGATIVE: Range = Range {
    words: "a finite number, 0 or greater",
    least: 0.0,
    ..FINITE
};

/// The power of H that fits the unit of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A number without unit: no multiple of H.
    Plain,
    /// s: multiples of H.
    Time,
    /// s^2: multiples of H^2.
    TimeSquared,
    /// kg/s, kg m^2/s: a mass or moment of inertia over H.
    PerTime,
    /// kg/s^2, kg m^2/s^2: the same over H^2.
    PerTimeSquared,
}

impl Unit {
    /// The power of H as a formula ends with it.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Time => "H",
            Self::TimeSquared => "H^2",
            Self::PerTime => "/H",
            Self::PerTimeSquared => "/H^2",
        }
    }

    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Plain => "a number",
            Self::Time => "a number, or a multiple of the macro step such as \"2H\"",
            Self::TimeSquared => {
                "a number, or a multiple of the squared macro step such as \"0.5 H^2\""
            }
            Self::PerTime => "a number, or a mass over the macro step such as \"1.3/H\"",
            Self::PerTimeSquared => {
                "a number, or a mass over the squared macro step such as \"2.5/H^2\""
            }
        }
    }
}

/// The texts of choices.
pub(crate) const fn texts<T, const N: usize>(
    choices: &[(&'static str, T); N],
) -> [&'static str; N] {
    let mut texts = [""; N];
    let mut place = 0;
    while place < N {
        texts[place] = choices[place].0;
        place += 1;
    }
    texts
}
