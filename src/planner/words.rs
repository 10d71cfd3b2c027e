//! Limits in words, in degrees and metres.

use super::LimitFinding;
use crate::digits::digits;
use crate::ocp::Interval;
use crate::problem::LimitId;
use crate::system::Component;

/// One sentence about what cannot hold, by a motion whose refinement `converged` or did not.
pub(super) fn cannot_hold(limits: &[LimitFinding], converged: bool) -> String {
    let verb = if converged {
        "cannot hold; the smallest bound that was found to work is"
    } else {
        "was not found to hold; no bound that works is known, on a coarse mesh it would be"
    };
    sentence(limits, verb)
}

/// One sentence that says of every limit, by `verb`, what stands to the bound that would hold;
/// limits of the same bound on the same component share their part of it.
pub(super) fn sentence(limits: &[LimitFinding], verb: &str) -> String {
    let mut parts: Vec<(Vec<String>, &LimitFinding)> = Vec::new();
    for finding in limits {
        let limit = format!("{} = {}", finding.limit, shown(finding, &finding.bound));
        let same = |other: &LimitFinding| {
            other.component == finding.component
                && other.bound == finding.bound
                && shown(other, &other.smallest_bound) == shown(finding, &finding.smallest_bound)
        };
        match parts.iter_mut().find(|(_, other)| same(other)) {
            Some((keys, _)) => keys.push(limit),
            None => parts.push((vec![limit], finding)),
        }
    }
    let part = |(keys, finding): &(Vec<String>, &LimitFinding)| {
        format!(
            "{} ({}) {verb} {}",
            keys.join(" and "),
            finding.name,
            shown(finding, &finding.smallest_bound)
        )
    };
    parts.iter().map(part).collect::<Vec<_>>().join("; ")
}

/// A bound as a person reads it.
fn shown(finding: &LimitFinding, bound: &Interval) -> String {
    let (factor, unit) = finding.unit.readable();
    let number = |value: f64| digits(value * factor, 2, 3);
    if finding.component == Component::RotationAngle {
        format!("{}{unit}", number(bound.upper))
    } else if finding.limit == LimitId::KeepOut {
        format!(
            "a clearance of {}{unit}",
            digits(bound.lower * factor, 4, 3)
        )
    } else if bound.lower == -bound.upper {
        format!("±{}{unit}", number(bound.upper))
    } else {
        format!("[{}, {}]{unit}", number(bound.lower), number(bound.upper))
    }
}
