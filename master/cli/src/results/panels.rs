//! Which curves go into which panel of the picture of a run: those that the scene asks for, or a panel for every quantity and
//! unit.

use std::collections::BTreeMap;

use linchpin_master::results::Quantity;
use linchpin_master::scene::Panel;

use super::trace::Reading;
use super::{ReportedColumn, Trace};
use crate::plot::Scale;

/// A panel of the picture of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shown {
    /// Label of its axis, with the unit.
    pub label: String,
    /// Scale of its axis.
    pub scale: Scale,
    /// Label of the x axis, where that is not the time.
    pub over: Option<String>,
    /// How many curves it is meant to have.
    pub curves: usize,
}

/// Panels and their curves, still empty.
pub(super) struct Layout {
    pub shown: Vec<Shown>,
    pub traces: Vec<Trace>,
}

/// Place of the time in a row.
const TIME: usize = 0;

impl Layout {
    /// The panels of a scene.
    pub fn of_panels(columns: &[ReportedColumn], panels: &[Panel]) -> Self {
        let place_of = |name: &String| columns.iter().position(|column| column.name() == name);
        let places_of =
            |sum: &[String]| -> Vec<usize> { sum.iter().filter_map(place_of).collect() };
        let is_multiplier = |place: &usize| columns[*place].quantity() == Quantity::Multiplier;
        let traced = panels.iter().enumerate().flat_map(|(panel, own)| {
            let over = own.over.as_ref();
            let over = over.map_or_else(|| vec![TIME], |over| places_of(&over.column));
            own.curves.iter().map(move |curve| {
                let places = places_of(curve);
                let shows_multipliers = places.iter().any(is_multiplier);
                let readings = [over.clone(), places].map(Reading::Sum);
                Trace::new(curve.join(" + "), panel, shows_multipliers, readings)
            })
        });
        let shown = panels.iter().map(|panel| Shown {
            label: panel.label.clone(),
            scale: Scale::Linear,
            over: panel.over.as_ref().map(|over| over.label.clone()),
            curves: panel.curves.len(),
        });
        Self {
            traces: traced.collect(),
            shown: shown.collect(),
        }
    }

    /// A panel for every quantity and unit of the columns at these places. Unit quaternions are shown by the angle by which their
    /// marker has turned, once for each.
    pub fn of_quantities(columns: &[ReportedColumn], places: &[usize]) -> Self {
        let mut layout = Self {
            shown: Vec::new(),
            traces: Vec::new(),
        };
        let mut turned: Vec<&str> = Vec::new();
        for &place in places {
            let own = &columns[place];
            let marker = own
                .column
                .marker
                .as_ref()
                .map(|marker| marker.name.as_str());
            match (own.quantity(), marker) {
                (Quantity::Attitude, Some(marker)) => {
                    if !turned.contains(&marker) {
                        turned.push(marker);
                        layout.add_turn(columns, marker);
                    }
                }
                _ => layout.add(own, place),
            }
        }
        layout.sort();
        layout
    }

    fn add(&mut self, own: &ReportedColumn, place: usize) {
        let quantity = own.quantity();
        let scale = match quantity {
            Quantity::Step | Quantity::ErrorEstimate => Scale::Logarithmic,
            _ => Scale::Linear,
        };
        let panel = self.panel(label(quantity, &own.column.unit), scale);
        let shows_multipliers = quantity == Quantity::Multiplier;
        let readings = [vec![TIME], vec![place]].map(Reading::Sum);
        let name = own.name().to_owned();
        self.traces
            .push(Trace::new(name, panel, shows_multipliers, readings));
    }

    /// Adds the turn of a marker, if all components of its quaternion are there.
    fn add_turn(&mut self, columns: &[ReportedColumn], marker: &str) {
        let components = columns.iter().enumerate().filter_map(|(place, own)| {
            let part = own.column.marker.as_ref();
            let part = part.filter(|part| part.name == marker)?;
            (own.quantity() == Quantity::Attitude).then_some((part.component, place))
        });
        let places: Vec<usize> = components
            .collect::<BTreeMap<_, _>>()
            .into_values()
            .collect();
        let Ok(places) = <[usize; 4]>::try_from(places) else {
            return;
        };
        let panel = self.panel("turn since the start in rad".into(), Scale::Linear);
        let first = None;
        let readings = [Reading::Sum(vec![TIME]), Reading::Turn { places, first }];
        self.traces
            .push(Trace::new(marker.to_owned(), panel, false, readings));
    }

    /// The number of the panel with this label, which is made if it is not there.
    fn panel(&mut self, label: String, scale: Scale) -> usize {
        let place = self.shown.iter().position(|own| own.label == label);
        let place = place.unwrap_or_else(|| {
            self.shown.push(Shown {
                label,
                scale,
                over: None,
                curves: 0,
            });
            self.shown.len() - 1
        });
        self.shown[place].curves += 1;
        place
    }

    /// What moves comes first, what tells of the macro steps last.
    fn sort(&mut self) {
        let rank = |label: &str| RANKS.iter().position(|start| label.starts_with(start));
        let mut order: Vec<usize> = (0..self.shown.len()).collect();
        order.sort_by_key(|place| rank(&self.shown[*place].label).unwrap_or(RANKS.len()));
        let new = |old: usize| order.iter().position(|place| *place == old);
        for trace in &mut self.traces {
            trace.panel = new(trace.panel).unwrap_or(trace.panel);
        }
        self.shown = order
            .iter()
            .map(|place| self.shown[*place].clone())
            .collect();
        self.traces.sort_by_key(|trace| trace.panel);
    }
}

/// Beginnings of labels in the order of the panels; outputs of other kinds come before what tells of the joints.
const RANKS: [&str; 23] = [
    "position",
    "angle",
    "turn",
    "velocity",
    "angular velocity",
    "acceleration",
    "angular acceleration",
    "force",
    "moment",
    "voltage",
    "current",
    "power",
    "energy",
    "output",
    "joint force",
    "joint moment",
    "joint load",
    "residual",
    "macro step",
    "estimated error",
    "degree",
    "repeated",
    "time",
];

/// Label of the axis of a quantity in this unit.
fn label(quantity: Quantity, unit: &str) -> String {
    let name = match (quantity, unit) {
        (Quantity::Time, _) => "time",
        (Quantity::Position, "m") => "position",
        (Quantity::Velocity, "m/s") => "velocity",
        (Quantity::Acceleration, "m/s^2") => "acceleration",
        (Quantity::Attitude, _) => "quaternion",
        (Quantity::Multiplier, "N") => "joint force",
        (Quantity::Multiplier, "N m") => "joint moment",
        (Quantity::Multiplier, _) => "joint load",
        (Quantity::Residual, _) => "residual",
        (Quantity::Step, _) => "macro step H",
        (Quantity::Degree, _) => "degree",
        (Quantity::ErrorEstimate, _) => return "estimated error / motion".into(),
        (Quantity::Rejections, _) => "repeated attempts",
        // Of markers and other outputs alike.
        (_, "rad") => "angle",
        (_, "rad/s") => "angular velocity",
        (_, "rad/s^2") => "angular acceleration",
        (Quantity::Position, _) => "position",
        (Quantity::Velocity, _) => "velocity",
        (Quantity::Acceleration, _) => "acceleration",
        (Quantity::Output, "N") => "force",
        (Quantity::Output, "N m") => "moment",
        (Quantity::Output, "J") => "energy",
        (Quantity::Output, "W") => "power",
        (Quantity::Output, "V") => "voltage",
        (Quantity::Output, "A") => "current",
        (Quantity::Output, _) => "output",
    };
    match unit {
        "" | "1" => name.to_owned(),
        unit => format!("{name} in {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use linchpin_master::results::MarkerPart;

    use super::*;
    use crate::results::about::tests::column;

    fn labels(layout: &Layout) -> Vec<(&str, usize)> {
        let shown = layout.shown.iter();
        shown.map(|own| (own.label.as_str(), own.curves)).collect()
    }

    #[test]
    fn a_panel_for_every_quantity_and_unit_in_the_order_of_a_reader() {
        let columns = [
            column("t", "s", Quantity::Time),
            column("link.tip_x", "m", Quantity::Position),
            column("link.tip_angle", "rad", Quantity::Position),
            column("link.rate", "rad/s", Quantity::Output),
            column("link.energy", "J", Quantity::Output),
            column("link.gap", "m", Quantity::Output),
            column("link.share", "1", Quantity::Output),
            column("link.angle", "rad", Quantity::Output),
            column("body.y", "m", Quantity::Position),
            column("hinge.lambda.x", "N", Quantity::Multiplier),
            column("hinge.lambda.axis", "N m", Quantity::Multiplier),
            column("hinge.residual.position.x", "m", Quantity::Residual),
            column("step", "s", Quantity::Step),
            column("error_estimate", "1", Quantity::ErrorEstimate),
        ];
        let layout = Layout::of_quantities(&columns, &(1..columns.len()).collect::<Vec<_>>());
        let expected = [
            ("position in m", 2),
            ("angle in rad", 2),
            ("angular velocity in rad/s", 1),
            ("energy in J", 1),
            ("output in m", 1),
            ("output", 1),
            ("joint force in N", 1),
            ("joint moment in N m", 1),
            ("residual in m", 1),
            ("macro step H in s", 1),
            ("estimated error / motion", 1),
        ];
        assert_eq!(labels(&layout), expected);
        for trace in &layout.traces {
            let own = columns.iter().find(|column| column.name() == trace.name);
            let own = own.unwrap();
            let label = label(own.quantity(), &own.column.unit);
            assert_eq!(layout.shown[trace.panel].label, label, "{}", trace.name);
        }
    }

    #[test]
    fn a_quaternion_is_one_turn_whatever_of_it_is_asked_for() {
        let mut columns = vec![column("t", "s", Quantity::Time)];
        for (component, name) in ["qw", "qx", "qy", "qz"].into_iter().enumerate() {
            let mut own = column(&format!("body.{name}"), "1", Quantity::Attitude);
            own.column.marker = Some(MarkerPart {
                name: "body.centre".into(),
                component: 3 + component,
            });
            columns.push(own);
        }
        for places in [&[1, 2, 3, 4][..], &[3]] {
            let layout = Layout::of_quantities(&columns, places);
            assert_eq!(labels(&layout), [("turn since the start in rad", 1)]);
            assert_eq!(layout.traces[0].name, "body.centre");
        }
        columns.pop();
        assert_eq!(labels(&Layout::of_quantities(&columns, &[1])), []);
    }
}
