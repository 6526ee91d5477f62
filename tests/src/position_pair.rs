//! Two masses that swing on springs of their own and on one between them, and know each other's position only: connected signals without
//! joints.

use std::f64::consts::TAU;

use linchpin::connect::Place;

use crate::runs::{Trajectory, run};
use crate::scenes::with_settings;

const PAIR: &str = r#"
[scene]
name = "pair"
t_end = 1.0
[coupling]
method = "hermite"
macro_step = 1e-2
[[subsystem]]
name = "mass1"
model = "oscillator"
parameters = { m = 1.0, c = 39.47841760435743, x0 = 1.0, partner_stiffness = 157.91367041742973 }
[[subsystem]]
name = "mass2"
model = "oscillator"
parameters = { m = 1.0, c = 39.47841760435743, x0 = 0.0, partner_stiffness = 157.91367041742973 }
[[connection]]
name = "there"
from = "mass1.x"
to = "mass2.partner_x"
[[connection]]
name = "back"
from = "mass2.x"
to = "mass1.partner_x"
"#;

/// Settings of the coupling such as `"degree=3"`: the largest error of the position of the first mass, and the run. Both masses swing with
/// 2 pi rad/s, against each other with 6 pi.
pub fn position_pair(coupling: &str) -> (f64, Trajectory) {
    let trajectory = run(&with_settings(PAIR, coupling, &[]), Place::InProcess);
    let position = |t: f64| 0.5 * (TAU * t).cos() + 0.5 * (3.0 * TAU * t).cos();
    let times = trajectory.column("t");
    let points = times.into_iter().zip(trajectory.column("mass1.x"));
    let errors = points.map(|(t, x)| (x - position(t)).abs());
    (errors.fold(0.0, f64::max), trajectory)
}
