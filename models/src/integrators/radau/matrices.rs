//! Factorised iteration matrices, kept for steps that need the same ones.

use nalgebra::{Complex, DMatrix, DVector, Dyn, LU};

use super::tableau::{ALPHA, BETA, GAMMA};

/// The matrices `(gamma/h) I - J` and `((alpha + i beta)/h) I - J` of one step size `h` and one Jacobian `J`.
#[derive(Debug)]
pub struct Matrices {
    step: f64,
    jacobian: DMatrix<f64>,
    real: LU<f64, Dyn, Dyn>,
    complex: LU<Complex<f64>, Dyn, Dyn>,
}

impl Matrices {
    fn new(step: f64, jacobian: &DMatrix<f64>) -> Self {
        let mut real = -jacobian;
        let mut complex = real.map(Complex::from);
        for i in 0..jacobian.nrows() {
            real[(i, i)] += GAMMA / step;
            complex[(i, i)] += Complex::new(ALPHA / step, BETA / step);
        }
        Self {
            step,
            jacobian: jacobian.clone(),
            real: LU::new(real),
            complex: LU::new(complex),
        }
    }

    fn are_of(&self, step: f64, jacobian: &DMatrix<f64>) -> bool {
        self.step == step && self.jacobian == *jacobian
    }

    /// Solves with the real matrix in place; false if it is singular.
    pub fn solve_real(&self, rhs: &mut DVector<f64>) -> bool {
        self.real.solve_mut(rhs)
    }

    /// Solves with the complex matrix in place; false if it is singular.
    pub fn solve_complex(&self, rhs: &mut DVector<Complex<f64>>) -> bool {
        self.complex.solve_mut(rhs)
    }
}

/// The matrices of the steps of one interval, in order. Those of the interval before stay behind them: if the same
/// step sizes and Jacobians come again, nothing is factorised and nothing allocated.
#[derive(Debug, Default)]
pub struct MatrixStore {
    kept: Vec<Matrices>,
    used: usize,
}

impl MatrixStore {
    /// Begins an interval.
    pub fn clear(&mut self) {
        self.used = 0;
    }

    /// Place of the matrices of `step` and `jacobian`.
    pub fn place(&mut self, step: f64, jacobian: &DMatrix<f64>) -> usize {
        if self.used > 0 && self.kept[self.used - 1].are_of(step, jacobian) {
            return self.used - 1;
        }
        let place = self.used;
        match self.kept.get_mut(place) {
            Some(kept) if kept.are_of(step, jacobian) => {}
            Some(kept) => *kept = Matrices::new(step, jacobian),
            None => self.kept.push(Matrices::new(step, jacobian)),
        }
        self.used += 1;
        place
    }

    /// The matrices at `place`.
    pub fn get(&self, place: usize) -> &Matrices {
        &self.kept[place]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where the factors lie: a new factorisation has new memory while the old one still exists.
    fn address(store: &MatrixStore, place: usize) -> *const f64 {
        store.get(place).real.lu_internal().as_ptr()
    }

    #[test]
    fn the_same_steps_in_the_next_interval_need_no_factorisation() {
        let jacobian = DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -37.0, -0.2]);
        let mut store = MatrixStore::default();
        let places = [0.02, 0.02, 0.013].map(|step| store.place(step, &jacobian));
        assert_eq!(places, [0, 0, 1]);
        let addresses = [0, 1].map(|place| address(&store, place));
        store.clear();
        assert_eq!(
            [0.02, 0.02, 0.013].map(|step| store.place(step, &jacobian)),
            places
        );
        assert_eq!([0, 1].map(|place| address(&store, place)), addresses);
        store.clear();
        assert_eq!(
            [0.02, 0.017].map(|step| store.place(step, &jacobian)),
            [0, 1]
        );
        assert_eq!(address(&store, 0), addresses[0]);
        assert_ne!(address(&store, 1), addresses[1]);
    }

    #[test]
    fn a_solution_satisfies_its_equation() {
        let jacobian = DMatrix::from_row_slice(2, 2, &[0.3, 1.0, -37.0, -0.2]);
        let mut store = MatrixStore::default();
        let place = store.place(0.13, &jacobian);
        let mut x = DVector::from_vec(vec![Complex::new(1.0, -2.0), Complex::new(0.4, 3.0)]);
        let rhs = x.clone();
        assert!(store.get(place).solve_complex(&mut x));
        let shift = Complex::new(ALPHA, BETA) / 0.13;
        let residual = x.map(|x| x * shift) - jacobian.map(Complex::from) * &x - rhs;
        assert!(residual.norm() < 1e-14, "{residual}");
    }
}
