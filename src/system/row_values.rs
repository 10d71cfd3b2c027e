//! Values of rows along a trajectory, and of the goals for the end effector.

use super::FreeFloating;
use super::rows::GoalRows;
use crate::autodiff::Scalar;
use crate::dynamics::Data;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::ocp::{Ends, Ocp, Point};
use crate::transcription::Discretization;

impl<Sp: Space> FreeFloating<Sp> {
    /// The goal for the end effector at t_f.
    pub(crate) fn final_goal(&self) -> Option<&GoalRows<Sp>> {
        self.goal.as_ref()
    }

    /// The goals at way-points: which one, its fraction of the duration, its rows.
    pub(crate) fn way_point_goals(&self) -> impl Iterator<Item = (usize, f64, &GoalRows<Sp>)> {
        let fractions = self.formulation.way_points.iter().map(|p| p.fraction);
        let goals = fractions.zip(&self.way_points).enumerate();
        goals.filter_map(|(w, (fraction, goal))| Some((w, fraction, goal.as_ref()?)))
    }

    /// Values of a goal's rows for the states `x`, `t` seconds after t₀.
    pub(crate) fn goal_values(&self, goal: &GoalRows<Sp>, x: &[f64], t: f64) -> Vec<f64> {
        let mut data = Data::<Sp, f64>::new(&self.tree);
        let mut rows = vec![0.0; goal.quantities().len()];
        self.pose(goal, x, t, &mut data, &mut rows);
        rows
    }

    /// Rows of a goal for the states `x`, `t` seconds after t₀.
    pub(super) fn pose<S: Scalar>(
        &self,
        goal: &GoalRows<Sp>,
        x: &[S],
        t: S,
        data: &mut Data<Sp, S>,
        rows: &mut [S],
    ) {
        let (eta, joints) = x.split_at(self.attitude.count());
        self.tree.kinematics(&joints[..self.joint_count()], data);
        self.tree.momentum(data);
        if let Some(pose) = self.tree.end_effector(data) {
            let carry = |position: &mut [S]| self.drift.carry(t, position);
            let base = (self.attitude, eta);
            goal.values(base, pose, &data.system_center, carry, rows);
        }
    }

    /// Values of the path rows at every collocation point of `trajectory`.
    pub fn path_rows(&self, trajectory: &Discretization) -> Vec<Vec<f64>> {
        let mut scratch = self.scratch::<f64>();
        let mut rates = vec![0.0; trajectory.states];
        let times = trajectory.times();
        (0..trajectory.mesh.points())
            .map(|k| {
                let mut rows = vec![0.0; self.formulation.path.len()];
                let (x, u, t) = (trajectory.state(k), trajectory.control(k), times[k]);
                self.continuous(Point { x, u, t }, &mut scratch, &mut rates, &mut rows);
                rows
            })
            .collect()
    }

    /// States and values of the rows at every way-point of `trajectory`.
    pub fn passed(&self, trajectory: &Discretization) -> Vec<(Vec<f64>, Vec<f64>)> {
        let mut u = vec![0.0; trajectory.controls];
        let points = self.formulation.way_points.iter().zip(&self.way_points);
        points
            .map(|(point, goal)| {
                let mut x = vec![0.0; trajectory.states];
                trajectory.at_fraction(point.fraction, &mut x, &mut u);
                let t = point.fraction * trajectory.duration;
                let goal = goal.as_ref();
                let rows = goal.map_or_else(Vec::new, |goal| self.goal_values(goal, &x, t));
                (x, rows)
            })
            .collect()
    }

    /// Values of the boundary rows at the ends of `trajectory`.
    pub fn end_rows(&self, trajectory: &Discretization) -> Vec<f64> {
        let mut rows = vec![0.0; self.formulation.boundary.len()];
        let ends = Ends {
            initial: trajectory.state(0),
            terminal: trajectory.state(trajectory.mesh.points()),
            duration: trajectory.duration,
        };
        self.boundary(ends, &mut self.scratch::<f64>(), &mut rows);
        rows
    }
}
