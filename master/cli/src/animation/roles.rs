//! How markers are shown, by their names and by what else their models tell.

use linchpin_master::results::{Mechanism, RecordedMarker};
use linchpin_proto::v1::MarkerKind;

use super::motion::Motion;

/// How a marker is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// As a frame or a block, with its path, joined to others of its subsystem.
    Framed,
    /// As a point of a line with those of its name.
    Outline,
    /// As the place of a contact, joined to nothing.
    Dot,
}

/// The roles of all markers. Outlines consist of two or more markers of a subsystem in the plane or in space whose names
/// are the same word with a number, and which are no contacts; contacts so named are dots.
pub(super) fn roles(mechanism: &Mechanism) -> Vec<Role> {
    let markers = &mechanism.markers;
    let is_contact = |place: usize| mechanism.contacts.iter().any(|own| own.marker == place);
    let can_outline = |place: usize, marker: &RecordedMarker| {
        marker.kind != MarkerKind::Scalar && !is_contact(place)
    };
    let role = |(place, marker): (usize, &RecordedMarker)| {
        let Some(word) = numbered(&marker.name) else {
            return Role::Framed;
        };
        if is_contact(place) && marker.kind != MarkerKind::Scalar {
            return Role::Dot;
        }
        let is_partner = |(other, partner): (usize, &RecordedMarker)| {
            other != place
                && partner.subsystem == marker.subsystem
                && numbered(&partner.name) == Some(word)
                && can_outline(other, partner)
        };
        match can_outline(place, marker) && markers.iter().enumerate().any(is_partner) {
            true => Role::Outline,
            false => Role::Framed,
        }
    };
    markers.iter().enumerate().map(role).collect()
}

/// The word of a name that is a word and a number.
fn numbered(name: &str) -> Option<&str> {
    let word = name.trim_end_matches(|character: char| character.is_ascii_digit());
    (!word.is_empty() && word.len() < name.len()).then_some(word)
}

/// Markers that a line joins, in the order of the description.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Joined {
    /// Places of the markers, two or more.
    pub markers: Vec<usize>,
    /// Class of the line in the style sheet.
    pub class: &'static str,
}

/// The lines of all subsystems: each the one of its framed markers, then its outlines.
pub(super) fn joined(motion: &Motion) -> Vec<Joined> {
    let mut lines: Vec<(usize, Option<&str>, Joined)> = Vec::new();
    for (place, marker) in motion.markers.iter().enumerate() {
        let (word, class) = match marker.role {
            Role::Framed => (None, "body"),
            Role::Outline => (numbered(&marker.name), "outline"),
            Role::Dot => continue,
        };
        let is_own = |line: &&mut (usize, Option<&str>, Joined)| {
            (line.0, line.1) == (marker.subsystem, word)
        };
        match lines.iter_mut().find(is_own) {
            Some((_, _, line)) => line.markers.push(place),
            None => {
                let markers = vec![place];
                lines.push((marker.subsystem, word, Joined { markers, class }));
            }
        }
    }
    let lines = lines.into_iter().map(|(_, _, line)| line);
    lines.filter(|line| line.markers.len() > 1).collect()
}
