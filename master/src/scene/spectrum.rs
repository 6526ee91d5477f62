//! The file of `linchpin spectrum`: integration schemes whose spectra are compared, as written and as resolved.

use std::path::Path;

use super::sweeps::{log_grid, read_linear_grid};
use crate::reading::error::SceneErrors;
use crate::reading::error_kind::SceneErrorKind;
use crate::reading::lists::{collect, sections};
use crate::reading::reader::{FINITE, Field, POSITIVE, Problems, Range, Section};
use crate::reading::text::text_of;
use crate::reading::written::{Value, Written};

/// Schemes over the step, and a region of parameters; one of them is there.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumFile {
    /// Its name.
    pub name: String,
    /// Steps over period `dt / T`, increasing.
    pub sweep: Vec<f64>,
    /// Largest `dt / T` that the picture of period errors shows.
    pub period_to: f64,
    /// The schemes; their labels differ.
    pub curves: Vec<SpectrumCurve>,
    /// The region of parameters of generalised-alpha.
    pub region: Option<SpectrumRegion>,
}

/// A scheme with its label.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumCurve {
    /// Name in legend and table.
    pub label: String,
    /// The scheme.
    pub scheme: SpectrumScheme,
}

/// A scheme; its parameters are within their ranges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpectrumScheme {
    /// Generalised-alpha with optimal parameters.
    GeneralizedAlpha {
        /// Spectral radius for infinite frequency, 0 to 1.
        rho_inf: f64,
    },
    /// Generalised-alpha with any parameters that are stable.
    NewmarkAlpha {
        /// At most `alpha_f`.
        alpha_m: f64,
        /// At most 1/2.
        alpha_f: f64,
    },
    /// Bathe's method.
    Bathe,
    /// ED-alpha.
    EdAlpha {
        /// Spectral radius for infinite frequency, 0 to 1.
        rho_inf: f64,
        /// Place of the cut-off, greater than 0.
        alpha_ar: f64,
    },
    /// Moreau's midpoint rule.
    Moreau,
    /// Half-explicit timestepping.
    Hets,
}

/// A grid over the parameters of generalised-alpha.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumRegion {
    /// Values of `alpha_m`, increasing.
    pub alpha_m: Vec<f64>,
    /// Values of `alpha_f`, increasing.
    pub alpha_f: Vec<f64>,
    /// Points that the picture names.
    pub points: Vec<RegionPoint>,
}

/// A named point of the region.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionPoint {
    /// Its name.
    pub label: String,
    /// Its abscissa.
    pub alpha_m: f64,
    /// Its ordinate.
    pub alpha_f: f64,
}

const SPECTRUM_FILE: &str = "spectrum file";
const KINDS: [&str; 6] = [
    "generalized-alpha",
    "newmark-alpha",
    "bathe",
    "ed-alpha",
    "moreau",
    "hets",
];
const DEFAULT_FROM: f64 = 1e-2;
const DEFAULT_TO: f64 = 1e2;
const DEFAULT_POINTS: usize = 161;
const DEFAULT_PERIOD_TO: f64 = 0.5;
const DEFAULT_ALPHA_AR: f64 = 1.0 / 6.0;
const MOST_POINTS: usize = 100_000;
const STEP_OVER_PERIOD: Range = Range {
    words: "greater than 0 and at most 1e6",
    contains: |value| value > 0.0 && value <= 1e6,
};
const RADIUS: Range = Range {
    words: "0 to 1",
    contains: |value| (0.0..=1.0).contains(&value),
};
const AT_MOST_HALF: Range = Range {
    words: "at most 0.5, or high frequencies grow",
    contains: |value| value <= 0.5,
};

/// Whether the file at `path` describes spectra, as one with a table `spectrum` does; false if it cannot be read.
pub fn is_spectrum(path: &Path) -> bool {
    let text = text_of(path, SPECTRUM_FILE).ok();
    let written = text.and_then(|text| Written::parse(&text, "", SPECTRUM_FILE).ok());
    let root = written.map(|written| written.root.value);
    matches!(root, Some(Value::Table(table)) if table.contains_key("spectrum"))
}

/// Reads a spectrum file.
///
/// # Errors
/// All mistakes in the file.
pub fn load_spectrum(path: &Path) -> Result<SpectrumFile, SceneErrors> {
    let text = text_of(path, SPECTRUM_FILE)?;
    parse_spectrum(&text, &path.display().to_string())
}

/// Like [`load_spectrum`], for the text of such a file; `origin` names it in messages.
///
/// # Errors
/// All mistakes in the text.
pub fn parse_spectrum(text: &str, origin: &str) -> Result<SpectrumFile, SceneErrors> {
    let written = Written::parse(text, origin, SPECTRUM_FILE)?;
    let mut problems = Problems::new(&written);
    let file = read(&written, &mut problems);
    problems.finish(file)
}

fn read(written: &Written, problems: &mut Problems<'_>) -> Option<SpectrumFile> {
    let Value::Table(table) = &written.root.value else {
        return None;
    };
    let root = Section::root(written, table);
    // Of a scene, every key would be a mistake.
    let example = "[spectrum] with name, and [[spectrum.curve]] with label and scheme";
    let head = root.require("spectrum", example, problems)?;
    root.allow_only(&["spectrum"], problems);
    let section = head.section(problems)?;
    let allowed = [
        "name",
        "from",
        "to",
        "points",
        "period_to",
        "curve",
        "region",
    ];
    section.allow_only(&allowed, problems);
    let name = section
        .require("name", "name = \"fig08\"", problems)
        .and_then(|field| field.name(problems));
    let sweep = read_sweep(&section, problems);
    let period_to = optional(
        &section,
        "period_to",
        DEFAULT_PERIOD_TO,
        &POSITIVE,
        problems,
    );
    let region = match section.get("region") {
        Some(field) => { field.section(problems) }
            .and_then(|region| read_region(&region, problems))
            .map(Some),
        None => {
            let example = "[[spectrum.curve]] with label and scheme";
            section.require("curve", example, problems);
            Some(None)
        }
    };
    let tables = sections(&section, "curve", problems);
    report_equal_labels(&tables, "curve", problems);
    let curves = collect(&tables, |table| read_curve(table, problems));
    Some(SpectrumFile {
        name: name?.to_owned(),
        sweep: sweep?,
        period_to: period_to?,
        curves: curves?,
        region: region?,
    })
}

/// A number with a default.
fn optional(
    section: &Section<'_>,
    key: &str,
    default: f64,
    range: &Range,
    problems: &mut Problems<'_>,
) -> Option<f64> {
    let field = section.get(key);
    field.map_or(Some(default), |field| field.number(range, problems))
}

fn read_sweep(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
    let from = optional(section, "from", DEFAULT_FROM, &STEP_OVER_PERIOD, problems);
    let to = optional(section, "to", DEFAULT_TO, &STEP_OVER_PERIOD, problems);
    let points = section.get("points").map_or(Some(DEFAULT_POINTS), |field| {
        field.whole(2, MOST_POINTS, problems)
    });
    let (from, to, points) = (from?, to?, points?);
    if from >= to {
        let field = section.get("to").or_else(|| section.get("from"))?;
        let allowed = format!("such that from = {from:?} is less than to = {to:?}");
        return field.out_of_range(&allowed, problems);
    }
    Some(log_grid(from, to, points))
}

fn read_label(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<String> {
    let field = section.require("label", "label = \"rho_inf = 0.8\"", problems)?;
    match field.text(problems)? {
        "" => field.wrong_type("a text that is not empty", problems),
        label => Some(label.to_owned()),
    }
}

fn report_equal_labels(
    tables: &[Section<'_>],
    taken_by: &'static str,
    problems: &mut Problems<'_>,
) {
    let labels: Vec<Field<'_>> = tables
        .iter()
        .filter_map(|table| table.get("label"))
        .collect();
    for (place, field) in labels.iter().enumerate() {
        let Some(label) = field.peek_text() else {
            continue;
        };
        let mut earlier = labels[..place].iter();
        let Some(first) = earlier.find(|earlier| earlier.peek_text() == Some(label)) else {
            continue;
        };
        let line = problems.written.place(&first.node.spot);
        let kind = SceneErrorKind::DuplicateName {
            key: field.key.clone(),
            name: label.to_owned(),
            taken_by,
            line: line.map(|place| place.line),
        };
        field.report(kind, problems);
    }
}

fn read_curve(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<SpectrumCurve> {
    section.allow_only(&["label", "scheme"], problems);
    let label = read_label(section, problems);
    let example = "scheme = { kind = \"generalized-alpha\", rho_inf = 0.8 }";
    let scheme = section
        .require("scheme", example, problems)
        .and_then(|field| field.section(problems))
        .and_then(|scheme| read_scheme(&scheme, problems));
    Some(SpectrumCurve {
        label: label?,
        scheme: scheme?,
    })
}

fn read_scheme(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<SpectrumScheme> {
    let kinds = KINDS.map(|kind| (kind, kind));
    let kind = section
        .require("kind", "kind = \"bathe\"", problems)
        .and_then(|field| field.choice(&kinds, problems))?;
    let rho_inf = |problems: &mut Problems<'_>| {
        let field = section.require("rho_inf", "rho_inf = 0.8", problems)?;
        field.number(&RADIUS, problems)
    };
    match kind {
        "generalized-alpha" => {
            section.allow_only(&["kind", "rho_inf"], problems);
            let rho_inf = rho_inf(problems)?;
            Some(SpectrumScheme::GeneralizedAlpha { rho_inf })
        }
        "newmark-alpha" => read_newmark(section, problems),
        "ed-alpha" => {
            section.allow_only(&["kind", "rho_inf", "alpha_ar"], problems);
            let rho_inf = rho_inf(problems);
            let alpha_ar = optional(section, "alpha_ar", DEFAULT_ALPHA_AR, &POSITIVE, problems);
            Some(SpectrumScheme::EdAlpha {
                rho_inf: rho_inf?,
                alpha_ar: alpha_ar?,
            })
        }
        parameterless => {
            section.allow_only(&["kind"], problems);
            Some(match parameterless {
                "bathe" => SpectrumScheme::Bathe,
                "moreau" => SpectrumScheme::Moreau,
                _ => SpectrumScheme::Hets,
            })
        }
    }
}

fn read_newmark(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<SpectrumScheme> {
    section.allow_only(&["kind", "alpha_m", "alpha_f"], problems);
    let field = section.require("alpha_m", "alpha_m = 0.0", problems);
    let alpha_m = { field.as_ref() }.and_then(|field| field.number(&FINITE, problems));
    let alpha_f = section
        .require("alpha_f", "alpha_f = 0.3", problems)
        .and_then(|field| field.number(&AT_MOST_HALF, problems));
    let (alpha_m, alpha_f) = (alpha_m?, alpha_f?);
    if alpha_m > alpha_f {
        let allowed = format!("at most alpha_f = {alpha_f:?}, or high frequencies grow");
        return field?.out_of_range(&allowed, problems);
    }
    Some(SpectrumScheme::NewmarkAlpha { alpha_m, alpha_f })
}

fn read_region(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<SpectrumRegion> {
    section.allow_only(&["alpha_m", "alpha_f", "point"], problems);
    let mut axis = |key| {
        let field = section.require(key, "{ from = -1.2, to = 0.7, points = 77 }", problems)?;
        read_linear_grid(&field.section(problems)?, problems)
    };
    let (alpha_m, alpha_f) = (axis("alpha_m"), axis("alpha_f"));
    let tables = sections(section, "point", problems);
    report_equal_labels(&tables, "point", problems);
    let points = collect(&tables, |table| read_point(table, problems));
    Some(SpectrumRegion {
        alpha_m: alpha_m?,
        alpha_f: alpha_f?,
        points: points?,
    })
}

fn read_point(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<RegionPoint> {
    section.allow_only(&["label", "alpha_m", "alpha_f"], problems);
    let label = read_label(section, problems);
    let mut number = |key, example| {
        let field = section.require(key, example, problems)?;
        field.number(&FINITE, problems)
    };
    let (alpha_m, alpha_f) = (
        number("alpha_m", "alpha_m = -1.0"),
        number("alpha_f", "alpha_f = 0.5"),
    );
    Some(RegionPoint {
        label: label?,
        alpha_m: alpha_m?,
        alpha_f: alpha_f?,
    })
}
