//! Samples and the table.

use std::time::Instant;

use crate::BLOCK;
use crate::macro_steps::Messages;

/// One thing that is measured.
pub struct Series {
    /// What it is.
    pub name: &'static str,
    /// Whether it is the round that macro steps are compared with.
    pub is_reference: bool,
    once: Box<dyn FnMut()>,
    samples: Vec<f64>,
}

impl Series {
    /// Measures `once`, which is one macro step or one round.
    pub fn new(name: &'static str, once: impl FnMut() + 'static) -> Self {
        Self {
            name,
            is_reference: false,
            once: Box::new(once),
            samples: Vec::new(),
        }
    }

    /// Makes it the reference.
    pub fn reference(mut self) -> Self {
        self.is_reference = true;
        self
    }

    /// One sample.
    pub fn measure(&mut self) {
        let started = Instant::now();
        for _ in 0..BLOCK {
            (self.once)();
        }
        self.samples
            .push(started.elapsed().as_secs_f64() * 1e6 / f64::from(BLOCK));
    }

    fn quantile(&self, share: f64) -> f64 {
        let mut sorted = self.samples.clone();
        sorted.sort_by(f64::total_cmp);
        sorted[((sorted.len() - 1) as f64 * share).round() as usize]
    }
}

/// Prints medians, spread and the ratio to the reference.
pub fn print_table(series: &[Series], messages: &Messages) {
    println!(
        "two workers, {} B to each and {} B back in every macro step; medians of {} blocks of {BLOCK}",
        messages.request_bytes().len(),
        messages.reply_bytes().len(),
        series[0].samples.len()
    );
    let reference = series
        .iter()
        .find(|series| series.is_reference)
        .unwrap()
        .quantile(0.5);
    println!(
        "{:<52} {:>9} {:>17} {:>11} {:>9}",
        "", "us", "(10 % .. 90 %)", "per second", "ratio"
    );
    for series in series {
        let median = series.quantile(0.5);
        println!(
            "{:<52} {median:>9.2} {:>17} {:>11.0} {:>9.3}",
            series.name,
            format!(
                "({:.1} .. {:.1})",
                series.quantile(0.1),
                series.quantile(0.9)
            ),
            1e6 / median,
            median / reference
        );
    }
}
