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
    /// What resists that joint, base and other joints being free: 1/(H⁻¹)ⱼⱼ, in `unit`.
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
    let mut worst: Option<(usize, Spread)> = None;
    for k in 0..=plan.mesh.points() {
        let theta = &plan.state(k)[parameters..parameters + n];
        system.tree().kinematics(theta, &mut data);
        system.tree().momentum(&mut data);
        system.tree().mass_matrix(&mut data);
        let lower = &data.mass_matrix;
        let inertia = DMatrix::from_fn(n, n, |i, j| lower[i.max(j) * n + i.min(j)]);
        let Some(found) = Spread::of(inertia) else {
            continue;
        };
        if worst
            .as_ref()
            .is_none_or(|(_, most)| found.condition > most.condition)
        {
            worst = Some((k, found));
        }
    }
    let (
        k,
        Spread {
            condition,
            joint,
            inertia,
        },
    ) = worst?;
    let joint = &problem.robot.joints()[joint];
    Some(Conditioning {
        time: plan.mesh.node_fractions()[k] * plan.duration,
        condition,
        joint: joint.name.clone(),
        inertia,
        unit: Unit::inertia(joint.kind),
    })
}

/// How far the eigenvalues of an inertia matrix lie apart.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Spread {
    /// The largest over the smallest.
    condition: f64,
    /// The component that is largest in the eigenvector of the smallest.
    joint: usize,
    /// What resists that component where all others are free.
    inertia: f64,
}

impl Spread {
    /// Of a symmetric matrix; `None` where it is not positive definite.
    fn of(inertia: DMatrix<f64>) -> Option<Self> {
        let found = SymmetricEigen::new(inertia.clone());
        let (least, small) = found.eigenvalues.argmin();
        let large = found.eigenvalues.max();
        if !(small > 0.0 && large.is_finite()) {
            return None;
        }
        let joint = found.eigenvectors.column(least).iamax();
        let inverse = inertia.cholesky()?.inverse();
        Some(Self {
            condition: large / small,
            joint,
            inertia: 1.0 / inverse[(joint, joint)],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Spread;
    use nalgebra::DMatrix;

    #[test]
    fn the_component_of_least_inertia_is_named() {
        let inertia = DMatrix::from_row_slice(2, 2, &[4.0, 0.1, 0.1, 0.01]);
        let found = Spread::of(inertia).unwrap();
        // λ = (4.01 ± √(3.99² + 0.04))/2.
        let root = (3.99_f64.powi(2) + 0.04).sqrt();
        let condition = (4.01 + root) / (4.01 - root);
        assert!((found.condition / condition - 1.0).abs() < 1e-9);
        assert_eq!(found.joint, 1);
        // 0.01 − 0.1²/4.
        assert!((found.inertia - 0.0075).abs() < 1e-12);
        assert_eq!(Spread::of(DMatrix::zeros(2, 2)), None);
    }
}
