//! The moving mechanism as one HTML file that needs nothing else: no network, no other file.
//!
//! The master knows no shapes, only the markers that the models describe. So the picture shows every marker as a small
//! frame (in the plane and in space) or as a block (on a line), the markers of one subsystem joined in the order of
//! their description, the joints as dots, and the path of every marker. Names say more: numbered markers are the points
//! of an outline, and markers with a normal force are contacts.
//!
//! * [`motion`](Motion): takes the positions of the markers from the rows of a run, thinned evenly in time;
//! * `roles`: which markers are frames, points of outlines, contacts, and what is joined to what;
//! * `contacts`: forces and impacts;
//! * `stage`: from the numbers of a marker to its pose in the inertial frame, and the space that the run takes;
//! * `view`: from the inertial frame to the picture, without perspective;
//! * `scenery`: grid and scales;
//! * `picture`: the first frame as SVG, readable without scripting;
//! * `film`: the frames as the script of the page reads them;
//! * `page`: all of it in one file.
//!
//! Script and style sheet are in `assets/animation/`. The script moves the elements of the first frame; it knows each by
//! its place.

mod contacts;
mod film;
mod motion;
mod page;
mod picture;
mod roles;
mod scenery;
mod stage;
mod view;

use std::path::Path;

use linchpin_master::scene::Scene;

pub use motion::Motion;

use crate::commands::CommandError;
use crate::files::write_text;

/// Writes the animation of a run, or of one case of a scene, to `path`.
///
/// # Errors
/// The file cannot be written.
pub fn write(
    scene: &Scene,
    case: Option<&str>,
    motion: &Motion,
    path: &Path,
) -> Result<(), CommandError> {
    let title = match case {
        Some(case) => format!("{} [{case}]", scene.name),
        None => scene.name.clone(),
    };
    let text = page::text(&title, motion).map_err(CommandError::unwritable(path))?;
    write_text(path, &text)
}

#[cfg(test)]
mod tests;
