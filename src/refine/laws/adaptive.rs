//! The paper's adaptive law, eq. (29) to (32), segment by segment.
//!
//! Where the largest error of a segment is above the tolerance, the curvature (29) of the state
//! with that error decides: the segment is divided where the curvature has a peak, and gets more
//! points where it has none. Where the paper says nothing:
//!
//! - λ₁·⌈…⌉ of (30) and λ₂·⌈…⌉ of (32) are rounded to whole numbers, at least two parts and one
//!   point.
//! - A segment whose error hardly fell when its degree was raised is divided: no degree resolves a
//!   switch of the control inside it.
//! - A segment that (32) would give more than `max_points` is divided instead.
//! - Each part of a divided segment gets `points`, or as many more as it takes for the parts
//!   together to have no fewer points than the segment had: n parts of a segment of N points get
//!   max(`points`, ⌈N/n⌉) each. A cut must not take away the accuracy that is there.
//! - A segment that is accurate but exceeds a bound between its nodes is cut in two at the place of
//!   the largest violation, which becomes a node, and in three where that is near an end of the
//!   segment: on the mesh after the excess comes back in the long part. It is cut in four where what
//!   exceeds its bound may jump.
//!
//! Derived in docs/algorithms.md#adaptive-law.

use super::raise::{decades, raised};
use crate::collocation::{Mesh, MeshError};
use crate::refine::curvature::{Curvature, even_cuts};
use crate::refine::{
    Assessment, Decision, Erring, Record, Refined, RefinementLaw, Settings, Violation,
};
use crate::transcription::Structure;

/// The largest error of segment `s` on the mesh before, where it was the same segment with fewer
/// points.
fn error_before(assessment: &Assessment<'_>, s: usize) -> Option<f64> {
    let (mesh, errors) = assessment.before?;
    let new = &assessment.trajectory.mesh;
    let ends = &new.breakpoints()[s..s + 2];
    let old = mesh
        .breakpoints()
        .windows(2)
        .position(|pair| pair == ends)?;
    (mesh.rule(old).len() < new.rule(s).len()).then(|| errors.worst(old).1)
}

/// Where in a segment a cut for the sake of a bound may be, |τ|: not so near its end that one of
/// the parts is of no use.
const OUTERMOST: f64 = 0.9;
/// Distance from the middle, |τ|, from which on the longer part is cut as well.
const NEAR_AN_END: f64 = 0.8;

/// Where a segment is cut in which a control jumps: the jump stays in one of the parts, wherever it
/// is, and its overshoot lasts a quarter as long.
const QUARTERS: [f64; 3] = [-0.5, 0.0, 0.5];

/// The cuts of a segment one of whose nodes is to be at `place`.
fn cuts_at(place: f64) -> Vec<f64> {
    let half_of_the_rest = 0.5 * (place - place.signum());
    match place {
        _ if place > NEAR_AN_END => vec![half_of_the_rest, place],
        _ if place < -NEAR_AN_END => vec![place, half_of_the_rest],
        _ => vec![place],
    }
}

/// Mesh iterations without a limit of the user's.
const MOST: usize = 40;
/// Mesh iterations that are made whether or not the error falls, and at most for the sake of bounds
/// that are exceeded by little.
const PATIENT: usize = 6;
/// The best error of so many meshes is compared with the best before them.
const RECENT: usize = 3;
/// Part of the best error before to which a later one has to fall for there to be progress.
const PROGRESS: f64 = 0.7;
/// Factor by which an error may be larger than that before and yet count as falling with it.
const HARDLY_MORE: f64 = 1.1;
/// Relative change of the cost over the last meshes above which the solution itself still moves: the error
/// is then that of another motion each time.
const MOVES: f64 = 3e-5;
/// Part to which a raised degree has to bring the error of a segment down; otherwise the solution
/// is not smooth there, and the segment is divided.
const SMOOTH: f64 = 0.3;

/// Whether the last meshes neither brought the error below what it was before them nor bring it down from
/// one to the next; where it is within the tolerance, how far bounds are exceeded.
fn has_stalled(records: &[Record], tolerance: f64) -> bool {
    if records.len() < PATIENT.max(RECENT + 1) {
        return false;
    }
    let accurate = |record: &Record| record.max_error <= tolerance;
    let by_bounds = records.iter().rev().take(RECENT).all(accurate);
    let size = |record: &Record| match by_bounds {
        true => record.removable_violation,
        false => record.max_error,
    };
    let best = |records: &[Record]| records.iter().map(size).fold(f64::INFINITY, f64::min);
    let (before, recent) = records.split_at(records.len() - RECENT);
    // One mesh that was lucky is no measure for those after it.
    let falls = recent
        .windows(2)
        .all(|pair| size(&pair[1]) <= HARDLY_MORE * size(&pair[0]))
        && size(&recent[RECENT - 1]) <= PROGRESS * size(&recent[0]);
    let (from, to) = (recent[0].objective, recent[RECENT - 1].objective);
    let moves = !by_bounds && (to - from).abs() > MOVES * to.abs();
    best(recent) > PROGRESS * best(before) && !moves && !falls
}

#[derive(Debug)]
pub(super) struct Law<'a>(pub &'a Settings);

/// What becomes of one segment.
enum Change {
    Keep,
    /// This many points.
    Raise(usize),
    /// Divided at these τ.
    Divide(Vec<f64>),
}

impl RefinementLaw for Law<'_> {
    fn first_mesh(&self) -> Result<Mesh, MeshError> {
        Mesh::uniform(self.0.segments, self.0.points)
    }

    fn describe(&self) -> String {
        let settings = self.0;
        let iterations = match settings.max_iterations {
            Some(most) => format!("{most} iterations"),
            None => "as many iterations as it takes while the error falls".into(),
        };
        format!(
            "{} segments of {} points, at most {} points and {iterations}",
            settings.segments, settings.points, settings.max_points
        )
    }

    fn is_last(&self, records: &[Record]) -> bool {
        let count = records.len();
        match self.0.max_iterations {
            Some(most) => count >= most,
            None if records[count - 1].verdict.is_converged() => count >= PATIENT,
            None => count >= MOST || has_stalled(records, self.0.tolerance),
        }
    }

    fn refine(&self, assessment: &Assessment<'_>) -> Option<Refined> {
        let old = &assessment.trajectory.mesh;
        let changes: Vec<Change> = (0..old.segments())
            .map(|s| self.change(assessment, s))
            .collect();
        let decisions: Vec<Decision> = changes
            .iter()
            .map(|change| match change {
                Change::Keep => Decision::Keep,
                Change::Raise(points) => Decision::Raise(*points),
                Change::Divide(cuts) => Decision::Divide(cuts.len() + 1),
            })
            .collect();
        if decisions.iter().all(|d| *d == Decision::Keep) {
            return None;
        }
        let mesh = match self.changed(old, &changes) {
            // A mesh of more points than there may be: nothing more can be done.
            Err(MeshError::TooMany { .. }) => return None,
            mesh => mesh.expect("cuts rise within their segment"),
        };
        Some(Refined {
            mesh,
            decisions,
            structure: Structure::default(),
        })
    }
}

impl Law<'_> {
    fn change(&self, assessment: &Assessment<'_>, s: usize) -> Change {
        let settings = self.0;
        let (erring, error) = assessment.errors.worst(s);
        if error <= settings.tolerance {
            return self.cut_at_violation(&assessment.violations[s]);
        }
        let rough = error_before(assessment, s).is_some_and(|before| error > SMOOTH * before);
        let wanted = raised(settings, assessment.trajectory.mesh.rule(s).len(), error);
        let parts = settings.lambda1 * decades(error, settings.tolerance);
        let parts = (parts.round() as usize).max(2);
        let full = rough || wanted > settings.max_points;
        match erring {
            Erring::State(state) => {
                let curvature = Curvature::new(assessment.trajectory, s, state);
                if full || curvature.ratio() > settings.r_max {
                    Change::Divide(curvature.cuts(parts))
                } else {
                    Change::Raise(wanted)
                }
            }
            // An integral has no curve of its own.
            Erring::Integral(_) if full => Change::Divide(even_cuts(parts)),
            Erring::Integral(_) => Change::Raise(wanted),
        }
    }

    fn cut_at_violation(&self, violations: &[Violation]) -> Change {
        violations
            .iter()
            .filter(|v| v.relative > self.0.bound_tolerance)
            .max_by(|a, b| a.relative.total_cmp(&b.relative))
            .map_or(Change::Keep, |worst| {
                Change::Divide(match worst.jumps {
                    true => QUARTERS.to_vec(),
                    false => cuts_at(worst.tau.clamp(-OUTERMOST, OUTERMOST)),
                })
            })
    }

    /// `old` with the change of each segment.
    fn changed(&self, old: &Mesh, changes: &[Change]) -> Result<Mesh, MeshError> {
        let mut breakpoints = vec![0.0];
        let mut points = Vec::new();
        for (s, change) in changes.iter().enumerate() {
            let n = old.rule(s).len();
            match change {
                Change::Keep => points.push(n),
                Change::Raise(more) => points.push(*more),
                Change::Divide(cuts) => {
                    let parts = cuts.len() + 1;
                    breakpoints.extend(cuts.iter().map(|&tau| old.fraction(s, tau)));
                    let each = self.0.points.max(n.div_ceil(parts));
                    points.extend(std::iter::repeat_n(each, parts));
                }
            }
            breakpoints.push(old.breakpoints()[s + 1]);
        }
        Mesh::new(breakpoints, &points)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nlp::Status;
    use crate::refine::{Bounded, Errors, Verdict};
    use crate::transcription::Discretization;
    use std::time::Duration;

    /// ε_d = 10⁻⁵, λ₁ = 2, λ₂ = 3, r_max = 1.5, 5 points a part, at most 20.
    fn settings() -> Settings {
        Settings {
            tolerance: 1e-5,
            bound_tolerance: 1e-3,
            lambda1: 2.0,
            lambda2: 3.0,
            r_max: 1.5,
            points: 5,
            max_points: 20,
            ..Settings::default()
        }
    }

    /// One segment with `points` points, the state a·τ², its error and a violation.
    fn refine(points: usize, a: f64, error: f64, violation: Option<(f64, f64)>) -> Option<Refined> {
        let mesh = Mesh::uniform(1, points).unwrap();
        let trajectory = Discretization::sample(mesh, 1.0, 1, 0, |fraction, x, _| {
            x[0] = a * (2.0 * fraction - 1.0).powi(2);
        });
        let violation = violation.map(|(tau, relative)| Violation {
            what: Bounded::State(0),
            segment: 0,
            tau,
            t: 0.0,
            value: 0.0,
            excess: relative,
            relative,
            lasts: 0.0,
            jumps: false,
        });
        let settings = settings();
        Law(&settings).refine(&Assessment {
            trajectory: &trajectory,
            errors: &Errors {
                by_segment: vec![vec![error]],
                integrals: vec![Vec::new()],
            },
            before: None,
            violations: &[violation.into_iter().collect()],
            solution: &trajectory,
            structure: &Structure::default(),
            structure_failed: false,
            facts: None,
            tolerance: settings.tolerance,
        })
    }

    /// Mesh iterations with these largest errors, of one cost.
    fn records(errors: &[f64]) -> Vec<Record> {
        let record = |&max_error: &f64| Record {
            points: 5,
            segments: 1,
            breakpoints: vec![0.0, 1.0],
            quadrature_error: max_error,
            segment_errors: vec![vec![max_error]],
            max_error,
            max_violation: 0.0,
            removable_violation: 0.0,
            objective: 1.0,
            objective_error: 0.0,
            nlp_iterations: 1,
            nlp_status: Status::Solved,
            verdict: Verdict::AboveTolerance,
            time: Duration::ZERO,
            decisions: Vec::new(),
        };
        errors.iter().map(record).collect()
    }

    #[test]
    fn errors_that_fall_have_not_stalled_whatever_came_before() {
        for (errors, stalled) in [
            // A lucky third mesh: those after it fall one after another.
            (
                &[3e-3, 2e-4, 1.1e-5, 2e-5, 2.6e-4, 1.4e-4, 3.6e-5][..],
                false,
            ),
            (&[9e-3, 1e-4, 2e-5, 3.4e-5, 2.6e-5, 1.7e-5], false),
            // A plateau, and errors that hardly fall.
            (&[9e-3, 1e-4, 6e-5, 7e-5, 6.5e-5, 6.4e-5], true),
            (&[9e-3, 1e-4, 2e-5, 1.9e-5, 4e-5, 3e-5], true),
            // Too few to tell.
            (&[1e-4, 1e-4, 1e-4, 1e-4], false),
        ] {
            assert_eq!(has_stalled(&records(errors), 1e-5), stalled, "{errors:?}");
        }
    }

    #[test]
    fn a_peak_of_curvature_divides_the_segment() {
        // X = τ²: r = 2.25 > 1.5, see the test of the curvature. e = 4·10⁻⁴:
        // ⌈−3.398 + 5⌉ = ⌈1.602⌉ = 2, n = 2·2 = 4 parts by (30). By (31) they end at
        // τ = −0.393076, 0, 0.393076, fractions (τ + 1)/2 = 0.303462, 0.5, 0.696538.
        let next = refine(5, 1.0, 4e-4, None).unwrap();
        assert_eq!(next.decisions, [Decision::Divide(4)]);
        assert_eq!(next.mesh.points_per_segment(), [5; 4]);
        for (found, expected) in
            next.mesh
                .breakpoints()
                .iter()
                .zip([0.0, 0.303_461_9, 0.5, 0.696_538_1, 1.0])
        {
            // The trapezoidal rule of 101 samples.
            assert!((found - expected).abs() < 1e-4, "{found}, {expected}");
        }
    }

    #[test]
    fn an_even_curvature_raises_the_degree() {
        // X = τ²/10: ν = 0.2/(1 + 0.04τ²)^{3/2} falls from 0.2 to 0.1886 only, r < 1.06. e = 4·10⁻⁴:
        // N* = 5 + 3·2 = 11 by (32).
        let next = refine(5, 0.1, 4e-4, None).unwrap();
        assert_eq!(next.decisions, [Decision::Raise(11)]);
        assert_eq!(next.mesh.points_per_segment(), [11]);
        assert_eq!(next.mesh.breakpoints(), [0.0, 1.0]);
    }

    #[test]
    fn a_division_leaves_no_fewer_points_than_there_were() {
        // e = 2·10⁻⁵: one decade, n = 2 parts. Two of 5 points would be fewer than 14: ⌈14/2⌉ = 7.
        let next = refine(14, 1.0, 2e-5, None).unwrap();
        assert_eq!(next.mesh.points_per_segment(), [7, 7]);
        // 18 + 3 = 21 is above the limit of 20 points: divided though the curvature is even.
        let next = refine(18, 0.1, 2e-5, None).unwrap();
        assert_eq!(next.mesh.points_per_segment(), [9, 9]);
        // Four parts of 5 points are more than 16 already.
        let next = refine(16, 0.1, 4e-4, None).unwrap();
        assert_eq!(next.mesh.points_per_segment(), [5; 4]);
        // An accurate segment of 15 points, cut for the sake of a bound: ⌈15/2⌉ = 8.
        let next = refine(15, 1.0, 1e-9, Some((0.2, 0.01))).unwrap();
        assert_eq!(next.mesh.points_per_segment(), [8, 8]);
        assert_eq!(next.mesh.breakpoints(), [0.0, 0.6, 1.0]);
    }

    #[test]
    fn bounds_ask_for_a_cut_where_the_error_asks_for_nothing() {
        assert_eq!(refine(5, 1.0, 1e-5, None), None);
        assert_eq!(refine(5, 1.0, 1e-9, Some((0.2, 1e-3))), None);
        // Not nearer than |τ| = 0.9 to an end: fraction 0.95, and half of the rest.
        let next = refine(5, 1.0, 1e-9, Some((0.99, f64::INFINITY))).unwrap();
        assert_eq!(next.decisions, [Decision::Divide(3)]);
        assert_eq!(next.mesh.breakpoints(), [0.0, 0.475, 0.95, 1.0]);
        let next = refine(5, 1.0, 1e-9, Some((-0.85, 1.0))).unwrap();
        let breakpoints = next.mesh.breakpoints();
        assert!((breakpoints[1] - 0.075).abs() < 1e-12 && (breakpoints[2] - 0.5375).abs() < 1e-12);
    }

    #[test]
    fn an_error_that_is_not_a_number_is_not_within_the_tolerance() {
        for error in [f64::NAN, f64::INFINITY] {
            // As one decade: two parts, or 5 + 3 points.
            let next = refine(5, 1.0, error, None).unwrap();
            assert_eq!(next.decisions, [Decision::Divide(2)]);
            let next = refine(5, 0.1, error, None).unwrap();
            assert_eq!(next.decisions, [Decision::Raise(8)]);
        }
    }
}
