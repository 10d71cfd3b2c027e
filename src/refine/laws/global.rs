//! The traditional global method: one segment, the degree raised by (32) until the error is within
//! the tolerance.

use super::raise::raised;
use crate::collocation::{Mesh, MeshError};
use crate::refine::{Assessment, Decision, Record, Refined, RefinementLaw, Settings};
use crate::transcription::Structure;

/// One segment, or one between each two way-points, all with as many points.
#[derive(Debug)]
pub(super) struct Law<'a>(pub &'a Settings);

impl RefinementLaw for Law<'_> {
    fn first_mesh(&self) -> Result<Mesh, MeshError> {
        Mesh::uniform(1, self.0.global_points)
    }

    fn describe(&self) -> String {
        let settings = self.0;
        format!(
            "one segment of {} points, at most {}",
            settings.global_points, settings.max_global_points
        )
    }

    fn is_last(&self, records: &[Record]) -> bool {
        records[records.len() - 1].max_error <= self.0.tolerance
    }

    fn refine(&self, assessment: &Assessment<'_>) -> Option<Refined> {
        let settings = self.0;
        let old = &assessment.trajectory.mesh;
        let points = old.rule(0).len();
        let error = assessment.errors.max();
        if error <= settings.tolerance || points >= settings.max_global_points {
            return None;
        }
        let more = raised(settings, points, error).min(settings.max_global_points);
        let mesh = Mesh::new(old.breakpoints().to_vec(), &vec![more; old.segments()]);
        Some(Refined {
            mesh: mesh.expect("the breakpoints of a mesh"),
            decisions: vec![Decision::Raise(more); old.segments()],
            structure: Structure::default(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::refine::Errors;
    use crate::transcription::Discretization;

    fn refine(points: usize, error: f64) -> Option<Refined> {
        let settings = Settings {
            tolerance: 1e-5,
            lambda2: 3.0,
            max_global_points: 30,
            ..Settings::default()
        };
        let mesh = Mesh::uniform(2, points).unwrap();
        let trajectory = Discretization::sample(mesh, 1.0, 1, 0, |_, _, _| {});
        Law(&settings).refine(&Assessment {
            trajectory: &trajectory,
            errors: &Errors {
                by_segment: vec![vec![1e-9], vec![error]],
                integrals: vec![Vec::new(); 2],
            },
            before: None,
            violations: &[vec![], vec![]],
            solution: &trajectory,
            structure: &Structure::default(),
            structure_failed: false,
            facts: None,
            tolerance: settings.tolerance,
        })
    }

    #[test]
    fn the_degree_is_raised_everywhere_up_to_its_limit() {
        // ⌈log₁₀ 3·10⁻⁴ + 5⌉ = ⌈1.48⌉ = 2: 20 + 3·2 = 26 points, in both segments.
        let next = refine(20, 3e-4).unwrap();
        assert_eq!(next.mesh.points_per_segment(), [26, 26]);
        assert_eq!(next.decisions, [Decision::Raise(26); 2]);
        // 26 + 6 is above the limit of 30.
        assert_eq!(refine(26, 3e-4).unwrap().mesh.points(), 60);
        assert_eq!(refine(30, 3e-4), None);
        assert_eq!(refine(20, 1e-6), None);
        assert_eq!(refine(20, f64::NAN).unwrap().mesh.points(), 46);
    }
}
