//! The largest values along a trajectory that the cost is about: what static parameters begin with.

use super::dispatch::{System, with_system};
use super::free_floating::FreeFloating;
use super::instant::{Instant, Pose};
use super::rows::{PathBlock, PeakRow};
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::problem::Problem;
use crate::transcription::Discretization;

impl<Sp: Space> FreeFloating<Sp> {
    /// The path rows that hold a quantity below its peak.
    pub(super) fn peak_rows(&self) -> impl Iterator<Item = &PeakRow> {
        self.path.iter().filter_map(|block| match block {
            PathBlock::Peak(row) => Some(row),
            _ => None,
        })
    }

    /// The largest value at the nodes of `trajectory` of each quantity whose peak is in the cost, in
    /// the order of the static parameters.
    pub(crate) fn peaks(&self, trajectory: &Discretization) -> Vec<f64> {
        let rows: Vec<&PeakRow> = self.peak_rows().collect();
        let mut peaks: Vec<f64> = rows.iter().map(|row| row.least()).collect();
        if rows.is_empty() {
            return peaks;
        }
        let plant = &self.plant;
        let mut data = Data::<Sp, f64>::new(&plant.tree);
        let mut eta_rates = vec![0.0; plant.parameters()];
        for (k, t) in trajectory.times().into_iter().enumerate() {
            let (eta, joints) = trajectory.state(k).split_at(plant.parameters());
            let (theta, dtheta) = joints.split_at(plant.joints());
            plant.tree.kinematics(theta, &mut data);
            plant.tree.momentum(&mut data);
            plant.base_rate(eta, dtheta, &mut data);
            plant.attitude.rates(eta, &data.base_rate, &mut eta_rates);
            let at = Instant {
                pose: Pose {
                    plant,
                    eta,
                    t,
                    data: &data,
                    parameters: &[],
                },
                dtheta,
                u: &[],
                base_rate: plant.limited_rates(&eta_rates, &data.base_rate),
                torque: &[],
            };
            for (peak, row) in peaks.iter_mut().zip(&rows) {
                *peak = peak.max(row.square(&at).sqrt());
            }
        }
        peaks
    }

    /// `trajectory` with static parameters that hold along it.
    pub(crate) fn with_peaks(&self, trajectory: Discretization) -> Discretization {
        let parameters = self.peaks(&trajectory);
        Discretization {
            parameters,
            ..trajectory
        }
    }
}

/// `plan` with the static parameters that `problem` has, as they hold along it.
pub fn with_peaks(problem: &Problem, plan: Discretization) -> Discretization {
    with_system!(&System::new(problem), system => system.with_peaks(plan))
}
