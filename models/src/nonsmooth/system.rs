//! What an integration scheme knows of a mechanical system.

use std::sync::Arc;

use super::matrix::{BorderedBand, Shape};

/// One contact or constraint of a mechanical system: its laws. Its kinematics are rows of
/// [`MechanicalSystem::directions`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Whether it can open.
    pub side: Side,
    /// Newton's coefficient of restitution in normal direction, 0 to 1 (S2 eq. 11).
    pub normal_restitution: f64,
    /// The same in tangential direction, 0 to 1 (S2 eq. 12).
    pub tangential_restitution: f64,
    /// Coulomb's coefficient of friction, 0 or greater (S2 eq. 2).
    pub friction: f64,
    /// Tangential directions: 0 without friction, 1 in the plane, 2 in space.
    pub tangents: usize,
}

impl Contact {
    /// A constraint without friction that never opens.
    pub const CONSTRAINT: Self = Self {
        side: Side::Bilateral,
        normal_restitution: 0.0,
        tangential_restitution: 0.0,
        friction: 0.0,
        tangents: 0,
    };

    /// Rows that it has: one normal, then its tangents.
    pub const fn rows(&self) -> usize {
        1 + self.tangents
    }
}

/// Whether a contact can open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// `0 <= g_N`, and the force only presses: `0 <= lambda_N` (S2 eq. 1).
    Unilateral,
    /// `g_N = 0`, and the force has either sign.
    Bilateral,
}

/// A system at one instant.
#[derive(Debug, Clone, Copy)]
pub struct Instant<'a> {
    /// Time (s).
    pub t: f64,
    /// Coordinates.
    pub q: &'a [f64],
    /// Their velocities.
    pub v: &'a [f64],
    /// Inputs of the subsystem.
    pub inputs: &'a [f64],
}

/// A mechanical system with contacts, `M(q) a = f(t, q, v, u) + W(q) lambda` (S2 eq. 16, with `f = h - C v - K q`).
///
/// `n` coordinates `q` with velocities `v = q'`. Every contact has a gap `g_N(q)` (m, or rad for an angle), a normal
/// row `W_N^T = dg_N/dq`, and tangential rows `W_T^T` with `g_T' = W_T^T v`. Forces act on the system as `W lambda`: a
/// normal force presses the gap open where it is positive, a tangential one acts along growing `g_T`. SI units.
pub trait MechanicalSystem: Send {
    /// Number of coordinates and structure of the matrices `M`, `C`, `K`.
    fn shape(&self) -> Shape;

    /// The contacts in the order of their rows; the same throughout a run.
    fn contacts(&self) -> &[Contact];

    /// Writes `M(q)`, symmetric and positive definite, to a matrix of zeros.
    fn mass(&self, q: &[f64], mass: &mut BorderedBand);

    /// Writes all forces but those of the contacts.
    fn force(&self, at: Instant<'_>, force: &mut [f64]);

    /// Adds `K = -df/dq` and `C = -df/dv` to matrices of zeros, as far as the scheme is to treat them implicitly: what
    /// is stiff must be there; what is left out is found by iteration. Returns whether there is anything.
    fn tangents(
        &self,
        _at: Instant<'_>,
        _stiffness: &mut BorderedBand,
        _damping: &mut BorderedBand,
    ) -> bool {
        false
    }

    /// Writes the gap `g_N` of every contact, in the order of [`MechanicalSystem::contacts`].
    fn gaps(&self, q: &[f64], gaps: &mut [f64]);

    /// Writes `W^T(q)`, a row of `n` numbers after the other: for every contact its normal row, then its tangents.
    fn directions(&self, q: &[f64], rows: &mut [f64]);

    /// Writes, for every row of [`MechanicalSystem::directions`], `(dW^T/dt) v`: what its rate changes by besides `W^T
    /// a`.
    fn direction_rates(&self, q: &[f64], v: &[f64], rates: &mut [f64]);

    /// Kinetic and potential energy (J).
    fn energy(&self, q: &[f64], v: &[f64]) -> f64;
}

impl<S: MechanicalSystem + Sync + ?Sized> MechanicalSystem for Arc<S> {
    fn shape(&self) -> Shape {
        (**self).shape()
    }

    fn contacts(&self) -> &[Contact] {
        (**self).contacts()
    }

    fn mass(&self, q: &[f64], mass: &mut BorderedBand) {
        (**self).mass(q, mass);
    }

    fn force(&self, at: Instant<'_>, force: &mut [f64]) {
        (**self).force(at, force);
    }

    fn tangents(
        &self,
        at: Instant<'_>,
        stiffness: &mut BorderedBand,
        damping: &mut BorderedBand,
    ) -> bool {
        (**self).tangents(at, stiffness, damping)
    }

    fn gaps(&self, q: &[f64], gaps: &mut [f64]) {
        (**self).gaps(q, gaps);
    }

    fn directions(&self, q: &[f64], rows: &mut [f64]) {
        (**self).directions(q, rows);
    }

    fn direction_rates(&self, q: &[f64], v: &[f64], rates: &mut [f64]) {
        (**self).direction_rates(q, v, rates);
    }

    fn energy(&self, q: &[f64], v: &[f64]) -> f64 {
        (**self).energy(q, v)
    }
}

/// Number of rows of all contacts together.
pub fn rows(contacts: &[Contact]) -> usize {
    contacts.iter().map(Contact::rows).sum()
}
