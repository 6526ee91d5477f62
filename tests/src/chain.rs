//! The hanging chain: `scenes/chain` and its monolithic counterpart.

use linchpin_models::reference::{Chain, GroundHinge, Link};

const LINK: Link = Link {
    m: 1.3,
    inertia: 0.06,
    length: 0.7,
};

/// Angles of the links from the x axis at the start (rad): awkward ones, hanging down.
fn angles(links: usize) -> Vec<f64> {
    let angle = |link: usize| -1.2 + 0.3 * (1.7 * link as f64).sin();
    (0..links)
        .map(|link| (angle(link) * 1e3).round() / 1e3)
        .collect()
}

/// The chain of `links` links, at least one, as a scene.
pub fn scene_text(links: usize) -> String {
    let mut text = format!(
        "# A chain of {links} links that hangs on a hinge in the ground; every link has a worker of its own. The first link is a\n\
         # pendulum, the others are free bodies, each hinged to the end of the one before.\n\
         # Other lengths: cargo run --release --package linchpin-tests --example chain -- LINKS > FILE\n\n\
         [scene]\nname = \"chain-{links}\"\nt_end = 0.5\n\n\
         [coupling]\nmethod = \"weighted\"\ndegree = 1\nmacro_step = 1e-3\n"
    );
    let Link { m, inertia, length } = LINK;
    let mut start = [0.0, 0.0];
    for (number, angle) in (1..).zip(angles(links)) {
        let (model, place) = match number {
            1 => ("pendulum", String::new()),
            _ => (
                "planar-body",
                format!(", x0 = {:.12}, y0 = {:.12}", start[0], start[1]),
            ),
        };
        text += &format!(
            "\n[[subsystem]]\nname = \"link{number}\"\nmodel = \"{model}\"\n\
             parameters = {{ m = {m}, inertia = {inertia}, length = {length}{place}, angle0 = {angle} }}\n"
        );
        start[0] += length * angle.cos();
        start[1] += length * angle.sin();
    }
    for hinge in 1..links {
        let (end, next) = (if hinge == 1 { "tip" } else { "end" }, hinge + 1);
        text += &format!(
            "\n[[joint]]\nname = \"hinge{hinge}\"\nkind = \"atpoint\"\na = \"link{hinge}.{end}\"\nb = \"link{next}.start\"\n"
        );
    }
    text + &output(links)
}

/// Angles and energies; the picture shows a few of the links, and that the energy of all of them stays.
fn output(links: usize) -> String {
    let mut text = "\n[output]\nvariables = [\n".to_owned();
    for number in 1..=links {
        text += &format!("  \"link{number}.angle\", \"link{number}.energy\",\n");
    }
    let mut shown = vec![1, links / 2, links];
    shown.retain(|&link| link > 0);
    shown.dedup();
    let angles: Vec<_> = shown
        .iter()
        .map(|link| format!("\"link{link}.angle\""))
        .collect();
    let energies: Vec<_> = (1..=links)
        .map(|link| format!("link{link}.energy"))
        .collect();
    text += &format!(
        "]\n\n[[output.panel]]\nlabel = \"angle in rad\"\ncolumns = [{}]\n\n\
         [[output.panel]]\nlabel = \"energy in J\"\ncolumns = [\"{}\"]\n",
        angles.join(", "),
        energies.join(" + ")
    );
    text
}

/// The same chain in absolute angles.
pub fn reference(links: usize) -> Chain {
    Chain {
        link: LINK,
        hinge: GroundHinge::default(),
        gravity: 9.81,
        angles: angles(links),
        rates: vec![0.0; links],
    }
}
