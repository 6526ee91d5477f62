//! Force/force coupling by penalty spring-dampers, explicit: what common co-simulation masters do today.
//!
//! A spring and a damper stand in place of every condition `g` of a joint. At each macro point the multiplier is their load,
//! `lambda = -s (K g + D g')`, with `s` the [`load_power`](crate::joint::Condition::load_power) of the condition, so that a
//! condition that is open is pulled shut; exchanged variables are what the outputs show, `w = y`. All are extrapolated
//! over the next step through their past values, and no macro step is repeated.
//!
//! Jacobi: all subsystems step at once. Gauss-Seidel: one after the other in the order of the scene; the end values of
//! the coupling variables follow from the outputs of those that have stepped and the extrapolated outputs of the others,
//! and the inputs are interpolated through them.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::spring::Spring;
use crate::joint::Level;
use crate::layout::{Layout, Row};
use crate::methods::condition::SingularRow;
use crate::methods::method::{Built, CouplingMethod, Order, Reached};
use crate::methods::saved::{Saved, Unreadable};
use crate::signal::{Curve, Curves, History, Lagrange, Variables};
use crate::system::{Outputs, motion_of};

/// Whose states are written.
const NAME: &str = "penalty";

/// A penalty coupling.
pub struct PenaltyCoupling {
    springs: Vec<Spring>,
    order: Order,
    /// Places of the coupling outputs of each subsystem among those of all, one behind the other.
    places: Vec<Range<usize>>,
    length: f64,
    /// Coupling variables at the end of the step, as far as they are known.
    ends: Vec<f64>,
    /// Outputs there: extrapolated until the subsystem has stepped. Only with Gauss-Seidel.
    outputs: Vec<f64>,
    state: State,
}

/// What is remembered at a macro point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    history: History,
    /// Outputs of all subsystems, with Gauss-Seidel.
    outputs: Option<History>,
}

impl PenaltyCoupling {
    /// One spring for each row; `history` holds the exchanged variables at the first macro point with these `outputs`.
    /// With Gauss-Seidel the outputs are extrapolated with `output_degree`.
    pub fn build(
        order: Order,
        springs: Vec<Spring>,
        history: History,
        output_degree: usize,
        layout: &Layout,
        outputs: &dyn Outputs,
    ) -> Built {
        let mut newest = Vec::new();
        let places = (0..layout.outputs.len()).map(|subsystem| {
            let start = newest.len();
            newest.extend_from_slice(outputs.of(subsystem));
            start..newest.len()
        });
        let places = places.collect();
        let variables = Variables {
            degrees: vec![output_degree; newest.len()],
            rotations: Vec::new(),
        };
        let past = match order {
            Order::Jacobi => None,
            Order::GaussSeidel => Some(History::new(variables, &newest, Vec::new())),
        };
        let method = Self {
            springs,
            order,
            places,
            length: 0.0,
            ends: history.newest().to_vec(),
            outputs: newest,
            state: State {
                history,
                outputs: past,
            },
        };
        Built {
            method: Box::new(method),
            end: None,
            point: None,
        }
    }
}

impl CouplingMethod for PenaltyCoupling {
    fn predict(&mut self, length: f64) {
        self.length = length;
        if let Some(outputs) = &self.state.outputs {
            extrapolate(&self.state.history, length, &mut self.ends);
            extrapolate(outputs, length, &mut self.outputs);
        }
    }

    /// Through an end value that is extrapolated itself, the interpolation is the extrapolation.
    fn lend(&self, to: &mut dyn FnMut(&dyn Curves, &dyn Curves)) {
        let curves = Lagrange {
            history: &self.state.history,
            curve: match self.order {
                Order::Jacobi => Curve::Extrapolated,
                Order::GaussSeidel => Curve::Interpolated(&self.ends),
            },
            length: self.length,
        };
        to(&curves, &curves);
    }

    fn ends(&self) -> &[f64] {
        &self.ends
    }

    fn order(&self) -> Order {
        self.order
    }

    fn advanced(&mut self, layout: &Layout, stepped: usize, outputs: &dyn Outputs) {
        let (all, places) = (&mut self.outputs, &self.places);
        all[places[stepped].clone()].copy_from_slice(outputs.of(stepped));
        let of = |subsystem: usize| &all[places[subsystem].clone()];
        let coupling = (&self.springs[..], &self.state.history);
        take(coupling, layout, of, |new| new == stepped, &mut self.ends);
    }

    fn reached(&mut self, reached: Reached<'_>) -> Result<(), SingularRow> {
        if self.order == Order::Jacobi {
            let outputs = |subsystem: usize| reached.outputs.of(subsystem);
            let coupling = (&self.springs[..], &self.state.history);
            take(coupling, reached.layout, outputs, |_| true, &mut self.ends);
        }
        self.state.history.push(self.length, &self.ends);
        if let Some(outputs) = &mut self.state.outputs {
            outputs.push(self.length, &self.outputs);
        }
        Ok(())
    }

    /// Loads of the springs, one for each row.
    fn multipliers(&self) -> &[f64] {
        &self.state.history.newest()[..self.springs.len()]
    }

    fn multipliers_at(
        &self,
        _tau: f64,
        layout: &Layout,
        outputs: &dyn Outputs,
        multipliers: &mut [f64],
    ) {
        write_loads(&self.springs, layout, outputs, multipliers);
    }

    fn state(&self) -> Saved {
        Saved::new(NAME, &self.state)
    }

    fn resume(&mut self, state: &Saved) -> Result<(), Unreadable> {
        self.state = state.read(NAME)?;
        Ok(())
    }
}

/// Writes the end values of the coupling variables that depend on a subsystem that is `new`.
fn take<'a>(
    (springs, history): (&[Spring], &History),
    layout: &Layout,
    outputs: impl Fn(usize) -> &'a [f64] + Copy,
    is_new: impl Fn(usize) -> bool,
    ends: &mut [f64],
) {
    for (row, spring) in springs.iter().enumerate() {
        let markers = &layout.joint_of(row).ends;
        if markers.iter().any(|end| is_new(end.subsystem)) {
            ends[row] = spring_load(layout, row, spring, outputs);
        }
    }
    for exchanged in layout.exchanged.iter().filter(|one| is_new(one.subsystem)) {
        let own = outputs(exchanged.subsystem);
        let value = exchanged.read(own, history.attitudes(), history.newest());
        let places = exchanged.first..exchanged.first + exchanged.size();
        ends[places].copy_from_slice(&value.as_slice()[..exchanged.size()]);
    }
}

/// Writes the loads of the springs under these outputs of all subsystems, one for each row, in front of `values`.
pub fn write_loads(springs: &[Spring], layout: &Layout, outputs: &dyn Outputs, values: &mut [f64]) {
    let outputs = |subsystem: usize| outputs.of(subsystem);
    for (row, (spring, value)) in springs.iter().zip(values).enumerate() {
        *value = spring_load(layout, row, spring, outputs);
    }
}

/// Load of the spring in place of a row: `-s (K g + D g')`.
fn spring_load<'a>(
    layout: &Layout,
    row: usize,
    spring: &Spring,
    outputs: impl Fn(usize) -> &'a [f64],
) -> f64 {
    let Row { joint, condition } = layout.rows[row];
    let motion = motion_of(layout, joint, outputs);
    let condition = layout.joints[joint].joint.condition(condition);
    let [g, rate, _] = condition.values(Level::Velocity, &motion);
    -condition.load_power() * (spring.stiffness * g + spring.damping * rate)
}

/// All variables of `history` at the end of a step of length `step` (s).
fn extrapolate(history: &History, step: f64, ends: &mut [f64]) {
    for (variable, end) in ends.iter_mut().enumerate() {
        *end = history.value(variable, Curve::Extrapolated, step, step);
    }
}
