//! `trajectory.csv`: one row a time, one column a component.

use super::Trajectory;

/// The trajectory as CSV, all digits; a value that is not finite is left empty.
///
/// Columns: `t, eta_…, zeta_…, th_…, dth_…, u_…, tau_…, deta_…`, components counted from 1.
///
/// # Errors
/// Where the rows differ in length.
pub fn trajectory_csv(trajectory: &Trajectory) -> Result<String, csv::Error> {
    let columns: [(&str, &[Vec<f64>]); 7] = [
        ("eta", &trajectory.base_attitude),
        ("zeta", &trajectory.base_position),
        ("th", &trajectory.joint_position),
        ("dth", &trajectory.joint_velocity),
        ("u", &trajectory.control),
        ("tau", &trajectory.joint_torque),
        ("deta", &trajectory.base_rate),
    ];
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header = vec!["t".to_string()];
    for (name, rows) in columns {
        let count = rows.first().map_or(0, Vec::len);
        header.extend((1..=count).map(|component| format!("{name}_{component}")));
    }
    writer.write_record(header)?;
    for (k, t) in trajectory.t.iter().enumerate() {
        let values = columns.iter().filter_map(|(_, rows)| rows.get(k)).flatten();
        let row: Vec<Option<f64>> = std::iter::once(t)
            .chain(values)
            .map(|value| value.is_finite().then_some(*value))
            .collect();
        writer.serialize(row)?;
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_flattened_and_digits_kept() {
        let one = |value| vec![vec![value]];
        let trajectory = Trajectory {
            t: vec![0.1],
            attitude: "angle".into(),
            base_attitude: one(1.0 / 3.0),
            base_position: vec![vec![1e-20, 2.0]],
            base_rate: one(3.0),
            joint_position: one(4.0),
            joint_velocity: one(5.0),
            control: one(f64::NAN),
            joint_torque: one(-7.0),
        };
        assert_eq!(
            trajectory_csv(&trajectory).unwrap(),
            "t,eta_1,zeta_1,zeta_2,th_1,dth_1,u_1,tau_1,deta_1\n\
             0.1,0.3333333333333333,1e-20,2.0,4.0,5.0,,-7.0,3.0\n"
        );
    }
}
