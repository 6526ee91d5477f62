//! The report for build servers: one suite, a case for every check.

use std::fmt::Write;

use super::{CheckReport, Report};
use crate::conformance::verdict::Grade;

impl Report {
    /// The report as JUnit XML. A warning is a case that passes with output.
    pub fn to_junit(&self) -> String {
        let suite = format!("linchpin conformance of {} {}", self.worker, self.model);
        let seconds: f64 = self.checks.iter().map(|check| check.seconds).sum();
        let mut text = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" time=\"{seconds:.3}\">\n",
            escaped(&suite),
            self.checks.len(),
            self.count(Grade::Fail),
            self.count(Grade::NotApplicable)
        );
        text.extend(self.checks.iter().map(case));
        text + "</testsuite>\n"
    }
}

fn case(check: &CheckReport) -> String {
    let mut text = format!(
        "  <testcase classname=\"conformance\" name=\"{}\" time=\"{:.3}\">\n",
        escaped(check.name),
        check.seconds
    );
    let found = escaped(&findings(check));
    match check.grade {
        Grade::Pass => {}
        Grade::NotApplicable => text += &format!("    <skipped message=\"{found}\"/>\n"),
        Grade::Warn => text += &format!("    <system-out>{found}</system-out>\n"),
        Grade::Fail => {
            text += &format!(
                "    <failure message=\"{}\">{found}</failure>\n",
                escaped(check.title)
            );
        }
    }
    text + "  </testcase>\n"
}

fn findings(check: &CheckReport) -> String {
    let mut text = String::new();
    for finding in &check.findings {
        text += &finding.text;
        for own in &finding.differences {
            // A String takes everything.
            let _ = write!(
                text,
                "\n{}: {} instead of {}",
                own.place, own.found, own.expected
            );
        }
    }
    text
}

fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe += "&amp;",
            '<' => safe += "&lt;",
            '>' => safe += "&gt;",
            '"' => safe += "&quot;",
            '\n' | '\t' => safe.push(character),
            // XML 1.0 has no other control characters.
            control if control.is_control() => safe.push(' '),
            other => safe.push(other),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn markup_is_escaped() {
        assert_eq!(escaped("a<b & \"c\"\u{1}"), "a&lt;b &amp; &quot;c&quot; ");
    }
}
