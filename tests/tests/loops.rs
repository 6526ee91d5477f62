//! A closed loop of links, one worker each, that turns and falls freely: what Newton's laws conserve.

#![allow(clippy::unwrap_used, missing_docs)]

use linchpin::connect::Place;
use linchpin_tests::convergence::slope_of;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;

/// Enough for a sparse coupling system.
const LINKS: usize = 24;
const GRAVITY: f64 = 9.81;
const TURNING: f64 = 2.3;
const DRIFT: [f64; 2] = [0.4, -0.7];

struct Link {
    start: [f64; 2],
    length: f64,
    angle: f64,
    m: f64,
    inertia: f64,
}

/// Sides of a polygon without any symmetry, unequal in length and mass.
fn links() -> Vec<Link> {
    let corner = |number: usize| {
        let phi = std::f64::consts::TAU * (number % LINKS) as f64 / LINKS as f64;
        let radius = 1.5 + 0.2 * (3.0 * phi).sin() + 0.1 * (2.0 * phi).cos();
        [radius * phi.cos(), 0.7 * radius * phi.sin()]
    };
    let link = |number: usize| {
        let (start, end) = (corner(number), corner(number + 1));
        let side = [end[0] - start[0], end[1] - start[1]];
        let length = side[0].hypot(side[1]);
        let m = 0.8 + 0.3 * (2.9 * number as f64).sin();
        Link {
            start,
            length,
            angle: side[1].atan2(side[0]),
            m,
            inertia: 0.09 * m * length * length,
        }
    };
    (0..LINKS).map(link).collect()
}

/// All links turn at one rate at the start, as one body would; but they are no body, so the polygon changes its shape.
fn scene_text(links: &[Link]) -> String {
    let mut text =
        "[scene]\nname = \"loop\"\nt_end = 0.3\n[coupling]\nmethod = \"weighted\"\ndegree = 1\nmacro_step = 1e-3\n"
            .to_owned();
    let mut variables = Vec::new();
    for (number, link) in links.iter().enumerate() {
        let Link {
            start: [x, y],
            length,
            angle,
            m,
            inertia,
        } = link;
        let (vx, vy) = (DRIFT[0] - TURNING * y, DRIFT[1] + TURNING * x);
        text += &format!(
            "[[subsystem]]\nname = \"link{number}\"\nmodel = \"planar-body\"\n\
             parameters = {{ m = {m:?}, inertia = {inertia:?}, length = {length:?}, x0 = {x:?}, y0 = {y:?}, \
             angle0 = {angle:?}, vx0 = {vx:?}, vy0 = {vy:?}, rate0 = {TURNING} }}\n\
             solver = {{ kind = \"radau5\", rtol = 1e-11, atol = 1e-11 }}\n\
             [[joint]]\nname = \"hinge{number}\"\nkind = \"atpoint\"\na = \"link{number}.end\"\nb = \"link{}.start\"\n",
            (number + 1) % LINKS
        );
        let names = ["x", "y", "vx", "vy", "angle", "rate", "energy"];
        variables.extend(names.map(|name| format!("\"link{number}.{name}\"")));
    }
    text + &format!("[output]\nvariables = [{}]\n", variables.join(", "))
}

/// Sums over all links at one time.
#[derive(Default)]
struct Sums {
    mass: f64,
    moment: [f64; 2],
    momentum: [f64; 2],
    spin: f64,
    energy: f64,
}

impl Sums {
    fn of(links: &[Link], trajectory: &Trajectory, row: usize) -> Self {
        let mut sums = Self::default();
        for (number, Link { m, inertia, .. }) in links.iter().enumerate() {
            let value = |name: &str| {
                let name = format!("link{number}.{name}");
                let place = trajectory.columns.iter().position(|column| *column == name);
                trajectory.rows[row][place.unwrap()]
            };
            let [x, y, vx, vy] = ["x", "y", "vx", "vy"].map(value);
            sums.mass += m;
            sums.moment = [sums.moment[0] + m * x, sums.moment[1] + m * y];
            sums.momentum = [sums.momentum[0] + m * vx, sums.momentum[1] + m * vy];
            sums.spin += m * (x * vy - y * vx) + inertia * value("rate");
            sums.energy += value("energy");
        }
        sums
    }

    /// Angular momentum about the centre of mass.
    fn central_spin(&self) -> f64 {
        let [x, y] = self.moment;
        let [px, py] = self.momentum;
        self.spin - (x * py - y * px) / self.mass
    }
}

/// Largest errors over the run: momentum, angular momentum and energy, each relative.
fn errors(h: f64) -> [f64; 3] {
    let links = links();
    let scene = with_settings(&scene_text(&links), &format!("macro_step={h:e}"), &[]);
    let trajectory = run(&scene, Place::InProcess);
    assert_changes_shape(&trajectory);
    let start = Sums::of(&links, &trajectory, 0);
    let scale = start.mass * GRAVITY * scene.t_end;
    let mut largest = [0.0_f64; 3];
    for (row, values) in trajectory.rows.iter().enumerate() {
        let now = Sums::of(&links, &trajectory, row);
        let fallen = start.momentum[1] - start.mass * GRAVITY * values[0];
        let momentum = (now.momentum[0] - start.momentum[0]).hypot(now.momentum[1] - fallen);
        let found = [
            momentum / scale,
            now.central_spin() / start.central_spin() - 1.0,
            (now.energy - start.energy) / start.energy,
        ];
        for (largest, found) in largest.iter_mut().zip(found) {
            *largest = largest.max(found.abs());
        }
    }
    largest
}

/// A loop that turned like one body would conserve everything without any joint working.
fn assert_changes_shape(trajectory: &Trajectory) {
    let [first, opposite] =
        [0, LINKS / 2].map(|number| trajectory.column(&format!("link{number}.angle")));
    let bend = |row: usize| first[row] - opposite[row];
    let change = bend(first.len() - 1) - bend(0);
    assert!(change.abs() > 0.05, "{change}");
}

/// Opposite forces on the two links of a hinge leave the momentum as it is, whatever the macro step; they act in points as
/// far apart as the hinge is open, so the angular momentum and the energy show the order of the method.
#[test]
fn momentum_is_conserved_and_angular_momentum_and_energy_to_the_order() {
    let macro_steps = [4e-3, 2e-3, 1e-3];
    let errors = macro_steps.map(errors);
    for [momentum, ..] in errors {
        assert!(momentum < 1e-14, "{momentum:e}");
    }
    for of in 1..3 {
        let errors = errors.map(|errors| errors[of]);
        let order = slope_of(macro_steps.into_iter().zip(errors));
        assert!((order - 4.0).abs() < 0.2, "{order} {errors:?}");
        assert!(errors[2] < 1e-9, "{errors:?}");
    }
}
