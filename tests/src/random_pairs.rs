//! Spectral radii of the macro-step maps of random linear oscillator pairs.
//!
//! The maps come from the co-simulation itself. What is known of every such map is taken out before its eigenvalues are
//! computed: without springs to ground the pair may rest anywhere, `A e_x = e_x` with `x = 1` for both masses, and without dampers it may drift,
//! `A e_v = e_v + H e_x` with `v = 1`, both with no force in the link. This Jordan block is the motion of a free body and no
//! fault of the coupling, but rounding splits its eigenvalue 1 by the square root of the rounding. In the quotient space, of the
//! coordinates `x_2 - x_1`, `v_2 - v_1` and the multipliers, it is gone; the block triangular form shows that the other eigenvalues
//! stay. What is left has to be a contraction or at least bounded.
//!
//! Every eigenvalue gets a bound of what rounding of the map's entries may do to it, and every pair is judged in two units of force,
//! which makes all roundings other ones. Where the bound reaches across the limit, where the two differ, or where two
//! macro steps are not twice the map to eight digits, double precision cannot tell: the pair is out of reach, counted and named.

use std::f64::consts::LN_10;
use std::sync::Arc;

use faer::Mat;
use faer::linalg::solvers::DenseSolveCore;
use linchpin_master::connection::Direct;
use linchpin_master::probe::spectrum::{balanced, entangled, submatrix};
use linchpin_master::probe::{MacroStepMap, ProbeError, macro_step_map};
use linchpin_models::oscillator::{Oscillator, OscillatorParameters};
use linchpin_proto::contract::Contract;
use linchpin_worker::{Host, Model};

use crate::masses::scene_text;
use crate::scenes::with_settings;

/// Radii up to this are stable.
pub const STABLE: f64 = 1.0 + 1e-9;

/// An entry of a map may be wrong by this many roundings of its terms.
const ROUNDINGS: f64 = 10.0;

/// Two oscillators in a rigid link, and the macro step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Masses a and b.
    pub masses: [OscillatorParameters; 2],
    /// Macro step (s).
    pub macro_step: f64,
}

/// Endless pairs, log-uniform and the same for the same seed: masses 1e-2..1e2 kg, stiffness 0 (one in ten) or 1e-1..1e8 N/m,
/// damping 0 (one in ten) or 1e-2..1e5 N s/m, macro step 1e-4..3e-2 s.
#[derive(Debug, Clone)]
pub struct Pairs {
    state: u64,
}

impl Pairs {
    /// The sequence of this seed.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// Uniform in 0..1: SplitMix64.
    fn uniform(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) as f64 / 2f64.powi(64)
    }

    /// Log-uniform between powers of ten.
    fn log_uniform(&mut self, [from, to]: [f64; 2]) -> f64 {
        ((from + (to - from) * self.uniform()) * LN_10).exp()
    }

    fn zero_or(&mut self, exponents: [f64; 2]) -> f64 {
        match self.uniform() < 0.1 {
            true => 0.0,
            false => self.log_uniform(exponents),
        }
    }
}

impl Iterator for Pairs {
    type Item = Pair;

    fn next(&mut self) -> Option<Pair> {
        let mut mass = || OscillatorParameters {
            m: self.log_uniform([-2.0, 2.0]),
            c: self.zero_or([-1.0, 8.0]),
            d: self.zero_or([-2.0, 5.0]),
            x0: 0.0,
            v0: 0.0,
        };
        Some(Pair {
            masses: [mass(), mass()],
            macro_step: self.log_uniform([-4.0, 3e-2_f64.log10()]),
        })
    }
}

impl Pair {
    /// The map of one macro step with settings of the coupling such as `"method=weighted index=1 degree=1"`.
    ///
    /// # Errors
    /// What the probe cannot do.
    pub fn map(&self, coupling: &str) -> Result<MacroStepMap, ProbeError> {
        let text = scene_text(&self.masses, &[(0, 1)], &[0, 1]);
        let coupling = format!("{coupling} macro_step={:e}", self.macro_step);
        let scene = with_settings(&text, &coupling, &["scene.t_end=1"]);
        let model: Box<dyn Model> = Box::new(Oscillator);
        let host = Arc::new(Host::new(vec![model]));
        macro_step_map(&scene, &mut |_, _| {
            Ok(Box::new(
                Direct::new(Arc::clone(&host) as Arc<dyn Contract>),
            ))
        })
    }
}

/// What the eigenvalues of a map say.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// No eigenvalue above the limit.
    Stable,
    /// The largest is above it.
    Unstable(f64),
    /// Rounding decides on which side of the limit it is, or the map is not linear to within rounding.
    OutOfReach(String),
}

/// The other unit of force: not a power of two, so that every rounding is another one.
const OTHER_UNIT: f64 = 1.7;

impl Pair {
    /// Judges the pair under settings of the coupling, in two units of force; both have to say the same.
    ///
    /// # Panics
    /// The scene is none.
    pub fn judge(&self, coupling: &str) -> Verdict {
        match [
            self.judge_once(coupling),
            self.in_other_unit().judge_once(coupling),
        ] {
            [Verdict::Stable, Verdict::Stable] => Verdict::Stable,
            [Verdict::Unstable(one), Verdict::Unstable(_)] => Verdict::Unstable(one),
            [Verdict::OutOfReach(why), _] | [_, Verdict::OutOfReach(why)] => {
                Verdict::OutOfReach(why)
            }
            [one, other] => {
                Verdict::OutOfReach(format!("{one:?} in one unit, {other:?} in another"))
            }
        }
    }

    /// Whether the macro step resolves the motion of both masses: omega H and the decay d H / m are at most 1.
    pub fn is_resolved(&self) -> bool {
        let h = self.macro_step;
        self.masses
            .iter()
            .all(|mass| (mass.c / mass.m).sqrt() * h <= 1.0 && mass.d / mass.m * h <= 1.0)
    }

    /// Masses, stiffnesses and dampings times a factor: the same motion under forces as many times as large.
    fn in_other_unit(&self) -> Self {
        let masses = self.masses.map(|mass| OscillatorParameters {
            m: OTHER_UNIT * mass.m,
            c: OTHER_UNIT * mass.c,
            d: OTHER_UNIT * mass.d,
            ..mass
        });
        Self { masses, ..*self }
    }

    fn judge_once(&self, coupling: &str) -> Verdict {
        match self.map(coupling) {
            Ok(map) => self.quotient(&map).judge(),
            Err(error @ (ProbeError::NotLinear { .. } | ProbeError::Run(_))) => {
                Verdict::OutOfReach(error.to_string())
            }
            Err(error) => panic!("{error}"),
        }
    }

    /// The map with the motions that it is known to have taken out.
    fn quotient(&self, map: &MacroStepMap) -> Quotient {
        let [a, b] = &self.masses;
        let names = map.coordinates().iter().map(|one| one.column.as_str());
        let names: Vec<_> = names.collect();
        let of = |output: &str| {
            ["mass1", "mass2"].map(|mass| {
                let column = format!("{mass}.{output}");
                names.iter().position(|name| *name == column).unwrap()
            })
        };
        let mut quotient = Quotient::of(map.matrix());
        if a.c == 0.0 && b.c == 0.0 {
            quotient.remove(of("x"));
            if a.d == 0.0 && b.d == 0.0 {
                quotient.remove(of("v"));
            }
        }
        quotient
    }
}

/// A map on a quotient space, with the sizes of the terms of its entries.
struct Quotient {
    matrix: Mat<f64>,
    sizes: Mat<f64>,
    kept: Vec<usize>,
}

impl Quotient {
    fn of(matrix: &Mat<f64>) -> Self {
        let size = matrix.nrows();
        Self {
            matrix: matrix.clone(),
            sizes: Mat::from_fn(size, size, |i, j| matrix[(i, j)].abs()),
            kept: (0..size).collect(),
        }
    }

    /// Goes over to the space in which a state `u` with 1 in both places, 0 elsewhere, is nothing: `Q s = A s - (A s)_p u` on the
    /// states with `s_p = 0`, where `p` is the first place.
    fn remove(&mut self, [first, second]: [usize; 2]) {
        for column in 0..self.matrix.ncols() {
            let (value, size) = (self.matrix[(first, column)], self.sizes[(first, column)]);
            self.matrix[(second, column)] -= value;
            self.sizes[(second, column)] += size;
        }
        self.kept.retain(|place| *place != first);
    }

    /// Eigenvalues `mu`, in absolute value, each with the first-order bound of its shift when every term of an entry is rounded:
    /// `|dmu_i| <= ROUNDINGS eps (|U^-1| S |U|)_ii`, with the eigenvectors `U` and the sizes `S`.
    fn eigenvalues(&self) -> Vec<(f64, f64)> {
        let matrix = submatrix(&self.matrix, &self.kept);
        let sizes = submatrix(&self.sizes, &self.kept);
        let rounding = ROUNDINGS * f64::EPSILON;
        let places = entangled(&matrix);
        let alone = (0..matrix.nrows()).filter(|place| !places.contains(place));
        let alone = alone.map(|i| (matrix[(i, i)].abs(), rounding * sizes[(i, i)]));
        let (matrix, scales) = balanced(&submatrix(&matrix, &places));
        let sizes = submatrix(&sizes, &places);
        let eigen = matrix.eigen().unwrap();
        let (vectors, values) = (eigen.U(), eigen.S().column_vector());
        let inverse = vectors.partial_piv_lu().inverse();
        let size = scales.len();
        let bound = |i: usize| {
            let mut sum = 0.0;
            for row in 0..size {
                for column in 0..size {
                    let entry = sizes[(row, column)] * scales[column] / scales[row];
                    sum += inverse[(i, row)].norm() * entry * vectors[(column, i)].norm();
                }
            }
            rounding * sum
        };
        let entangled = (0..size).map(|i| (values[i].norm(), bound(i)));
        entangled.chain(alone).collect()
    }

    fn judge(&self) -> Verdict {
        let eigenvalues = self.eigenvalues();
        let above = eigenvalues
            .iter()
            .filter(|(size, shift)| size - shift > STABLE);
        let radius = above.map(|(size, _)| *size).fold(0.0, f64::max);
        if radius > 0.0 {
            return Verdict::Unstable(radius);
        }
        // Also a shift that is not a number is out of reach.
        let near = eigenvalues
            .iter()
            .find(|(size, shift)| (size + shift).is_nan() || size + shift > STABLE);
        near.map_or(Verdict::Stable, |(size, shift)| {
            Verdict::OutOfReach(format!("an eigenvalue {size} is known to {shift:e}"))
        })
    }
}

/// How many pairs are stable, unstable and out of reach.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tally {
    /// Pairs.
    pub pairs: usize,
    /// Those that are unstable, with their radii.
    pub unstable: Vec<(Pair, f64)>,
    /// Those that are out of reach, with the reason.
    pub out_of_reach: Vec<(Pair, String)>,
}

impl Tally {
    /// Judges the first pairs of the sequence with this seed.
    pub fn of(coupling: &str, seed: u64, pairs: usize) -> Self {
        let mut tally = Self {
            pairs,
            ..Self::default()
        };
        for pair in Pairs::new(seed).take(pairs) {
            match pair.judge(coupling) {
                Verdict::Stable => {}
                Verdict::Unstable(radius) => tally.unstable.push((pair, radius)),
                Verdict::OutOfReach(why) => tally.out_of_reach.push((pair, why)),
            }
        }
        tally
    }
}
