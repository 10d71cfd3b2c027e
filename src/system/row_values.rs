//! Values of rows, of the goals for the end effector and of the cost terms along a trajectory.

use super::cost::{CostTerm, CostTerms, EndTerm, PathTerm, quadrature};
use super::dispatch::{System, with_system};
use super::free_floating::FreeFloating;
use super::instant::{Instant, Pose};
use super::rows::{EndBlock, EndEffectorRows, EndRows};
use super::torques::torques;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::ocp::Ocp;
use crate::problem::Problem;
use crate::transcription::{Discretization, integrals};

impl<Sp: Space> FreeFloating<Sp> {
    /// The goal for the end effector at t_f.
    pub(crate) fn final_goal(&self) -> Option<&EndEffectorRows<Sp>> {
        self.end.iter().find_map(|block| match block {
            EndBlock::EndEffector(goal) => Some(goal),
            _ => None,
        })
    }

    /// The goals at way-points: which one, its fraction of the duration, its rows.
    pub(crate) fn way_point_goals(
        &self,
    ) -> impl Iterator<Item = (usize, f64, &EndEffectorRows<Sp>)> {
        let points = self.way_points.iter().enumerate();
        points.filter_map(|(w, point)| Some((w, point.fraction(), point.goal.as_ref()?)))
    }

    /// Values of a goal's rows for the states `x`, `t` seconds after t₀.
    pub(crate) fn goal_values(&self, goal: &EndEffectorRows<Sp>, x: &[f64], t: f64) -> Vec<f64> {
        let mut data = Data::<Sp, f64>::new(self.tree());
        let mut rows = vec![0.0; goal.rows().len()];
        goal.values(&self.pose(x, &[], t, &mut data), &mut rows);
        rows
    }

    /// Values of the path rows at every collocation point of `trajectory`.
    pub fn path_values(&self, trajectory: &Discretization) -> Vec<Vec<f64>> {
        let mut scratch = self.scratch::<f64>();
        let mut rates = vec![0.0; trajectory.states];
        let times = trajectory.times();
        let trajectory = &self.with_peaks(trajectory.clone());
        (0..trajectory.mesh.points())
            .map(|k| {
                let mut rows = vec![0.0; self.path_rows().len()];
                let (x, u, t) = (trajectory.state(k), trajectory.control(k), times[k]);
                let point = trajectory.point(x, u, t);
                self.continuous(point, &mut scratch, &mut rates, &mut rows);
                rows
            })
            .collect()
    }

    /// States and values of the rows at every way-point of `trajectory`.
    pub fn way_point_values(&self, trajectory: &Discretization) -> Vec<(Vec<f64>, Vec<f64>)> {
        let mut u = vec![0.0; trajectory.controls];
        let points = self.way_points.iter();
        points
            .map(|point| {
                let mut x = vec![0.0; trajectory.states];
                trajectory.at_fraction(point.fraction(), &mut x, &mut u);
                let t = point.fraction() * trajectory.duration;
                let goal = point.goal.as_ref();
                let rows = goal.map_or_else(Vec::new, |goal| self.goal_values(goal, &x, t));
                (x, rows)
            })
            .collect()
    }

    /// Values of the boundary rows at the ends of `trajectory`.
    pub fn end_values(&self, trajectory: &Discretization) -> Vec<f64> {
        let mut rows = vec![0.0; self.bounded.boundary.len()];
        let mut trajectory = self.with_peaks(trajectory.clone());
        trajectory.integrals = integrals(self, &self.formulation, &trajectory);
        self.boundary(trajectory.ends(), &mut self.scratch::<f64>(), &mut rows);
        rows
    }

    /// The cost of `trajectory`, term by term, by the quadrature of (25).
    pub fn cost_terms(&self, trajectory: &Discretization) -> CostTerms {
        let (plant, peaks) = (&self.plant, self.peaks(trajectory));
        let mut data = Data::<Sp, f64>::new(&plant.tree);
        let mut eta_rates = vec![0.0; plant.parameters()];
        let mut torque = vec![0.0; plant.joints()];
        let mut sums = vec![0.0; self.path_cost.len()];
        let times = trajectory.times();
        let weights = quadrature(&trajectory.mesh, trajectory.duration);
        for (k, weight) in weights.into_iter().enumerate() {
            let (x, u) = (trajectory.state(k), trajectory.control(k));
            let (eta, joints) = x.split_at(plant.parameters());
            let (theta, dtheta) = joints.split_at(plant.joints());
            plant.tree.kinematics(theta, &mut data);
            plant.tree.momentum(&mut data);
            plant.base_rate(eta, dtheta, &mut data);
            plant.attitude.rates(eta, &data.base_rate, &mut eta_rates);
            if self.needs.torque {
                plant.tree.mass_matrix(&mut data);
                torques(&data.mass_matrix, u, &mut torque);
            }
            let at = Instant {
                pose: Pose {
                    plant,
                    eta,
                    t: times[k],
                    data: &data,
                    parameters: &peaks,
                },
                dtheta,
                u,
                base_rate: plant.limited_rates(&eta_rates, &data.base_rate),
                torque: &torque,
            };
            for (sum, term) in sums.iter_mut().zip(&self.path_cost) {
                *sum += weight * term.value(&at);
            }
        }
        let last = trajectory.state(trajectory.mesh.points());
        let end = self.pose(last, &peaks, trajectory.duration, &mut data);
        let path = self
            .path_cost
            .iter()
            .zip(sums)
            .map(|(term, value)| CostTerm {
                id: PathTerm::<Sp>::id(term),
                side: PathTerm::<Sp>::side(term),
                value,
            });
        let ends = self.end_cost.iter().map(|term| CostTerm {
            id: EndTerm::<Sp>::id(term),
            side: EndTerm::<Sp>::side(term),
            value: term.value(&end),
        });
        CostTerms {
            terms: path.chain(ends).collect(),
        }
    }
}

/// The cost of a planned motion with the weights of `problem`, term by term.
pub fn cost_terms(problem: &Problem, plan: &Discretization) -> CostTerms {
    with_system!(&System::new(problem), system => system.cost_terms(plan))
}
