//! The progress bar of a study.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over `all` runs, called `unit`; hidden unless `is_shown`.
pub fn bar(all: usize, unit: &str, is_shown: bool) -> ProgressBar {
    if !is_shown {
        return ProgressBar::hidden();
    }
    let template = format!("{{bar:40}} {{pos}}/{{len}} {unit}  {{per_sec}}  {{eta}} left");
    let bar = ProgressBar::new(all as u64);
    match ProgressStyle::with_template(&template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
