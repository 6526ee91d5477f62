//! Motion of the slider and the rod: what contacts see, what is drawn and reported.

use super::{ANGLES, FlexibleSliderCrank, Moved, Pose};
use crate::nonsmooth::systems::rod::coordinates::PER_NODE;

impl FlexibleSliderCrank {
    /// Centre of the slider, S2 (170) (m).
    pub fn slider(&self, q: &[f64]) -> [f64; 2] {
        let [x, y] = self.body.end(&q[ANGLES..]);
        self.place(q, [self.mechanism.rod.length + x, y])
    }

    /// Velocity of the slider's centre (m/s).
    pub fn slider_velocity(&self, q: &[f64], v: &[f64]) -> [f64; 2] {
        let moved = self.slider_by_coordinates(q);
        let [along, across] = self.body.end(&v[ANGLES..]);
        let [sin, cos] = moved.frame;
        [0, 1].map(|axis| {
            let frame = [cos * along - sin * across, sin * along + cos * across];
            moved.crank[axis] * v[0] + moved.rod[axis] * v[1] + frame[axis]
        })
    }

    /// Acceleration of the slider's centre (m/s^2).
    pub fn slider_acceleration(&self, q: &[f64], v: &[f64], a: &[f64]) -> [f64; 2] {
        let linear = self.slider_velocity(q, a);
        let of_velocities = self.slider_acceleration_of_velocities(q, v);
        [0, 1].map(|axis| linear[axis] + of_velocities[axis])
    }

    /// Displacement of the rod's end in its frame, along and across (m).
    pub fn end_displacement(&self, q: &[f64]) -> [f64; 2] {
        self.body.end(&q[ANGLES..])
    }

    /// Bending moment at the root of the rod, `E I w''` there (N m): the torque at the beam root of S2 Fig. 26.
    ///
    /// The crank's end is a hinge, so that the moment there goes to 0 with finer elements. Only with the tangential
    /// frame and [`RotaryInertia::Frame`], as in S2, it goes to the moment `rho I l theta_2''` that turns all sections.
    ///
    /// [`RotaryInertia::Frame`]: crate::nonsmooth::systems::rod::RotaryInertia::Frame
    pub fn root_moment(&self, q: &[f64]) -> f64 {
        self.body.root_moment(&q[ANGLES..])
    }

    /// Numbers that [`FlexibleSliderCrank::write_nodal`] writes: three a node.
    pub fn nodal_count(&self) -> usize {
        self.body.nodal_count()
    }

    /// Writes the displacements of the nodes in the rod's frame, from the root on: along (m), across (m), slope (rad).
    pub fn write_nodal(&self, q: &[f64], nodal: &mut [f64]) {
        self.body.write_nodal(&q[ANGLES..], nodal);
    }

    /// Places of the nodes, from the root on (m).
    pub fn nodes(&self, q: &[f64]) -> Vec<[f64; 2]> {
        let mut nodal = vec![0.0; self.nodal_count()];
        self.write_nodal(q, &mut nodal);
        let rod = &self.mechanism.rod;
        let spacing = rod.length / rod.elements as f64;
        let nodes = nodal.chunks_exact(PER_NODE).enumerate();
        nodes
            .map(|(node, moved)| self.place(q, [node as f64 * spacing + moved[0], moved[1]]))
            .collect()
    }

    /// Place of a node, with its distance from the line between both ends drawn `magnification` times as large (m): the
    /// ends stay where they are.
    pub fn node(&self, q: &[f64], node: usize, magnification: f64) -> [f64; 2] {
        let rod = &self.mechanism.rod;
        let elastic = &q[ANGLES..];
        let [along, across] = self.body.node(elastic, node);
        let share = node as f64 / rod.elements as f64;
        let on_line = share * self.body.end(elastic)[1];
        let place = [
            share * rod.length + along,
            on_line + magnification * (across - on_line),
        ];
        self.place(q, place)
    }

    /// Where a point of the rod's frame is.
    fn place(&self, q: &[f64], [x, y]: [f64; 2]) -> [f64; 2] {
        let l1 = self.mechanism.crank_length;
        let pose = Pose::of(q);
        let ([s1, c1], [s2, c2]) = (pose.crank, pose.rod);
        [l1 * c1 + c2 * x - s2 * y, l1 * s1 + s2 * x + c2 * y]
    }

    /// How the slider's centre moves with the coordinates (S2 179, 180).
    pub(super) fn slider_by_coordinates(&self, q: &[f64]) -> Moved<'_> {
        let l1 = self.mechanism.crank_length;
        let pose = Pose::of(q);
        let ([s1, c1], [s2, c2]) = (pose.crank, pose.rod);
        let [x, y] = self.body.end(&q[ANGLES..]);
        let x = self.mechanism.rod.length + x;
        Moved {
            crank: [-l1 * s1, l1 * c1],
            rod: [-s2 * x - c2 * y, c2 * x - s2 * y],
            frame: pose.rod,
            end: &self.body.end,
        }
    }

    /// Acceleration of the slider's centre when the coordinates have none: centripetal and Coriolis terms.
    pub(super) fn slider_acceleration_of_velocities(&self, q: &[f64], v: &[f64]) -> [f64; 2] {
        let l1 = self.mechanism.crank_length;
        let pose = Pose::of(q);
        let ([s1, c1], [s2, c2]) = (pose.crank, pose.rod);
        let [x, y] = self.body.end(&q[ANGLES..]);
        let [x_rate, y_rate] = self.body.end(&v[ANGLES..]);
        let x = self.mechanism.rod.length + x;
        let (w1, w2) = (v[0], v[1]);
        let along = -w2 * w2 * x - 2.0 * w2 * y_rate;
        let across = -w2 * w2 * y + 2.0 * w2 * x_rate;
        [
            -l1 * c1 * w1 * w1 + c2 * along - s2 * across,
            -l1 * s1 * w1 * w1 + s2 * along + c2 * across,
        ]
    }
}
