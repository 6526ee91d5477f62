//! The report for people.

use std::fmt;

use linchpin_proto::readable::number;

use super::{CheckReport, Report};
use crate::conformance::compare::Difference;
use crate::conformance::verdict::{Finding, Grade};

/// Differing values that are shown of one finding.
const SHOWN: usize = 5;

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let steps: Vec<String> = self.steps.iter().map(|&step| number(step)).collect();
        writeln!(
            f,
            "{} {}, model {}, macro step {} s\n",
            self.worker,
            self.worker_version,
            self.model,
            steps.join(", ")
        )?;
        self.checks
            .iter()
            .try_for_each(|check| write_check(f, check))?;
        if let Some(words) = &self.last_words {
            writeln!(f, "\nthe worker does not answer any more{words}")?;
        }
        writeln!(
            f,
            "\n{} passed, {} with a warning, {} failed, {} not applicable",
            self.count(Grade::Pass),
            self.count(Grade::Warn),
            self.count(Grade::Fail),
            self.count(Grade::NotApplicable)
        )
    }
}

fn write_check(f: &mut fmt::Formatter<'_>, check: &CheckReport) -> fmt::Result {
    let (grade, name) = (check.grade.word(), check.name);
    match (check.grade, &check.findings[..]) {
        (Grade::NotApplicable, [reason, ..]) => {
            writeln!(f, "{grade:<15}{name:<19}{}", reason.text)?
        }
        _ => writeln!(f, "{grade:<15}{name:<19}{}{}", check.title, margin(check))?,
    }
    if check.grade > Grade::NotApplicable {
        for finding in &check.findings {
            write_finding(f, finding)?;
        }
        writeln!(f, "{:17}look at: {}", "", check.look_at)?;
    }
    check
        .notes
        .iter()
        .try_for_each(|note| writeln!(f, "{:17}note: {note}", ""))
}

/// How far the worst of the values that agree is from what is allowed.
fn margin(check: &CheckReport) -> String {
    let share = check.worst.as_ref().map(Difference::ratio);
    match (check.grade, share) {
        (Grade::Pass, Some(share)) if share > 0.0 => format!(
            " ({} values, {} % of what is allowed)",
            check.compared,
            number((100.0 * share * 10.0).round() / 10.0)
        ),
        (Grade::Pass, _) if check.compared > 0 => {
            format!(" ({} values, no difference)", check.compared)
        }
        _ => String::new(),
    }
}

fn write_finding(f: &mut fmt::Formatter<'_>, finding: &Finding) -> fmt::Result {
    writeln!(f, "{:17}{}", "", finding.text)?;
    let mut differences: Vec<&Difference> = finding.differences.iter().collect();
    differences.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
    for own in differences.iter().take(SHOWN) {
        writeln!(f, "{:19}{}", "", line(own))?;
    }
    match differences.len().saturating_sub(SHOWN) {
        0 => Ok(()),
        more => writeln!(f, "{:19}and {more} more", ""),
    }
}

fn line(own: &Difference) -> String {
    let values = format!(
        "{}: {} instead of {}",
        own.place,
        number(own.found),
        number(own.expected)
    );
    match own.allowed > 0.0 {
        true => format!("{values}, may be off by {:.1e}", own.allowed),
        false => format!("{values}, by {:.1e}", own.found - own.expected),
    }
}
