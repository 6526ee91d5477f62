//! The description fits itself.

use std::collections::BTreeSet;

use linchpin_proto::v1::MarkerKind;

use super::{About, Check};
use crate::conformance::bench::Bench;
use crate::conformance::subject::{Marker, Subject};
use crate::conformance::verdict::{Grade, Stop, Verdict};

/// Names are unique, lists of markers have the lengths of their kind, and the tolerance is one.
pub struct Description;

impl Check for Description {
    fn about(&self) -> About {
        About {
            name: "description",
            title: "names are unique, markers complete, the tolerance positive",
            equation: "lengths of a marker's lists: 1; 2 or 3; 3, 6 or 7 by its kind",
            tolerance: "exact",
            look_at: "Describe: names of inputs, outputs and markers; the lists of each marker; InitializeReply.tolerance",
        }
    }

    fn run(&self, bench: &Bench<'_>, verdict: &mut Verdict) -> Result<(), Stop> {
        let subject = &bench.subject;
        let markers: Vec<String> = subject.markers.iter().map(|own| own.name.clone()).collect();
        let lists = [
            ("inputs", &subject.inputs),
            ("outputs", &subject.outputs),
            ("markers", &markers),
        ];
        for (what, names) in lists {
            let mut seen = BTreeSet::new();
            for name in names.iter().filter(|&name| !seen.insert(name)) {
                verdict.find(Grade::Fail, format!("two {what} have the name \"{name}\""));
            }
        }
        for marker in &subject.markers {
            examine(subject, marker, verdict);
        }
        match bench.told_tolerance {
            Some(told) if !(told > 0.0 && told.is_finite()) => verdict.find(
                Grade::Fail,
                format!(
                    "the tolerance of the solver is {told}; it must be positive, or absent for a solver that is exact up to \
                     rounding"
                ),
            ),
            _ => {}
        }
        Ok(())
    }
}

fn examine(subject: &Subject, marker: &Marker, verdict: &mut Verdict) {
    let [position, motion]: [&[usize]; 2] = match marker.kind {
        MarkerKind::Scalar => [&[1], &[1]],
        MarkerKind::Planar => [&[2, 3], &[2, 3]],
        MarkerKind::Spatial => [&[3, 7], &[3, 6]],
        MarkerKind::Unspecified => {
            let text = format!("marker \"{}\" has no kind", marker.name);
            return verdict.find(Grade::Fail, text);
        }
    };
    let lists = [
        ("position", &marker.position, position, &subject.outputs),
        ("velocity", &marker.velocity, motion, &subject.outputs),
        (
            "acceleration",
            &marker.acceleration,
            motion,
            &subject.outputs,
        ),
        ("load", &marker.load, motion, &subject.inputs),
    ];
    for (what, list, lengths, names) in lists {
        if !list.is_empty() && !lengths.contains(&list.len()) {
            let kind = marker.kind.as_str_name();
            let text = format!(
                "the {what} of marker \"{}\" has {} components; a marker of kind {kind} has {lengths:?}, or none",
                marker.name,
                list.len()
            );
            verdict.find(Grade::Fail, text);
        }
        let mut seen = BTreeSet::new();
        if let Some(&twice) = list.iter().find(|&&own| !seen.insert(own)) {
            let text = format!(
                "the {what} of marker \"{}\" names \"{}\" twice",
                marker.name, names[twice]
            );
            verdict.find(Grade::Fail, text);
        }
    }
}
