//! The first frame as SVG, with the paths of all markers.

use std::fmt::{self, Display, Write};

use linchpin_proto::joint_load::Marker as _;
use nalgebra::Vector3;

use super::contacts::FLASH;
use super::motion::{Frame, Marker, Motion};
use super::page::colour_class;
use super::roles::{Role, joined};
use super::scenery::Scenery;
use super::stage::Stage;
use super::view::View;
use crate::html::Escaped;

/// Radii of the dots at markers and joints in pixels.
const MARKER_RADIUS: f64 = 3.5;
const JOINT_RADIUS: f64 = 5.5;

/// Where the time stands, from the right and from above, in pixels.
const CLOCK: (f64, f64) = (12.0, 24.0);

/// The picture of the first frame. The groups `scenery`, `traces`, `bodies`, `markers`, `joints` and `contacts` have
/// their elements in the order of the frames' description, by which the script finds them; markers without a frame have
/// none in `traces` and `markers`.
pub(super) struct Picture<'a> {
    /// What it shows, in words.
    pub title: &'a str,
    /// What moves.
    pub motion: &'a Motion,
    /// Where it moves.
    pub stage: &'a Stage,
    /// How it is seen.
    pub view: &'a View,
    /// What does not move.
    pub scenery: &'a Scenery,
}

impl Display for Picture<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (width, height) = self.view.size;
        writeln!(
            f,
            r#"<svg id="picture" viewBox="0 0 {width} {height}" role="img" aria-label="{}">"#,
            Escaped(self.title)
        )?;
        self.write_scenery(f)?;
        self.write_traces(f)?;
        if let Some(first) = self.motion.frames().next() {
            self.write_bodies(f, first)?;
            self.write_markers(f, first)?;
            self.write_joints(f, first)?;
            self.write_contacts(f, first)?;
            let (x, t) = (width - CLOCK.0, first.t);
            writeln!(
                f,
                r#"<text id="time" x="{x}" y="{}" text-anchor="end">t = {t} s</text>"#,
                CLOCK.1
            )?;
        }
        writeln!(f, "</svg>")
    }
}

impl Picture<'_> {
    fn write_scenery(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, r#"<g id="scenery">"#)?;
        for line in &self.scenery.lines {
            let ends = line.ends.map(Vector3::from);
            writeln!(f, "{}", self.polyline(line.class, &ends))?;
        }
        for label in &self.scenery.labels {
            let (x, y) = self.view.place(&label.at.into());
            let (x, y) = (x + label.offset.0, y + label.offset.1);
            let (anchor, text) = (label.anchor, Escaped(&label.text));
            writeln!(
                f,
                r#"<text x="{x:.1}" y="{y:.1}" text-anchor="{anchor}">{text}</text>"#
            )?;
        }
        writeln!(f, "</g>")
    }

    fn write_traces(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, r#"<g id="traces">"#)?;
        for marker in self.framed() {
            let path = self.motion.frames().map(|frame| self.point(marker, frame));
            let path: Vec<Vector3<f64>> = path.collect();
            let class = format!("trace {}", colour_class(marker.subsystem));
            writeln!(f, "{}", self.polyline(&class, &path))?;
        }
        writeln!(f, "</g>")
    }

    fn write_bodies(&self, f: &mut fmt::Formatter<'_>, frame: &Frame) -> fmt::Result {
        writeln!(f, r#"<g id="bodies">"#)?;
        for line in joined(self.motion) {
            let markers = line
                .markers
                .iter()
                .map(|&number| &self.motion.markers[number]);
            let points: Vec<Vector3<f64>> = markers.map(|m| self.point(m, frame)).collect();
            let subsystem = self.motion.markers[line.markers[0]].subsystem;
            let class = format!("{} {}", line.class, colour_class(subsystem));
            writeln!(f, "{}", self.polyline(&class, &points))?;
        }
        writeln!(f, "</g>")
    }

    fn write_markers(&self, f: &mut fmt::Formatter<'_>, frame: &Frame) -> fmt::Result {
        writeln!(f, r#"<g id="markers">"#)?;
        for marker in self.framed() {
            let pose = self.stage.pose(marker, frame);
            let subsystem = &self.motion.subsystems[marker.subsystem];
            writeln!(
                f,
                r#"<g class="marker {}"><title>{}.{}</title>"#,
                colour_class(marker.subsystem),
                Escaped(subsystem),
                Escaped(&marker.name)
            )?;
            for line in self.stage.shape(marker.form) {
                let ends = line.iter().map(|own| pose.point(own));
                let ends: Vec<Vector3<f64>> = ends.collect();
                writeln!(f, "{}", self.polyline("shape", &ends))?;
            }
            writeln!(f, "{}</g>", self.dot(&pose.position, MARKER_RADIUS))?;
        }
        writeln!(f, "</g>")
    }

    fn write_joints(&self, f: &mut fmt::Formatter<'_>, frame: &Frame) -> fmt::Result {
        writeln!(f, r#"<g id="joints">"#)?;
        for joint in &self.motion.joints {
            let marker = |number: usize| &self.motion.markers[number];
            let [a, b] = joint.ends.map(|end| self.point(marker(end), frame));
            let held = self.stage.held(joint, self.motion, frame);
            let name = Escaped(&joint.name);
            writeln!(f, r#"<g class="joint"><title>{name}</title>"#)?;
            let link = [a, held[0], held[1], b];
            writeln!(f, "{}", self.polyline("link", &link))?;
            let [a, b] = held.map(|point| self.dot(&point, JOINT_RADIUS));
            writeln!(f, "{a}{b}</g>")?;
        }
        writeln!(f, "</g>")
    }

    fn write_contacts(&self, f: &mut fmt::Formatter<'_>, frame: &Frame) -> fmt::Result {
        writeln!(f, r#"<g id="contacts">"#)?;
        for (place, contact) in self.motion.contacts.iter().enumerate() {
            let marker = &self.motion.markers[contact.marker];
            let subsystem = Escaped(&self.motion.subsystems[marker.subsystem]);
            let (name, at) = (Escaped(&marker.name), self.point(marker, frame));
            let dot = self.dot(&at, self.motion.dot_radius(place, frame));
            let flash = self.motion.flashes(contact).first().copied();
            let strength = flash.unwrap_or(0.0);
            let ring = self.dot(&at, if strength > 0.0 { FLASH.0 } else { 0.0 });
            writeln!(
                f,
                r#"<g class="contact" style="--flash: {strength}"><title>{subsystem}.{name}</title>{dot}{ring}</g>"#
            )?;
        }
        writeln!(f, "</g>")
    }

    fn framed(&self) -> impl Iterator<Item = &Marker> {
        let markers = self.motion.markers.iter();
        markers.filter(|marker| marker.role == Role::Framed)
    }

    fn point(&self, marker: &Marker, frame: &Frame) -> Vector3<f64> {
        self.stage.pose(marker, frame).position
    }

    /// A line through points, without those that fall on the one before.
    fn polyline(&self, class: &str, points: &[Vector3<f64>]) -> String {
        let mut line = format!(r#"<polyline class="{class}" points=""#);
        let mut before = String::new();
        for point in points {
            let (x, y) = self.view.place(point);
            let place = format!("{x:.1},{y:.1}");
            if place != before {
                // Writing to a string does not fail.
                let _ = write!(line, "{}{place}", if before.is_empty() { "" } else { " " });
                before = place;
            }
        }
        line + r#""/>"#
    }

    fn dot(&self, at: &Vector3<f64>, radius: f64) -> String {
        let (x, y) = self.view.place(at);
        format!(r#"<circle cx="{x:.1}" cy="{y:.1}" r="{radius}"/>"#)
    }
}
