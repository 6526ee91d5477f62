//! The page: everything in one file that loads nothing.

use std::fmt::{self, Display};

use linchpin_master::results::Statistics;

use super::envelope::{Bound, Cheapest, Ratio};
use super::pictures::{MONOLITHIC, Picture};
use super::summary::{EnvelopeRow, envelope};
use super::{Depth, Ending, Report, SceneReport, SettingReport, StudyRun};
use crate::html::Escaped;
use crate::plot::PlotError;
use crate::study::orders;

const STYLE: &str = include_str!("../../../assets/report.css");

/// The whole page; it is well-formed XML too.
///
/// # Errors
/// A picture cannot be drawn.
pub fn text(report: &Report) -> Result<String, PlotError> {
    let scenes = report.scenes.iter().map(Section::new);
    let page = Page {
        report,
        scenes: scenes.collect::<Result<_, _>>()?,
    };
    Ok(page.to_string())
}

struct Page<'a> {
    report: &'a Report,
    scenes: Vec<Section<'a>>,
}

/// A scene with its pictures: the text of each SVG and what it shows.
struct Section<'a> {
    scene: &'a SceneReport,
    pictures: Vec<(String, String)>,
}

impl<'a> Section<'a> {
    fn new(scene: &'a SceneReport) -> Result<Self, PlotError> {
        let pictures = Picture::all(scene).into_iter();
        let drawn = pictures.map(|picture| {
            let svg = inline(picture.chart.svg(&scene.name)?);
            Ok((svg, picture.caption))
        });
        Ok(Self {
            scene,
            pictures: drawn.collect::<Result<_, PlotError>>()?,
        })
    }
}

/// In a page an SVG needs no name space.
fn inline(svg: String) -> String {
    svg.replacen(r#" xmlns="http://www.w3.org/2000/svg""#, "", 1)
}

impl Display for Page<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let title = Escaped(&self.report.title);
        write!(
            f,
            r#"<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<title>{title}</title>
<style>
{STYLE}</style>
</head>
<body>
<h1>{title}</h1>
<p>{note}</p>
"#,
            note = self.note()
        )?;
        f.write_str("<nav><ul>\n")?;
        for section in &self.scenes {
            let name = Escaped(&section.scene.name);
            writeln!(f, "<li><a href=\"#{name}\">{name}</a></li>")?;
        }
        f.write_str("</ul></nav>\n")?;
        for section in &self.scenes {
            section.write(f, &self.report.targets)?;
        }
        f.write_str("</body>\n</html>\n")
    }
}

impl Page<'_> {
    fn note(&self) -> String {
        let how = match self.report.depth {
            Depth::Full => "short runs five times, of which the fastest counts",
            Depth::Quick => "a quick look: the largest macro steps only, once each",
        };
        format!(
            "linchpin {}. All runs one after the other in one process, without sockets, on one machine of this architecture: {} \
             ({how}). Wall time is that of the macro steps. Errors are NRMS: rms(error)/rms(reference) over the macro points of \
             the run. Integrations are those of all subsystems over a macro step, whatever they are for. Curves of the \
             monolithic scene are runs over the tolerances of its solver.",
            env!("CARGO_PKG_VERSION"),
            std::env::consts::ARCH
        )
    }
}

impl Section<'_> {
    fn write(&self, f: &mut fmt::Formatter<'_>, targets: &[f64]) -> fmt::Result {
        let scene = self.scene;
        let name = Escaped(&scene.name);
        writeln!(f, "<section id=\"{name}\">\n<h2>{name}</h2>")?;
        writeln!(
            f,
            "<p>{}; errors of the {} against {}.</p>",
            Escaped(&scene.file),
            scene.quantity.name(),
            Escaped(&scene.reference)
        )?;
        self.write_envelope(f, targets)?;
        for (svg, caption) in &self.pictures {
            let caption = Escaped(caption);
            writeln!(
                f,
                "<figure>\n{svg}<figcaption>{caption}</figcaption>\n</figure>"
            )?;
        }
        self.write_table(f)?;
        f.write_str("</section>\n")
    }

    fn write_envelope(&self, f: &mut fmt::Formatter<'_>, targets: &[f64]) -> fmt::Result {
        f.write_str(
            "<table>\n<caption>What an error costs: the cheapest setting of every method, by interpolation of the \
             integrations</caption>\n<thead><tr><th>method</th><th>error</th><th>setting</th><th>integrations</th>\
             <th>to the best S1 setting</th><th>to the paper&#39;s own</th></tr></thead>\n<tbody>\n",
        )?;
        for row in envelope(self.scene, targets) {
            write_envelope_row(f, &row)?;
        }
        f.write_str("</tbody></table>\n")
    }

    fn write_table(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "<table>\n<caption>All runs</caption>\n<thead><tr><th>setting</th><th>H in s</th><th>error</th><th>order</th>\
             <th>integrations</th><th>predictor / columns / passes / corrector</th><th>exchanges</th><th>wall time in s</th><th>stable</th></tr></thead>\n<tbody>\n",
        )?;
        for setting in &self.scene.settings {
            self.write_setting(f, setting)?;
        }
        for run in &self.scene.monolithic {
            let label = format!("{:.0e} (tolerance)", run.tolerance);
            self.write_run(f, (MONOLITHIC, &label), &run.ending, None)?;
        }
        f.write_str("</tbody></table>\n")
    }

    fn write_setting(&self, f: &mut fmt::Formatter<'_>, setting: &SettingReport) -> fmt::Result {
        let orders = orders::neighbouring(&setting.runs, self.scene.quantity);
        for (StudyRun { macro_step, ending }, order) in setting.runs.iter().zip(orders) {
            let step = format!("{macro_step:.3e}");
            self.write_run(f, (&setting.name, &step), ending, order)?;
        }
        Ok(())
    }

    fn write_run(
        &self,
        f: &mut fmt::Formatter<'_>,
        (setting, step): (&str, &str),
        ending: &Ending,
        order: Option<f64>,
    ) -> fmt::Result {
        let statistics = ending.statistics();
        let count = |count: Option<u64>| count.map(|count| count.to_string()).unwrap_or_default();
        let error = ending.error(self.scene.quantity);
        let error = error.map(|error| format!("{error:.2e}"));
        let order = order.map(|order| format!("{order:.2}"));
        let time = ending.wall_time().map(|time| format!("{time:.2e}"));
        let reason = ending.instability(self.scene.quantity);
        let class = if reason.is_some() {
            " class=\"failed\""
        } else {
            ""
        };
        let verdict = match (&reason, ending) {
            (None, _) => "yes".to_owned(),
            (Some(reason), Ending::Refused(_)) => format!("the scene cannot have it: {reason}"),
            (Some(reason), _) => format!("no: {reason}"),
        };
        writeln!(
            f,
            "<tr{class}><td>{}</td><td>{step}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            Escaped(setting),
            error.unwrap_or_default(),
            order.unwrap_or_default(),
            count(statistics.map(|own| own.integrations)),
            by_cause(statistics),
            count(statistics.map(|own| own.exchanges)),
            time.unwrap_or_default(),
            Escaped(&verdict)
        )
    }
}

/// Integrations by cause.
fn by_cause(statistics: Option<&Statistics>) -> String {
    let causes = statistics.map(|own| own.integrations_by_cause);
    let shown = causes.map(|own| {
        let counts = [own.predictor, own.columns, own.passes, own.corrector];
        counts.map(|count| count.to_string()).join(" / ")
    });
    shown.unwrap_or_default()
}

fn write_envelope_row(f: &mut fmt::Formatter<'_>, row: &EnvelopeRow) -> fmt::Result {
    let (setting, cost) = match &row.cheapest {
        Some(Cheapest { setting, cost }) => (
            setting.as_str(),
            bounded(cost.integrations.round(), cost.bound),
        ),
        None => ("no run reached its end", String::new()),
    };
    let ratio = |ratio: Option<Ratio>| {
        let shown = ratio.map(|own| bounded(rounded(own.value), own.bound));
        shown.unwrap_or_default()
    };
    writeln!(
        f,
        "<tr><td>{}</td><td>{:e}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
        Escaped(&row.method),
        row.error,
        Escaped(setting),
        Escaped(&cost),
        Escaped(&ratio(row.to_best_s1)),
        Escaped(&ratio(row.to_paper))
    )
}

fn bounded(value: f64, bound: Bound) -> String {
    let sign = match bound {
        Bound::Interpolated => "",
        Bound::AtMost => "≤ ",
        Bound::MoreThan => "> ",
    };
    format!("{sign}{value}")
}

/// To two digits.
fn rounded(value: f64) -> f64 {
    let unit = 10_f64.powf(value.log10().floor() - 1.0);
    let digits = (value / unit).round();
    // Through its text, so that no digits of rounding follow.
    format!("{:.1e}", digits * unit).parse().unwrap_or(value)
}
