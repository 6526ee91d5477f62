//! What a flexible rod costs, over its elements, and what holds in hard cases.

use std::fmt::Write;
use std::time::Instant;

use linchpin_models::nonsmooth::matrix::BorderedBand;
use linchpin_models::nonsmooth::mechanics::StepError;
use linchpin_models::nonsmooth::mixed::Integrator;
use linchpin_models::nonsmooth::schemes::SchemeKind;
use linchpin_models::nonsmooth::state::Drive;
use linchpin_models::nonsmooth::system::{Instant as Instance, MechanicalSystem};
use linchpin_models::nonsmooth::systems::flexible_slider_crank::{
    FlexibleMechanism, FlexibleSliderCrank,
};
use linchpin_models::nonsmooth::systems::notch::CornerLaw;
use linchpin_models::nonsmooth::systems::rigid_slider_crank::{Guide, Mechanism};
use linchpin_worker::Inputs;
use nalgebra::DMatrix;

use super::runs::{SCHEMES, SETTINGS};

const DENSITY: f64 = 7800.0;
const STEEL: f64 = 2e11;

/// Both tables.
pub fn tables() -> String {
    costs() + &hard_cases()
}

/// The mechanism of Table 2.
fn system(elements: usize, modes: Option<usize>, youngs_modulus: f64) -> FlexibleSliderCrank {
    let rigid = Mechanism::table_2();
    let mut mechanism = FlexibleMechanism::of(&rigid, elements, [youngs_modulus, DENSITY]).unwrap();
    mechanism.rod.modes = modes;
    let law = CornerLaw {
        normal_restitution: 0.1,
        tangential_restitution: 0.0,
        friction: 0.1,
    };
    FlexibleSliderCrank::new(mechanism, Guide::Clearance(law)).unwrap()
}

/// A finished run.
struct Run {
    /// Angle of the crank after every millisecond.
    angles: Vec<f64>,
    seconds_per_step: f64,
    iterations: f64,
}

/// Runs from rest; stops at the first step that fails.
fn run(
    system: FlexibleSliderCrank,
    scheme: SchemeKind,
    dt: f64,
    steps: usize,
) -> Result<Run, StepError> {
    let rest = vec![0.0; system.shape().order()];
    let inputs = Inputs::constant(&[]);
    let drive = Drive {
        start: 0.0,
        inputs: &inputs,
    };
    let start: [&[f64]; 2] = [&rest, &rest];
    let mut integrator = Integrator::new(Box::new(system), 0, scheme, SETTINGS, start).unwrap();
    integrator.start(drive)?;
    let stride = (1e-3 / dt).round() as usize;
    let mut angles = Vec::new();
    let began = Instant::now();
    for step in 1..=steps {
        integrator.step(drive, dt)?;
        if step % stride.max(1) == 0 {
            angles.push(integrator.state.q[0]);
        }
    }
    Ok(Run {
        angles,
        seconds_per_step: began.elapsed().as_secs_f64() / steps as f64,
        iterations: integrator.mechanics.counters.iterations as f64 / steps as f64,
    })
}

fn costs() -> String {
    let sizes = [4, 10, 20, 40, 80];
    let mut text = String::from(
        "## Cost of a step over the elements of the rod\n\n\
         Table 2 of S2, microseconds a step; dt = 1e-5 s, for Moreau and HETS 1e-9 s, which they need with 80 elements. The\n\
         last column has six modes of 20 elements.\n\n\
         | scheme | 4 | 10 | 20 | 40 | 80 | 80 over 40 | six modes |\n|---|---|---|---|---|---|---|---|\n",
    );
    for (name, scheme) in SCHEMES {
        let is_explicit = matches!(scheme, SchemeKind::Moreau | SchemeKind::Hets);
        let dt = if is_explicit { 1e-9 } else { 1e-5 };
        let least = |elements, modes| {
            let runs = (0..5).map(|_| {
                let run = run(system(elements, modes, STEEL), scheme, dt, 500).unwrap();
                run.seconds_per_step * 1e6
            });
            runs.fold(f64::INFINITY, f64::min)
        };
        let times = sizes.map(|elements| least(elements, None));
        let _ = write!(text, "| {name} |");
        for time in times {
            let _ = write!(text, " {time:.1} |");
        }
        let _ = writeln!(
            text,
            " {:.2} | {:.1} |",
            times[4] / times[3],
            least(20, Some(6))
        );
    }
    text.push('\n');
    text
}

/// Schemes of the hard cases.
const HARD: [(&str, SchemeKind); 8] = [
    (
        "generalised-alpha (1)",
        SchemeKind::GeneralizedAlpha { rho_inf: 1.0 },
    ),
    (
        "generalised-alpha (0.8)",
        SchemeKind::GeneralizedAlpha { rho_inf: 0.8 },
    ),
    (
        "generalised-alpha (0.5)",
        SchemeKind::GeneralizedAlpha { rho_inf: 0.5 },
    ),
    (
        "generalised-alpha (0)",
        SchemeKind::GeneralizedAlpha { rho_inf: 0.0 },
    ),
    ("Bathe", SchemeKind::Bathe),
    (
        "ED-alpha (0)",
        SchemeKind::EdAlpha {
            rho_inf: 0.0,
            alpha_ar: 1.0 / 6.0,
        },
    ),
    ("HETS", SchemeKind::Hets),
    ("Moreau", SchemeKind::Moreau),
];

fn hard_cases() -> String {
    let mut text = String::from(
        "## Hard cases: stiffness and step\n\n\
         Table 2 with 4 elements to t = 0.05 s: error of the crank's angle (rad), largest at 50 instants, against ED-alpha (0)\n\
         with dt = 1e-6 s, and iterations a step. The limit of the explicit schemes is 2 over the\n\
         highest frequency of the mechanism; there 20,000 steps are taken, whose error says nothing.\n\n",
    );
    for youngs_modulus in [1e9, STEEL, 1e13, 1e15] {
        let limit = 2.0 / highest_frequency(&system(4, None, youngs_modulus));
        let finest = run(system(4, None, youngs_modulus), HARD[5].1, 1e-6, 50_000).unwrap();
        let _ = writeln!(
            text,
            "E = {youngs_modulus:e} N/m^2, explicit limit dt = {limit:.2e} s\n\n\
             | scheme | dt = 1e-4 s | 1e-5 s | 0.95 of the limit | 1.05 of the limit |\n|---|---|---|---|---|"
        );
        for (name, scheme) in HARD {
            let _ = write!(text, "| {name} |");
            for dt in [1e-4_f64, 1e-5] {
                let steps = (0.05 / dt).round() as usize;
                let cell = cell(youngs_modulus, scheme, dt, steps, Some(&finest));
                let _ = write!(text, " {cell} |");
            }
            for share in [0.95, 1.05] {
                let cell = cell(youngs_modulus, scheme, share * limit, 20_000, None);
                let _ = write!(text, " {cell} |");
            }
            text.push('\n');
        }
        text.push('\n');
    }
    text
}

/// Highest angular frequency of the mechanism at its start, from `K x = omega^2 M x`.
fn highest_frequency(system: &FlexibleSliderCrank) -> f64 {
    let shape = system.shape();
    let n = shape.order();
    let zeros = || BorderedBand::zeros(shape);
    let (mut mass, mut stiffness, mut damping) = (zeros(), zeros(), zeros());
    let rest = vec![0.0; n];
    let at = Instance {
        t: 0.0,
        q: &rest,
        v: &rest,
        inputs: &[],
    };
    system.mass(&rest, &mut mass);
    system.tangents(at, &mut stiffness, &mut damping);
    let dense = |matrix: &BorderedBand| DMatrix::from_fn(n, n, |i, j| matrix.get(i, j));
    let root = dense(&mass).cholesky().unwrap();
    let half = root.l().solve_lower_triangular(&dense(&stiffness)).unwrap();
    let scaled = root.l().solve_lower_triangular(&half.transpose()).unwrap();
    scaled.symmetric_eigenvalues().max().sqrt()
}

fn cell(
    youngs_modulus: f64,
    scheme: SchemeKind,
    dt: f64,
    steps: usize,
    finest: Option<&Run>,
) -> String {
    match run(system(4, None, youngs_modulus), scheme, dt, steps) {
        Err(StepError::NotConverged { .. }) => "told not to converge".to_owned(),
        Err(StepError::NotFinite | StepError::Unstable { .. }) => "told to be unstable".to_owned(),
        Err(error) => error.to_string(),
        Ok(run) => match finest {
            None => "stable".to_owned(),
            Some(finest) => {
                let differences = run.angles.iter().zip(&finest.angles);
                let error = differences
                    .map(|(own, exact)| (own - exact).abs())
                    .fold(0.0, f64::max);
                format!("{error:.1e}, {:.1} iterations", run.iterations)
            }
        },
    }
}
