//! A planning problem built in code: two arm poses, limits, weights, a plan.
//!
//! ```sh
//! cargo run --release --example plan_in_code
//! ```

use ffsm_ipopt::dynamics::{Body, Inertia, Joint, JointKind, JointLimits, Model, Placement};
use ffsm_ipopt::nalgebra::{Matrix3, Vector3};
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Status, plan};
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::verify::verify;
use std::error::Error;

/// A three-link planar arm on a 60 kg microsatellite.
fn robot() -> Result<Model, Box<dyn Error>> {
    let body = |name: &str, mass: f64, length: f64| -> Result<Body, Box<dyn Error>> {
        let inertia = Matrix3::identity() * mass * length * length / 12.0;
        let center = Vector3::new(0.5 * length, 0.0, 0.0);
        Ok(Body {
            name: name.into(),
            inertia: Inertia::new(mass, center, inertia)?,
        })
    };
    let joint = |name: &str, parent, offset, body| Joint {
        name: name.into(),
        kind: JointKind::Revolute,
        parent,
        placement: Placement::from_xyz_rpy([offset, 0.0, 0.0], [0.0; 3]),
        axis: Vector3::z_axis(),
        limits: JointLimits::NONE,
        body,
    };
    let base = Inertia::new(60.0, Vector3::zeros(), Matrix3::identity() * 2.5)?;
    let joints = vec![
        joint("shoulder", None, 0.25, body("upper arm", 3.0, 0.5)?),
        joint("elbow", Some(0), 0.5, body("forearm", 2.5, 0.5)?),
        joint("wrist", Some(1), 0.5, body("hand", 1.0, 0.2)?),
    ];
    Ok(Model::new(
        "microsat",
        Body {
            name: "bus".into(),
            inertia: base,
        },
        joints,
    )?)
}

/// Runs the example; its assertions are tested.
pub fn main() -> Result<(), Box<dyn Error>> {
    let mut problem = Problem::builder("deploy", robot()?, 15.0, &[0.0; 3], &[0.8, -0.6, 0.9]);
    problem.limits.joint_velocity = vec![Interval::symmetric(0.5); 3];
    problem.limits.control = vec![Interval::symmetric(1.0); 3];
    problem.cost.final_base_attitude = vec![100.0];
    problem.cost.final_base_position = vec![1.0; 2];
    problem.cost.base_rate = vec![1.0];
    problem.cost.joint_rate = vec![0.05; 3];
    problem.cost.control = vec![0.1; 3];
    let problem = problem.build()?;

    let plan = plan(&problem)?;
    assert_eq!(plan.status, Status::Solved);
    println!(
        "{} in {:.0} ms: base turns by at most {:.3}° and ends {:.3}° off",
        problem.name,
        plan.timing.total.as_secs_f64() * 1e3,
        plan.metrics.max_base_attitude.to_degrees(),
        plan.metrics.final_base_attitude.to_degrees(),
    );
    let checked = verify(&problem, &plan.discretization)?;
    println!(
        "re-integrated: the base is where it was planned to within {:.1e}°",
        checked.max_base_attitude_drift.to_degrees()
    );
    Ok(())
}
