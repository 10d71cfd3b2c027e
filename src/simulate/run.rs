//! One run: the plan played on the platform from release to the end.

use super::SimulateError;
use super::dynamics::{BASE, PlanarDynamics, Wrench};
use super::forces::Forces;
use super::noise::{Noise, Source};
use super::platform::JointFriction;
use super::player::Player;
use super::tracking::Tracking;
use crate::integrate::{DormandPrince, IntegrationError, Ode};
use nalgebra::Vector2;
use std::collections::VecDeque;

const RELATIVE: f64 = 1e-10;
const ABSOLUTE: f64 = 1e-13;
/// Far above what any run needs.
const MAX_STEPS: usize = 50_000_000;
/// A joint farther from its plan has run away, rad or m.
const LOST: f64 = 10.0;
/// Instants closer than this are one, s.
const INSTANT: f64 = 1e-9;

/// What happened in one run, one row a frame of the motion capture.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Run {
    /// Times, s; the last is the end of the plan.
    pub t: Vec<f64>,
    /// Position x, y (m) of the tracked point and attitude (rad), as measured.
    pub measured: Vec<[f64; BASE]>,
    /// Position x, y of the base's origin and attitude, as they were.
    pub actual: Vec<[f64; BASE]>,
    /// Joint positions, rad or m.
    pub joint_position: Vec<Vec<f64>>,
    /// Torques, N·m or N, joint friction not counted.
    pub joint_torque: Vec<Vec<f64>>,
    /// Largest difference between a joint and its plan, rad or m.
    pub max_joint_error: f64,
    /// Largest change of the linear momentum, kg m/s.
    pub max_linear_momentum: f64,
    /// Largest change of the angular momentum about the system's mass centre, kg m²/s.
    pub max_angular_momentum: f64,
    /// Steps of the adaptive integrator.
    pub steps: usize,
}

/// The robot under torques and forces: y = [q, v], both of length 3 + n.
struct Plant {
    dynamics: PlanarDynamics,
    forces: Forces,
    friction: JointFriction,
    /// Torques of the actuators.
    torque: Vec<f64>,
    /// The same less friction.
    net: Vec<f64>,
    wrenches: Vec<Wrench>,
    linear: Vector2<f64>,
    angular: f64,
    found: [f64; 2],
}

impl Ode for Plant {
    type Error = std::convert::Infallible;

    fn rate(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Error> {
        let size = self.dynamics.size();
        let (q, v) = y.split_at(size);
        self.dynamics.place(q, v);
        self.forces
            .wrenches(self.dynamics.states(), q[2], &mut self.wrenches);
        let JointFriction {
            coulomb,
            viscous,
            slip_rate,
        } = self.friction;
        for ((net, torque), rate) in self.net.iter_mut().zip(&self.torque).zip(&v[BASE..]) {
            *net =
                torque - rate * (viscous + coulomb / (rate * rate + slip_rate * slip_rate).sqrt());
        }
        let (dq, dv) = dy.split_at_mut(size);
        dq.copy_from_slice(v);
        self.dynamics.accelerations(&self.wrenches, &self.net, dv);
        Ok(())
    }
}

impl Plant {
    fn after_step(&mut self, y: &[f64]) {
        let (q, v) = y.split_at(self.dynamics.size());
        self.dynamics.place(q, v);
        let linear = (self.dynamics.linear_momentum() - self.linear).norm();
        let angular = (self.dynamics.angular_momentum() - self.angular).abs();
        self.found = [self.found[0].max(linear), self.found[1].max(angular)];
    }
}

/// Commands on their way to the joints.
struct Pipeline {
    n: usize,
    times: VecDeque<f64>,
    torques: VecDeque<f64>,
}

impl Pipeline {
    fn push(&mut self, time: f64, torque: &[f64]) {
        self.times.push_back(time);
        self.torques.extend(torque);
    }

    /// Takes out the command that is due at `t`, the last where there are several.
    fn pop(&mut self, t: f64, torque: &mut [f64]) -> bool {
        let mut due = false;
        while self.times.front().is_some_and(|time| *time <= t + INSTANT) {
            self.times.pop_front();
            for (value, next) in torque.iter_mut().zip(self.torques.drain(..self.n)) {
                *value = next;
            }
            due = true;
        }
        due
    }
}

/// Plays run `index`.
pub(super) fn play(player: &Player, index: usize) -> Result<Run, SimulateError> {
    let platform = player.platform();
    let reference = player.reference();
    let n = player.plant().joint_count();
    let end = reference.time(reference.samples());
    let stream = |source| Noise::new(platform.seed, index, source);

    let (mut plant, mut y) = start(player, &mut stream(Source::Release));
    let size = plant.dynamics.size();
    let mut tracking = Tracking::new(platform.controller, reference, player.tree());
    let [mut encoder, mut torque_noise, mut capture] =
        [Source::Encoder, Source::Torque, Source::Capture].map(stream);
    let mut pipeline = Pipeline {
        n,
        times: VecDeque::new(),
        torques: VecDeque::new(),
    };
    let mut integrator = DormandPrince::new(2 * size, RELATIVE, ABSOLUTE, MAX_STEPS);
    let mut run = Run::default();
    let (mut seen, mut command) = (vec![0.0; 2 * n], vec![0.0; n]);
    let (mut t, mut sample, mut frame, mut fresh) = (0.0, 0, 0, true);
    loop {
        if sample < reference.samples() && reference.time(sample) <= t + INSTANT {
            let (q, v) = y.split_at(size);
            let (positions, rates) = seen.split_at_mut(n);
            for j in 0..n {
                let error = (q[BASE + j] - reference.position(sample)[j]).abs();
                if error.is_nan() || error > LOST {
                    return Err(SimulateError::Stuck { time: t });
                }
                run.max_joint_error = run.max_joint_error.max(error);
                positions[j] = q[BASE + j] + encoder.draw(platform.encoder.position_noise);
                rates[j] = v[BASE + j] + encoder.draw(platform.encoder.rate_noise);
            }
            tracking.command(sample, positions, rates, &mut command);
            let actuator = &platform.actuator;
            for value in &mut command {
                let limit = actuator.torque_limit;
                *value = value.clamp(-limit, limit) + torque_noise.draw(actuator.torque_noise);
            }
            pipeline.push(t + actuator.delay, &command);
            sample += 1;
        }
        fresh |= pipeline.pop(t, &mut plant.torque);
        let frame_time = (frame as f64 / platform.capture.rate).min(end);
        if frame_time <= t + INSTANT {
            record(&mut run, t, &mut plant, &y, player, &mut capture);
            frame += 1;
        }
        if t >= end {
            break;
        }
        let mut next = (frame as f64 / platform.capture.rate).min(end);
        if sample < reference.samples() {
            next = next.min(reference.time(sample));
        }
        if let Some(due) = pipeline.times.front() {
            next = next.min(*due);
        }
        // Close to the end is the end.
        if end - next < INSTANT {
            next = end;
        }
        integrator
            .advance(&mut plant, [t, next], &mut y, fresh, Plant::after_step)
            .map_err(|error| match error {
                IntegrationError::Rate(time, _)
                | IntegrationError::StepUnderflow(time)
                | IntegrationError::StepLimit(time) => SimulateError::Stuck { time },
            })?;
        (t, fresh) = (next, false);
    }
    [run.max_linear_momentum, run.max_angular_momentum] = plant.found;
    run.steps = integrator.taken();
    for j in 0..n {
        let error = (y[BASE + j] - reference.position(reference.samples())[j]).abs();
        run.max_joint_error = run.max_joint_error.max(error);
    }
    Ok(run)
}

/// The robot as it is let go.
fn start(player: &Player, noise: &mut Noise) -> (Plant, Vec<f64>) {
    let platform = player.platform();
    let robot = player.plant();
    let n = robot.joint_count();
    let mut dynamics = PlanarDynamics::new(robot.clone());
    let size = dynamics.size();
    let mut y = vec![0.0; 2 * size];
    let [x, y0, attitude] = player.start();
    y[..BASE].copy_from_slice(&[x, y0, attitude]);
    y[BASE..size].copy_from_slice(player.reference().position(0));
    y[size + BASE..].copy_from_slice(player.reference().rate(0));
    dynamics.place(&y[..size], &y[size..]);
    let (linear, angular) = player.momentum();
    let planned = dynamics.base_velocity(&linear, angular);

    let release = &platform.release;
    let velocity = release
        .velocity
        .map(|v| v + noise.draw(release.velocity_noise));
    let rate = release.rate + noise.draw(release.rate_noise);
    // The whole turns about its mass centre.
    let arm = Vector2::new(x, y0) - dynamics.center();
    y[size] = planned[0] + velocity[0] - rate * arm.y;
    y[size + 1] = planned[1] + velocity[1] + rate * arm.x;
    y[size + 2] = planned[2] + rate;

    dynamics.place(&y[..size], &y[size..]);
    let plant = Plant {
        forces: Forces::new(platform, robot, &Vector2::new(x, y0), attitude),
        friction: platform.joint_friction,
        torque: vec![0.0; n],
        net: vec![0.0; n],
        wrenches: vec![Wrench::ZERO; n + 1],
        linear: dynamics.linear_momentum(),
        angular: dynamics.angular_momentum(),
        found: [0.0; 2],
        dynamics,
    };
    (plant, y)
}

fn record(run: &mut Run, t: f64, plant: &mut Plant, y: &[f64], player: &Player, noise: &mut Noise) {
    let (q, v) = y.split_at(plant.dynamics.size());
    plant.dynamics.place(q, v);
    let capture = &player.platform().capture;
    let tracked = player.plant().flat(0, &capture.point);
    let (point, _) = plant.dynamics.states()[0].point(&tracked);
    let mut length = || noise.draw(capture.position_noise);
    let (dx, dy) = (length(), length());
    run.measured.push([
        point.x + dx,
        point.y + dy,
        q[2] + noise.draw(capture.attitude_noise),
    ]);
    run.t.push(t);
    run.actual.push([q[0], q[1], q[2]]);
    run.joint_position.push(q[BASE..].to_vec());
    run.joint_torque.push(plant.torque.clone());
}
