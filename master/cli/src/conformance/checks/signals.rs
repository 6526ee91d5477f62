//! A signal is the polynomial through its points, whichever these are.

use linchpin_proto::v1::Signal;

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::compare::Comparison;
use crate::conformance::inputs::Inputs;
use crate::conformance::instance::{Inside, Instance, Kept};
use crate::conformance::measured::allowed;
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Share of the response to the inputs by which it may differ where the same polynomials are sent otherwise.
const SHARE: f64 = 1e-6;

/// Nodes in shares of the step, inside and outside of it, in no order.
const NODES: [f64; 4] = [1.0, 0.0, -1.0, -2.5];

/// The nodes of a signal do not count, its polynomial does; an input without one has its default.
pub struct Signals;

impl Check for Signals {
    fn about(&self) -> About {
        About {
            name: "signals",
            title: "a signal is the polynomial through its points; inputs without one have their default",
            equation: "u(tau) = sum of values_i l_i(tau) with the Lagrange polynomials of the nodes, also of those outside of the step",
            tolerance: "1e-6 of the response to the inputs, which leaves half of the digits to rounding, and the solver's tolerance",
            look_at: "how nodes and values become a polynomial (not line by line), that nodes count from the start of the step, and which \
                      value an input has that no signal names",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let count = bench.subject.inputs.len();
        if count == 0 {
            return Err(Stop::not_applicable("the model has no inputs"));
        }
        let mut instance = bench.in_motion()?;
        let start = instance.keep()?;
        let step = bench.step();
        for degree in 0..=bench.subject.highest_degree() {
            let inputs = bench.loaded(degree);
            let signals = (0..count)
                .map(|input| inputs.signal_through(input, &NODES[..=degree], step))
                .collect();
            let text =
                format!("polynomials of degree {degree} through other nodes are other inputs");
            let comparison = compare(bench, (&mut instance, &start), &inputs, signals)?;
            verdict.judge(comparison, Grade::Fail, text);
        }
        let inputs = bench.unloaded();
        let needed = (0..count)
            .filter(|&input| !bench.subject.has_default[input])
            .map(|input| inputs.signal(input, [0.0, 1.0], step))
            .collect();
        let comparison = compare(bench, (&mut instance, &start), &inputs, needed)?;
        let text = "inputs without a signal do not have their defaults";
        verdict.judge(comparison, Grade::Fail, text);
        Ok(())
    }
}

/// The end of a step under `signals` against that under `inputs`.
fn compare(
    bench: &Bench<'_>,
    (instance, start): (&mut Instance<'_>, &Kept),
    inputs: &Inputs,
    signals: Vec<Signal>,
) -> Result<Comparison, Stop> {
    let step = bench.step();
    // The size of a response, also where nothing but defaults are sent.
    instance.go_back(start)?;
    let lively = instance.step(step, &bench.loaded(0))?;
    instance.go_back(start)?;
    let rest = instance.step(step, &bench.unloaded())?;
    instance.go_back(start)?;
    let expected = instance.step(step, inputs)?;
    instance.go_back(start)?;
    let request = instance.step_request(step, signals, Inside::default());
    let found = instance.take(&request)?;
    let response: Vec<f64> = lively.iter().zip(&rest).map(|(a, b)| a - b).collect();
    let sizes = bench.subject.sizes_of_groups(&response);
    let mut comparison = Comparison::default();
    for (output, name) in bench.subject.outputs.iter().enumerate() {
        let floor = bench.floor(output, &[found[output], lively[output]]);
        if let Some(allowed) = allowed(SHARE, sizes[output], floor) {
            comparison.near(name, found[output], expected[output], allowed);
        }
    }
    Ok(comparison)
}
