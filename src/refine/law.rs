//! The refinement laws: adaptive, eq. (29) to (32), and global.

use super::curvature::Curvature;
use super::{Decision, Errors, Method, Settings, Violation};
use crate::collocation::Mesh;
use crate::transcription::Discretization;

/// The next mesh and what was decided for each segment; `None` where the law can do no more.
///
/// `violations` are those to be removed, by segments. The adaptive law divides a segment for their
/// sake where its error asks for nothing: in two, at the place of the largest one, which becomes a
/// node.
pub fn refine(
    settings: &Settings,
    trajectory: &Discretization,
    errors: &Errors,
    violations: &[Vec<Violation>],
) -> Option<(Mesh, Vec<Decision>)> {
    let mut decisions = Vec::new();
    let mut cuts = Vec::new();
    for (s, violations) in violations.iter().enumerate() {
        let decision = match settings.method {
            Method::Adaptive => adaptive(settings, trajectory, errors, s),
            Method::Global => global(settings, trajectory, errors),
        };
        let worst = violations
            .iter()
            .filter(|v| v.relative > settings.bound_tolerance)
            .max_by(|a, b| a.relative.total_cmp(&b.relative));
        let (decision, taus) = match (decision, worst) {
            (Decision::Divide(parts), _) => {
                let curvature = Curvature::new(trajectory, s, errors.worst(s).0);
                (decision, curvature.cuts(parts))
            }
            (Decision::Keep, Some(worst)) if settings.method == Method::Adaptive => {
                let tau = worst.tau.clamp(-OUTERMOST, OUTERMOST);
                (Decision::Divide(2), vec![tau])
            }
            _ => (decision, Vec::new()),
        };
        decisions.push(decision);
        cuts.push(taus);
    }
    if decisions.iter().all(|d| *d == Decision::Keep) {
        return None;
    }
    let mesh = apply(settings, &trajectory.mesh, &decisions, &cuts);
    Some((mesh, decisions))
}

/// Where in a segment a cut for the sake of a bound may be: not so near its end that one of the
/// parts is of no use.
const OUTERMOST: f64 = 0.9;

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

fn apply(settings: &Settings, old: &Mesh, decisions: &[Decision], cuts: &[Vec<f64>]) -> Mesh {
    let mut breakpoints = vec![0.0];
    let mut points = Vec::new();
    for (s, decision) in decisions.iter().enumerate() {
        let n = old.rule(s).len();
        match *decision {
            Decision::Keep => points.push(n),
            Decision::Raise(more) => points.push(more),
            Decision::Divide(parts) => {
                breakpoints.extend(cuts[s].iter().map(|&tau| old.fraction(s, tau)));
                points.extend(std::iter::repeat_n(settings.points, parts));
            }
        }
        breakpoints.push(old.breakpoints()[s + 1]);
    }
    Mesh::new(breakpoints, &points).expect("cuts rise within their segment")
}
