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
    is_sparse: bool,
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

fn measure(arrangement: Arrangement, bodies: usize) -> Solution {
    let (arrangement, hinges) = arrangement;
    let pattern = hinges::pattern(bodies, &hinges(bodies));
    let [dense, sparse] =
        [LinearSolver::dense, LinearSolver::sparse].map(|solver| time(solver(&pattern), &pattern));
    Solution {
        arrangement,
        bodies,
        dense,
        sparse,
        is_sparse: LinearSolver::new(&pattern).is_sparse(),
    }
}

/// Shows and returns the times of all arrangements.
pub fn show() -> Vec<Solution> {
    let mut table = String::from("| bodies |");
    for (arrangement, _) in ARRANGEMENTS {
        table += &format!(" {arrangement}: dense | sparse |");
    }
    table += "\n|---|---|---|---|---|---|---|---|---|\n";
    let mut solutions = Vec::new();
    for bodies in BODIES {
        table += &format!("| {bodies} |");
        for arrangement in ARRANGEMENTS {
            let solution = measure(arrangement, bodies);
            for (time, is_chosen) in [
                (solution.dense, !solution.is_sparse),
                (solution.sparse, solution.is_sparse),
            ] {
                let bold = if is_chosen { "**" } else { "" };
                let digits = if time < 1000.0 { 1 } else { 0 };
                table += &format!(" {bold}{time:.digits$}{bold} |");
            }
            solutions.push(solution);
        }
        table.push('\n');
    }
    crate::show("linear solver", &table);
    solutions
}
