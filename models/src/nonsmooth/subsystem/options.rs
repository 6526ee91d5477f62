//! Base integration schemes as solvers of a scene, with their options.

use linchpin_proto::v1;
use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;

use crate::mechanics::describe::optional;
use crate::mechanics::solvers::kind;
use crate::nonsmooth::contact::Jacobian;
use crate::nonsmooth::mechanics::{Level, Settings};
use crate::nonsmooth::schemes::SchemeKind;

const GENERALIZED_ALPHA: &str = "generalized-alpha";
const NEWMARK_ALPHA: &str = "newmark-alpha";
const BATHE: &str = "bathe";
const ED_ALPHA: &str = "ed-alpha";
const MOREAU: &str = "moreau";
const HETS: &str = "hets";

/// The step that is as good as none: every macro step is one internal step.
const NO_LIMIT: f64 = 1e9;

/// What a scene's solver says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choice {
    /// The scheme.
    pub scheme: SchemeKind,
    /// How steps are taken.
    pub settings: Settings,
    /// Longest internal step (s).
    pub step: f64,
}

/// What a master is told; the first one is the default.
pub fn descriptions() -> Vec<v1::SolverKind> {
    let rho_inf = |default| {
        optional(
            "rho_inf",
            "1",
            "spectral radius for infinite frequency, 0 (strongest damping) to 1 (none)",
            default,
        )
    };
    let described = |name: &str, what: &str, own: Vec<v1::Parameter>| {
        kind(name, what, own.into_iter().chain(common()).collect())
    };
    vec![
        described(
            GENERALIZED_ALPHA,
            "generalised-alpha method on velocity level, order 2, damping of high frequencies by rho_inf",
            vec![rho_inf(0.8)],
        ),
        described(
            NEWMARK_ALPHA,
            "generalised-alpha method with free parameters: both 0 is Newmark's trapezoidal rule, alpha_m = 0 is HHT",
            vec![
                optional(
                    "alpha_m",
                    "1",
                    "share of the old acceleration, at most alpha_f",
                    0.0,
                ),
                optional(
                    "alpha_f",
                    "1",
                    "share of the old equation of motion, at most 0.5",
                    0.0,
                ),
            ],
        ),
        described(
            BATHE,
            "Bathe's method on velocity level, order 2, no parameters, high frequencies vanish",
            vec![],
        ),
        described(
            ED_ALPHA,
            "energy decaying ED-alpha method on velocity level, order 2, the smallest period error",
            vec![
                rho_inf(0.0),
                optional(
                    "alpha_ar",
                    "1",
                    "place of the cut-off, greater than 0",
                    1.0 / 6.0,
                ),
            ],
        ),
        v1::SolverKind {
            without_impacts: true,
            ..described(
                MOREAU,
                "Moreau's midpoint rule, order 1, explicit: omega step < 2",
                vec![],
            )
        },
        described(
            HETS,
            "half-explicit timestepping, order 2, explicit but for contact forces: omega step < 2",
            vec![],
        ),
    ]
}

fn common() -> Vec<v1::Parameter> {
    let flag = |name, what: &str, default| optional(name, "", what, default);
    vec![
        optional(
            "step",
            "s",
            "longest internal step, greater than 0; a macro step is cut into equal parts, by default it is one step",
            NO_LIMIT,
        ),
        optional(
            "tolerance",
            "1",
            "the iteration of a step ends when velocities change by less than this share of their size",
            1e-12,
        ),
        optional("iterations", "", "iterations of a step at most", 50.0),
        flag(
            "consistent_start",
            "1: accelerations at the start agree with closed contacts; 0: they ignore them, as in the paper",
            1.0,
        ),
        flag(
            "restart",
            "1: accelerations are found anew behind an impact; 0: those before it go on, as in the paper",
            1.0,
        ),
        flag(
            "hold_pressed",
            "1: a contact that presses stays closed where rounding or drift opens its gap; 0: the gap alone decides, \
             as in the paper",
            1.0,
        ),
        flag(
            "full_jacobian",
            "1: the contact iteration has all derivatives; 0: without that of the friction radius, as in the paper",
            1.0,
        ),
        flag(
            "acceleration_level",
            "0: contacts are held on velocity level; 1: on acceleration level, for comparison (not moreau, hets, \
             bathe, ed-alpha)",
            0.0,
        ),
    ]
}

/// The solver of a setup.
///
/// # Errors
/// [`SetupError`] if an option is out of its range.
pub fn choose(setup: &Setup) -> Result<Choice, SetupError> {
    let rho_inf = || setup.option_in("rho_inf", "it must be 0 to 1", |r| (0.0..=1.0).contains(&r));
    let scheme = match setup.solver() {
        GENERALIZED_ALPHA => SchemeKind::GeneralizedAlpha {
            rho_inf: rho_inf()?,
        },
        NEWMARK_ALPHA => {
            let allowed = "it must be at most 0.5";
            let alpha_f = setup.option_in("alpha_f", allowed, |alpha| alpha <= 0.5)?;
            let allowed = "it must be at most alpha_f, or high frequencies grow";
            SchemeKind::NewmarkAlpha {
                alpha_m: setup.option_in("alpha_m", allowed, |alpha| alpha <= alpha_f)?,
                alpha_f,
            }
        }
        BATHE => SchemeKind::Bathe,
        ED_ALPHA => SchemeKind::EdAlpha {
            rho_inf: rho_inf()?,
            alpha_ar: setup.positive_option("alpha_ar")?,
        },
        MOREAU => SchemeKind::Moreau,
        HETS => SchemeKind::Hets,
        other => {
            let known: Vec<String> = descriptions().into_iter().map(|kind| kind.name).collect();
            return Err(SetupError::UnknownSolver {
                kind: other.to_owned(),
                known: known.join(", "),
            });
        }
    };
    Ok(Choice {
        scheme,
        settings: settings(setup)?,
        step: setup.positive_option("step")?,
    })
}

fn settings(setup: &Setup) -> Result<Settings, SetupError> {
    let flag = |name: &str| {
        let is_flag = |value: f64| value == 0.0 || value == 1.0;
        let value = setup.option_in(name, "it must be 0 or 1", is_flag)?;
        Ok::<bool, SetupError>(value == 1.0)
    };
    let defaults = Settings::default();
    let mut contact = defaults.contact;
    if !flag("full_jacobian")? {
        contact.jacobian = Jacobian::AsPrinted;
    }
    let iterations = setup.option_in(
        "iterations",
        "it must be a whole number from 1 to 10000",
        |number| number.fract() == 0.0 && (1.0..=1e4).contains(&number),
    )?;
    Ok(Settings {
        level: if flag("acceleration_level")? {
            Level::Acceleration
        } else {
            Level::Velocity
        },
        has_consistent_start: flag("consistent_start")?,
        restarts_after_impacts: flag("restart")?,
        holds_pressed_contacts: flag("hold_pressed")?,
        tolerance: setup.option_in("tolerance", "it must be 1e-15 to 1e-3", |tolerance| {
            (1e-15..=1e-3).contains(&tolerance)
        })?,
        most_iterations: iterations as usize,
        contact,
    })
}
