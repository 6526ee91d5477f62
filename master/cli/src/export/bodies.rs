//! The markers of a run as points in space, by the columns of its table.

use linchpin_master::results::Quantity;

use crate::results::ReportedColumn;

/// The markers of a subsystem whose positions are in the table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Body {
    /// Name of the subsystem.
    pub name: String,
    /// Its markers in the order of the columns.
    pub points: Vec<Point>,
}

/// A marker as a point.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Point {
    /// `SUBSYSTEM.MARKER`
    pub name: String,
    /// Columns of its coordinates x, y, z; without one the coordinate is 0, as z in the plane.
    places: [Option<usize>; 3],
}

impl Point {
    /// Its coordinates in a row (m).
    pub fn at(&self, row: &[f64]) -> [f64; 3] {
        self.places
            .map(|place| place.map_or(0.0, |place| row[place]))
    }
}

/// The bodies of a run: of every marker whose position is in the table, as far as it is a length.
pub fn bodies(columns: &[ReportedColumn]) -> Vec<Body> {
    let mut bodies: Vec<Body> = Vec::new();
    for (place, own) in columns.iter().enumerate() {
        let Some(marker) = &own.column.marker else {
            continue;
        };
        let is_coordinate = own.quantity() == Quantity::Position && own.column.unit == "m";
        if !is_coordinate || marker.component > 2 {
            continue;
        }
        let (subsystem, _) = marker.name.rsplit_once('.').unwrap_or((&marker.name, ""));
        let body = of_name(&mut bodies, subsystem);
        let number = body
            .points
            .iter()
            .position(|point| point.name == marker.name);
        let number = number.unwrap_or_else(|| {
            body.points.push(Point {
                name: marker.name.clone(),
                places: [None; 3],
            });
            body.points.len() - 1
        });
        body.points[number].places[marker.component] = Some(place);
    }
    bodies
}

fn of_name<'a>(bodies: &'a mut Vec<Body>, name: &str) -> &'a mut Body {
    let place = bodies.iter().position(|own| own.name == name);
    let place = place.unwrap_or_else(|| {
        bodies.push(Body {
            name: name.to_owned(),
            points: Vec::new(),
        });
        bodies.len() - 1
    });
    &mut bodies[place]
}

#[cfg(test)]
mod tests {
    use linchpin_master::results::MarkerPart;

    use super::*;
    use crate::results::about::tests::column;

    #[test]
    fn markers_are_points_of_their_subsystems() {
        let part = |name: &str, unit: &str, quantity, marker: &str, component| {
            let mut own = column(name, unit, quantity);
            own.column.marker = Some(MarkerPart {
                name: marker.into(),
                component,
            });
            own
        };
        let columns = [
            column("t", "s", Quantity::Time),
            part("arm.tip_y", "m", Quantity::Position, "arm.tip", 1),
            part("arm.tip_x", "m", Quantity::Position, "arm.tip", 0),
            part("arm.tip_angle", "rad", Quantity::Position, "arm.tip", 2),
            part("arm.tip_vx", "m/s", Quantity::Velocity, "arm.tip", 0),
            part("top.end_z", "m", Quantity::Position, "top.end", 2),
            part("top.end_qw", "1", Quantity::Attitude, "top.end", 3),
            part("motor.shaft", "rad", Quantity::Position, "motor.shaft", 0),
        ];
        let row = [0.5, 2.0, 1.0, 0.1, 9.0, 3.0, 1.0, 7.0];
        let bodies = bodies(&columns);
        let found: Vec<(&str, &str, [f64; 3])> = bodies
            .iter()
            .flat_map(|body| {
                body.points
                    .iter()
                    .map(|own| (body.name.as_str(), own.name.as_str(), own.at(&row)))
            })
            .collect();
        let expected = [
            ("arm", "arm.tip", [1.0, 2.0, 0.0]),
            ("top", "top.end", [0.0, 0.0, 3.0]),
        ];
        assert_eq!(found, expected);
    }
}
