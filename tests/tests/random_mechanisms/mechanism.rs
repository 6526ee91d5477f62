//! Random planar mechanisms: links between vertices, as a scene of one worker a link and as one system of bodies.

use std::f64::consts::PI;
use std::fmt::Write;

use proptest::prelude::*;

/// Steps of the reference: the polynomials of degree 5 between them miss nothing that could be seen.
const SAMPLES: f64 = 3000.0;

/// Acceleration of gravity, m/s^2.
const GRAVITY: f64 = 9.81;

/// A rigid link from one vertex to another.
#[derive(Debug, Clone, Copy)]
pub struct Link {
    /// The link whose end it hangs on; none: the origin, which is ground.
    parent: Option<usize>,
    m: f64,
    inertia: f64,
    length: f64,
    angle: f64,
    rate: f64,
}

/// Links that hang on each other by hinges, all in the end on the origin; a ring comes back to it.
#[derive(Debug, Clone)]
pub struct Mechanism {
    pub links: Vec<Link>,
    pub is_ring: bool,
}

/// Trees of two to five links, and rings of four, of masses over four decades.
pub fn mechanism() -> impl Strategy<Value = Mechanism> {
    prop_oneof![3 => tree(), 1 => ring()]
}

/// Mass, and inertia as a share of that of a rod.
fn weight() -> impl Strategy<Value = (f64, f64)> {
    (
        (-2.0..2.0f64).prop_map(|power| 10f64.powf(power)),
        0.5..1.5f64,
    )
}

fn tree() -> impl Strategy<Value = Mechanism> {
    let link = (
        weight(),
        0.3..1.5f64,
        -PI..PI,
        -2.0..2.0f64,
        any::<prop::sample::Index>(),
    );
    prop::collection::vec(link, 2..=5).prop_map(|drawn| {
        let links = drawn.iter().enumerate().map(|(number, own)| {
            let ((m, share), length, angle, rate, parent) = *own;
            Link {
                parent: (number > 0).then(|| parent.index(number)),
                m,
                inertia: share * m * length * length / 12.0,
                length,
                angle,
                rate,
            }
        });
        Mechanism {
            links: links.collect(),
            is_ring: false,
        }
    })
}

/// A ring at rest, whose corners are three points apart from each other and from the origin.
fn ring() -> impl Strategy<Value = Mechanism> {
    let corner = |x: f64, y: f64| (x - 0.3..x + 0.3, y - 0.3..y + 0.3);
    let corners = (corner(0.9, -0.4), corner(0.4, -1.4), corner(-0.7, -0.8));
    (corners, [weight(), weight(), weight(), weight()]).prop_map(|((a, b, c), weights)| {
        let mut links = Vec::new();
        for (number, (m, share)) in weights.into_iter().enumerate() {
            links.push(Link {
                parent: number.checked_sub(1),
                m,
                inertia: share,
                length: 0.0,
                angle: 0.0,
                rate: 0.0,
            });
        }
        lay(&mut links, &[a, b, c]);
        for link in &mut links {
            link.inertia *= link.m * link.length * link.length / 12.0;
        }
        Mechanism {
            links,
            is_ring: true,
        }
    })
}

/// Gives the links of a ring the lengths and angles that lead from the origin over these corners back to it.
fn lay(links: &mut [Link], corners: &[(f64, f64)]) {
    let mut start = (0.0, 0.0);
    let ends = corners.iter().chain([&(0.0, 0.0)]);
    for (link, &end) in links.iter_mut().zip(ends) {
        let (x, y) = (end.0 - start.0, end.1 - start.1);
        (link.length, link.angle) = (x.hypot(y), y.atan2(x));
        start = end;
    }
}

impl Mechanism {
    /// A time in which it moves by much and does not yet forget its start: a third of the swing of the whole as a pendulum, and a turn
    /// of less than a radian at the rates of the start.
    pub fn time(&self) -> f64 {
        let length: f64 = self.links.iter().map(|link| link.length).sum();
        let swing = (length / GRAVITY).sqrt();
        let fastest = self
            .links
            .iter()
            .fold(0.0, |fastest: f64, link| fastest.max(link.rate.abs()));
        swing.min(1.0 / fastest.max(1e-9))
    }

    /// The same with other angles at the start, one more and one less by `by` (rad, and m of the corners of a ring).
    pub fn disturbed(&self, by: f64) -> Self {
        let sign = |number: usize| if number.is_multiple_of(2) { by } else { -by };
        let mut disturbed = self.clone();
        if self.is_ring {
            let corners = self.ends().into_iter().enumerate();
            let corners = corners.map(|(number, [_, [x, y, ..]])| (x + sign(number), y));
            lay(
                &mut disturbed.links,
                &corners.take(self.links.len() - 1).collect::<Vec<_>>(),
            );
        } else {
            for (number, link) in disturbed.links.iter_mut().enumerate() {
                link.angle += sign(number);
            }
        }
        disturbed
    }

    /// Position and velocity of the start and the end of every link at the start.
    fn ends(&self) -> Vec<[[f64; 4]; 2]> {
        let mut ends: Vec<[[f64; 4]; 2]> = Vec::new();
        for link in &self.links {
            let start = link.parent.map_or([0.0; 4], |parent| ends[parent][1]);
            ends.push([start, at(&start, link, link.length)]);
        }
        ends
    }

    /// A scene with a worker for each link.
    pub fn scene(&self) -> String {
        let mut text = format!(
            "[scene]\nname = \"random\"\nt_end = {:?}\n[coupling]\nmacro_step = {:?}\n",
            self.time(),
            self.time() / 20.0
        );
        for (number, (link, [start, _])) in self.links.iter().zip(self.ends()).enumerate() {
            let Link {
                m,
                inertia,
                length,
                angle,
                rate,
                ..
            } = link;
            let [x, y, vx, vy] = start;
            // Writing to a string does not fail.
            let _ = write!(
                text,
                "[[subsystem]]\nname = \"link{number}\"\nmodel = \"planar-body\"\n\
                 solver = {{ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }}\n\
                 parameters = {{ m = {m:?}, inertia = {inertia:?}, length = {length:?}, x0 = {x:?}, y0 = {y:?}, \
                 angle0 = {angle:?}, vx0 = {vx:?}, vy0 = {vy:?}, rate0 = {rate:?} }}\n\
                 [[joint]]\nname = \"hinge{number}\"\nkind = \"atpoint\"\na = \"{}\"\nb = \"link{number}.start\"\n",
                link.parent
                    .map_or("ground".to_owned(), |parent| format!("link{parent}.end")),
            );
        }
        if self.is_ring {
            let last = self.links.len() - 1;
            let _ = write!(
                text,
                "[[joint]]\nname = \"last\"\nkind = \"atpoint\"\na = \"ground\"\nb = \"link{last}.end\"\n"
            );
        }
        text + &self.output("link", ".")
    }

    /// The same as one system in one solver.
    pub fn monolith(&self) -> String {
        let mut text = format!(
            "[scene]\nname = \"monolith\"\nt_end = {:?}\n[coupling]\nmacro_step = {:?}\n[[subsystem]]\nname = \"all\"\n\
             model = \"planar-multibody\"\nsolver = {{ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }}\n\
             [subsystem.parameters]\nformulation = \"{}\"\n",
            self.time(),
            self.time() / SAMPLES,
            if self.is_ring { "absolute" } else { "minimal" },
        );
        for (number, (link, [start, _])) in self.links.iter().zip(self.ends()).enumerate() {
            let [x, y, vx, vy] = at(&start, link, link.length / 2.0);
            let Link {
                m,
                inertia,
                length,
                angle,
                rate,
                ..
            } = link;
            let [px, py, ..] = start;
            let parent = link
                .parent
                .map_or("ground".to_owned(), |parent| format!("link{parent}"));
            let _ = write!(
                text,
                "[subsystem.parameters.body.link{number}]\nm = {m:?}\ninertia = {inertia:?}\nposition = [{x:?}, {y:?}]\n\
                 velocity = [{vx:?}, {vy:?}]\nangle = {angle:?}\nrate = {rate:?}\n\
                 [subsystem.parameters.joint.hinge{number}]\nkind = \"revolute\"\na = \"{parent}\"\nb = \"link{number}\"\n\
                 point = [{px:?}, {py:?}]\n\
                 [subsystem.parameters.marker.link{number}-end]\nbody = \"link{number}\"\npoint = [{:?}, 0.0]\n",
                length / 2.0,
            );
        }
        if self.is_ring {
            let last = self.links.len() - 1;
            let _ = write!(
                text,
                "[subsystem.parameters.joint.last]\nkind = \"revolute\"\na = \"ground\"\nb = \"link{last}\"\npoint = [0.0, 0.0]\n"
            );
        }
        text + &self.output("all.link", "-")
    }

    fn output(&self, before: &str, between: &str) -> String {
        let columns = self.columns(before, between);
        let names: Vec<&String> = columns.iter().flatten().collect();
        format!("[output]\nvariables = {names:?}\n")
    }

    /// Names of position, velocity and acceleration of all ends, coordinate by coordinate.
    pub fn columns(&self, before: &str, between: &str) -> Vec<[String; 3]> {
        let numbers = 0..self.links.len();
        let names = numbers.flat_map(|number| {
            ["x", "y"].map(|axis| {
                ["", "v", "a"].map(|rate| format!("{before}{number}{between}end_{rate}{axis}"))
            })
        });
        names.collect()
    }
}

/// Position and velocity at a distance from the start of a link, which has those of `start`.
fn at(&[x, y, vx, vy]: &[f64; 4], link: &Link, distance: f64) -> [f64; 4] {
    let (sin, cos) = link.angle.sin_cos();
    let (along, across) = (distance * cos, distance * sin);
    [
        x + along,
        y + across,
        vx - link.rate * across,
        vy + link.rate * along,
    ]
}
