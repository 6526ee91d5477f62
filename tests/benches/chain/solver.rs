//! One solution of the coupling system, dense and sparse.

use linchpin_master::system::pattern::Pattern;
use linchpin_master::system::solve::LinearSolver;
use linchpin_tests::hinges;

use crate::least_time;

const BODIES: [usize; 11] = [4, 6, 8, 10, 12, 16, 24, 32, 64, 128, 256];

type Arrangement = (&'static str, fn(usize) -> Vec<[usize; 2]>);

const ARRANGEMENTS: [Arrangement; 4] = [
    ("chain", hinges::chain),
    ("ring", hinges::ring),
    ("tree", hinges::tree),
    ("star", hinges::star),
];

/// Times in us.
pub struct Solution {
    pub arrangement: &'static str,
    pub bodies: usize,
    pub dense: f64,
    pub sparse: f64,
}

/// Numbers without a visible relation, larger on the diagonal.
fn values(pattern: &Pattern) -> Vec<f64> {
    let places = pattern.rows().iter().zip(pattern.columns()).enumerate();
    let value = |(entry, (row, column))| {
        let own = if row == column { 4.0 } else { 0.0 };
        own + (1.7 * entry as f64).sin()
    };
    places.map(value).collect()
}

fn time(mut solver: LinearSolver, pattern: &Pattern) -> f64 {
    let values = values(pattern);
    let mut rhs = vec![1.0; pattern.size()];
    let turns = (4_000 / pattern.size()).max(4);
    least_time(turns, || {
        rhs.fill(1.0);
        solver.solve(pattern, &values, &mut rhs).unwrap();
    })
}

/// Prints and returns the times of all arrangements.
pub fn print_table() -> Vec<Solution> {
    println!("\nOne solution of the coupling system in us\n");
    println!("| bodies | arrangement | variables | entries | dense | sparse | chosen |");
    println!("|---|---|---|---|---|---|---|");
    let mut solutions = Vec::new();
    for (arrangement, hinges) in ARRANGEMENTS {
        for bodies in BODIES {
            let pattern = hinges::pattern(bodies, &hinges(bodies));
            let [dense, sparse] = [LinearSolver::dense, LinearSolver::sparse]
                .map(|solver| time(solver(&pattern), &pattern));
            let chosen = match LinearSolver::new(&pattern).is_sparse() {
                true => "sparse",
                false => "dense",
            };
            println!(
                "| {bodies} | {arrangement} | {} | {} | {dense:.1} | {sparse:.1} | {chosen} |",
                pattern.size(),
                pattern.entries()
            );
            solutions.push(Solution {
                arrangement,
                bodies,
                dense,
                sparse,
            });
        }
    }
    solutions
}
