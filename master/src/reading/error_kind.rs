//! What can be wrong with a scene.

use std::fmt;
use std::path::PathBuf;

use linchpin_proto::readable::{number, time};

/// Names in the order in which they are offered; shown as a list.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names(Vec<String>);

impl<S: AsRef<str>> From<&[S]> for Names {
    fn from(names: &[S]) -> Self {
        Self(names.iter().map(|name| name.as_ref().to_owned()).collect())
    }
}

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            f.write_str("none")
        } else {
            f.write_str(&self.0.join(", "))
        }
    }
}

/// What can be wrong with a scene. Numbers are in SI units, keys are dotted.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneErrorKind {
    /// The file cannot be read.
    #[error("the {document} {} cannot be read: {source}", path.display())]
    Unreadable {
        /// What it should be.
        document: &'static str,
        /// The path as given.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// There is no such file.
    #[error("there is no {document} {}", path.display())]
    NotFound {
        /// What it should be.
        document: &'static str,
        /// The path as given.
        path: PathBuf,
    },
    /// The file is not text.
    #[error("the {document} {} is not UTF-8 text: byte {offset} starts no character", path.display())]
    NotUtf8 {
        /// What it should be.
        document: &'static str,
        /// The path as given.
        path: PathBuf,
        /// The first byte that is not text.
        offset: usize,
    },
    /// The text is not TOML.
    #[error("this is not TOML: {reason}")]
    NotToml {
        /// What the TOML parser says.
        reason: String,
    },
    /// A key that does not exist.
    #[error("`{section}` has no key `{key}`; it has {allowed}")]
    UnknownKey {
        /// The key.
        key: String,
        /// The table in which it stands.
        section: String,
        /// The keys of that table.
        allowed: Names,
        /// The key that was probably meant.
        nearest: Option<String>,
    },
    /// A key of another coupling method than the chosen one.
    #[error("the method `{method}` has no `{key}`, which belongs to {owners}")]
    KeyOfOtherMethod {
        /// The key.
        key: String,
        /// The chosen method.
        method: &'static str,
        /// The methods that have the key.
        owners: Names,
    },
    /// A key that is needed is absent.
    #[error("`{section}` lacks `{key}`")]
    MissingKey {
        /// The key.
        key: &'static str,
        /// The table in which it should stand.
        section: String,
        /// A line that would do.
        example: &'static str,
    },
    /// A value of the wrong type, or outside of its range.
    #[error("`{key}` must be {allowed}, found {found}")]
    WrongValue {
        /// The key.
        key: String,
        /// What it may be.
        allowed: String,
        /// The value.
        found: String,
    },
    /// A degree that follows estimates which the method does not have.
    #[error(
        "`{key}` = \"automatic\" comes with baumgarte and weighted, whose corrected values tell the error of every degree; \
         the method `{method}` takes a whole number"
    )]
    NoAutomaticDegree {
        /// The key.
        key: String,
        /// The method.
        method: &'static str,
        /// Its highest degree.
        highest: usize,
    },
    /// A multiple of the macro step that no number can hold.
    #[error(
        "`{key}` = {formula} is {} for macro_step = {}, which is not a usable number",
        number(*value), number(*macro_step)
    )]
    FormulaOutOfRange {
        /// The key.
        key: String,
        /// The multiple of H.
        formula: String,
        /// Its value.
        value: f64,
        /// H in s.
        macro_step: f64,
    },
    /// A word that is not among the choices.
    #[error("`{key}` has no choice {found:?}; it may be {allowed}")]
    UnknownChoice {
        /// The key.
        key: String,
        /// The word.
        found: String,
        /// The choices.
        allowed: Names,
        /// The choice that was probably meant.
        nearest: Option<String>,
    },
    /// A name that nothing in the scene has.
    #[error("`{key}`: nothing is named {name:?}; known: {known}")]
    UnknownName {
        /// The key that refers to it.
        key: String,
        /// The name.
        name: String,
        /// The names there are.
        known: Names,
        /// The name that was probably meant.
        nearest: Option<String>,
    },
    /// A name with characters that names may not have.
    #[error("`{key}` = {name:?} is not a name; a name has one or more of A-Z a-z 0-9 _ -")]
    InvalidName {
        /// The key.
        key: String,
        /// The name.
        name: String,
    },
    /// A key of a nested table with characters that names may not have.
    #[error(
        "`{section}` has a key {key:?}, which is not a name; a name has one or more of A-Z a-z 0-9 _ -"
    )]
    InvalidKey {
        /// The table in which it stands.
        section: String,
        /// The key.
        key: String,
    },
    /// A name that is given twice.
    #[error("`{key}` = {name:?} is taken already by a {taken_by}{}", line.map(|l| format!(" in line {l}")).unwrap_or_default())]
    DuplicateName {
        /// The key.
        key: String,
        /// The name.
        name: String,
        /// What has the name already.
        taken_by: &'static str,
        /// Where that stands.
        line: Option<usize>,
    },
    /// A reference to an output or a marker that is not `subsystem.name`.
    #[error("`{key}` = {found:?} is not {allowed}")]
    InvalidReference {
        /// The key.
        key: String,
        /// The reference.
        found: String,
        /// What it should look like.
        allowed: &'static str,
    },
    /// A joint with both sides on one subsystem.
    #[error("joint {joint:?} has both sides on subsystem {subsystem:?}; it must connect two")]
    JoinedToItself {
        /// The joint.
        joint: String,
        /// The subsystem.
        subsystem: String,
    },
    /// A connection with both sides on one subsystem.
    #[error(
        "connection {connection:?} has both sides on subsystem {subsystem:?}; it must connect two"
    )]
    ConnectedToItself {
        /// The connection.
        connection: String,
        /// The subsystem.
        subsystem: String,
    },
    /// An index that the parameters contradict.
    #[error("index {index} of method `{method}` needs {needs}, found {first} and {second}")]
    IndexContradiction {
        /// The method.
        method: &'static str,
        /// The index given.
        index: u8,
        /// What that index means for the parameters.
        needs: String,
        /// The first parameter as `name = value`.
        first: String,
        /// The second parameter as `name = value`.
        second: String,
        /// The index that these parameters have.
        fits: Option<u8>,
    },
    /// The parameter of the accelerations without that of the velocities.
    #[error(
        "{second} needs {first_name} > 0, found {first_name} = 0: no index has this combination"
    )]
    NoSuchIndex {
        /// Name of the parameter that is zero.
        first_name: &'static str,
        /// The other parameter as `name = value`.
        second: String,
        /// A value that would do.
        example: String,
    },
    /// The end does not lie after the start.
    #[error("t_end = {} s must lie after t_start = {} s, by a finite time", time(*t_end), time(*t_start))]
    EndBeforeStart {
        /// Start in s.
        t_start: f64,
        /// End in s.
        t_end: f64,
    },
    /// A macro step longer than the simulated time.
    #[error(
        "`{key}` = {} s must be at most the simulated time t_end - t_start = {} s",
        number(*macro_step), time(*duration)
    )]
    StepTooLong {
        /// The key.
        key: String,
        /// H in s.
        macro_step: f64,
        /// t_end - t_start in s.
        duration: f64,
    },
    /// So many steps that no run would end.
    #[error(
        "`{key}` = {} s makes {} steps or rows, and at most {} are allowed",
        number(*step), number(*steps), number(*most)
    )]
    TooManySteps {
        /// The key.
        key: String,
        /// Their length in s.
        step: f64,
        /// Their number.
        steps: f64,
        /// What is allowed.
        most: f64,
        /// Length in s of so many steps.
        least: f64,
    },
    /// A key that says something about variable macro steps, where they do not vary.
    #[error("`{key}` belongs to variable macro steps, which `coupling.tolerance` turns on")]
    OnlyWithTolerance {
        /// The key.
        key: String,
    },
    /// A step that cannot be shortened cannot be rejected.
    #[error(
        "`{key}` = \"reject\" repeats a step with a shorter one, which only a variable macro step can; with a fixed one \"warn\" and \
         \"fail\" are allowed"
    )]
    RejectOfFixedSteps {
        /// The key.
        key: String,
    },
    /// Least, first and greatest macro step in no order.
    #[error("`{shorter}` = {} s must be at most `{longer}` = {} s", number(*least), number(*most))]
    StepsOutOfOrder {
        /// The key of what must be the shorter step.
        shorter: String,
        /// Its value in s.
        least: f64,
        /// The key of what must be the longer step.
        longer: String,
        /// Its value in s.
        most: f64,
    },
    /// A scene without subsystems.
    #[error("the scene has no subsystem; it needs at least one [[subsystem]]")]
    NoSubsystem,
    /// A subsystem that nothing serves.
    #[error("`{subsystem}` gives neither model nor address, command or fmu")]
    NotServed {
        /// The subsystem.
        subsystem: String,
    },
    /// A subsystem with two of address, command and fmu.
    #[error("`{subsystem}` gives both {} and {}; exactly one of them may stand", keys[0], keys[1])]
    ServedTwice {
        /// The subsystem.
        subsystem: String,
        /// The keys.
        keys: [&'static str; 2],
    },
    /// An address that cannot be reached by this program.
    #[error(
        "`{key}` = {address:?} is not an address; it must be https://HOST:PORT, http://HOST:PORT or unix:/PATH"
    )]
    InvalidAddress {
        /// The key.
        key: String,
        /// The address.
        address: String,
    },
    /// An encrypted connection without certificates.
    #[error("`{key}` = {address:?} is reached by TLS, and the scene names no certificates")]
    NoCertificates {
        /// The key.
        key: String,
        /// The address.
        address: String,
    },
    /// A connection to another machine that nothing protects.
    #[error("`{key}` = {address:?} would be reached in plain text over a network")]
    PlainText {
        /// The key.
        key: String,
        /// The address.
        address: String,
    },
    /// A key of an override that can name nothing in a scene.
    #[error("{key:?} is not the key of a setting")]
    OverrideKey {
        /// The key.
        key: String,
    },
    /// A key of an override that leads through a plain value.
    #[error("{key:?} cannot be set, because a part of it is {blocking}")]
    OverrideBlocked {
        /// The key.
        key: String,
        /// The value in the way.
        blocking: String,
    },
    /// A value of an override that is not TOML.
    #[error("{value:?} is not a TOML value: {reason}")]
    OverrideValue {
        /// The value.
        value: String,
        /// What the TOML parser says.
        reason: String,
    },
    /// Something that only a worker can find, such as a parameter that its model does not have.
    #[error("`{key}`: {message}")]
    RefusedByWorker {
        /// The key it is about.
        key: String,
        /// What the worker says.
        message: String,
        /// What to do.
        help: Option<String>,
    },
}

impl SceneErrorKind {
    /// What to do about it, where the message does not say so already.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::UnknownKey { nearest, .. }
            | Self::UnknownChoice { nearest, .. }
            | Self::UnknownName { nearest, .. } => {
                nearest.as_ref().map(|name| format!("did you mean `{name}`?"))
            }
            Self::KeyOfOtherMethod { key, owners, .. } => {
                Some(format!("remove `{key}`, or choose the method {owners}"))
            }
            Self::NoAutomaticDegree { highest: 0, .. } => Some("choose 0, or remove the key".into()),
            Self::NoAutomaticDegree { highest, .. } => {
                Some(format!("choose a whole number from 0 to {highest}"))
            }
            Self::MissingKey { example, .. } => Some(format!("for example {example}")),
            Self::IndexContradiction { fits, first, second, .. } => Some(match fits {
                Some(index) => format!("index = {index} fits {first} and {second}; without `index` it follows from them"),
                None => format!("remove {first} or {second} to get its default"),
            }),
            Self::NoSuchIndex { first_name, example, .. } => {
                Some(format!("for example {first_name} = {example}"))
            }
            Self::NotServed { .. } => Some(
                "give model = \"oscillator\" (built in), address = \"http://HOST:PORT\", command = [\"PROGRAM\"] or fmu = \"PATH\""
                    .into(),
            ),
            Self::ServedTwice { .. } => Some("remove one of them".into()),
            Self::NoCertificates { .. } => Some(
                "make them with linchpin certificates DIR SCENE, and name those of the master: security.certificates = \"DIR/master\""
                    .into(),
            ),
            Self::PlainText { .. } => Some(
                "write https:// and name certificates (linchpin certificates makes them), or permit it with \
                 security.plain_text = true where the network keeps strangers away"
                    .into(),
            ),
            Self::OverrideKey { .. } => Some(
                "write SECTION.KEY as in coupling.degree; entries of a list go by name, as in subsystem.mass1.parameters.c, or `*` for all"
                    .into(),
            ),
            Self::NotFound { .. } => Some("check the path; it counts from the current folder".into()),
            Self::TooManySteps { key, least, .. } => {
                Some(format!("choose {key} of {} s or more, or a shorter time", number(*least)))
            }
            Self::StepTooLong { .. } => Some("choose a smaller macro step or a later t_end".into()),
            Self::RefusedByWorker { help, .. } => help.clone(),
            Self::RejectOfFixedSteps { .. } => Some(
                "give coupling.tolerance, e.g. 1e-6, which lets the macro step vary, or choose \"fail\" or \"warn\"".to_owned(),
            ),
            _ => None,
        }
    }
}
