use super::*;

fn polynomial(degree: usize, length: f64) -> Polynomial {
    let nodes: Vec<f64> = (0..=degree)
        .map(|i| length * i as f64 / degree.max(1) as f64)
        .collect();
    let values: Vec<f64> = nodes.iter().map(|t| (3.0 * t / length).cos()).collect();
    Polynomial::through(&nodes, &values).unwrap()
}

fn value(pieces: &Pieces, polynomial: &Polynomial, length: f64, t: f64) -> f64 {
    let part = length / pieces.count() as f64;
    let number = ((t / part) as usize).min(pieces.count() - 1);
    let since = t - number as f64 * part;
    let mut factorial = 1.0;
    (0..=pieces.degree())
        .map(|order| {
            factorial *= (order as f64).max(1.0);
            pieces.derivative(polynomial, length, number, order) * since.powi(order as i32)
                / factorial
        })
        .sum()
}

#[test]
fn a_polynomial_of_the_degree_of_the_pieces_is_itself() {
    for (count, degree) in [(1, 0), (1, 3), (3, 0), (4, 1), (2, 5), (7, 2), (1, 7)] {
        let (pieces, length) = (Pieces::new(count, degree).unwrap(), 0.03);
        let true_one = polynomial(degree, length);
        for i in 0..=20 {
            let t = length * f64::from(i) / 20.0;
            let error = value(&pieces, &true_one, length, t) - true_one.value(t);
            assert!(error.abs() < 1e-10, "{count} {degree}: {error:e}");
        }
    }
}

/// One sub-step of degree 0: the mean.
#[test]
fn a_single_constant_is_the_mean() {
    let pieces = Pieces::new(1, 0).unwrap();
    let line = Polynomial::through(&[0.0, 2.0], &[1.0, 5.0]).unwrap();
    assert!((pieces.derivative(&line, 2.0, 0, 0) - 3.0).abs() < 1e-14);
}

/// The integrals with powers of time, by the midpoints of many parts, are those of the true input.
#[test]
fn moments_over_the_whole_step_are_kept() {
    for (count, degree) in [(2, 0), (4, 0), (6, 0), (8, 0), (3, 1), (30, 0)] {
        let (pieces, length) = (Pieces::new(count, degree).unwrap(), 0.7);
        let true_one = polynomial(5, length);
        let parts = 840 * 4;
        for power in 0..(count * (degree + 1)).min(MAX_WEIGHTS) {
            let terms = (0..parts).map(|i| {
                let t = length * (f64::from(i) + 0.5) / f64::from(parts);
                let missed = true_one.value(t) - value(&pieces, &true_one, length, t);
                missed * (t / length).powi(power as i32) / f64::from(parts)
            });
            let moment: f64 = terms.sum();
            assert!(
                moment.abs() < 2e-6,
                "{count} {degree}: moment {power} is {moment:e}"
            );
        }
    }
}

/// A mass under a force, `x'' = u`: the position at the end is off with the order that the moments promise, here 0 from two pieces on.
#[test]
fn pieces_stay_near_the_polynomial() {
    for count in 1..=8 {
        let pieces = Pieces::new(count, 0).unwrap();
        let true_one = polynomial(5, 1.0);
        for i in 0..count {
            let middle = (i as f64 + 0.5) / count as f64;
            let apart = pieces.derivative(&true_one, 1.0, i, 0) - true_one.value(middle);
            assert!(apart.abs() < 0.6 / count as f64, "{count}, {i}: {apart}");
        }
    }
}
