//! The condition number of the joint-space inertia matrix along a plan.

use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::problem::{Problem, Unit};
use crate::system::{FreeFloating, System, with_system};
use crate::transcription::Discretization;
use nalgebra::{DMatrix, SymmetricEigen};

/// Where the inertia matrix H of a plan is closest to singular, and by which joint.
///
/// Where its condition number is large, a small error of the control is a large error of the motion
/// of that joint.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Conditioning {
    /// When, s.
    pub time: f64,
    /// The condition number of H there: its largest eigenvalue over its smallest.
    pub condition: f64,
    /// Name of the joint that has the largest part in the motion of least inertia.
    pub joint: String,
    /// What resists that joint where the others are held, the base being free: its entry on the
    /// diagonal of H, in `unit`.
    pub inertia: f64,
    /// kg m² or kg.
    pub unit: &'static str,
}

/// The largest condition number of H at the nodes of `plan`; `None` where H is nowhere positive
/// definite to working precision.
pub(super) fn most_extreme(problem: &Problem, plan: &Discretization) -> Option<Conditioning> {
    with_system!(&System::new(problem), system => along(problem, system, plan))
}

fn along<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    plan: &Discretization,
) -> Option<Conditioning> {
    let n = system.joint_count();
    let parameters = system.attitude().count();
    let mut data = Data::<Sp, f64>::new(system.tree());
    let mut worst: Option<(f64, usize, usize, f64)> = None;
    for k in 0..=plan.mesh.points() {
        let theta = &plan.state(k)[parameters..parameters + n];
        system.tree().kinematics(theta, &mut data);
        system.tree().momentum(&mut data);
        system.tree().mass_matrix(&mut data);
        let lower = &data.mass_matrix;
        let inertia = DMatrix::from_fn(n, n, |i, j| lower[i.max(j) * n + i.min(j)]);
        let Some((condition, joint)) = condition(&inertia) else {
            continue;
        };
        if worst.is_none_or(|(most, ..)| condition > most) {
            worst = Some((condition, k, joint, inertia[(joint, joint)]));
        }
    }
    let (condition, k, joint, inertia) = worst?;
    let joint = &problem.robot.joints()[joint];
    Some(Conditioning {
        time: plan.mesh.node_fractions()[k] * plan.duration,
        condition,
        joint: joint.name.clone(),
        inertia,
        unit: Unit::inertia(joint.kind),
    })
}

/// The condition number of a symmetric matrix, and the component that is largest in the eigenvector
/// of its smallest eigenvalue.
fn condition(inertia: &DMatrix<f64>) -> Option<(f64, usize)> {
    let found = SymmetricEigen::new(inertia.clone());
    let (least, small) = found.eigenvalues.argmin();
    let large = found.eigenvalues.max();
    (small > 0.0 && large.is_finite()).then(|| {
        let vector = found.eigenvectors.column(least);
        (large / small, vector.iamax())
    })
}

#[cfg(test)]
mod tests {
    use super::condition;
    use nalgebra::DMatrix;

    #[test]
    fn the_component_of_least_inertia_is_named() {
        let inertia = DMatrix::from_row_slice(2, 2, &[4.0, 0.1, 0.1, 0.01]);
        let (found, joint) = condition(&inertia).unwrap();
        // λ = (4.01 ± √(3.99² + 0.04))/2.
        let root = (3.99_f64.powi(2) + 0.04).sqrt();
        assert!((found / ((4.01 + root) / (4.01 - root)) - 1.0).abs() < 1e-9);
        assert_eq!(joint, 1);
        assert_eq!(condition(&DMatrix::zeros(2, 2)), None);
    }
}
