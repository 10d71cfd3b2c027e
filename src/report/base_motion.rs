//! The base's motion beside that without planning, in words and numbers.

use super::format::degrees;
use crate::study::{BaseMotion, Baselines, Gain};

/// Label and angles of each motion that there is without planning.
pub(super) fn beside(found: &Baselines) -> Vec<(&'static str, String)> {
    let shown = |motion: BaseMotion| {
        format!(
            "largest {}, final {}",
            degrees(motion.largest),
            degrees(motion.last)
        )
    };
    [("straight line", found.straight), ("matpm", found.matpm)]
        .into_iter()
        .filter_map(|(label, motion)| Some((label, shown(motion?))))
        .collect()
}

/// A sentence where planning gained little over the straight joint path.
pub(super) fn remark(planned: BaseMotion, found: &Baselines) -> Option<String> {
    let straight = found.straight?;
    let helps = "cost.preset = \"still\", a weight on cost.peak_base_attitude, or a search from \
                 many starts may turn it less";
    match Gain::of(planned, straight) {
        Gain::Needless | Gain::Clear => None,
        Gain::Little => Some(format!(
            "the base turns {} less than along the straight joint path, {} against {}; {helps}",
            match planned.largest < straight.largest {
                true => "hardly",
                false => "no",
            },
            degrees(planned.largest),
            degrees(straight.largest)
        )),
        Gain::EndAlone => Some(format!(
            "the base ends less turned than along the straight joint path, but turns by {} on its \
             way, {} there; {helps}",
            degrees(planned.largest),
            degrees(straight.largest)
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plan_that_turns_the_base_as_far_is_not_said_to_turn_it_less() {
        let motion = |largest| BaseMotion {
            largest,
            last: largest,
        };
        let straight = Baselines {
            straight: Some(motion(0.5)),
            ..Baselines::default()
        };
        let said = |largest| remark(motion(largest), &straight).unwrap_or_default();
        assert!(said(0.49).contains("turns hardly less than along"));
        assert!(said(0.5).contains("turns no less than along"));
        assert!(said(0.6).contains("turns no less than along"));
        assert_eq!(said(0.1), "");
    }
}
