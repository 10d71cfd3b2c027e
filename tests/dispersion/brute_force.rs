//! Single samples against the re-integration's own kinematics and inertia matrix.

use crate::{chaser, problems, run};
use ffsm_ipopt::config::Dispersion;
use ffsm_ipopt::dynamics::Model;
use ffsm_ipopt::integrate::Rk4;
use ffsm_ipopt::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use ffsm_ipopt::planner::plan;
use ffsm_ipopt::problem::Problem;
use ffsm_ipopt::study::dispersion::{Replays, Sample};
use ffsm_ipopt::system::watched_poses;
use ffsm_ipopt::transcription::Discretization;
use ffsm_ipopt::verify::bodies::{BaseMotion, Bodies, orientation};
use ffsm_ipopt::verify::mass_matrix::MassMatrix;

/// Orientation and position of the base at all times that figures are taken at.
fn poses(
    problem: &Problem,
    plan: &Discretization,
    model: &Model,
    sample: Option<&Sample>,
) -> Vec<(UnitQuaternion<f64>, Vector3<f64>)> {
    let n = model.joint_count();
    let angles = problem.attitude_sizes().0;
    let fractions: Vec<f64> = watched_poses(problem, plan)
        .iter()
        .map(|pose| pose.fraction)
        .collect();
    let plane = model.plane().map(|plane| plane.basis);
    let axes = |v: [f64; 3]| plane.map_or(Vector3::from(v), |basis| basis * Vector3::from(v));
    let linear = sample.map_or(Vector3::zeros(), |s| axes(s.linear));
    let angular = sample.map_or(Vector3::zeros(), |s| axes(s.angular));
    let start = orientation(model, problem.attitude, &plan.state(0)[..angles]);
    let mut bodies = Bodies::new(model);
    let mut mass = MassMatrix::new(model);
    let mut y = [0.0; 7];
    y[3..].copy_from_slice(start.coords.as_slice());
    let mut rk4 = Rk4::new(7);
    let mut found = vec![(start, Vector3::zeros())];
    for ends in fractions.windows(2) {
        let (s, _) = plan.mesh.locate(0.5 * (ends[0] + ends[1]));
        let cuts = plan.mesh.breakpoints();
        let unit = 0.5 * (cuts[s + 1] - cuts[s]) * plan.duration;
        let rate = |fraction: f64, y: &[f64], dy: &mut [f64]| {
            let tau = 2.0 * (fraction - cuts[s]) / (cuts[s + 1] - cuts[s]) - 1.0;
            let (mut x, mut dx) = (vec![0.0; plan.states], vec![0.0; plan.states]);
            plan.state_in(s, tau, &mut x);
            plan.state_derivative_in(s, tau, &mut dx);
            let (mut q, mut dq) = (vec![0.0; n], vec![0.0; n]);
            for j in 0..n {
                let [error, drift] =
                    sample.map_or([0.0; 2], |s| s.joint_error(j, fraction, plan.duration));
                q[j] = x[angles + j] + error;
                dq[j] = dx[angles + j] / unit + drift;
            }
            let turn = UnitQuaternion::new_normalize(Quaternion::new(y[6], y[3], y[4], y[5]));
            let position = Vector3::new(y[0], y[1], y[2]);
            bodies.update(model, &BaseMotion::placed(position, turn), &q, &dq);
            mass.update(model, &bodies, &dq).unwrap();
            let arm = bodies.center() - position;
            let (velocity, omega) =
                mass.with_momentum(&dq, &linear, &(angular + arm.cross(&linear)));
            let spin = Quaternion::from_imag(omega) * turn.into_inner() * 0.5;
            dy[..3].copy_from_slice(velocity.as_slice());
            dy[3..].copy_from_slice(spin.coords.as_slice());
            dy.iter_mut().for_each(|rate| *rate *= plan.duration);
        };
        if ends[1] > ends[0] {
            rk4.integrate(rate, [ends[0], ends[1]], 3, &mut y);
        }
        let turn = UnitQuaternion::new_normalize(Quaternion::new(y[6], y[3], y[4], y[5]));
        found.push((turn, Vector3::new(y[0], y[1], y[2])));
    }
    found
}

fn check(problem: &Problem, attitudes: f64) {
    let plan = plan(problem).unwrap().discretization;
    let mut dispersion = Dispersion::usual(&problem.robot);
    for set in [
        "body.*.mass=normal(100%, 10%)",
        "body.*.com=normal(0, 0.02)",
        "body.*.inertia=uniform(50%, 150%)",
        "joint.*.offset=normal(0, 0.02)",
        "joint.*.tracking=normal(0, 0.01)",
        "momentum.linear=normal(0.05, 0.1)",
        "momentum.angular=normal(0, 0.02)",
    ] {
        dispersion.set(&problem.robot, set).unwrap();
    }
    let replays = Replays::new(problem, &plan, &dispersion, 11).unwrap();
    let figures = run(&replays, 20);
    let nominal = poses(problem, &plan, &problem.robot, None);
    for index in [0, 7, 8, 19] {
        let sample = replays.sample(index).unwrap();
        let found = poses(problem, &plan, &sample.model, Some(&sample));
        let figures = &figures[index as usize];
        let angles = found.iter().map(|(turn, _)| turn.angle());
        let moves = found.iter().map(|(_, position)| position.norm());
        // The plan's collocation error is taken off each sample.
        let room = 1e-8 + replays.drift()[0] + replays.drift()[1];
        for (name, figure, expected) in [
            (
                "largest angle",
                figures.max_base_attitude,
                angles.fold(0.0, f64::max),
            ),
            (
                "displacement",
                figures.max_base_displacement,
                moves.fold(0.0, f64::max),
            ),
            (
                "last displacement",
                figures.final_base_displacement,
                found.last().unwrap().1.norm(),
            ),
            (
                "last angle",
                figures.final_base_attitude,
                found.last().unwrap().0.angle(),
            ),
        ] {
            let gap = (figure - expected).abs();
            assert!(
                gap < room,
                "{} {index} {name}: {figure} {expected}",
                problem.name
            );
        }
        let departed = nominal.last().unwrap().0.inverse() * found.last().unwrap().0;
        assert!(
            departed.angle() > attitudes,
            "it does perturb: {departed:?}"
        );
        let gap = (figures.departure_angle() - departed.angle()).abs();
        assert!(gap < room, "{} {index}: {gap:e}", problem.name);
    }
}

#[test]
fn samples_in_space() {
    check(&chaser("roll-pitch-yaw"), 1e-4);
}

#[test]
fn samples_in_the_plane() {
    check(&problems::smooth(), 1e-4);
}
