use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Drawn, Surface};
use super::style::{FRAME, LABEL_TEXT, TICK_TEXT, fitted, stroke, text, text_width, units};

/// Colours of growth factors: blue below 1, white at 1, red above.
///
/// Either side uses the whole of its colour, however unequal their widths: below 1 in proportion to the distance
/// from 1, above 1 in proportion to the logarithm, because factors of unstable cases spread over decades.
pub(super) struct GrowthColours {
    least: f64,
    greatest: f64,
}

/// Ends of the scale, kept light enough for dark marks on top.
const DAMPED: RGBColor = RGBColor(84, 153, 199);
const NEUTRAL: RGBColor = RGBColor(250, 250, 250);
const GROWING: RGBColor = RGBColor(222, 110, 90);

/// A side narrower than this holds rounding only.
const ROUNDING: f64 = 1e-9;

const STRIPES: i32 = 96;
const BAR_WIDTH: f64 = 24.0;
const TICK_GAP: f64 = 8.0;

impl GrowthColours {
    /// The scale for these values, `None` if none of them is finite and not negative.
    pub(super) fn spanning(values: impl Iterator<Item = f64>) -> Option<Self> {
        let usable = values.filter(|value| value.is_finite() && *value >= 0.0);
        let (least, greatest) = usable.fold(
            (f64::INFINITY, 0.0),
            |(least, greatest): (f64, f64), value| (least.min(value), greatest.max(value)),
        );
        let open = |end: f64| {
            if (end - 1.0).abs() < ROUNDING {
                1.0
            } else {
                end
            }
        };
        (least <= greatest).then(|| Self {
            least: open(least.min(1.0)),
            greatest: open(greatest.max(1.0)),
        })
    }

    /// Place of the value between -1 (least) and 1 (greatest); 0 is the value 1. Infinity counts as the greatest.
    fn place(&self, value: f64) -> f64 {
        let place = if value < 1.0 {
            (value - 1.0) / (1.0 - self.least)
        } else {
            value.ln() / self.greatest.ln()
        };
        if place.is_nan() {
            0.0
        } else {
            place.clamp(-1.0, 1.0)
        }
    }

    /// Inverse of [`GrowthColours::place`].
    fn value(&self, place: f64) -> f64 {
        if place < 0.0 {
            1.0 + place * (1.0 - self.least)
        } else {
            (place * self.greatest.ln()).exp()
        }
    }

    /// Colour of the value, `None` for NaN and negative numbers.
    pub(super) fn of(&self, value: f64) -> Option<RGBColor> {
        (value >= 0.0).then(|| shade(self.place(value)))
    }

    fn ends(&self) -> (f64, f64) {
        let lower = if self.least < 1.0 { -1.0 } else { 0.0 };
        let upper = if self.greatest > 1.0 || lower == 0.0 {
            1.0
        } else {
            0.0
        };
        (lower, upper)
    }

    fn ticks(&self) -> Vec<(f64, String)> {
        let (lower, upper) = self.ends();
        let places = [-1.0, -0.5, 0.0, 0.5, 1.0]
            .into_iter()
            .filter(|place| (lower..=upper).contains(place));
        let labelled = places.map(|place| (place, growth_label(self.value(place))));
        labelled
            .filter(|(place, label)| *place == 0.0 || label != "1")
            .collect()
    }

    /// Width of the bar with its labels, in drawing units.
    pub(super) fn width(&self) -> i32 {
        let labels = self
            .ticks()
            .iter()
            .map(|(_, label)| text_width(label, TICK_TEXT))
            .max()
            .unwrap_or(0);
        labels + units(BAR_WIDTH + 2.0 * TICK_GAP + 1.6 * LABEL_TEXT)
    }

    /// Draws the colour bar into the area, with its label to the right.
    pub(super) fn draw<DB: Surface>(
        &self,
        area: &DrawingArea<DB, Shift>,
        label: &str,
    ) -> Drawn<DB> {
        let (width, height) = area.dim_in_pixel();
        let (width, height) = (width as i32, height as i32);
        let (lower, upper) = self.ends();
        let down =
            |place: f64| (f64::from(height) * (upper - place) / (upper - lower)).round() as i32;
        for stripe in 0..STRIPES {
            let place = |edge: i32| lower + (upper - lower) * f64::from(edge) / f64::from(STRIPES);
            let middle = (place(stripe) + place(stripe + 1)) / 2.0;
            let corners = [
                (0, down(place(stripe + 1))),
                (units(BAR_WIDTH), down(place(stripe))),
            ];
            area.draw(&Rectangle::new(corners, shade(middle).filled()))?;
        }
        let right = units(BAR_WIDTH);
        let outline = [(0, 0), (right, 0), (right, height), (0, height), (0, 0)];
        DB::polyline(area, &outline, stroke(FRAME, 1.0))?;
        let style = text(TICK_TEXT, FRAME, HPos::Left, VPos::Center);
        for (place, label) in self.ticks() {
            let y = down(place);
            let tick = [(right, y), (right + units(TICK_GAP / 2.0), y)];
            DB::polyline(area, &tick, stroke(FRAME, 1.25))?;
            area.draw_text(&label, &style, (right + units(TICK_GAP), y))?;
        }
        let upright =
            text(LABEL_TEXT, FRAME, HPos::Center, VPos::Bottom).transform(FontTransform::Rotate270);
        area.draw_text(
            &fitted(label, LABEL_TEXT, height),
            &upright,
            (width, height / 2),
        )
    }
}

fn shade(place: f64) -> RGBColor {
    let end = if place < 0.0 { DAMPED } else { GROWING };
    let mixed = |from: u8, to: u8| {
        (f64::from(from) + place.abs() * (f64::from(to) - f64::from(from))).round() as u8
    };
    RGBColor(
        mixed(NEUTRAL.0, end.0),
        mixed(NEUTRAL.1, end.1),
        mixed(NEUTRAL.2, end.2),
    )
}

/// The factor with two significant digits of its distance from 1.
fn growth_label(value: f64) -> String {
    if value >= 1e4 {
        return format!("{value:.1e}");
    }
    let distance = (value - 1.0).abs();
    let decimals = if distance > 0.0 {
        (1.0 - distance.log10().floor()).clamp(0.0, 12.0) as usize
    } else {
        0
    };
    let text = format!("{value:.decimals$}");
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by it")]
mod tests {
    use super::*;

    #[test]
    fn one_is_neutral_and_both_ends_use_their_full_colour() {
        let colours =
            GrowthColours::spanning([0.9989, 0.9995, 1.0, 1.13, 37.0, f64::NAN].into_iter())
                .unwrap();
        assert_eq!(colours.of(1.0), Some(NEUTRAL));
        assert_eq!(colours.of(0.9989), Some(DAMPED));
        assert_eq!(colours.of(37.0), Some(GROWING));
        assert_eq!(colours.of(f64::INFINITY), Some(GROWING));
        assert_eq!(colours.of(f64::NAN), None);
        assert!((colours.place(37f64.sqrt()) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn labels_show_the_distance_from_one() {
        assert_eq!(growth_label(0.9989), "0.9989");
        assert_eq!(growth_label(1.0), "1");
        assert_eq!(growth_label(6.08), "6.1");
        assert_eq!(growth_label(100.0), "100");
        assert_eq!(growth_label(0.0), "0");
    }

    #[test]
    fn only_stable_values_leave_out_the_growing_side() {
        let colours = GrowthColours::spanning([0.25, 1.0 + 1e-13].into_iter()).unwrap();
        let labels: Vec<String> = colours
            .ticks()
            .into_iter()
            .map(|(_, label)| label)
            .collect();
        assert_eq!(labels, ["0.25", "0.62", "1"]);
    }
}
