//! Hermite coupling: multipliers that are polynomials of their own on every macro step.
//!
//! On the step from `T_N` to `T_{N+1}` a multiplier is a polynomial of degree 2 to 5 in `s = (t - T_N)/H`. Nothing of it comes from
//! steps before but, in the variant that is continuous, its start value. It has as many unknown values at equidistant
//! nodes as there are conditions ([`Variant`]), for APV of degree 2
//!
//! ```text
//! lambda(s) = l_0 (1 - s)(1 - 2s) + l_1 4s(1 - s) + l_2 s(2s - 1)
//! g''(T_N) = 0,   g(T_{N+1}) / H^2 = 0,   g'(T_{N+1}) / H = 0
//! ```
//!
//! For free bodies the velocity at the end takes the mean of a load over the step, the position its mean weighted by `1 - s`:
//! `l_1` weighs 2/3 and 1/3, `l_2` 1/6 and 0. What the polynomial misses of the true multiplier,
//! `c H^3 s (s^2 - 6 s/5 + 3/10)`, then has no mean of either kind, so positions and velocities feel it only through
//! stiffness, damping and geometry: one power of `H` for each integration. That is why APV has order 5 where its multipliers,
//! which miss `c H^3/10` at the end, have order 3.
//!
//! Motion that is exchanged is a polynomial through position and velocity at both ends and the acceleration at the start: the
//! end values are unknowns, with the conditions that they are what the partner's outputs say (`curves`). All conditions are
//! linearised about the prediction with columns of the workers for each shape, and solved together (`stack`).
//!
//! With every degree more a moment of each condition over the step vanishes, which the workers' outputs at instants inside it tell
//! (`moments`). Solutions of fewer degrees tell the error, and where the top coefficient of a multiplier does not fall its top condition
//! is relaxed (`reduced`).
//!
//! * `scene`, `variant`: parameters: which conditions;
//! * `coupling`: the method in a macro step;
//! * `shapes`: what the curves are made of;
//! * `curves`, `sample`: the curves of all variables, and their values where they are looked at;
//! * `continuation`: what of a curve goes on from one step to the next;
//! * `moments`: how conditions inside the step are read;
//! * `stack`, `reduced`: the equations of all unknowns, and those of fewer degrees or with relaxed top conditions.

mod continuation;
mod curves;
mod coupling;
mod moments;
mod reduced;
mod sample;
mod scene;
mod shapes;
mod stack;
mod variant;

pub use scene::Hermite;
pub use variant::Variant;
