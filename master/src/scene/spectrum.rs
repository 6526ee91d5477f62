//! The file of `linchpin spectrum`: integration schemes whose spectra are compared, as written and as resolved.

use std::path::Path;

use super::sweeps::{LINEAR_GRID, log_grid, read_linear_grid};
use crate::reading::error::SceneErrors;
use crate::reading::key::{FINITE, Key, POSITIVE, Range, Takes};
use crate::reading::lists::sections;
use crate::reading::names::report_repeated;
use crate::reading::reader::{Field, Problems, Section, collect, given};
use crate::reading::text::text_of;
use crate::reading::written::Written;

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

/// The tables of a spectrum file.
pub const SPECTRUM_KEYS: [Key; 1] = [Key::new("spectrum", Takes::Table(|| SPECTRUM.to_vec()))
    .required("[spectrum] with name, and [[spectrum.curve]] with label and scheme")
    .means("what is compared")];
const SPECTRUM: [Key; 7] = [
    Key::new("name", Takes::Name)
        .required("name = \"fig08\"")
        .means("name of the results folder"),
    Key::new("from", Takes::Number(STEP_OVER_PERIOD))
        .default_number(FROM)
        .means("the least dt / T"),
    Key::new("to", Takes::Number(STEP_OVER_PERIOD))
        .default_number(TO)
        .means("the greatest dt / T"),
    Key::new("points", Takes::Whole(2, MOST_POINTS))
        .default_number(POINTS as f64)
        .means("how many there are, at equal ratios"),
    Key::new("period_to", Takes::Number(POSITIVE))
        .default_number(PERIOD_TO)
        .means("right end of the picture of period errors, dt / T"),
    CURVE,
    Key::new("region", Takes::Table(|| REGION.to_vec()))
        .default("none")
        .means("with curves or alone: where generalised-alpha is stable"),
];
const CURVE: Key = Key::new("curve", Takes::Tables(|| CURVE_KEYS.to_vec()))
    .required("[[spectrum.curve]] with label and scheme")
    .default("required without `region`")
    .means("a scheme of the picture");
const CURVE_KEYS: [Key; 2] = [
    LABEL,
    Key::new(
        "scheme",
        Takes::Table(|| vec![KIND, RHO_INF, NEWMARK[0], NEWMARK[1], ALPHA_AR]),
    )
    .required("scheme = { kind = \"generalized-alpha\", rho_inf = 0.8 }")
    .means("kind and parameters of the scheme"),
];
const LABEL: Key = Key::new("label", Takes::Text)
    .required("label = \"rho_inf = 0.8\"")
    .means("name in legend and table");
const KIND: Key = Key::new("kind", Takes::Choice(&KINDS))
    .required("kind = \"bathe\"")
    .means("the scheme; parameters that it does not have may not stand");
const KINDS: [&str; 6] = [
    "generalized-alpha",
    "newmark-alpha",
    "bathe",
    "ed-alpha",
    "moreau",
    "hets",
];
const RHO_INF: Key = Key::new(
    "rho_inf",
    Takes::Number(Range {
        words: "0 to 1",
        least: 0.0,
        most: 1.0,
        ..FINITE
    }),
)
.required("rho_inf = 0.8")
.default("required for generalized-alpha and ed-alpha")
.means("spectral radius for infinite frequency (S2 eq. 26)");
const NEWMARK: [Key; 2] = [
    Key::new("alpha_m", Takes::Number(FINITE))
        .required("alpha_m = 0.0")
        .default("required for newmark-alpha")
        .means("at most `alpha_f`; (0, 0) is Newmark, (0, alpha) is HHT"),
    Key::new(
        "alpha_f",
        Takes::Number(Range {
            words: "at most 0.5, or high frequencies grow",
            most: 0.5,
            ..FINITE
        }),
    )
    .required("alpha_f = 0.3")
    .default("required for newmark-alpha")
    .means("not less than `alpha_m`"),
];
const ALPHA_AR: Key = Key::new("alpha_ar", Takes::Number(POSITIVE))
    .default("1/6")
    .means("ed-alpha: place of the cut-off");
const REGION: [Key; 3] = [
    region_axis("alpha_m"),
    region_axis("alpha_f"),
    Key::new("point", Takes::Tables(|| POINT.to_vec()))
        .default("none")
        .means("a point that the picture names"),
];
const fn region_axis(name: &'static str) -> Key {
    Key::new(name, Takes::Table(|| LINEAR_GRID.to_vec()))
        .required("{ from = -1.2, to = 0.7, points = 77 }")
        .means("values at equal distances")
}
const POINT: [Key; 3] = [
    LABEL,
    Key::new("alpha_m", Takes::Number(FINITE))
        .required("alpha_m = -1.0")
        .means("its abscissa"),
    Key::new("alpha_f", Takes::Number(FINITE))
        .required("alpha_f = 0.5")
        .means("its ordinate"),
];
const SPECTRUM_FILE: &str = "spectrum file";
const FROM: f64 = 1e-2;
const TO: f64 = 1e2;
const POINTS: usize = 161;
const PERIOD_TO: f64 = 0.5;
const DEFAULT_ALPHA_AR: f64 = 1.0 / 6.0;
const MOST_POINTS: usize = 100_000;
const STEP_OVER_PERIOD: Range = Range {
    words: "greater than 0 and at most 1e6",
    above: 0.0,
    most: 1e6,
    ..FINITE
};

/// Whether the file at `path` describes spectra, as one with a table `spectrum` does; false if it cannot be read.
pub fn is_spectrum(path: &Path) -> bool {
    Written::has_table(path, SPECTRUM_KEYS[0].name)
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
    let root = Section::root(written)?;
    // Of a scene, every key would be a mistake.
    let [head] = root.fields(&SPECTRUM_KEYS, problems);
    let head = head?;
    root.allow_only(&SPECTRUM_KEYS, problems);
    let section = head.section(problems)?;
    let [name, from, to, points, period_to, curves, region] = section.read(&SPECTRUM, problems);
    let name = name.and_then(|field| field.name(problems));
    let sweep = read_sweep(from, to, points, problems);
    let period_to = period_to.map_or(Some(PERIOD_TO), |field| field.number(problems));
    if region.is_none() {
        section.require(&CURVE, problems);
    }
    let region = given(region, |field| {
        read_region(&field.section(problems)?, problems)
    });
    let tables = sections(curves, problems);
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

fn read_sweep(
    from_field: Option<Field<'_>>,
    to_field: Option<Field<'_>>,
    points: Option<Field<'_>>,
    problems: &mut Problems<'_>,
) -> Option<Vec<f64>> {
    let from = given(from_field.clone(), |field| field.number(problems));
    let to = given(to_field.clone(), |field| field.number(problems));
    let points = points.map_or(Some(POINTS), |field| field.whole(problems));
    let (from, to, points) = (from?.unwrap_or(FROM), to?.unwrap_or(TO), points?);
    if from >= to {
        let allowed = format!("such that from = {from:?} is less than to = {to:?}");
        return to_field.or(from_field)?.refuse(&allowed, problems);
    }
    Some(log_grid(from, to, points))
}

fn report_equal_labels(
    tables: &[Section<'_>],
    taken_by: &'static str,
    problems: &mut Problems<'_>,
) {
    let labels: Vec<Field<'_>> = { tables.iter() }
        .filter_map(|table| table.get(&LABEL))
        .collect();
    report_repeated(&labels, taken_by, problems);
}

fn read_curve(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<SpectrumCurve> {
    let [label, scheme] = section.read(&CURVE_KEYS, problems);
    let label = label.and_then(|field| field.filled_text(problems));
    let scheme = scheme.and_then(|field| read_scheme(&field.section(problems)?, problems));
    Some(SpectrumCurve {
        label: label?,
        scheme: scheme?,
    })
}

fn read_scheme(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<SpectrumScheme> {
    let kinds = KINDS.map(|kind| (kind, kind));
    let [kind] = section.fields(&[KIND], problems);
    match kind?.choice(&kinds, problems)? {
        "generalized-alpha" => {
            section.allow_only(&[KIND, RHO_INF], problems);
            let rho_inf = section.require(&RHO_INF, problems)?.number(problems)?;
            Some(SpectrumScheme::GeneralizedAlpha { rho_inf })
        }
        "newmark-alpha" => read_newmark(section, problems),
        "ed-alpha" => {
            section.allow_only(&[KIND, RHO_INF, ALPHA_AR], problems);
            let rho_inf = section.require(&RHO_INF, problems);
            let rho_inf = rho_inf.and_then(|field| field.number(problems));
            let alpha_ar = section.get(&ALPHA_AR);
            let alpha_ar = alpha_ar.map_or(Some(DEFAULT_ALPHA_AR), |field| field.number(problems));
            Some(SpectrumScheme::EdAlpha {
                rho_inf: rho_inf?,
                alpha_ar: alpha_ar?,
            })
        }
        parameterless => {
            section.allow_only(&[KIND], problems);
            Some(match parameterless {
                "bathe" => SpectrumScheme::Bathe,
                "moreau" => SpectrumScheme::Moreau,
                _ => SpectrumScheme::Hets,
            })
        }
    }
}

fn read_newmark(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<SpectrumScheme> {
    section.allow_only(&[KIND, NEWMARK[0], NEWMARK[1]], problems);
    let [field, alpha_f] = { NEWMARK.each_ref() }.map(|key| section.require(key, problems));
    let alpha_m = field.as_ref().and_then(|field| field.number(problems));
    let alpha_f = alpha_f.and_then(|field| field.number(problems));
    let (alpha_m, alpha_f) = (alpha_m?, alpha_f?);
    if alpha_m > alpha_f {
        let allowed = format!("at most alpha_f = {alpha_f:?}, or high frequencies grow");
        return field?.refuse(&allowed, problems);
    }
    Some(SpectrumScheme::NewmarkAlpha { alpha_m, alpha_f })
}

fn read_region(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<SpectrumRegion> {
    let [alpha_m, alpha_f, points] = section.read(&REGION, problems);
    let mut axis =
        |field: Option<Field<'_>>| read_linear_grid(&field?.section(problems)?, problems);
    let (alpha_m, alpha_f) = (axis(alpha_m), axis(alpha_f));
    let tables = sections(points, problems);
    report_equal_labels(&tables, "point", problems);
    let points = collect(&tables, |table| read_point(table, problems));
    Some(SpectrumRegion {
        alpha_m: alpha_m?,
        alpha_f: alpha_f?,
        points: points?,
    })
}

fn read_point(section: &Section<'_>, problems: &mut Problems<'_>) -> Option<RegionPoint> {
    let [label, alpha_m, alpha_f] = section.read(&POINT, problems);
    let label = label.and_then(|field| field.filled_text(problems));
    let alpha_m = alpha_m.and_then(|field| field.number(problems));
    let alpha_f = alpha_f.and_then(|field| field.number(problems));
    Some(RegionPoint {
        label: label?,
        alpha_m: alpha_m?,
        alpha_f: alpha_f?,
    })
}
