//! Progress bars.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar of this length and look; hidden unless `is_shown`.
pub fn bar(length: u64, template: &str, is_shown: bool) -> ProgressBar {
    if !is_shown {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(length);
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        // Templates are fixed; the plain style still shows how far the work is.
        Err(_) => bar,
    }
}
