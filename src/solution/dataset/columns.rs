//! Records as columns. docs/batches.md lists them.

use super::table::{Column, Data};
use crate::config::{Cell, CellKind};
use crate::study::batch::{Figures, Motion, Record};

/// The positions of the rows in the batch.
pub(super) const ROW: &str = "row";
/// How the rows ended.
pub(super) const STATUS: &str = "status";

/// A column by its name, and its value of one row.
type Named<T, V> = (&'static str, fn(&T) -> V);

/// The columns of `records`, those of the keys that vary among them, and those of the motions where
/// they are asked for.
pub(super) fn of(records: &[Record], keys: &[(String, CellKind)], motions: bool) -> Vec<Column> {
    let mut columns = vec![
        column(
            ROW,
            Data::Integer(each(records, |r| Some(r.position as i64))),
        ),
        column("key", text(records, |r| r.key.clone())),
        column("name", text(records, |r| r.name.clone())),
        column(STATUS, text(records, |r| r.status.name().into())),
        column("reason", text(records, |r| r.reason.clone())),
    ];
    for (i, (name, kind)) in keys.iter().enumerate() {
        columns.push(column(name, cells(records, i, *kind)));
    }
    let integers: [Named<Figures, i64>; 4] = [
        ("points", |f| f.points as i64),
        ("segments", |f| f.segments as i64),
        ("mesh_iterations", |f| f.mesh_iterations as i64),
        ("nlp_iterations", |f| f.nlp_iterations as i64),
    ];
    let numbers: [Named<Figures, Option<f64>>; 17] = [
        ("objective", |f| Some(f.objective)),
        ("max_error", |f| Some(f.max_error)),
        ("max_base_attitude", |f| Some(f.max_base_attitude)),
        ("final_base_attitude", |f| Some(f.final_base_attitude)),
        ("max_base_displacement", |f| Some(f.max_base_displacement)),
        ("final_base_displacement", |f| {
            Some(f.final_base_displacement)
        }),
        ("peak_joint_velocity", |f| Some(f.peak_joint_velocity)),
        ("peak_joint_torque", |f| Some(f.peak_joint_torque)),
        ("goal_distance", |f| f.goal_distance),
        ("goal_angle", |f| f.goal_angle),
        ("verification_attitude", |f| f.verification_attitude),
        ("verification_position", |f| f.verification_position),
        ("verification_joint", |f| f.verification_joint),
        ("seconds_setup", |f| Some(f.seconds_setup)),
        ("seconds_derivatives", |f| Some(f.seconds_derivatives)),
        ("seconds_linear_solver", |f| Some(f.seconds_linear_solver)),
        ("seconds_ipopt_other", |f| Some(f.seconds_ipopt_other)),
    ];
    for (name, of) in integers {
        let values = each(records, |r| r.figures.as_ref().map(of));
        columns.push(column(name, Data::Integer(values)));
    }
    for (name, of) in numbers {
        let values = each(records, |r| r.figures.as_ref().and_then(of));
        columns.push(column(name, Data::Number(values)));
    }
    columns.push(column(
        "seconds",
        Data::Number(each(records, |r| Some(r.seconds))),
    ));
    let solver = |r: &Record| {
        r.figures
            .as_ref()
            .map_or(String::new(), |f| f.linear_solver.clone())
    };
    columns.push(column("linear_solver", text(records, solver)));
    if motions {
        columns.extend(motion(records));
    }
    columns
}

fn motion(records: &[Record]) -> impl Iterator<Item = Column> {
    let rows: [Named<Motion, Vec<Vec<f64>>>; 7] = [
        ("base_attitude", |m| m.base_attitude.clone()),
        ("base_position", |m| m.base_position.clone()),
        ("base_rate", |m| m.base_rate.clone()),
        ("joint_position", |m| m.joint_position.clone()),
        ("joint_velocity", |m| m.joint_velocity.clone()),
        ("control", |m| m.control.clone()),
        ("joint_torque", |m| m.joint_torque.clone()),
    ];
    let t = each(records, |r| r.motion.as_ref().map(|m| m.t.clone()));
    let t = column("t", Data::Numbers(t));
    std::iter::once(t).chain(rows.into_iter().map(|(name, of)| {
        let values = each(records, |r| r.motion.as_ref().map(of));
        column(name, Data::Rows(values))
    }))
}

fn column(name: &str, data: Data) -> Column {
    let name = name.into();
    Column { name, data }
}

fn each<T>(records: &[Record], of: impl Fn(&Record) -> Option<T>) -> Vec<Option<T>> {
    records.iter().map(of).collect()
}

/// Texts, none where one is empty.
fn text(records: &[Record], of: impl Fn(&Record) -> String) -> Data {
    Data::Text(each(records, |r| {
        Some(of(r)).filter(|text| !text.is_empty())
    }))
}

/// The values of the key with that index.
fn cells(records: &[Record], index: usize, kind: CellKind) -> Data {
    let cell = |record: &Record| record.cells.get(index).cloned();
    match kind {
        CellKind::Number => Data::Number(each(records, |r| match cell(r)? {
            Cell::Number(number) => Some(number),
            _ => None,
        })),
        CellKind::Text => Data::Text(each(records, |r| match cell(r)? {
            Cell::Text(text) => Some(text),
            _ => None,
        })),
        CellKind::Numbers => Data::Numbers(each(records, |r| match cell(r)? {
            Cell::Numbers(numbers) => Some(numbers),
            _ => None,
        })),
    }
}
