//! Limits in words, in degrees and metres.

use super::LimitFinding;
use crate::ocp::Interval;
use crate::problem::LimitId;
use crate::system::Component;

/// One sentence about what cannot hold, by a motion whose refinement `converged` or did not.
pub(super) fn cannot_hold(limits: &[LimitFinding], converged: bool) -> String {
    sentence(limits, |floor, works| match (floor, converged) {
        (Some(floor), true) => {
            format!("cannot hold; no bound below {floor} can work, {works} was found to")
        }
        (None, true) => {
            format!("cannot hold; the smallest bound that was found to work is {works}")
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
    let number = |value: f64| digits(value * factor);
    if finding.component == Component::RotationAngle {
        format!("{}{unit}", number(bound.upper))
    } else if finding.limit == LimitId::KeepOut {
        format!("a clearance of {:.4}{unit}", bound.lower * factor)
    } else if bound.lower == -bound.upper {
        format!("±{}{unit}", number(bound.upper))
    } else {
        format!("[{}, {}]{unit}", number(bound.lower), number(bound.upper))
    }
}

/// Two decimals; below one three digits that count, so that a small bound is not shown as zero.
fn digits(value: f64) -> String {
    if value == 0.0 || value.abs() >= 0.995 || !value.is_finite() {
        return format!("{value:.2}");
    }
    let decimals = 2 - value.abs().log10().floor().max(-9.0) as i32;
    format!("{value:.*}", decimals.max(2) as usize)
}

#[cfg(test)]
mod tests {
    use super::digits;

    #[test]
    fn a_small_bound_is_not_shown_as_zero() {
        for (value, shown) in [
            (29.1942, "29.19"),
            (-1.5, "-1.50"),
            (0.9, "0.900"),
            (0.00495, "0.00495"),
            (0.0, "0.00"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(digits(value), shown);
        }
    }
}
