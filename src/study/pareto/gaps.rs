//! Where the points of a front are farthest apart.

use super::point::ParetoPoint;

/// Part of the distance of two neighbours within which a point between them is at one of them.
const AT_AN_END: f64 = 0.05;
/// Ratio of two factors below which there is nothing between them for weights to find.
const NEXT: f64 = 1.01;
/// Part of the whole front's extent below which two neighbours are near enough.
const NEAR: f64 = 0.01;

/// How the part of a front between two neighbours is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum By {
    /// By weights between theirs.
    Weights,
    /// By a bound on the base's motion between theirs: no weights lead there.
    Bound,
}

/// The first of two neighbours, and how to get in between.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gap {
    pub first: usize,
    pub by: By,
}

/// The gap between two neighbours, both solved, that are farthest apart; `closed` are the factors of
/// the first neighbours of those that were tried, each with how.
pub(super) fn widest(points: &[ParetoPoint], closed: &[(f64, By)]) -> Option<Gap> {
    let gaps = (1..points.len()).filter_map(|k| {
        let [a, b] = [&points[k - 1], &points[k]];
        let tried = |by: By| closed.contains(&(a.factor, by));
        let weighable = a.bound.is_none() && b.bound.is_none() && b.factor > NEXT * a.factor;
        let by = match weighable && !tried(By::Weights) {
            true => By::Weights,
            false => By::Bound,
        };
        // A bound takes base motion from the first for more effort.
        let ordered = by == By::Weights || a.base > b.base && a.joints < b.joints;
        let is_open = a.is_solved() && b.is_solved() && ordered && !tried(by);
        is_open.then(|| (Gap { first: k - 1, by }, distance(points, a, b)))
    });
    let widest = gaps.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (widest.1 > NEAR).then_some(widest.0)
}

/// Whether `point`, planned between two neighbours, is at one of them, or no better than one.
pub(super) fn is_at_an_end(point: &ParetoPoint, neighbours: &[ParetoPoint]) -> bool {
    let apart = |end: &ParetoPoint| distance(neighbours, point, end);
    let least = neighbours.iter().map(apart).fold(f64::INFINITY, f64::min);
    let dominated = |end: &ParetoPoint| end.base <= point.base && end.joints <= point.joints;
    // The whole distance is √2: each coordinate counts in parts of the neighbours' own range.
    !point.is_solved() || least < AT_AN_END || neighbours.iter().any(dominated)
}

/// Distance of two points, each coordinate in parts of its range over all solved `points`.
fn distance(points: &[ParetoPoint], a: &ParetoPoint, b: &ParetoPoint) -> f64 {
    let along = |of: fn(&ParetoPoint) -> f64| {
        let values = points.iter().filter(|p| p.is_solved()).map(of);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        match high > low {
            true => (of(a) - of(b)) / (high - low),
            false => 0.0,
        }
    };
    along(|point| point.base).hypot(along(|point| point.joints))
}
