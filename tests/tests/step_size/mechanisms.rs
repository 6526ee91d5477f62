//! Variable macro steps on the shipped mechanisms: the tolerance is met from their first step on, and columns that stay in use save integrations
//! where steps are many.

use linchpin::connect::Place;
use linchpin_master::scene::Scene;
use linchpin_tests::runs::{Trajectory, run};
use linchpin_tests::scenes::with_settings;

struct Mechanism {
    name: &'static str,
    text: &'static str,
    /// Columns of results that are compared, all of one size.
    motion: &'static [&'static str],
}

const MECHANISMS: [Mechanism; 5] = [
    Mechanism {
        name: "slider-crank",
        text: include_str!("../../../scenes/slider-crank.toml"),
        motion: &["link1.angle", "link2.angle"],
    },
    Mechanism {
        name: "double pendulum",
        text: include_str!("../../../scenes/double-pendulum.toml"),
        motion: &["link1.angle", "link2.angle"],
    },
    Mechanism {
        name: "pendulum on a universal joint",
        text: include_str!("../../../scenes/spatial/universal-pendulum.toml"),
        motion: &["lower.x", "lower.y", "lower.z"],
    },
    // At rest until the motor starts, so nothing is known of the sizes of its rates.
    Mechanism {
        name: "motor with a driven link",
        text: include_str!("../../../scenes/motor/driven-link.toml"),
        motion: &["link1.angle", "link2.angle"],
    },
    // Turns through 46 rad/s from the start.
    Mechanism {
        name: "top in a gimbal",
        text: include_str!("../../../scenes/spatial/gimbal.toml"),
        motion: &[
            "top.start_qw",
            "top.start_qx",
            "top.start_qy",
            "top.start_qz",
        ],
    },
];

const METHODS: [&str; 3] = [
    "method=hermite",
    "method=weighted a=2 b=2.6 degree=2",
    "method=baumgarte beta=2H gamma=H^2 degree=automatic",
];

const SETTINGS: [&str; 3] = [
    "scene.t_end=0.8",
    "output.interval=0.02",
    "subsystem.*.solver={ kind = \"radau5\", rtol = 1e-12, atol = 1e-12 }",
];

impl Mechanism {
    fn with(&self, coupling: &str) -> Scene {
        // Controllers have no solver with a tolerance.
        let has_controller = self.text.contains("pi-controller");
        let settings = if has_controller {
            &SETTINGS[..2]
        } else {
            &SETTINGS
        };
        with_settings(self.text, coupling, settings)
    }

    /// Largest distance from the reference, over the largest value.
    fn error(&self, own: &Trajectory, reference: &Trajectory) -> f64 {
        let (mut error, mut size) = (0.0_f64, 0.0_f64);
        for name in self.motion {
            let exact = reference.column(name);
            for (own, exact) in own.column(name).iter().zip(exact) {
                error = error.max((own - exact).abs());
                size = size.max(exact.abs());
            }
        }
        error / size
    }
}

#[test]
fn the_tolerance_is_met_with_fewer_integrations_than_columns_in_every_step_take() {
    for mechanism in MECHANISMS {
        let fine = "method=hermite jacobian=every-step macro_step=5e-4";
        let reference = run(&mechanism.with(fine), Place::InProcess);
        for method in METHODS {
            for tolerance in [1e-4, 1e-6] {
                let with = |jacobian: &str| {
                    let coupling = format!("{method} jacobian={jacobian} tolerance={tolerance:e}");
                    run(&mechanism.with(&coupling), Place::InProcess)
                };
                let (reuse, every) = (with("reuse"), with("every-step"));
                let errors = [&reuse, &every].map(|own| mechanism.error(own, &reference));
                let [reused, all] = [&reuse, &every].map(|own| own.integrations);
                let context = format!(
                    "{}, {method} {tolerance:e}: {errors:?}, integrations {reused} {all}",
                    mechanism.name
                );
                println!("{context}");
                assert_eq!(reuse.rows.len(), reference.rows.len(), "{context}");
                assert!(
                    errors.iter().all(|error| *error < 3.0 * tolerance),
                    "{context}"
                );
                // In few long steps columns hardly come back.
                let most = if tolerance < 1e-5 { 0.95 } else { 1.3 };
                assert!((reused as f64) < most * all as f64, "{context}");
            }
        }
    }
}
