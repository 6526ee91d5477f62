//! The amplification matrix of a scheme, found by steps from unit states (S2 eq. 94).

use linchpin_worker::Inputs;
use nalgebra::DMatrix;

use super::oscillator::Oscillator;
use super::roots::{eigenvalues, principal};
use super::{Spectrum, SpectrumError};
use crate::nonsmooth::mechanics::{Mechanics, Settings, StepError};
use crate::nonsmooth::schemes::{Scheme, SchemeError, SchemeKind};
use crate::nonsmooth::state::{Drive, State, Step};

/// Largest step over period: beyond it the square of `Omega` leaves no digits.
const MOST_STEP_OVER_PERIOD: f64 = 1e9;

/// All variables behind a step, in the unit of `q`.
type Response = [f64; Variable::ALL.len()];

/// A variable of the state of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variable {
    /// `q`.
    Coordinate,
    /// `dt v`.
    Velocity,
    /// `dt^2 a`.
    Acceleration,
    /// `dt^2 A` of the generalised-alpha method (S2 eq. 21).
    Auxiliary,
}

impl Variable {
    const ALL: [Self; 4] = [
        Self::Coordinate,
        Self::Velocity,
        Self::Acceleration,
        Self::Auxiliary,
    ];

    fn of(self, state: &mut State) -> &mut [f64] {
        match self {
            Self::Coordinate => &mut state.q,
            Self::Velocity => &mut state.v,
            Self::Acceleration => &mut state.a,
            Self::Auxiliary => &mut state.auxiliary,
        }
    }

    /// Power of `dt` that gives it the unit of `q`.
    fn scale(self, dt: f64) -> f64 {
        match self {
            Self::Coordinate => 1.0,
            Self::Velocity => dt,
            Self::Acceleration | Self::Auxiliary => dt * dt,
        }
    }
}

/// What a step makes of a state, `X_{i+1} = A X_i`.
#[derive(Debug, Clone, PartialEq)]
pub struct Amplification {
    /// The variables of `X`, those that the scheme reads: a variable of which the next state is independent adds an
    /// eigenvalue 0 and is left out.
    pub variables: Vec<Variable>,
    /// `A`.
    pub matrix: DMatrix<f64>,
    /// Step over period.
    pub dt_over_period: f64,
}

impl Amplification {
    /// Spectral radius and principal roots.
    ///
    /// # Errors
    /// [`SpectrumError::NoEigenvalues`].
    pub fn spectrum(&self) -> Result<Spectrum, SpectrumError> {
        let roots =
            eigenvalues(&self.matrix).ok_or(SpectrumError::NoEigenvalues(self.dt_over_period))?;
        let moduli = roots.iter().map(|root| root.re.hypot(root.im));
        Ok(Spectrum {
            dt_over_period: self.dt_over_period,
            radius: moduli.fold(0.0, f64::max),
            principal: principal(&roots),
        })
    }
}

/// A scheme on a mass that vibrates with a period of 1 s.
pub struct Probe {
    mechanics: Mechanics,
    scheme: Box<dyn Scheme>,
    inputs: Inputs,
    from: State,
    to: State,
}

impl Probe {
    /// For a scheme.
    ///
    /// # Errors
    /// [`SchemeError`]: parameters out of range.
    pub fn new(scheme: SchemeKind) -> Result<Self, SchemeError> {
        Self::with(|mechanics| scheme.build(mechanics))
    }

    /// For a scheme that `build` makes.
    ///
    /// # Errors
    /// Those of `build`.
    pub fn with<E>(
        build: impl FnOnce(&Mechanics) -> Result<Box<dyn Scheme>, E>,
    ) -> Result<Self, E> {
        let system = Box::new(Oscillator::UNIT_PERIOD);
        let mechanics = Mechanics::new(system, 0, Settings::default());
        let state = State::new(mechanics.order(), mechanics.rows());
        Ok(Self {
            scheme: build(&mechanics)?,
            mechanics,
            inputs: Inputs::constant(&[]),
            from: state.clone(),
            to: state,
        })
    }

    /// The matrix for a step over period.
    ///
    /// # Errors
    /// [`SpectrumError`].
    pub fn amplification(&mut self, dt_over_period: f64) -> Result<Amplification, SpectrumError> {
        if !(dt_over_period > 0.0 && dt_over_period <= MOST_STEP_OVER_PERIOD) {
            return Err(SpectrumError::StepOverPeriod(dt_over_period));
        }
        let mut matrix = DMatrix::zeros(Variable::ALL.len(), Variable::ALL.len());
        for (column, variable) in Variable::ALL.into_iter().enumerate() {
            let response = self.response(variable, dt_over_period);
            let response = response.map_err(|source| SpectrumError::Step {
                dt_over_period,
                source,
            })?;
            matrix.column_mut(column).copy_from_slice(&response);
        }
        Ok(without_idle_variables(matrix, dt_over_period))
    }

    /// Spectral radius and principal roots for a step over period.
    ///
    /// # Errors
    /// [`SpectrumError`].
    pub fn spectrum(&mut self, dt_over_period: f64) -> Result<Spectrum, SpectrumError> {
        self.amplification(dt_over_period)?.spectrum()
    }

    /// What a step makes of the state that is 1 in one variable and 0 in the others, all of them in the unit of `q`.
    fn response(&mut self, one: Variable, dt: f64) -> Result<Response, StepError> {
        for variable in Variable::ALL {
            let value = if variable == one {
                1.0 / variable.scale(dt)
            } else {
                0.0
            };
            variable.of(&mut self.from).fill(value);
        }
        let drive = Drive {
            start: 0.0,
            inputs: &self.inputs,
        };
        let step = Step {
            drive,
            tau: 0.0,
            dt,
            active: &[],
        };
        self.scheme
            .advance(&mut self.mechanics, step, &self.from, &mut self.to)?;
        if !self.to.is_finite() {
            return Err(StepError::NotFinite);
        }
        Ok(Variable::ALL.map(|variable| variable.of(&mut self.to)[0] * variable.scale(dt)))
    }
}

/// Takes out, one after the other, the variables whose column is 0.
fn without_idle_variables(matrix: DMatrix<f64>, dt_over_period: f64) -> Amplification {
    let mut places: Vec<usize> = (0..matrix.ncols()).collect();
    let is_idle = |places: &[usize], column: usize| {
        let mut rows = places.iter();
        rows.all(|&row| matrix[(row, column)] == 0.0)
    };
    while let Some(idle) = { places.iter() }.position(|&column| is_idle(&places, column)) {
        places.remove(idle);
    }
    Amplification {
        variables: places.iter().map(|&place| Variable::ALL[place]).collect(),
        matrix: matrix.select_rows(&places).select_columns(&places),
        dt_over_period,
    }
}
