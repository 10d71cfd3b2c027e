//! What `compare` leaves behind: one task by every planner as Markdown, CSV and JSON.

use super::Sheet;
use super::rows::Rows;
use crate::planner::Status;
use crate::study::{Comparison, Entry};
use crate::system::{JointEffort, Metrics};
use crate::text::digits::digits;
use serde::Serialize;

/// One task by every planner.
pub type ComparisonReport<'a> = Rows<'a, ComparisonRow>;

/// One planner; SI units and radians, null where there is no plan.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComparisonRow {
    method: &'static str,
    description: &'static str,
    /// As in `solution.json`, or "not_for_this_task".
    status: &'static str,
    /// Why it is not solved.
    reason: Option<String>,
    max_base_attitude: Option<f64>,
    final_base_attitude: Option<f64>,
    max_base_displacement: Option<f64>,
    final_base_displacement: Option<f64>,
    base_rate_integral: Option<f64>,
    control_integral: Option<f64>,
    torque_integral: Option<f64>,
    peak_joint_velocity: Option<f64>,
    peak_joint_torque: Option<f64>,
    /// J of the problem, whatever the planner's own cost.
    objective: Option<f64>,
    /// Wall time, s.
    seconds: Option<f64>,
}

impl ComparisonRow {
    /// The row of one planner.
    fn of(entry: &Entry) -> Self {
        let (plan, refused) = match &entry.plan {
            Ok(plan) => (Some(plan), None),
            Err(reason) => (None, Some(reason.clone())),
        };
        let effort = plan.map(|p| JointEffort::of(&p.trajectory, &p.discretization.mesh));
        let metric = |value: fn(&Metrics) -> f64| plan.map(|p| value(&p.metrics));
        let reason = plan.and_then(|plan| match (&plan.diagnosis, plan.status) {
            (Some(diagnosis), _) => Some(diagnosis.summary.clone()),
            (None, Status::NotConverged) => Some(match plan.iterations.last() {
                Some(last) if !last.nlp_status.is_solved() => last.nlp_status.describe().into(),
                _ => format!(
                    "the tolerance {:e} is not reached, the largest error is {:.1e}",
                    plan.tolerance, plan.max_error
                ),
            }),
            _ => None,
        });
        Self {
            method: entry.method.name(),
            description: entry.method.describe(),
            status: plan.map_or("not_for_this_task", |plan| plan.status.name()),
            reason: refused.or(reason),
            max_base_attitude: metric(|m| m.max_base_attitude),
            final_base_attitude: metric(|m| m.final_base_attitude),
            max_base_displacement: metric(|m| m.max_base_displacement),
            final_base_displacement: metric(|m| m.final_base_displacement),
            base_rate_integral: effort.map(|e| e.base_rate),
            control_integral: effort.map(|e| e.control),
            torque_integral: effort.map(|e| e.torque),
            peak_joint_velocity: metric(|m| m.peak_joint_velocity),
            peak_joint_torque: metric(|m| m.peak_joint_torque),
            objective: plan.map(|p| p.objective).filter(|j| j.is_finite()),
            seconds: plan.map(|p| p.timing.total.as_secs_f64()),
        }
    }
}

impl<'a> ComparisonReport<'a> {
    /// The report on `found` for the problem `name`.
    pub fn of(name: &'a str, found: &'a Comparison) -> Self {
        Self {
            name,
            rows: found.entries.iter().map(ComparisonRow::of).collect(),
            notes: &found.notes,
        }
    }

    /// The table, then why planners have no solution.
    pub fn markdown(&self) -> String {
        let mut text = format!(
            "`{}` by every planner.\n\n{}\n",
            self.name,
            self.sheet().markdown()
        );
        for row in &self.rows {
            if let Some(reason) = &row.reason {
                text.push_str(&format!("- {}: {reason}\n", row.method));
            }
        }
        text.push_str(&self.list());
        text.push_str(&format!(
            "\nAngles are those of the base's rotation. Sliding joints count in m and N. J is \
             the problem's cost, whatever a planner's own{}.\n{}",
            match self.has_infeasible() {
                true => "; where infeasible, that of a motion that does not keep all limits",
                false => "",
            },
            Self::origin()
        ));
        text
    }

    fn has_infeasible(&self) -> bool {
        let infeasible = Status::Infeasible.name();
        self.rows.iter().any(|row| row.status == infeasible)
    }

    fn sheet(&self) -> Sheet {
        let mut sheet = Sheet::new(&[
            "planner",
            "status",
            "base attitude max / °",
            "end / °",
            "displacement max / cm",
            "end / cm",
            "∫‖u‖²",
            "∫‖τ‖²",
            "joint rate max / °/s",
            "torque max / N·m",
            "J",
            "time / s",
        ])
        .words(2);
        let shown = |value: Option<f64>, factor: f64, decimals: usize| {
            value.map_or_else(|| "–".into(), |v| digits(v * factor, decimals, 2))
        };
        let digits = |value: Option<f64>| value.map_or_else(|| "–".into(), |v| format!("{v:.3e}"));
        let degrees = 1f64.to_degrees();
        for row in &self.rows {
            sheet.row(vec![
                row.method.into(),
                row.status.replace('_', " "),
                shown(row.max_base_attitude, degrees, 3),
                shown(row.final_base_attitude, degrees, 3),
                shown(row.max_base_displacement, 100.0, 3),
                shown(row.final_base_displacement, 100.0, 3),
                digits(row.control_integral),
                digits(row.torque_integral),
                shown(row.peak_joint_velocity, degrees, 3),
                shown(row.peak_joint_torque, 1.0, 4),
                shown(row.objective, 1.0, 6),
                shown(row.seconds, 1.0, 3),
            ]);
        }
        sheet
    }
}
