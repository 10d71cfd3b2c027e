//! What stands behind the rows and bounds of the programme: keys of the problem file, and the limits
//! that may give way.

use super::{FreeFloating, ROTATION};
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::ocp::{Interval, LimitGroup, Limited};

impl<Sp: Space> FreeFloating<Sp> {
    /// Key in the problem file of the limit behind path row `p`, and the joint it is about.
    pub fn path_limit(&self, p: usize) -> (&'static str, Option<usize>) {
        let count = |given: bool, rows: usize| if given { rows } else { 0 };
        let torques = count(self.rate_rows, Sp::ANGLES);
        let turn = torques + count(self.torque_rows, self.joint_count());
        if p < torques {
            ("limits.base_rate", None)
        } else if p < turn {
            ("limits.torque", Some(p - torques))
        } else if p < turn + self.turn.path().len() {
            ("limits.base_attitude", None)
        } else {
            ("limits.keep_out", None)
        }
    }

    /// Key in the problem file of the limit on state `i` along the path, and the joint it is about.
    pub fn state_limit(&self, i: usize) -> (&'static str, Option<usize>) {
        let n = self.joint_count();
        match i.checked_sub(self.attitude.count()) {
            None => ("limits.base_attitude", None),
            Some(j) if j < n => ("limits.joint_position", Some(j)),
            Some(j) => ("limits.joint_velocity", Some(j - n)),
        }
    }

    /// How far the pair behind path row `p` is too near where the row has that value, m.
    pub(crate) fn keep_out_depth(&self, p: usize, value: f64) -> f64 {
        let first = self.formulation.path.len() - self.keep_out.len();
        self.keep_out[p - first].depth(value)
    }

    /// Key in the problem file of what is behind boundary row `b`.
    pub fn boundary_key(&self, b: usize) -> &'static str {
        let goals = self.goal_rows();
        if b < goals {
            "task.final.end_effector"
        } else if b < goals + self.turn.ends().len() {
            "limits.final_base_attitude"
        } else {
            "limits.keep_out"
        }
    }

    /// Boundary rows of the end-effector goal, which come first.
    pub(super) fn goal_rows(&self) -> usize {
        self.formulation.boundary.len() - self.turn.ends().len() - self.keep_out.len()
    }

    /// Limits that may be what makes the problem infeasible, each with its key in the problem
    /// file. Base attitude along the path and at t_f give way together.
    pub fn limit_groups(&self) -> Vec<LimitGroup> {
        let n = self.joint_count();
        let states = &self.formulation.states;
        let scale = |bounds: &Interval| {
            let finite = [bounds.lower, bounds.upper].map(f64::abs);
            finite
                .into_iter()
                .filter(|b| b.is_finite())
                .fold(0.0, f64::max)
                .max(1e-3)
        };
        let mut groups = Vec::new();
        let mut push = |name: String, members: Vec<Limited>, bounds: &Interval| {
            if !members.is_empty() {
                groups.push(LimitGroup {
                    name,
                    members,
                    scale: scale(bounds),
                });
            }
        };
        let whole = !self.attitude.is_angles();
        let mut turn = Vec::new();
        for (i, state) in states.iter().enumerate().take(self.attitude.count()) {
            let along = state.bounds;
            let at_end = self.formulation.terminal[i];
            let members = [(along, Limited::State(i)), (at_end, Limited::Terminal(i))];
            let tightest = along.intersect(&at_end);
            let members = members
                .into_iter()
                .filter(|(b, _)| !b.is_free())
                .map(|(_, m)| m);
            if whole {
                turn.extend(members);
            } else {
                push(state.name.clone(), members.collect(), &tightest);
            }
        }
        // All that bounds the rotation angle gives way together.
        let on_turn = |p: &usize| self.path_limit(*p).0 == "limits.base_attitude";
        let path = 0..self.formulation.path.len();
        turn.extend(path.filter(on_turn).map(Limited::Path));
        let ends = (0..self.turn.ends().len()).map(|b| Limited::Boundary(self.goal_rows() + b));
        turn.extend(ends);
        // Of the squares: twice the relative excess of the angle, to first order.
        push(ROTATION.into(), turn, &Interval::symmetric(2.0));
        for (i, row) in self
            .formulation
            .path
            .iter()
            .enumerate()
            .filter(|(i, r)| !r.bounds.is_free() && !on_turn(i))
        {
            let mut members = vec![Limited::Path(i)];
            // The same pair at t_f: both lists of rows end with the pairs.
            if self.path_limit(i).0 == "limits.keep_out" {
                let from_last = self.formulation.path.len() - i;
                members.push(Limited::Boundary(
                    self.formulation.boundary.len() - from_last,
                ));
            }
            push(row.name.clone(), members, &row.bounds);
        }
        // Positions before rates: where both could give way, the cheaper one is found anyway.
        let joints = states.iter().enumerate().skip(self.attitude.count());
        for (i, state) in joints.take(2 * n) {
            if !state.bounds.is_free() {
                push(state.name.clone(), vec![Limited::State(i)], &state.bounds);
            }
        }
        let goal_rows = &self.formulation.boundary[..self.goal_rows()];
        for (b, row) in goal_rows.iter().enumerate() {
            // Allowed distances are small; a tenth of a metre or radian counts as one.
            groups.push(LimitGroup {
                name: row.name.clone(),
                members: vec![Limited::Boundary(b)],
                scale: 0.1,
            });
        }
        for (w, point) in self.formulation.way_points.iter().enumerate() {
            let mut push = |name: String, member| {
                groups.push(LimitGroup {
                    name,
                    members: vec![member],
                    scale: 0.1,
                });
            };
            for (i, _) in point
                .states
                .iter()
                .enumerate()
                .filter(|(_, b)| !b.is_free())
            {
                let name = format!("{}, way-point {}", states[i].name, w + 1);
                push(name, Limited::Passed(w, i));
            }
            for (r, row) in point.rows.iter().enumerate() {
                push(row.name.clone(), Limited::WayPoint(w, r));
            }
        }
        let mut push = |name: String, members: Vec<Limited>, bounds: &Interval| {
            groups.push(LimitGroup {
                name,
                members,
                scale: scale(bounds),
            });
        };
        for (j, control) in self.formulation.controls.iter().enumerate() {
            if !control.bounds.is_free() {
                push(
                    control.name.clone(),
                    vec![Limited::Control(j)],
                    &control.bounds,
                );
            }
        }
        groups
    }
}
