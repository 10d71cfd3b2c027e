//! Where the points of a front are farthest apart.

use super::point::ParetoPoint;

/// Part of the distance of two neighbours within which a point between them is at one of them.
const AT_AN_END: f64 = 0.05;
/// Ratio of two factors below which there is nothing between them.
const NEXT: f64 = 1.01;

/// The first of the two neighbours, both solved, that are farthest apart; those with a factor of
/// `closed` as the first are left out.
pub(super) fn widest(points: &[ParetoPoint], closed: &[f64]) -> Option<usize> {
    let gaps = (1..points.len()).filter_map(|k| {
        let [a, b] = [&points[k - 1], &points[k]];
        let is_open = a.is_solved()
            && b.is_solved()
            && b.factor > NEXT * a.factor
            && !closed.contains(&a.factor);
        is_open.then(|| (k - 1, distance(points, a, b)))
    });
    let widest = gaps.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (widest.1 > 0.0).then_some(widest.0)
}

/// Whether `point`, planned between two neighbours, is at one of them.
pub(super) fn is_at_an_end(point: &ParetoPoint, neighbours: &[ParetoPoint]) -> bool {
    let apart = |end: &ParetoPoint| distance(neighbours, point, end);
    let least = neighbours.iter().map(apart).fold(f64::INFINITY, f64::min);
    // The whole distance is √2: each coordinate counts in parts of the neighbours' own range.
    !point.is_solved() || least < AT_AN_END
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
