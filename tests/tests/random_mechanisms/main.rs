//! Random planar mechanisms with a tolerance, against the same as one system of bodies in one solver: trees and rings of links whose masses
//! differ by up to four decades. A run misses its tolerance by no more than a factor of ten, or says so.

#![allow(clippy::unwrap_used, missing_docs)]

mod mechanism;

use linchpin::connect::Place;
use linchpin_master::results::Warning;
use linchpin_master::setup::Options;
use linchpin_tests::evidence;
use linchpin_tests::runs::{run, try_run};
use linchpin_tests::scenes::with_settings;
use mechanism::{Mechanism, mechanism};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// Settings, and the tolerances that their order is made for.
const METHODS: [(&str, &[f64]); 4] = [
    ("hermite degree=2", &[1e-3, 1e-6]),
    ("hermite degree=3", &[1e-3, 1e-6, 1e-9]),
    ("hermite degree=automatic", &[1e-3, 1e-6, 1e-9]),
    ("weighted", &[1e-3, 1e-6]),
];

/// A start that is disturbed grows by less than this.
const MOST_GROWTH: f64 = 10.0;

/// By what the start is disturbed.
const DISTURBANCE: f64 = 1e-6;

/// A mechanism with its motion.
struct Reference {
    mechanism: Mechanism,
    /// Position, velocity and acceleration of every coordinate of the ends, at equal distances in time.
    motions: Vec<[Vec<f64>; 3]>,
    /// The largest displacement.
    motion: f64,
}

impl Reference {
    /// Those of the family that do not forget their start meanwhile.
    fn some(count: usize) -> Vec<Self> {
        let seed = *b"random mechanisms of linked rods";
        println!("seed {}", String::from_utf8_lossy(&seed));
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &seed);
        let mut runner = TestRunner::new_with_rng(Config::default(), rng);
        let mut draw = || mechanism().new_tree(&mut runner).unwrap().current();
        let all = std::iter::repeat_with(move || Self::of(draw()));
        all.flatten().take(count).collect()
    }

    fn of(mechanism: Mechanism) -> Option<Self> {
        let motions = |mechanism: &Mechanism| {
            let scene = with_settings(&mechanism.monolith(), "", &[]);
            let found = run(&scene, Place::InProcess);
            let columns = mechanism.columns("all.link", "-");
            let of = |names: [String; 3]| names.map(|name| found.column(&name));
            columns.into_iter().map(of).collect::<Vec<_>>()
        };
        let own = motions(&mechanism);
        let disturbed = motions(&mechanism.disturbed(DISTURBANCE));
        let positions = || own.iter().map(|[x, ..]| x);
        let size = positions()
            .flatten()
            .fold(0.0, |size: f64, x| size.max(x.abs()));
        let displacement = |x: &Vec<f64>| difference(x.iter().map(|own| [*own, x[0]]));
        let apart = positions().zip(&disturbed).map(|(x, [disturbed, ..])| {
            difference(x.iter().zip(disturbed).map(|(x, other)| [*x, *other]))
        });
        let growth = apart.fold(0.0, f64::max) / (DISTURBANCE * size);
        let motion = positions().map(displacement).fold(0.0, f64::max);
        (growth < MOST_GROWTH).then_some(Self {
            motion,
            motions: own,
            mechanism,
        })
    }

    /// The largest error of a run at its macro points, of the motion; and whether it says a word against itself.
    fn error(&self, coupling: &str) -> (f64, bool) {
        let scene = with_settings(&self.mechanism.scene(), coupling, &[]);
        let Ok(found) = try_run(&scene, Place::InProcess, &Options::default()) else {
            return (f64::INFINITY, true);
        };
        let times = found.column("t");
        let columns = self.mechanism.columns("link", ".");
        let errors = columns
            .iter()
            .zip(&self.motions)
            .map(|([name, ..], motion)| {
                let pairs = found.column(name).into_iter().zip(&times);
                difference(pairs.map(|(x, t)| [x, self.position(motion, *t)]))
            });
        let warnings = found.statistics.warnings();
        let is_told = warnings.iter().any(Warning::is_against_results);
        (errors.fold(0.0, f64::max) / self.motion, is_told)
    }

    /// A coordinate at time `t`, by the polynomial of degree 5 through both neighbours.
    fn position(&self, [x, v, a]: &[Vec<f64>; 3], t: f64) -> f64 {
        let intervals = x.len() - 1;
        let step = self.mechanism.time() / intervals as f64;
        let number = ((t / step) as usize).min(intervals - 1);
        let s = t / step - number as f64;
        let start = [x[number], step * v[number], step * step * a[number]];
        let next = number + 1;
        let end = [x[next], step * v[next], step * step * a[next]];
        // What the parabola of the start misses at the end, its rate and its second derivative.
        let missed = end[0] - start[0] - start[1] - start[2] / 2.0;
        let rate = end[1] - start[1] - start[2];
        let bend = end[2] - start[2];
        let cubic = 10.0 * missed - 4.0 * rate + bend / 2.0;
        let quartic = -15.0 * missed + 7.0 * rate - bend;
        let quintic = 6.0 * missed - 3.0 * rate + bend / 2.0;
        start[0] + s * (start[1] + s * (start[2] / 2.0 + s * (cubic + s * (quartic + s * quintic))))
    }
}

/// The largest difference of some pairs.
fn difference(pairs: impl Iterator<Item = [f64; 2]>) -> f64 {
    pairs.map(|[a, b]| (a - b).abs()).fold(0.0, f64::max)
}

/// What became of the runs of one method with one tolerance.
#[derive(Default)]
struct Count {
    /// Off by up to the tolerance, up to ten times, up to a hundred times, and more.
    within: [usize; 4],
    /// Warned of or ended, although others with such an error are not.
    told: usize,
    /// By more than ten times the tolerance, without a word.
    silent: Vec<String>,
}

fn count(references: &[Reference], coupling: &str, tolerance: f64) -> Count {
    let mut count = Count::default();
    for (number, reference) in references.iter().enumerate() {
        let (error, is_told) =
            reference.error(&format!("method={coupling} tolerance={tolerance:e}"));
        let place = [1.0, 10.0, 100.0]
            .iter()
            .position(|&times| error <= times * tolerance);
        count.within[place.unwrap_or(3)] += 1;
        count.told += usize::from(is_told);
        if error > 10.0 * tolerance && !is_told {
            count.silent.push(format!(
                "number {number}: {error:.1e} {:?}",
                reference.mechanism
            ));
        }
    }
    count
}

/// The table of so many mechanisms, the number of its runs, and those of them that are off by more than ten tolerances without a word.
fn table(cases: usize) -> (String, usize, Vec<String>) {
    let references = Reference::some(cases);
    let mut table = String::from(
        "| method | tolerance | error up to 1 | 10 | 100 tolerances | more | above 10 without a word | with a word |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    let (mut silent, mut runs) = (Vec::new(), 0);
    for (coupling, tolerances) in METHODS {
        for &tolerance in tolerances {
            let count = count(&references, coupling, tolerance);
            let [one, ten, hundred, more] = count.within;
            let (quiet, told) = (count.silent.len(), count.told);
            let row = format!(
                "| {coupling} | {tolerance:e} | {one} | {ten} | {hundred} | {more} | {quiet} | {told} |\n"
            );
            print!("{row}");
            table += &row;
            let named =
                { count.silent.into_iter() }.map(|one| format!("{coupling}, {tolerance:e}: {one}"));
            silent.extend(named);
            runs += cases;
        }
    }
    (table, runs, silent)
}

#[test]
fn tolerances_are_met_or_a_word_is_said() {
    let (_, runs, silent) = table(40);
    assert!(silent.len() * 1000 <= runs, "of {runs} runs: {silent:#?}");
}

#[test]
#[ignore = "takes three minutes; writes the table of the page with LINCHPIN_WRITE=1"]
fn table_of_random_mechanisms() {
    const COMMAND: &str =
        "cargo test --release --workspace --test random_mechanisms -- --ignored --nocapture";
    let (table, _, silent) = table(100);
    evidence::show("step-size.md", "random mechanisms", COMMAND, &table);
    println!("without a word: {silent:#?}");
}
