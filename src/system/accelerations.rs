//! The joints' accelerations along a motion.

use super::dispatch::{System, with_system};
use super::motion::Trajectory;
use crate::ocp::Ocp;
use crate::problem::Problem;
use crate::transcription::Discretization;

/// Joint accelerations θ̈ = u − H⁻¹Cθ̇, eq. (7), at the rows of `motion`, which is one of `plan`; rad/s² or
/// m/s², a row of length n each.
pub fn joint_accelerations(
    problem: &Problem,
    plan: &Discretization,
    motion: &Trajectory,
) -> Vec<Vec<f64>> {
    with_system!(&System::new(problem), system => {
        let formulation = system.formulation();
        let mut scratch = system.scratch::<f64>();
        let mut rates = vec![0.0; formulation.states.len()];
        let mut path = vec![0.0; formulation.path.len()];
        let row = |k: usize| {
            let x = [
                &motion.base_attitude[k][..],
                &motion.joint_position[k],
                &motion.joint_velocity[k],
            ];
            let x = x.concat();
            let point = plan.point(&x, &motion.control[k], motion.t[k]);
            system.continuous(point, &mut scratch, &mut rates, &mut path);
            rates[rates.len() - system.joint_count()..].to_vec()
        };
        (0..motion.t.len()).map(row).collect()
    })
}
