//! How segments tile the time axis.

use super::Rule;
use std::collections::HashMap;
use std::sync::Arc;

/// A mesh that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// No segment at all.
    #[error("a mesh needs at least one segment")]
    NoSegments,
    /// A segment without points.
    #[error("segment {segment} has no collocation points; it needs at least one")]
    NoPoints {
        /// Segment, counted from 1.
        segment: usize,
    },
    /// More points than memory should be asked for.
    #[error("{what} of {found} collocation points; expected at most {most}")]
    TooMany {
        /// "a mesh" or "a segment".
        what: &'static str,
        /// How many there would be; the largest number there is where that is no number.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// One more breakpoint than segments is needed.
    #[error("{breakpoints} breakpoints do not bound {segments} segments")]
    Mismatch {
        /// Number of breakpoints given.
        breakpoints: usize,
        /// Number of segments given.
        segments: usize,
    },
    /// Breakpoints must rise from 0 to 1.
    #[error("breakpoint {index} is {value}; breakpoints must rise from 0 to 1")]
    NotRising {
        /// Breakpoint, counted from 0.
        index: usize,
        /// Its value, fraction of the duration.
        value: f64,
    },
}

/// Segments s = 1 … S with their breakpoints and numbers of LGR points.
///
/// Breakpoints are fractions of the duration, 0 = t₀ and 1 = t_f, so that a mesh holds for a free
/// final time as well. Neighbouring segments share the node between them (Remark 3).
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    breakpoints: Vec<f64>,
    rules: Vec<Arc<Rule>>,
    starts: Vec<usize>,
}

/// Part of a segment's width within which a breakpoint moves rather than the segment be divided.
const NEAR: f64 = 0.1;

impl Mesh {
    /// Most collocation points of a mesh.
    pub const MOST_POINTS: usize = 50_000;
    /// Most collocation points of a segment, whose differentiation matrix is dense.
    pub const MOST_POINTS_IN_SEGMENT: usize = 1_000;

    /// Whether so many points can be had.
    fn count(points: impl Iterator<Item = usize>) -> Result<(), MeshError> {
        let mut sum = 0usize;
        let too_many = |what, found, most| Err(MeshError::TooMany { what, found, most });
        for n in points {
            if n > Self::MOST_POINTS_IN_SEGMENT {
                return too_many("a segment", n, Self::MOST_POINTS_IN_SEGMENT);
            }
            sum += n;
        }
        match sum > Self::MOST_POINTS {
            true => too_many("a mesh", sum, Self::MOST_POINTS),
            false => Ok(()),
        }
    }

    /// A mesh from breakpoints (S + 1, rising from 0 to 1) and points in each segment (S).
    ///
    /// # Errors
    /// [`MeshError`] for an empty mesh or segment, or breakpoints that do not rise from 0 to 1.
    pub fn new(breakpoints: Vec<f64>, points: &[usize]) -> Result<Self, MeshError> {
        if points.is_empty() {
            return Err(MeshError::NoSegments);
        }
        if breakpoints.len() != points.len() + 1 {
            return Err(MeshError::Mismatch {
                breakpoints: breakpoints.len(),
                segments: points.len(),
            });
        }
        if let Some(s) = points.iter().position(|&n| n == 0) {
            return Err(MeshError::NoPoints { segment: s + 1 });
        }
        Self::count(points.iter().copied())?;
        let last = points.len();
        for (index, &value) in breakpoints.iter().enumerate() {
            let good = match index {
                0 => value == 0.0,
                _ => value > breakpoints[index - 1] && (index < last || value == 1.0),
            };
            if !good {
                return Err(MeshError::NotRising { index, value });
            }
        }
        let mut cache = HashMap::new();
        let rules: Vec<Arc<Rule>> = points
            .iter()
            .map(|&n| {
                cache
                    .entry(n)
                    .or_insert_with(|| Arc::new(Rule::new(n)))
                    .clone()
            })
            .collect();
        let mut starts = vec![0];
        for n in points {
            starts.push(starts[starts.len() - 1] + n);
        }
        Ok(Self {
            breakpoints,
            rules,
            starts,
        })
    }

    /// `segments` equal segments with `points` LGR points each.
    ///
    /// # Errors
    /// [`MeshError`] where either is zero, or there would be too many points.
    pub fn uniform(segments: usize, points: usize) -> Result<Self, MeshError> {
        let all = segments.saturating_mul(points);
        if all > Self::MOST_POINTS {
            return Err(MeshError::TooMany {
                what: "a mesh",
                found: all,
                most: Self::MOST_POINTS,
            });
        }
        let breakpoints = (0..=segments)
            .map(|s| s as f64 / segments.max(1) as f64)
            .collect();
        Self::new(breakpoints, &vec![points; segments])
    }

    /// The same mesh with a breakpoint at each of `fractions`, which lie between 0 and 1 and rise.
    ///
    /// A breakpoint that is closer than a tenth of the narrower segment beside it moves there;
    /// else the segment is divided, and each part has its points.
    ///
    /// # Errors
    /// [`MeshError::NotRising`] for a fraction that is not above 0 and below 1.
    pub fn through(&self, fractions: &[f64]) -> Result<Self, MeshError> {
        let mut breakpoints = self.breakpoints.clone();
        let mut points = self.points_per_segment();
        for &fraction in fractions.iter() {
            if breakpoints.contains(&fraction) {
                continue;
            }
            let right = breakpoints
                .partition_point(|&b| b < fraction)
                .clamp(1, points.len());
            let close = |&b: &usize| {
                let inner = b > 0 && b < points.len() && !fractions.contains(&breakpoints[b]);
                let room = |b: usize| {
                    (breakpoints[b + 1] - breakpoints[b]).min(breakpoints[b] - breakpoints[b - 1])
                };
                inner && (breakpoints[b] - fraction).abs() <= NEAR * room(b)
            };
            match [right - 1, right].iter().find(|b| close(b)) {
                Some(&b) => breakpoints[b] = fraction,
                None => {
                    breakpoints.insert(right, fraction);
                    points.insert(right, points[right - 1]);
                }
            }
        }
        Self::new(breakpoints, &points)
    }

    /// The node at a breakpoint, which is the first of the segment that starts there; `None` where
    /// there is no breakpoint, and at t_f.
    pub fn node_at(&self, fraction: f64) -> Option<usize> {
        let s = self.breakpoints.iter().position(|&b| b == fraction)?;
        (s < self.segments()).then(|| self.start(s))
    }

    /// Number of segments S.
    pub fn segments(&self) -> usize {
        self.rules.len()
    }

    /// Number of collocation points in all segments together.
    pub fn points(&self) -> usize {
        self.starts[self.rules.len()]
    }

    /// Breakpoints as fractions of the duration, length S + 1.
    pub fn breakpoints(&self) -> &[f64] {
        &self.breakpoints
    }

    /// LGR points of each segment, length S.
    pub fn points_per_segment(&self) -> Vec<usize> {
        self.rules.iter().map(|rule| rule.len()).collect()
    }

    /// The Radau rule of segment `s`, counted from 0.
    pub fn rule(&self, s: usize) -> &Rule {
        &self.rules[s]
    }

    /// Number of the first node of segment `s` among all nodes; its last state node is the first
    /// of the next segment.
    pub fn start(&self, s: usize) -> usize {
        self.starts[s]
    }

    /// Width of segment `s`, fraction of the duration.
    pub fn width(&self, s: usize) -> f64 {
        self.breakpoints[s + 1] - self.breakpoints[s]
    }

    /// Fraction of the duration at τ ∈ [−1, 1] of segment `s`, eq. (16).
    pub fn fraction(&self, s: usize, tau: f64) -> f64 {
        if tau == 1.0 {
            return self.breakpoints[s + 1];
        }
        self.breakpoints[s] + 0.5 * (tau + 1.0) * self.width(s)
    }

    /// Fractions of the duration of all state nodes, the last being 1; length points + 1.
    pub fn node_fractions(&self) -> Vec<f64> {
        let mut fractions: Vec<f64> = (0..self.segments())
            .flat_map(|s| {
                self.rules[s]
                    .points()
                    .iter()
                    .map(move |&tau| self.fraction(s, tau))
            })
            .collect();
        fractions.push(1.0);
        fractions
    }

    /// Segment and τ of a fraction of the duration; at a breakpoint the segment that starts there.
    pub fn locate(&self, fraction: f64) -> (usize, f64) {
        let s = self
            .breakpoints
            .partition_point(|&b| b <= fraction)
            .clamp(1, self.segments())
            - 1;
        let tau = 2.0 * (fraction - self.breakpoints[s]) / self.width(s) - 1.0;
        (s, tau.clamp(-1.0, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_breakpoint_nearby_moves_and_a_new_one_divides() {
        let mesh = Mesh::uniform(4, 3).unwrap();
        let through = mesh.through(&[0.26, 0.4, 0.75]).unwrap();
        assert_eq!(through.breakpoints(), [0.0, 0.26, 0.4, 0.5, 0.75, 1.0]);
        assert_eq!(through.points_per_segment(), [3; 5]);
        assert_eq!(through.node_at(0.4), Some(6));
        assert_eq!(through.node_at(0.3), None);
        // A way-point never moves, however near the next.
        let two = mesh.through(&[0.25, 0.2500001]).unwrap();
        assert_eq!(two.breakpoints()[1..3], [0.25, 0.2500001]);
        assert_eq!(two.through(&[0.25, 0.2500001]).unwrap(), two);
        for wrong in [0.0 - 1e-3, 1.0 + 1e-3, f64::NAN] {
            assert!(mesh.through(&[wrong]).is_err(), "{wrong}");
        }
    }
}
