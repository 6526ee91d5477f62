//! The crank's equation, and Newton's and Euler's laws of the bars.

use nalgebra::Vector2;

use super::FourBar;
use super::closure::{Arm, Closure};

/// What a bar needs besides its weight.
struct Lack {
    force: Vector2<f64>,
    /// About its first hinge.
    moment: f64,
}

impl FourBar {
    /// Centres of mass in the frame, each from the crank's or the rocker's hinge there.
    pub(super) fn centres(&self, at: &Closure) -> [Arm; 3] {
        let [crank, coupler, rocker] = [0, 1, 2].map(|bar| at.arm(bar, self.bars[bar].centre));
        let tip = at.arm(0, [self.bars[0].length, 0.0]);
        [crank, tip + coupler, rocker]
    }

    /// Acceleration of free fall relative to the frame.
    fn weight(&self, t: f64) -> Vector2<f64> {
        Vector2::new(-self.shake.acceleration(t), -self.gravity)
    }

    pub(super) fn crank_acceleration(&self, t: f64, at: &Closure) -> f64 {
        let (mut inertia, mut moment) = (0.0, self.torque);
        for (i, (bar, centre)) in self.bars.iter().zip(self.centres(at)).enumerate() {
            inertia += bar.m * centre.partial.norm_squared() + bar.inertia * at.ratios[i].powi(2);
            moment += bar.m * (self.weight(t) - centre.bias).dot(&centre.partial)
                - bar.inertia * at.bias[i] * at.ratios[i];
        }
        moment / inertia
    }

    /// Coupler and rocker need moments about their first hinges, which the force between them brings; the other forces
    /// follow by Newton's laws.
    pub(super) fn hinge_forces(&self, t: f64, at: &Closure) -> [[f64; 2]; 4] {
        let [crank, coupler, rocker] = self.lacks(t, at);
        let [_, b, c] = [0, 1, 2].map(|bar| at.arm(bar, [self.bars[bar].length, 0.0]).arm);
        // F = p b + q c with b x F = -moment of the coupler, c x F = moment of the rocker.
        let product = b.perp(&c);
        let on_rocker = (-rocker.moment * b - coupler.moment * c) / product;
        let on_coupler = coupler.force + on_rocker;
        let on_crank = crank.force + on_coupler;
        let on_frame = on_rocker - rocker.force;
        [on_crank, on_coupler, on_rocker, on_frame].map(Into::into)
    }

    fn lacks(&self, t: f64, at: &Closure) -> [Lack; 3] {
        let alpha = self.crank_acceleration(t, at);
        let centres = self.centres(at);
        [0, 1, 2].map(|i| {
            let bar = self.bars[i];
            let acceleration = centres[i].bias + centres[i].partial * alpha;
            let force = bar.m * (acceleration - self.weight(t));
            let turning = bar.inertia * (at.bias[i] + at.ratios[i] * alpha);
            Lack {
                force,
                moment: turning + at.arm(i, bar.centre).arm.perp(&force),
            }
        })
    }
}
