//! What `pareto` leaves behind: the trade-off curve as Markdown, CSV and JSON.

use super::Sheet;
use super::rows::Rows;
use crate::planner::Status;
use crate::study::pareto::ParetoPoint;
use crate::system::JointEffort;
use crate::text::digits::digits;
use serde::Serialize;

/// The trade-off between the base's motion and the joints' effort.
pub type ParetoReport<'a> = Rows<'a, ParetoRow>;

/// One point of the curve; SI units and radians.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParetoRow {
    /// On the weights of the base.
    pub(super) factor: f64,
    /// On the base's motion B, where no factor leads to the point; none elsewhere.
    pub(super) bound: Option<f64>,
    pub(super) status: Status,
    /// Weighted terms of the cost about the base, without the factor.
    pub(super) base_motion: f64,
    /// Weighted terms of the cost about the joints.
    pub(super) joint_effort: f64,
    pub(super) max_base_attitude: f64,
    pub(super) final_base_attitude: f64,
    pub(super) max_base_displacement: f64,
    pub(super) final_base_displacement: f64,
    pub(super) base_rate_integral: f64,
    pub(super) control_integral: f64,
    pub(super) torque_integral: f64,
    pub(super) peak_joint_velocity: f64,
    pub(super) peak_joint_torque: f64,
    pub(super) meshes: usize,
    pub(super) nlp_iterations: u32,
    pub(super) points: usize,
    /// Wall time, s.
    pub(super) seconds: f64,
}

impl ParetoRow {
    /// The row of one point.
    fn of(point: &ParetoPoint) -> Self {
        let plan = &point.plan;
        let effort = JointEffort::of(&plan.trajectory, &plan.discretization.mesh);
        let metrics = &plan.metrics;
        Self {
            factor: point.factor,
            bound: point.bound,
            status: plan.status,
            base_motion: point.base,
            joint_effort: point.joints,
            max_base_attitude: metrics.max_base_attitude,
            final_base_attitude: metrics.final_base_attitude,
            max_base_displacement: metrics.max_base_displacement,
            final_base_displacement: metrics.final_base_displacement,
            base_rate_integral: effort.base_rate,
            control_integral: effort.control,
            torque_integral: effort.torque,
            peak_joint_velocity: metrics.peak_joint_velocity,
            peak_joint_torque: metrics.peak_joint_torque,
            meshes: plan.iterations.len(),
            nlp_iterations: plan.iterations.iter().map(|i| i.nlp_iterations).sum(),
            points: plan.discretization.mesh.points(),
            seconds: plan.timing.total.as_secs_f64(),
        }
    }

    /// Whether the point belongs to the curve.
    pub(super) fn is_solved(&self) -> bool {
        self.status == Status::Solved
    }
}

impl<'a> ParetoReport<'a> {
    /// The report on `points` for the problem `name`.
    pub fn of(name: &'a str, points: &[ParetoPoint], notes: &'a [String]) -> Self {
        Self {
            name,
            rows: points.iter().map(ParetoRow::of).collect(),
            notes,
        }
    }

    /// The table, and what its columns are.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "`{}`: base motion against joint effort.\n\n{}\n\
             B and E are the terms of the problem's cost about the base and about the joints; \
             every\nplan minimises factor·B + E, \
             or E under a bound on B where no factor leads.\n",
            self.name,
            self.sheet().markdown()
        );
        text.push_str(&self.list());
        text.push_str(&Self::origin());
        text
    }

    /// One row a point.
    pub(super) fn sheet(&self) -> Sheet {
        let mut sheet = Sheet::new(&[
            "factor on the base",
            "status",
            "base motion B",
            "joint effort E",
            "attitude max / °",
            "end / °",
            "displacement end / cm",
            "∫‖u‖²",
            "∫‖τ‖²",
            "Ipopt iterations",
            "time / s",
        ]);
        for row in &self.rows {
            sheet.row(vec![
                match row.bound {
                    Some(bound) => format!("B ≤ {bound:.3e}"),
                    None => format!("{:.3e}", row.factor),
                },
                row.status.words().into(),
                format!("{:.4e}", row.base_motion),
                format!("{:.4e}", row.joint_effort),
                digits(row.max_base_attitude.to_degrees(), 3, 2),
                digits(row.final_base_attitude.to_degrees(), 3, 2),
                digits(100.0 * row.final_base_displacement, 3, 2),
                format!("{:.3e}", row.control_integral),
                format!("{:.3e}", row.torque_integral),
                row.nlp_iterations.to_string(),
                format!("{:.3}", row.seconds),
            ]);
        }
        sheet
    }
}
