//! When the errors of a refinement tell that it leads nowhere.

use super::Record;

/// Meshes after the first on which the error may not fall for the refinement to diverge.
const GROWING: usize = 3;
/// Factor by which the cost then is larger at least.
const GROWTH: f64 = 1.2;
/// Error below which nothing diverges.
const COARSE: f64 = 1e-3;
/// Error above which a mesh says nothing of a motion.
const WILD: f64 = 1.0;
/// Meshes after the first that tell of a divergence then, if the error rises from each to the next, and
/// factor by which the cost is larger at least on the last: that of the first alone may be far too
/// low.
const GROWING_WILDLY: usize = 2;
const WILD_GROWTH: f64 = 2.0;
/// Factor by which a cost grows on the second mesh already where there is no motion to be found: the bounds
/// that were kept between few points cannot be kept between more.
const FIRST_GROWTH: f64 = 10.0;

/// Whether no mesh has a smaller error than the first, far above the tolerance, and the cost has
/// grown: over several meshes, or over fewer where the error is larger than any motion's and
/// rises, the fewer the more the cost grows.
pub(super) fn diverges(records: &[Record], tolerance: f64) -> bool {
    let (first, later) = (&records[0], &records[1..]);
    let rough = |record: &Record| record.max_error >= first.max_error;
    let solved = |record: &Record| record.nlp_status.is_solved();
    let grows = |from: &Record, to: &Record, by: f64| to.objective > by * from.objective.abs();
    if !records.iter().all(solved)
        || !later.iter().all(rough)
        || first.max_error <= COARSE.max(tolerance)
    {
        return false;
    }
    let Some(last) = later.last() else {
        return false;
    };
    let mut pairs = records.windows(2);
    let is_wild = first.max_error > WILD && pairs.all(|pair| pair[1].max_error > pair[0].max_error);
    let growth = match later.len() {
        GROWING_WILDLY.. => WILD_GROWTH,
        _ => FIRST_GROWTH,
    };
    let is_long = later.len() >= GROWING;
    is_wild && grows(first, last, growth) || is_long && grows(first, last, GROWTH)
}
