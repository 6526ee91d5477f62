//! What the difference between a predicted and a corrected value tells about the error of the corrected curve.

/// Nodes and weights of the Gauss-Legendre rule with four points on `[0, 1]`, exact up to degree 7.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_9, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Error of a variable's interpolation over a step, per difference between its corrected and its extrapolated end value
/// (Milne's device, for any distances of the nodes).
///
/// With past nodes `t_0 = 0 > t_1 > ..` and the step `H`, the extrapolation of degree `q` misses the end by `c w_e(H)`, `w_e = (t - t_0) .. (t -
/// t_q)`, and the interpolation through the end is off by `c w_i`, `w_i = (t - H)(t - t_0) .. (t - t_{q-1})`, with the same `c`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ErrorShares {
    /// Mean of the error over the step: `integral of w_i / (H w_e(H))`. For equidistant nodes 1/2, 1/12, 1/24, 19/720 in size.
    pub mean: f64,
    /// Error of the position of a mass on which the variable acts as a force, per position that a change of the end value
    /// alone causes: `integral of (H - t) w_i`, over `w_e(H)` times that of `(H - t)` times the end's basis polynomial. For equidistant nodes 2/3, 1/4,
    /// 7/45 .. in size.
    pub position: f64,
    /// The difference falls with this power of `H`.
    pub order: usize,
}

impl ErrorShares {
    /// Where nothing is known of the steps before: all of the difference may be an error.
    pub const WITHOUT_PAST: Self = Self {
        mean: 1.0,
        position: 1.0,
        order: 1,
    };

    /// For past nodes `times`, newest first, of which the extrapolation has `extrapolated` and the interpolation `interpolated`.
    ///
    /// At the start the interpolation has one degree more than the extrapolation. Its error then is that of a degree less at most,
    /// which is what is told.
    pub fn new(times: &[f64], extrapolated: usize, interpolated: usize, step: f64) -> Self {
        let degree = extrapolated.saturating_sub(1);
        let node = |place: usize| times[place] / step;
        let from_nodes =
            |tau: f64, nodes: usize| -> f64 { (0..nodes).map(|place| tau - node(place)).product() };
        let missed = from_nodes(1.0, extrapolated);
        let basis = |tau: f64| from_nodes(tau, interpolated) / from_nodes(1.0, interpolated);
        let error = |tau: f64| (tau - 1.0) * from_nodes(tau, degree) / missed;
        let moved = integral(|tau| (1.0 - tau) * basis(tau));
        Self {
            mean: integral(error),
            position: integral(|tau| (1.0 - tau) * error(tau)) / moved,
            order: degree + 1,
        }
    }

    /// For a polynomial of this degree that every step finds anew, whose prediction is that of the step before, `past` times as long as
    /// the present one, continued. It misses `w(s) = s (s - 1/n) .. (s - 1)`, the prediction what that grows to in the next step.
    pub fn of_continuation(degree: usize, past: f64) -> Self {
        let node = |place: usize| place as f64 / degree as f64;
        let missed = |s: f64| -> f64 { (0..=degree).map(|place| s - node(place)).product() };
        let order = degree + 1;
        let continued = |s: f64| past.powi(order as i32) * missed(1.0 + s / past);
        let difference = integral(|s| (1.0 - s) * (continued(s) - missed(s)));
        Self {
            mean: integral(missed) / (continued(1.0) - missed(1.0)),
            position: integral(|s| (1.0 - s) * missed(s)) / difference,
            order,
        }
    }
}

fn integral(function: impl Fn(f64) -> f64) -> f64 {
    let terms = GAUSS.iter();
    terms.map(|&(node, weight)| weight * function(node)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equidistant_nodes_give_the_factors_of_milne_and_adams() {
        let times = [0.0, -0.3, -0.6, -0.9];
        let expected = [
            (-1.0 / 2.0, -2.0 / 3.0),
            (-1.0 / 12.0, -1.0 / 4.0),
            (-1.0 / 24.0, -7.0 / 45.0),
        ];
        for (degree, (mean, position)) in expected.into_iter().enumerate() {
            let shares = ErrorShares::new(&times, degree + 1, degree, 0.3);
            assert!((shares.mean - mean).abs() < 1e-14, "{shares:?}");
            assert!((shares.position - position).abs() < 1e-14, "{shares:?}");
            assert_eq!(shares.order, degree + 1);
        }
        let shares = ErrorShares::new(&times, 4, 3, 0.3);
        assert!((shares.mean + 19.0 / 720.0).abs() < 1e-14, "{shares:?}");
    }

    #[test]
    fn polynomials_that_are_found_anew_are_compared_with_those_before() {
        let expected = [(1, -1.0 / 12.0, -1.0 / 4.0), (2, 0.0, 1.0 / 30.0)];
        for (degree, mean, position) in expected {
            let shares = ErrorShares::of_continuation(degree, 1.0);
            assert!((shares.mean - mean).abs() < 1e-14, "{shares:?}");
            assert!((shares.position - position).abs() < 1e-14, "{shares:?}");
        }
        let shorter = ErrorShares::of_continuation(2, 2.0);
        assert!(shorter.position < 1.0 / 30.0, "{shorter:?}");
    }

    /// A force `t^(q+1)` on a free mass over unequal steps: the estimate is the error of its position.
    #[test]
    fn the_share_is_exact_where_the_next_derivative_is_constant() {
        let times = [0.0, -0.2, -0.7, -0.8];
        let step = 0.4;
        for degree in 0..4usize {
            let force = |t: f64| t.powi(degree as i32 + 1);
            let interpolated = degree;
            let value = |tau: f64, nodes: &[f64]| -> f64 {
                let basis = |own: usize| {
                    let others = nodes.iter().enumerate().filter(|(other, _)| *other != own);
                    others
                        .map(|(_, other)| (tau - other) / (nodes[own] - other))
                        .product::<f64>()
                };
                (0..nodes.len())
                    .map(|own| force(nodes[own]) * basis(own))
                    .sum()
            };
            let mut nodes = vec![step];
            nodes.extend(&times[..interpolated]);
            let change = force(step) - value(step, &times[..=degree]);
            let position = |function: &dyn Fn(f64) -> f64| {
                step * step * integral(|tau| (1.0 - tau) * function(tau * step))
            };
            let error = position(&|tau| value(tau, &nodes) - force(tau));
            let shares = ErrorShares::new(&times, degree + 1, interpolated, step);
            let basis = |tau: f64| {
                nodes[1..]
                    .iter()
                    .map(|node| (tau - node) / (step - node))
                    .product()
            };
            let estimate = -shares.position * change * position(&basis);
            assert!(
                (estimate - error).abs() < 1e-14,
                "{degree}: {estimate} {error}"
            );
        }
    }
}
