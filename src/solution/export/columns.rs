//! A motion as named columns with units.

use super::Samples;
use crate::dynamics::JointKind;
use crate::problem::Unit;

/// A column of numbers.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Column {
    /// Its quantity and component, `joint_position.elbow`.
    pub name: String,
    /// Its unit, ASCII characters alone.
    pub unit: &'static str,
    /// A value a row.
    pub values: Vec<f64>,
}

/// The unit of a quantity of a joint.
type UnitOf = fn(JointKind) -> Unit;

/// Quantities of a joint, with their units.
const OF_JOINTS: [(&str, UnitOf); 5] = [
    ("joint_position", Unit::position),
    ("joint_velocity", Unit::rate),
    ("joint_acceleration", Unit::acceleration),
    ("control", Unit::acceleration),
    ("joint_torque", Unit::effort),
];

/// The columns of `samples`: `time`, the base's pose and velocities by axis, then quantity by quantity a
/// column a joint, named by it.
pub fn columns(samples: &Samples) -> Vec<Column> {
    let mut columns = vec![Column {
        name: "time".into(),
        unit: "s",
        values: samples.t.clone(),
    }];
    let base = |quantity: &str, axes: &[&str], unit, of: &dyn Fn(usize, usize) -> f64| {
        let column = |(axis, name): (usize, &&str)| Column {
            name: format!("{quantity}.{name}"),
            unit,
            // Adding zero takes the sign off a zero.
            values: (0..samples.t.len()).map(|k| of(k, axis) + 0.0).collect(),
        };
        axes.iter().enumerate().map(column).collect::<Vec<_>>()
    };
    let (axes, rows) = (["x", "y", "z"], &samples.base);
    columns.extend(base("base_position", &axes, "m", &|k, i| {
        rows[k].position[i]
    }));
    columns.extend(base(
        "base_quaternion",
        &["w", "x", "y", "z"],
        "1",
        &|k, i| rows[k].quaternion[i],
    ));
    columns.extend(base("base_velocity", &axes, "m/s", &|k, i| {
        rows[k].velocity[i]
    }));
    columns.extend(base("base_angular_velocity", &axes, "rad/s", &|k, i| {
        rows[k].angular_velocity[i]
    }));
    for ((quantity, unit), rows) in OF_JOINTS.into_iter().zip(samples.joint_rows()) {
        for (j, (joint, kind)) in samples.joints.iter().zip(&samples.kinds).enumerate() {
            columns.push(Column {
                name: format!("{quantity}.{joint}"),
                unit: plain(unit(*kind)),
                values: rows.iter().map(|row| row[j]).collect(),
            });
        }
    }
    columns
}

/// The symbol of a unit without characters that other tools may not read.
fn plain(unit: Unit) -> &'static str {
    match unit {
        Unit::RadianPerSecondSquared => "rad/s^2",
        Unit::MetrePerSecondSquared => "m/s^2",
        Unit::NewtonMetre => "N m",
        unit => unit.symbol(),
    }
}
