//! Limits in words, in degrees and metres.

use super::LimitFinding;
use crate::ocp::Interval;
use crate::problem::LimitId;
use crate::system::Component;
use crate::text::digits::digits;

/// One sentence about what cannot hold, by a motion whose refinement `converged` or did not.
pub(super) fn cannot_hold(limits: &[LimitFinding], converged: bool) -> String {
    sentence(limits, |floor, works| match (floor, converged) {
        (Some(floor), true) => {
            format!("cannot hold; no bound below {floor} can work, {works} was found to")
        }
        (None, true) => {
            format!("was not found to hold; the smallest bound that was found to work is {works}")
        }
        (Some(floor), false) => format!(
            "cannot hold; no bound below {floor} can work, none that works is known, on a coarse \
             mesh it would be {works}"
        ),
        (None, false) => format!(
            "was not found to hold; no bound that works is known, on a coarse mesh it would be \
             {works}"
        ),
    })
}

/// A sentence that says which limits no motion keeps, and what was found to work in their place.
pub(super) fn proven(limits: &[LimitFinding]) -> String {
    sentence(limits, |floor, works| match floor {
        Some(floor) => {
            format!("cannot hold; no bound below {floor} can work, {works} was found to")
        }
        None => format!(
            "cannot hold, whatever the motion; the smallest bound that was found to work is {works}"
        ),
    })
}

/// One sentence that says of every limit what `said` makes of the bound below which none can work,
/// where it is known, and of the one that would hold; limits of the same bound on the same component
/// share their part of it.
pub(super) fn sentence(
    limits: &[LimitFinding],
    said: impl Fn(Option<String>, String) -> String,
) -> String {
    let mut parts: Vec<(Vec<String>, &LimitFinding, Option<f64>)> = Vec::new();
    for finding in limits {
        let limit = format!("{} = {}", finding.limit, shown(finding, &finding.bound));
        let same = |other: &LimitFinding| {
            other.component == finding.component
                && other.bound == finding.bound
                && shown(other, &other.smallest_bound) == shown(finding, &finding.smallest_bound)
        };
        match parts.iter_mut().find(|(_, other, _)| same(other)) {
            Some((keys, _, floor)) => {
                keys.push(limit);
                // Together they have the higher floor.
                *floor = floor.iter().copied().chain(finding.floor).reduce(f64::max);
            }
            None => parts.push((vec![limit], finding, finding.floor)),
        }
    }
    let part = |(keys, finding, floor): &(Vec<String>, &LimitFinding, Option<f64>)| {
        let floor = floor.map(|floor| shown(finding, &Interval::symmetric(floor)));
        let said = said(floor, shown(finding, &finding.smallest_bound));
        format!("{} ({}) {said}", keys.join(" and "), finding.name)
    };
    parts.iter().map(part).collect::<Vec<_>>().join("; ")
}

/// A bound as a person reads it.
fn shown(finding: &LimitFinding, bound: &Interval) -> String {
    let (factor, unit) = finding.unit.readable();
    let number = |value: f64| digits(value * factor, 2, 3);
    if let Component::Orientation(_) = finding.component {
        // Its row is the sine of the angle between the two orientations.
        let angle = bound.upper.clamp(0.0, 1.0).asin().to_degrees();
        format!("±{}°", digits(angle, 2, 3))
    } else if finding.component == Component::RotationAngle {
        format!("{}{unit}", number(bound.upper))
    } else if finding.limit == LimitId::KeepOut {
        format!(
            "a clearance of {}{unit}",
            digits(bound.lower * factor, 4, 3)
        )
    } else if bound.lower == -bound.upper {
        format!("±{}{unit}", number(bound.upper))
    } else if bound.lower == f64::NEG_INFINITY {
        format!("at most {}{unit}", number(bound.upper))
    } else if bound.upper == f64::INFINITY {
        format!("at least {}{unit}", number(bound.lower))
    } else {
        format!("[{}, {}]{unit}", number(bound.lower), number(bound.upper))
    }
}
