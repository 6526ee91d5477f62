//! Contact problems alone: random ones, dependent contacts, solvers against each other.

use linchpin_models::nonsmooth::contact::enumeration::{Count, Enumeration};
use linchpin_models::nonsmooth::contact::gauss_newton::{Damping, GaussNewton, Method};
use linchpin_models::nonsmooth::contact::uniqueness::Uniqueness;
use linchpin_models::nonsmooth::contact::{
    ContactSettings, ContactSolver, Jacobian, Law, Problem, SolverKind, Unsolved, Weights,
    gauss_seidel,
};
use proptest::prelude::*;

/// Numbers that look random, -1 to 1 (xorshift; Marsaglia 2003).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// `G = W^T M^-1 W` of `rows` rows of `n` numbers each.
fn delassus(rows: &[Vec<f64>], masses: &[f64]) -> Vec<f64> {
    let entry = |a: &Vec<f64>, b: &Vec<f64>| {
        let terms = a.iter().zip(b).zip(masses);
        terms.map(|((a, b), mass)| a * b / mass).sum::<f64>()
    };
    let pairs = rows
        .iter()
        .flat_map(|a| rows.iter().map(move |b| entry(a, b)));
    pairs.collect()
}

fn planar(friction: &[f64]) -> Vec<Law> {
    let laws = friction.iter().enumerate().flat_map(|(k, &coefficient)| {
        let normal = 2 * k;
        [
            Law::Normal,
            Law::Friction {
                normal,
                coefficient,
            },
        ]
    });
    laws.collect()
}

/// Two contacts in the plane with friction up to 0.5, of six coordinates, that both close.
fn random_problem(numbers: &mut Numbers) -> Problem {
    let mut row = |_| (0..6).map(|_| numbers.next()).collect();
    let rows: Vec<Vec<f64>> = (0..4).map(&mut row).collect();
    let friction = [0, 1].map(|_| 0.25 * (1.0 + numbers.next()));
    Problem {
        laws: planar(&friction),
        free: (0..4)
            .map(|row| match (row % 2, numbers.next()) {
                (0, free) => -free.abs(),
                (_, free) => free,
            })
            .collect(),
        delassus: delassus(&rows, &[1.0; 6]),
    }
}

fn method(jacobian: Jacobian) -> Method {
    Method {
        jacobian,
        weights: Weights::Automatic,
        tolerance: 1e-10,
        damping: Damping::None,
    }
}

fn velocities(problem: &Problem, x: &[f64]) -> Vec<f64> {
    (0..problem.len())
        .map(|row| problem.velocity(row, x))
        .collect()
}

#[test]
fn the_full_jacobian_converges_in_a_few_iterations() {
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let mut newton = GaussNewton::default();
    let mut uniqueness = Uniqueness::default();
    let [mut full, mut printed] = [(0, 0); 2];
    let mut problems = 0;
    while problems < 400 {
        let problem = random_problem(&mut numbers);
        if !uniqueness.is_certain(&problem) {
            continue;
        }
        problems += 1;
        for (jacobian, (iterations, failures)) in [
            (Jacobian::Full, &mut full),
            (Jacobian::AsPrinted, &mut printed),
        ] {
            let mut x = [0.0; 4];
            match newton.solve(&problem, method(jacobian), &mut x) {
                Some(taken) => *iterations += taken,
                None => *failures += 1,
            }
        }
    }
    let mean =
        |(iterations, failures): (usize, usize)| iterations as f64 / (problems - failures) as f64;
    assert_eq!(full.1, 0);
    assert!(mean(full) < 2.0, "{}", mean(full));
    assert!(mean(printed) > 8.0 && printed.1 > 0, "{}", mean(printed));
}

#[test]
fn solvers_agree() {
    let mut numbers = Numbers(0xd1b5_4a32_d192_ed03);
    let mut solver = ContactSolver::default();
    let (mut enumeration, mut uniqueness) = (Enumeration::default(), Uniqueness::default());
    for _ in 0..400 {
        let problem = random_problem(&mut numbers);
        let mut x = [0.0; 4];
        if !uniqueness.is_certain(&problem) {
            continue;
        }
        let settings = ContactSettings::default();
        let solved = solver.solve(&problem, &settings, &mut x).unwrap();
        assert!(!solved.is_ambiguous && solved.residual <= 1e-12);
        let expected = velocities(&problem, &x);
        let mut projected = [0.0; 4];
        let sweeps = gauss_seidel::solve(&problem, 1e-11, &mut projected);
        let mut listed = [f64::NAN; 4];
        assert_eq!(enumeration.solve(&problem, &mut listed), Count::One);
        let others = [sweeps.map(|_| projected), Some(listed)];
        for other in others.into_iter().flatten() {
            for (a, b) in expected.iter().zip(velocities(&problem, &other)) {
                assert!((a - b).abs() < 1e-8, "{a} {b} {problem:?}");
            }
        }
    }
}

#[test]
fn contacts_that_depend_on_each_other_share_their_force() {
    // The same contact three times, sliding, with a second one.
    let contact = [vec![0.3, 1.1], vec![1.2, -0.4]];
    let other = [vec![-0.7, 0.9], vec![0.8, 0.6]];
    let rows = [&contact, &contact, &contact, &other].map(|rows| rows.to_vec());
    let problem = Problem {
        laws: planar(&[0.13, 0.13, 0.13, 0.21]),
        free: vec![-1.0, 2.3, -1.0, 2.3, -1.0, 2.3, -0.4, 0.1],
        delassus: delassus(&rows.concat(), &[1.7, 0.6]),
    };
    let mut x = [0.0; 8];
    let settings = ContactSettings::default();
    let solved = ContactSolver::default().solve(&problem, &settings, &mut x);
    assert_eq!(solved.unwrap().solver, SolverKind::GaussNewton);
    assert!(x[0] > 0.1, "{x:?}");
    for k in [2, 4] {
        assert!(
            (x[k] - x[0]).abs() < 1e-12 && (x[k + 1] - x[1]).abs() < 1e-12,
            "{x:?}"
        );
    }
    let mut projected = [0.0; 8];
    assert!(gauss_seidel::solve(&problem, 1e-11, &mut projected).is_some());
    let pairs = velocities(&problem, &x);
    for (a, b) in pairs.iter().zip(velocities(&problem, &projected)) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

#[test]
fn coupled_stages_of_friction_in_space_stick() {
    // ED-alpha with rho_inf = 1/2 where a sliding mass stops: from zero forces the iteration cycles between sliding
    // states.
    let blocks = [[1.0, 1.0], [-1.0 / 3.0, 1.0 / 9.0]];
    let mut problem = Problem::default();
    for (stage, block) in blocks.into_iter().enumerate() {
        let normal = 3 * stage;
        let coefficient = 0.27;
        problem.laws.extend([
            Law::Normal,
            Law::Disc {
                normal,
                coefficient,
            },
            Law::Second,
        ]);
        for row in 0..3 {
            let entry = |column: usize| {
                if column % 3 == row {
                    2.554_7e-4 * block[column / 3]
                } else {
                    0.0
                }
            };
            problem.delassus.extend((0..6).map(entry));
        }
    }
    problem.free = vec![-6.853e-3, 0.0, 0.0, 7.614e-4, 4.776e-5, -3.395e-5];
    let mut x = [0.0; 6];
    let settings = ContactSettings::default();
    let solved = ContactSolver::default()
        .solve(&problem, &settings, &mut x)
        .unwrap();
    assert_eq!(solved.solver, SolverKind::GaussNewtonRestarted);
    assert!(
        velocities(&problem, &x).iter().all(|v| v.abs() < 1e-15),
        "{x:?}"
    );
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let problem = Problem {
        laws: vec![Law::Normal],
        free: vec![f64::NAN],
        delassus: vec![1.0],
    };
    let settings = ContactSettings::default();
    let solved = ContactSolver::default().solve(&problem, &settings, &mut [0.0]);
    assert_eq!(solved, Err(Unsolved::NotFinite));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Any number of contacts, dependent or not: what is returned meets all laws, and nothing is returned otherwise.
    #[test]
    fn a_solution_has_a_small_residual(
        rows in proptest::collection::vec(proptest::collection::vec(-2f64..2.0, 3), 2..9),
        masses in proptest::collection::vec(0.01f64..10.0, 3),
        friction in proptest::collection::vec(0f64..1.5, 4),
        free in proptest::collection::vec(-3f64..3.0, 8),
        start in proptest::collection::vec(-3f64..3.0, 8),
        is_bilateral in any::<bool>(),
        in_space in any::<bool>(),
    ) {
        let mut laws = planar(&friction);
        if is_bilateral {
            laws[0] = Law::Equality;
        }
        if in_space {
            laws[2..5].copy_from_slice(&[
                Law::Normal,
                Law::Disc { normal: 2, coefficient: friction[1] },
                Law::Second,
            ]);
            laws[5] = Law::Normal;
        }
        let mut n = rows.len();
        if matches!(laws.get(n), Some(Law::Second)) {
            n -= 1;
        }
        laws.truncate(n);
        if matches!(laws[n - 1], Law::Disc { .. }) {
            laws.pop();
        }
        let n = laws.len();
        let is_attached = laws.iter().all(|law| match law {
            Law::Friction { normal, .. } => matches!(laws[*normal], Law::Normal | Law::Equality),
            _ => true,
        });
        prop_assume!(is_attached);
        let delassus = delassus(&rows[..n], &masses);
        prop_assume!((0..n).all(|k| delassus[k * (n + 1)] > 1e-3));
        // Free velocities that some motion has, so that dependent rows do not contradict each other.
        let free: Vec<f64> = rows[..n]
            .iter()
            .map(|row| row.iter().zip(&free).map(|(a, b)| a * b).sum())
            .collect();
        let problem = Problem { laws, free, delassus };
        let mut x = start[..n].to_vec();
        let solved = ContactSolver::default().solve(&problem, &ContactSettings::default(), &mut x);
        if let Ok(solved) = solved {
            let scale = problem.scale(&x);
            prop_assert!(problem.residual(&x) <= 1e-9 * scale, "{solved:?}");
            prop_assert_eq!(problem.residual(&x), solved.residual);
        }
    }

    /// A problem that is said to have one solution has one: the states have no second one.
    #[test]
    fn what_is_certain_is_unique(
        rows in proptest::collection::vec(proptest::collection::vec(-2f64..2.0, 6), 6),
        friction in proptest::collection::vec(0f64..2.0, 3),
        free in proptest::collection::vec(-3f64..3.0, 6),
    ) {
        let problem = Problem {
            laws: planar(&friction),
            delassus: delassus(&rows, &[1.0; 6]),
            free,
        };
        let is_certain = Uniqueness::default().is_certain(&problem);
        let count = Enumeration::default().solve(&problem, &mut [f64::NAN; 6]);
        if is_certain {
            prop_assert_eq!(count, Count::One);
        }
    }
}
