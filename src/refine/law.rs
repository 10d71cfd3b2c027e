//! The refinement laws: adaptive, eq. (29) to (32), and global.

use super::curvature::Curvature;
use super::{Decision, Errors, Method, Settings};
use crate::collocation::Mesh;
use crate::transcription::Discretization;

/// The next mesh and what was decided for each segment; `None` where the law can do no more.
pub fn refine(
    settings: &Settings,
    trajectory: &Discretization,
    errors: &Errors,
) -> Option<(Mesh, Vec<Decision>)> {
    let decisions: Vec<Decision> = (0..trajectory.mesh.segments())
        .map(|s| match settings.method {
            Method::Adaptive => adaptive(settings, trajectory, errors, s),
            Method::Global => global(settings, trajectory, errors),
        })
        .collect();
    if decisions.iter().all(|d| *d == Decision::Keep) {
        return None;
    }
    Some((apply(settings, trajectory, errors, &decisions), decisions))
}

/// ⌈log₁₀ e − log₁₀ ε⌉, at least 1 where e exceeds ε.
fn decades(error: f64, tolerance: f64) -> f64 {
    (error.log10() - tolerance.log10()).ceil().max(1.0)
}

fn raised(settings: &Settings, points: usize, error: f64) -> usize {
    let more = settings.lambda2 * decades(error, settings.tolerance);
    points + (more.round() as usize).max(1)
}

fn adaptive(
    settings: &Settings,
    trajectory: &Discretization,
    errors: &Errors,
    s: usize,
) -> Decision {
    let (state, error) = errors.worst(s);
    if error <= settings.tolerance {
        return Decision::Keep;
    }
    let wanted = raised(settings, trajectory.mesh.rule(s).len(), error);
    let curved = Curvature::new(trajectory, s, state).ratio() > settings.r_max;
    if curved || wanted > settings.max_points {
        let parts = settings.lambda1 * decades(error, settings.tolerance);
        Decision::Divide((parts.round() as usize).max(2))
    } else {
        Decision::Raise(wanted)
    }
}

fn global(settings: &Settings, trajectory: &Discretization, errors: &Errors) -> Decision {
    let points = trajectory.mesh.rule(0).len();
    if errors.max() <= settings.tolerance || points >= settings.max_global_points {
        return Decision::Keep;
    }
    Decision::Raise(raised(settings, points, errors.max()).min(settings.max_global_points))
}

fn apply(
    settings: &Settings,
    trajectory: &Discretization,
    errors: &Errors,
    decisions: &[Decision],
) -> Mesh {
    let old = &trajectory.mesh;
    let mut breakpoints = vec![0.0];
    let mut points = Vec::new();
    for (s, decision) in decisions.iter().enumerate() {
        let n = old.rule(s).len();
        match *decision {
            Decision::Keep => points.push(n),
            Decision::Raise(more) => points.push(more),
            Decision::Divide(parts) => {
                let cuts = Curvature::new(trajectory, s, errors.worst(s).0).cuts(parts);
                breakpoints.extend(cuts.into_iter().map(|tau| old.fraction(s, tau)));
                points.extend(std::iter::repeat_n(settings.points, parts));
            }
        }
        breakpoints.push(old.breakpoints()[s + 1]);
    }
    Mesh::new(breakpoints, &points).expect("cuts rise within their segment")
}
