//! The page: picture, legend, controls, style sheet, frames and script in one file.

use std::fmt::{self, Display, Write};

use super::film::Film;
use super::motion::Motion;
use super::picture::Picture;
use super::roles::Role;
use super::scenery::Scenery;
use super::stage::Stage;
use super::view::View;
use crate::html::Escaped;
use crate::plot::{PALETTE_SIZE, palette_colour};

const STYLE: &str = include_str!("../../assets/animation/style.css");
const SCRIPT: &str = include_str!("../../assets/animation/player.js");

/// Kinds of strokes, which tell subsystems of one colour apart.
const STROKES: usize = 3;

/// Least relative luminance of a colour on a dark background, which gives a contrast of at least 5.
const LEAST_LUMINANCE: f64 = 0.25;

/// The whole page.
///
/// # Errors
/// The frames cannot be written as JSON.
pub(super) fn text(title: &str, motion: &Motion) -> std::io::Result<String> {
    let stage = Stage::of(motion);
    let view = View::on(&stage);
    let scenery = Scenery::of(&stage);
    let film = serde_json::to_string(&Film::of(motion, &stage, &view, &scenery))?;
    let picture = Picture {
        title,
        motion,
        stage: &stage,
        view: &view,
        scenery: &scenery,
    };
    let page = Page {
        title,
        motion,
        picture: &picture,
        film: &in_script(&film),
    };
    Ok(page.to_string())
}

struct Page<'a> {
    title: &'a str,
    motion: &'a Motion,
    picture: &'a Picture<'a>,
    film: &'a str,
}

impl Display for Page<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let title = Escaped(self.title);
        write!(
            f,
            r#"<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
{palette}{STYLE}</style>
</head>
<body>
<h1>{title}</h1>
{picture}<div id="controls" hidden></div>
<ul id="legend">
{legend}</ul>
<p>{note}</p>
<noscript><p>The picture shows the first frame; it moves where scripts are allowed.</p></noscript>
<script type="application/json" id="film">{film}</script>
<script>
{SCRIPT}</script>
</body>
</html>
"#,
            palette = palette(),
            picture = self.picture,
            legend = self.legend(),
            note = self.note(),
            film = self.film,
        )
    }
}

impl Page<'_> {
    /// One entry for every subsystem that is shown.
    fn legend(&self) -> String {
        let mut legend = String::new();
        for (number, name) in self.motion.subsystems.iter().enumerate() {
            let mut markers = self.motion.markers.iter();
            if markers.any(|marker| marker.subsystem == number) {
                let class = colour_class(number);
                let swatch = r#"<svg class="swatch" viewBox="0 0 28 10" aria-hidden="true">"#;
                let line = format!(r#"<polyline class="body {class}" points="1,5 27,5"/>"#);
                // Writing to a string does not fail.
                let _ = writeln!(legend, "<li>{swatch}{line}</svg>{}</li>", Escaped(name));
            }
        }
        legend
    }

    fn note(&self) -> String {
        let frames = self.motion.frames().count();
        let rows = self.motion.rows();
        let thinned = match self.motion.stride() {
            1 => format!("All {rows} rows of results.csv are shown."),
            stride => format!(
                "{frames} of the {rows} rows of results.csv are shown: one of {stride}, and the last one."
            ),
        };
        let lanes = match self.picture.stage.lanes().next() {
            Some(_) => {
                " What moves on a line has a lane of its own; the distance of lanes means nothing."
            }
            None => "",
        };
        let contacts = match (self.motion.contacts.is_empty(), self.motion.largest_force()) {
            (true, _) => String::new(),
            (false, 0.0) => " Rings that widen are impacts.".to_owned(),
            (false, largest) => format!(
                " Filled dots are closed contacts: their area grows with the normal force, at most {} N. \
                 Rings that widen are impacts.",
                three_digits(largest)
            ),
        };
        let mut markers = self.motion.markers.iter();
        let outlines = match markers.any(|marker| marker.role == Role::Outline) {
            true => ", numbered ones to those of the same name",
            false => "",
        };
        format!(
            "{thinned} Markers of one subsystem are joined by lines in the order of its description{outlines}; \
             shapes are not known.{lanes}{contacts}"
        )
    }
}

fn three_digits(value: f64) -> String {
    if (1e-3..1e5).contains(&value) {
        let places = (2.0 - value.log10().floor()).max(0.0) as usize;
        format!("{value:.places$}")
    } else {
        format!("{value:.2e}")
    }
}

/// Colour and stroke of a subsystem, as classes of the style sheet.
pub(super) fn colour_class(subsystem: usize) -> String {
    let (colour, stroke) = (subsystem % PALETTE_SIZE, subsystem / PALETTE_SIZE % STROKES);
    format!("colour{colour} stroke{stroke}")
}

/// The colours of the plots; on a dark background dark ones are mixed with white.
fn palette() -> String {
    let rules = |on_dark: bool| {
        let rule = |number| {
            let colour = palette_colour(number);
            let [red, green, blue] = if on_dark { lightened(colour) } else { colour };
            format!(".colour{number} {{ color: #{red:02x}{green:02x}{blue:02x}; }}\n")
        };
        (0..PALETTE_SIZE).map(rule).collect::<String>()
    };
    format!(
        "{}@media (prefers-color-scheme: dark) {{\n{}}}\n",
        rules(false),
        rules(true)
    )
}

fn lightened(colour: [u8; 3]) -> [u8; 3] {
    let mixed = |share: f64| {
        colour.map(|part| (f64::from(part) + share * (255.0 - f64::from(part))).round() as u8)
    };
    let shares = (0..=20).map(|step| 0.05 * f64::from(step));
    let mut mixtures = shares.map(mixed);
    let bright = mixtures.find(|mixture| luminance(*mixture) >= LEAST_LUMINANCE);
    bright.unwrap_or([255; 3])
}

/// Relative luminance of a colour, as the Web Content Accessibility Guidelines 2.1 define it.
fn luminance(colour: [u8; 3]) -> f64 {
    let linear = |part: u8| {
        let part = f64::from(part) / 255.0;
        match part <= 0.03928 {
            true => part / 12.92,
            false => ((part + 0.055) / 1.055).powf(2.4),
        }
    };
    let [red, green, blue] = colour.map(linear);
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// JSON that cannot end the script element it stands in: `<` is only ever part of a string there.
fn in_script(json: &str) -> String {
    json.replace('<', "\\u003c")
}
