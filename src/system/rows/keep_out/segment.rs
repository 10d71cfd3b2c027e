//! Signed distance of a segment to a solid at rest, m: the least of its points' distances, which
//! are a convex function along it.
//!
//! The nearest point is found with plain numbers, then carried into numbers with derivatives by a
//! Newton step on the condition that makes it nearest. That condition is linear along the segment
//! around the point, so that one step is exact in derivatives of every order.

use super::distance::Core;
use crate::autodiff::Scalar;
use std::array::from_fn;

/// Squared sine of the angle below which a segment counts as parallel to what it is nearest to.
/// The nearest point may then be anywhere on a stretch, and is held where it is.
const PARALLEL: f64 = 1e-8;

/// Rounding allowed for in lengths, relative to the largest.
const ROUNDING: f64 = 1e-12;

/// Points start + t·along, 0 ≤ t ≤ 1.
#[derive(Debug, Clone, Copy)]
struct Segment<S> {
    start: [S; 3],
    along: [S; 3],
}

impl<S: Scalar> Segment<S> {
    fn between(a: &[S; 3], b: &[S; 3]) -> Self {
        Self {
            start: *a,
            along: from_fn(|i| b[i] - a[i]),
        }
    }

    fn at(&self, t: S) -> [S; 3] {
        from_fn(|i| self.start[i] + t * self.along[i])
    }

    fn values(&self) -> Segment<f64> {
        Segment {
            start: self.start.map(|c| c.value()),
            along: self.along.map(|c| c.value()),
        }
    }
}

/// The plane of a face: which axis, and on which side.
type Face = (usize, f64);

const FACES: [Face; 6] = [
    (0, 1.0),
    (0, -1.0),
    (1, 1.0),
    (1, -1.0),
    (2, 1.0),
    (2, -1.0),
];

/// Height of a segment's points above the plane of a face: start + t·slope.
#[derive(Debug, Clone, Copy)]
struct Height<S> {
    start: S,
    slope: S,
}

impl<S: Scalar> Height<S> {
    fn at(&self, t: S) -> S {
        self.start + t * self.slope
    }
}

/// A parameter in 0..1 with derivatives: `step`, whose value is `t` up to rounding, or `t` held.
///
/// All that `step` depends on stays known where the parameter is at an end or held.
fn settled<S: Scalar>(t: f64, step: S, held: bool) -> S {
    let [low, high] = if held { [t, t] } else { [0.0, 1.0] };
    S::constant(low).max(step).min(S::constant(high))
}

impl Core {
    /// Distance of the segment between two points, negative where a part of it is inside.
    pub fn to_segment<S: Scalar>(&self, a: &[S; 3], b: &[S; 3]) -> S {
        let segment = Segment::between(a, b);
        let values = segment.values();
        let t = match self.deepest(&values) {
            Some(t) => self.deepest_by(&segment, t),
            None => self.nearest_by(&segment, self.nearest(&values)),
        };
        self.to_point(&segment.at(t))
    }

    fn height<S: Scalar>(&self, segment: &Segment<S>, (axis, side): Face) -> Height<S> {
        Height {
            start: segment.start[axis] * side - self.exit(axis),
            slope: segment.along[axis] * side,
        }
    }

    /// Where the segment is deepest inside; `None` where no part of it is inside.
    ///
    /// Inside, distance is the largest height: it is least at an end or where two heights are
    /// equal.
    fn deepest(&self, segment: &Segment<f64>) -> Option<f64> {
        if !self.has_inside() {
            return None;
        }
        let heights = FACES.map(|face| self.height(segment, face));
        let distance = |t: f64| {
            let heights = heights.iter().map(|height| height.at(t));
            heights.fold(f64::NEG_INFINITY, f64::max)
        };
        let equal = |a: &Height<f64>, b: &Height<f64>| (b.start - a.start) / (a.slope - b.slope);
        let pairs = (0..6).flat_map(|k| (0..k).map(move |l| [k, l]));
        let crossings = pairs.map(|[k, l]| equal(&heights[k], &heights[l]));
        let candidates = crossings
            .filter(|t| (0.0..=1.0).contains(t))
            .chain([0.0, 1.0]);
        let least = candidates
            .clone()
            .map(distance)
            .fold(f64::INFINITY, f64::min);
        if least >= 0.0 {
            return None;
        }
        // Where two of the candidates are deepest, all between them are.
        let deepest = candidates.filter(|&t| distance(t) <= least * (1.0 - ROUNDING));
        let ends = deepest.fold([1.0_f64, 0.0], |[low, high], t| [low.min(t), high.max(t)]);
        Some(0.5 * (ends[0] + ends[1]))
    }

    /// The parameter of the deepest point, whose value is `t`, with derivatives: one height that
    /// falls and one that rises stay equal.
    fn deepest_by<S: Scalar>(&self, segment: &Segment<S>, t: f64) -> S {
        let values = segment.values();
        let highest = |rising: bool| {
            let heights = FACES.map(|face| (face, self.height(&values, face)));
            let side = heights
                .into_iter()
                .filter(|(_, height)| (height.slope > 0.0) == rising);
            side.max_by(|(_, a), (_, b)| a.at(t).total_cmp(&b.at(t)))
        };
        let (Some((falling, f)), Some((rising, r))) = (highest(false), highest(true)) else {
            // A segment without length.
            return S::constant(t);
        };
        let largest =
            |lengths: &[f64; 3]| lengths.iter().fold(0.0, |most: f64, l| most.max(l.abs()));
        let length = largest(&values.along);
        // At an end, and on a stretch along the nearest face, the two are not equal.
        let apart =
            (f.at(t) - r.at(t)).abs() > 10.0 * ROUNDING * length.max(largest(&values.start));
        let flat = r.slope - f.slope < PARALLEL.sqrt() * length;
        let [f, r] = [falling, rising].map(|face| self.height(segment, face));
        let place = S::constant(t);
        let step = place + (f.at(place) - r.at(place)) / (r.slope - f.slope);
        settled(t, step, apart || flat)
    }

    /// Where a segment outside is nearest.
    ///
    /// The slope of the squared distance grows along the segment, and is straight between the
    /// planes of the faces.
    fn nearest(&self, segment: &Segment<f64>) -> f64 {
        let plane = |(axis, side): Face| {
            let t = (side * self.half(axis) - segment.start[axis]) / segment.along[axis];
            if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) }
        };
        let [a, b, c, d, e, f] = FACES.map(plane);
        let mut knots = [0.0, a, b, c, d, e, f, 1.0];
        knots.sort_unstable_by(f64::total_cmp);
        let slopes = knots.map(|t| self.slope(segment, t));
        let zero = |k: usize| {
            let (low, high) = (slopes[k], slopes[k + 1]);
            knots[k] - (knots[k + 1] - knots[k]) * low / (high - low)
        };
        let first = match slopes.iter().position(|slope| *slope >= 0.0) {
            Some(0) => 0.0,
            Some(k) => zero(k - 1),
            None => 1.0,
        };
        let last = match slopes.iter().rposition(|slope| *slope <= 0.0) {
            Some(7) => 1.0,
            Some(k) => zero(k),
            None => 0.0,
        };
        0.5 * (first + last)
    }

    /// The parameter of the nearest point, whose value is `t`, with derivatives: the slope of the
    /// squared distance stays zero.
    fn nearest_by<S: Scalar>(&self, segment: &Segment<S>, t: f64) -> S {
        let place = S::constant(t);
        let excess = self.excess(&segment.at(place));
        let mut curvature = S::zero();
        for (i, excess) in excess.iter().enumerate() {
            if self.half(i) == 0.0 || excess.value() != 0.0 {
                curvature += segment.along[i].square();
            }
        }
        let [x, y, z] = segment.along.map(|along| along.value().powi(2));
        let parallel = curvature.value() <= PARALLEL * (x + y + z);
        let step = place - self.slope(segment, place) / (curvature + f64::MIN_POSITIVE);
        settled(t, step, parallel)
    }

    /// Half the slope of the squared distance at a point of the segment.
    fn slope<S: Scalar>(&self, segment: &Segment<S>, t: S) -> S {
        let [x, y, z] = self.excess(&segment.at(t));
        let [along_x, along_y, along_z] = segment.along;
        x * along_x + y * along_y + z * along_z
    }

    /// From the nearest point of the core to a point outside, along each axis.
    fn excess<S: Scalar>(&self, point: &[S; 3]) -> [S; 3] {
        from_fn(|i| match self.half(i) {
            0.0 => point[i],
            half => point[i] - point[i].max(S::constant(-half)).min(S::constant(half)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::autodiff::HyperDual;

    type Second = HyperDual<6, 6>;

    /// A box, one of which z leads nowhere, and the axis of a capsule.
    fn cores() -> [Core; 3] {
        let solid = Core::new([0.4, 0.3, 0.2], 0.2);
        let closed = Core::new([0.4, 0.3, 2.0], 0.2).closed_along(2);
        [solid, closed, Core::new([0.5, 0.0, 0.0], 0.2)]
    }

    fn random_ends(random: &mut fastrand::Rng, size: f64) -> [[f64; 3]; 2] {
        [(); 2].map(|()| from_fn(|_| size * (2.0 * random.f64() - 1.0)))
    }

    #[test]
    fn no_point_of_the_segment_is_nearer() {
        const PLACES: u32 = 20_000;
        let mut random = fastrand::Rng::with_seed(5);
        let mut inside = 0;
        for round in 0..60 {
            let [a, b] = random_ends(&mut random, [0.3, 0.8, 1.5][round % 3]);
            for core in cores() {
                let found = core.to_segment(&a, &b);
                let segment = Segment::between(&a, &b);
                let places = (0..=PLACES).map(|k| f64::from(k) / f64::from(PLACES));
                let sampled = places.map(|t| core.to_point(&segment.at(t)));
                let expected = sampled.fold(f64::INFINITY, f64::min);
                let step =
                    segment.along.iter().map(|d| d * d).sum::<f64>().sqrt() / f64::from(PLACES);
                assert!(found <= expected + 1e-12, "{found} above {expected}");
                assert!(found >= expected - step, "{found} below {expected}");
                inside += usize::from(found < 0.0);
            }
        }
        assert!((20..100).contains(&inside), "{inside} inside");
    }

    #[test]
    fn parallel_segments() {
        let [solid, _, axis] = cores();
        // Along a face, above an edge, beside another segment, in line with it.
        for (core, a, b, expected) in [
            (&solid, [-1.0, 0.1, 0.5], [1.0, 0.1, 0.5], 0.3),
            (&solid, [-0.2, 0.7, 0.5], [0.1, 0.7, 0.5], 0.5),
            (&solid, [-1.0, 0.0, 0.1], [1.0, 0.0, 0.1], -0.1),
            (&axis, [-0.3, 0.0, 0.2], [2.0, 0.0, 0.2], 0.2),
            (&axis, [0.8, 0.4, 0.0], [2.0, 0.4, 0.0], 0.5),
            (&axis, [0.7, 0.0, 0.0], [0.9, 0.0, 0.0], 0.2),
            (&axis, [0.9, 0.4, 0.0], [0.9, 0.4, 0.0], 0.4_f64.hypot(0.4)),
        ] {
            let found = core.to_segment(&a, &b);
            assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
        }
    }

    /// Central differences of the distance and of its first derivatives.
    #[test]
    fn derivatives_of_first_and_second_order() {
        const STEP: f64 = 1e-5;
        let mut random = fastrand::Rng::with_seed(8);
        let seeded = |ends: &[[f64; 3]; 2]| -> [[Second; 3]; 2] {
            from_fn(|e| from_fn(|i| Second::seeded(ends[e][i], Some(3 * e + i), Some(3 * e + i))))
        };
        let mut checked = 0;
        for round in 0..60 {
            let ends = random_ends(&mut random, [0.3, 0.8, 1.5][round % 3]);
            for core in cores() {
                let at = |ends: &[[f64; 3]; 2]| {
                    let [a, b] = seeded(ends);
                    core.to_segment(&a, &b)
                };
                let found = at(&ends);
                let plain = core.to_segment(&ends[0], &ends[1]);
                assert!((found.value - plain).abs() < 1e-14);
                for k in 0..6 {
                    let moved = |by: f64| {
                        let mut ends = ends;
                        ends[k / 3][k % 3] += by;
                        at(&ends)
                    };
                    let (less, more) = (moved(-STEP), moved(STEP));
                    let slope = (more.value - less.value) / (2.0 * STEP);
                    let bent: [f64; 6] = from_fn(|l| (more.rows[l] - less.rows[l]) / (2.0 * STEP));
                    let near = |a: f64, b: f64, scale: f64| (a - b).abs() <= 1e-4 * (1.0 + scale);
                    // A kink between the two is no fault: the slopes there differ.
                    let kink = (0..6).any(|l| (more.rows[l] - less.rows[l]).abs() > 1e-2);
                    if kink {
                        continue;
                    }
                    checked += 1;
                    assert!(near(found.rows[k], slope, 1.0), "{} {slope}", found.rows[k]);
                    for (&one, two) in found.block[k].iter().zip(bent) {
                        assert!(near(one, two, two.abs() * 10.0), "{one} instead of {two}");
                    }
                }
            }
        }
        assert!(checked > 1000, "{checked}");
    }

    #[test]
    fn nothing_is_infinite_where_segments_meet_or_vanish() {
        for core in cores() {
            for (a, b) in [
                ([0.0; 3], [0.0; 3]),
                ([-0.5, 0.0, 0.0], [0.5, 0.0, 0.0]),
                ([0.0, -1.0, 0.0], [0.0, 1.0, 0.0]),
                ([-0.4, -0.3, 0.2], [0.4, 0.3, 0.2]),
            ] {
                let [a, b]: [[Second; 3]; 2] = from_fn(|e| {
                    from_fn(|i| Second::seeded([a, b][e][i], Some(3 * e + i), Some(3 * e + i)))
                });
                let found = core.to_segment(&a, &b);
                let finite = found.rows.iter().chain(found.block.iter().flatten());
                assert!(finite.copied().all(f64::is_finite), "{found:?}");
            }
        }
    }
}
