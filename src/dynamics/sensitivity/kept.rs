//! What first derivatives leave to second ones at the same point.

use super::Sensitivity;
use crate::dynamics::Storage;
use crate::dynamics::algebra::{Algebra, Vector};

impl<Sp: Algebra, J: Storage, const N: usize, const FUSED: bool> Sensitivity<Sp, J, N, FUSED> {
    /// Hands to `visit`, piece by piece and always in the same order, all the numbers that
    /// [`Sensitivity::second`], [`Sensitivity::torque_curvature`] and what reads first derivatives
    /// need of [`Sensitivity::load`], [`Sensitivity::first`] and [`Sensitivity::torque_by`].
    #[inline(always)]
    pub fn visit(&mut self, visit: &mut impl FnMut(&mut [f64])) {
        let fixed = &mut self.fixed;
        fixed.data.visit(visit);
        visit(fixed.center.components_mut());
        Sp::visit_inertia(&mut fixed.inverse_inertia, visit);
        for j in 0..self.steps.len() {
            let body = &mut fixed.bodies[j];
            visit(body.center.components_mut());
            Sp::visit_inertia(&mut body.rotational, visit);
            let carried = &mut fixed.carried[j];
            visit(carried.moment.components_mut());
            Sp::visit_inertia(&mut carried.inertia, visit);
            fixed.axes[j].visit(visit);
            fixed.drag[j].visit(visit);
            self.carried.coriolis[j].visit(visit);
            let step = &mut self.steps[j];
            step.velocity.visit(visit);
            for by in 0..2 {
                step.acceleration[by].visit(visit);
                step.force[by].visit(visit);
                step.momentum[by].visit(visit);
            }
            visit(step.coriolis.components_mut());
            self.controls.motion_by[j].visit(visit);
            self.controls.momentum_by[j].visit(visit);
        }
        self.carried.whole.visit(visit);
        for tangent in &mut self.tangents {
            let motions = [&mut tangent.velocity, &mut tangent.acceleration];
            for motion in motions {
                motion.visit(&mut |part| {
                    for number in part {
                        visit(&mut number.gradient);
                    }
                });
            }
            for joint in tangent.joints.iter_mut() {
                visit(&mut joint.gradient);
            }
        }
    }
}
