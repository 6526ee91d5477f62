//! Two bodies that float in space, in any joint.

use std::f64::consts::TAU;

use linchpin_master::joint::composite::{Frame, in_space};
use linchpin_master::scene::Scene;
use linchpin_models::reference::{
    BodyMotion, CompositeJoint, JointedBody, RigidBody, SpatialChain, SpatialChainMotion,
    SpatialJoint,
};
use nalgebra::{UnitQuaternion, Vector3};

use super::compare::{Loaded, motions, pose_errors};
use super::{joints, text, tumbling};
use crate::convergence::orders_of;
use crate::runs::Trajectory;
use crate::scenes::with_settings;

/// A point of space about which nothing is simple (m).
const ABOUT: Vector3<f64> = Vector3::new(0.7, -1.1, 0.4);

/// Markers of the outer and the inner body (m): none is at a point of the joint or at a centre of mass.
const MARKERS: [Vector3<f64>; 2] = [
    Vector3::new(-0.07, 0.15, 0.3),
    Vector3::new(0.2, 0.05, -0.3),
];

/// Body `inner`, and body `outer` in a joint on it; no weight.
pub struct Pair {
    /// The joint.
    pub joint: CompositeJoint,
    /// The same bodies in the coordinates of the joint, the inner one on a free joint in space.
    pub chain: SpatialChain,
}

/// How far a run is from the exact motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairErrors {
    /// Largest error of a centre of mass (m).
    pub position: f64,
    /// Largest error of an attitude (rad).
    pub attitude: f64,
    /// Largest error of the joint's load (N, N m) after the first tenth of the time.
    pub load: f64,
    /// Largest change of the energy, relative: the work of the joint.
    pub energy: f64,
    /// Largest change of the momentum (kg m/s).
    pub momentum: f64,
    /// Largest change of the angular momentum (kg m^2/s).
    pub angular_momentum: f64,
    /// Largest residual of the joint on the position level (m, or 1).
    pub gap: f64,
}

/// Sums over both bodies.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    energy: f64,
    momentum: Vector3<f64>,
    angular_momentum: Vector3<f64>,
}

impl Pair {
    /// Bodies with three different moments of inertia each, an offset joint turned against both, and every rate and
    /// coordinate of the joint off zero.
    pub fn floating(joint: CompositeJoint) -> Self {
        Self::turning(joint, 1.0)
    }

    /// The same with all rates times `factor`.
    pub fn turning(joint: CompositeJoint, factor: f64) -> Self {
        let free = SpatialJoint {
            inner_point: Vector3::zeros(),
            outer_point: Vector3::zeros(),
            freedoms: CompositeJoint::Free.freedoms(),
            attitude: UnitQuaternion::identity(),
        };
        let between = SpatialJoint {
            inner_point: Vector3::new(0.08, -0.03, -0.45),
            outer_point: Vector3::new(0.11, 0.06, 0.4),
            freedoms: joint.freedoms(),
            attitude: UnitQuaternion::from_scaled_axis(Vector3::new(-0.4, 0.7, 0.5)),
        };
        let count = between.freedoms.len();
        let coordinates = [0.3, -0.2, 0.25, -0.1, 0.15];
        let rates = [0.9, -1.4, 0.7, 1.1, -0.6];
        let rates = [&[0.5, 0.9, -0.4, 1.8, -2.5, 3.3], &rates[..count]].concat();
        let body = |m, [j1, j2, j3]: [f64; 3], joint| JointedBody {
            body: RigidBody {
                m,
                moments: Vector3::new(j1, j2, j3),
            },
            joint,
        };
        let chain = SpatialChain {
            bodies: vec![
                body(1.3, [0.17, 0.29, 0.23], free),
                body(0.8, [0.11, 0.05, 0.09], between),
            ],
            gravity: Vector3::zeros(),
            coordinates: [&[0.3, -0.7, 0.2, 0.4, -0.3, 0.8], &coordinates[..count]].concat(),
            rates: rates.iter().map(|rate| factor * rate).collect(),
        };
        Self { joint, chain }
    }

    /// The scene, with settings of the coupling such as `"degree=1 macro_step=1e-3"`.
    pub fn scene(&self, coupling: &str, t_end: f64) -> Scene {
        with_settings(&self.scene_text(t_end), coupling, &[])
    }

    /// Text of the scene.
    pub fn scene_text(&self, t_end: f64) -> String {
        let [inner, outer] = &self.chain.bodies[..] else {
            panic!("a pair has two bodies")
        };
        let start = &self.chain.motions(&[0.0]).unwrap()[0].bodies;
        let frame = self.frame();
        let far = Vector3::new(0.1, 0.2, -0.3);
        let [at_a, at_b] = MARKERS;
        [
            text::head(joints::name(&self.joint), t_end),
            text::body("inner", &inner.body, &start[0], [far, at_b], 0.0),
            text::body("outer", &outer.body, &start[1], [at_a, far], 0.0),
            text::joint("joint", &self.joint, ["outer.start", "inner.end"], &frame),
            text::output(&["inner", "outer"]),
        ]
        .concat()
    }

    /// Where the joint holds, seen from its markers.
    pub fn frame(&self) -> Frame {
        joints::frame(&self.joint, &self.chain.bodies[1].joint, MARKERS)
    }

    /// How many turns each body makes in the time `t` (s): its angular velocity over the time.
    pub fn turns(&self, t: f64) -> [f64; 2] {
        let step = 1e-2;
        let times: Vec<f64> = (0..)
            .map(|n| step * f64::from(n))
            .take_while(|time| *time < t)
            .collect();
        let motions = tumbling::motions(&self.chain, &times);
        let angle = |body: usize| {
            motions
                .iter()
                .map(move |now| step * now.bodies[body].omega.norm())
        };
        [0, 1].map(|body| angle(body).sum::<f64>() / TAU)
    }

    /// How far a run of the scene is from the exact motion.
    pub fn errors(&self, trajectory: &Trajectory) -> PairErrors {
        let exact = tumbling::motions(&self.chain, &trajectory.column("t"));
        let found = ["inner", "outer"].map(|body| motions(trajectory, body));
        let poses = [0, 1].map(|body| {
            let exact = exact.iter().map(|motion| &motion.bodies[body]);
            pose_errors(&found[body], exact)
        });
        let sums: Vec<_> = (0..exact.len())
            .map(|row| self.sums([&found[0][row], &found[1][row]]))
            .collect();
        let largest = |change: &dyn Fn(&Sums) -> f64| sums.iter().map(change).fold(0.0, f64::max);
        let first = &sums[0];
        PairErrors {
            position: poses[0][0].max(poses[1][0]),
            attitude: poses[0][1].max(poses[1][1]),
            load: self.load_error(trajectory, &exact),
            energy: largest(&|now| (now.energy - first.energy).abs() / first.energy),
            momentum: largest(&|now| (now.momentum - first.momentum).norm()),
            angular_momentum: largest(&|now| {
                (now.angular_momentum - first.angular_momentum).norm()
            }),
            gap: largest_of(trajectory, "joint.residual.position"),
        }
    }

    /// Kinetic energy at every recorded macro point (J).
    pub fn energies(&self, trajectory: &Trajectory) -> Vec<f64> {
        let [inner, outer] = ["inner", "outer"].map(|body| motions(trajectory, body));
        let pairs = inner.iter().zip(&outer);
        pairs
            .map(|(inner, outer)| self.sums([inner, outer]).energy)
            .collect()
    }

    fn sums(&self, motions: [&BodyMotion; 2]) -> Sums {
        let mut sums = Sums::default();
        for (jointed, motion) in self.chain.bodies.iter().zip(motions) {
            sums.energy += jointed.body.kinetic_energy(motion);
            sums.momentum += jointed.body.momentum(motion);
            sums.angular_momentum += jointed.body.angular_momentum(motion, &ABOUT);
        }
        sums
    }

    fn load_error(&self, trajectory: &Trajectory, exact: &[SpatialChainMotion]) -> f64 {
        let joint = in_space(joints::kind(&self.joint), &self.frame()).unwrap();
        let loaded = Loaded {
            name: "joint",
            joint: &joint,
            markers: [(1, MARKERS[0]), (0, MARKERS[1])],
        };
        loaded.load_error(trajectory, exact)
    }
}

impl PairErrors {
    /// Position, attitude, load, energy, in this order.
    pub fn measured(&self) -> [f64; 4] {
        [self.position, self.attitude, self.load, self.energy]
    }

    /// Observed orders of [`PairErrors::measured`] over the macro steps `h`.
    pub fn orders(h: &[f64], errors: &[Self]) -> [f64; 4] {
        let measured: Vec<_> = errors.iter().map(Self::measured).collect();
        orders_of(h, &measured)
    }
}

fn largest_of(trajectory: &Trajectory, start: &str) -> f64 {
    let names = trajectory.columns.iter();
    let names = names.filter(|name| name.starts_with(start));
    let values = names.flat_map(|name| trajectory.column(name));
    values.map(f64::abs).fold(0.0, f64::max)
}
