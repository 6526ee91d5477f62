//! What a master sees of the toy. The pole is at `x = 0`, the bird on the side of positive `x`.
//!
//! Places are as the equations of motion have them, linear in the angles: a point `(a, b)` of a body that has turned by
//! `phi` is `(a - b phi, b + a phi)` from where the body turns about.

use crate::mechanics::describe::input;
use crate::nonsmooth::subsystem::face::{Coordinate, Face, FaceContact, FaceMarker};
use crate::nonsmooth::subsystem::observed::{Motion, Observer, PointMotion};
use crate::nonsmooth::systems::woodpecker::Toy;

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Drawn {
    /// A point of the sleeve, over its inner radius and half height.
    Sleeve(f64, f64),
    /// The spring.
    Spring,
    /// A point of the bird from its centre, over reach and height of its beak.
    Bird(f64, f64),
    /// A side of the pole, and its upper (0) or lower (1) end.
    Pole(f64, usize),
}

/// All markers. Those without a number are joined to a skeleton: sleeve, spring, bird, beak.
const DRAWN: &[(&str, Drawn)] = &[
    ("upper", Drawn::Sleeve(1.0, 1.0)),
    ("lower", Drawn::Sleeve(1.0, -1.0)),
    ("spring", Drawn::Spring),
    ("bird", Drawn::Bird(0.0, 0.0)),
    ("beak", Drawn::Bird(-1.0, 1.0)),
    ("sleeve1", Drawn::Sleeve(1.0, 1.0)),
    ("sleeve2", Drawn::Sleeve(1.0, -1.0)),
    ("sleeve3", Drawn::Sleeve(-1.0, -1.0)),
    ("sleeve4", Drawn::Sleeve(-1.0, 1.0)),
    ("sleeve5", Drawn::Sleeve(1.0, 1.0)),
    ("body1", Drawn::Bird(-1.0, 1.0)),
    ("body2", Drawn::Bird(-0.6, 1.2)),
    ("body3", Drawn::Bird(-0.2, 1.15)),
    ("body4", Drawn::Bird(0.05, 0.8)),
    ("body5", Drawn::Bird(0.3, -0.2)),
    ("body6", Drawn::Bird(0.5, -1.6)),
    ("body7", Drawn::Bird(0.2, -1.6)),
    ("body8", Drawn::Bird(-0.2, -0.8)),
    ("body9", Drawn::Bird(-0.4, 0.0)),
    ("body10", Drawn::Bird(-0.3, 0.6)),
    ("body11", Drawn::Bird(-0.55, 0.85)),
    ("body12", Drawn::Bird(-1.0, 1.0)),
    ("right1", Drawn::Pole(1.0, 0)),
    ("right2", Drawn::Pole(1.0, 1)),
    ("left1", Drawn::Pole(-1.0, 0)),
    ("left2", Drawn::Pole(-1.0, 1)),
];

/// Names, units and numbers of everything.
pub fn face() -> Face {
    Face {
        coordinates: vec![
            Coordinate::length("y", "vy", "height of the sleeve"),
            Coordinate::angle("phi_m", "omega_m", "angle of the sleeve"),
            Coordinate::angle("phi_s", "omega_s", "angle of the bird"),
        ],
        contacts: ["beak", "lower", "upper"].map(FaceContact::at_point).into(),
        inputs: vec![
            input(
                "force",
                "N",
                "force on the middle of the sleeve, upwards positive",
            ),
            input("sleeve_moment", "N m", "moment on the sleeve"),
            input("bird_moment", "N m", "moment on the bird"),
        ],
        markers: DRAWN
            .iter()
            .map(|(name, _)| FaceMarker::drawn(name))
            .collect(),
        ..Face::default()
    }
}

/// What places are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Picture {
    /// The toy.
    pub toy: Toy,
    /// Upper and lower end of the pole (m).
    pub pole: [f64; 2],
}

impl Picture {
    /// Place and angle.
    fn place(&self, drawn: Drawn, [y, sleeve, bird]: [f64; 3]) -> [f64; 3] {
        let turned = |[x, y]: [f64; 2], [a, b]: [f64; 2], angle: f64| {
            [x + a - b * angle, y + b + a * angle, angle]
        };
        let [to_spring, to_bird] = self.toy.arms;
        let [spring_x, spring_y, _] = turned([0.0, y], [to_spring, 0.0], sleeve);
        match drawn {
            Drawn::Sleeve(a, b) => {
                let [radius, half_height] = self.toy.sleeve;
                turned([0.0, y], [a * radius, b * half_height], sleeve)
            }
            Drawn::Spring => [spring_x, spring_y, sleeve],
            Drawn::Bird(a, b) => {
                let [reach, height] = self.toy.beak;
                let point = [to_bird + a * reach, b * height];
                turned([spring_x, spring_y], point, bird)
            }
            Drawn::Pole(side, end) => [side * self.toy.pole_radius, self.pole[end], 0.0],
        }
    }
}

impl Observer for Picture {
    fn marker(&self, marker: usize, motion: Motion<'_>) -> PointMotion {
        let (Some(&(_, drawn)), &[y, sleeve, bird]) = (DRAWN.get(marker), motion.q) else {
            return [[f64::NAN; 3]; 3];
        };
        [self.place(drawn, [y, sleeve, bird]), [0.0; 3], [0.0; 3]]
    }
}
