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
    let helps = "cost.preset = \"still\", or a weight on cost.peak_base_attitude, asks for less";
    match Gain::of(planned, straight) {
        Gain::Needless | Gain::Clear => None,
        Gain::Little => Some(format!(
            "the base turns hardly less than along the straight joint path, {} against {}; {helps}",
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
