//! One run: the plan played on the platform from release to the end.

use super::SimulateError;
use super::dynamics::{BASE, PlanarDynamics, Wrench};
use super::forces::Forces;
use super::noise::{Noise, Source};

use super::platform::JointFriction;
use super::player::Player;
use super::tracking::Tracking;
use crate::integrate::{DormandPrince, IntegrationError, Ode};
use crate::numeric::raise_or_nan;
use crate::parallel;
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

impl Run {
    /// Whether all figures of it are finite numbers.
    fn is_finite(&self) -> bool {
        let poses = self.measured.iter().chain(&self.actual).flatten();
        let joints = self.joint_position.iter().chain(&self.joint_torque);
        let largest = [
            self.max_joint_error,
            self.max_linear_momentum,
            self.max_angular_momentum,
        ];
        poses
            .chain(joints.flatten())
            .chain(&largest)
            .all(|value| value.is_finite())
    }
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
    /// Largest changes of the linear and the angular momentum.
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
        raise_or_nan(&mut self.found[0], linear);
        raise_or_nan(&mut self.found[1], angular);
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

/// The plan played once, at time `t`.
struct Playback<'a> {
    player: &'a Player,
    plant: Plant,
    /// Coordinates and their rates.
    y: Vec<f64>,
    t: f64,
    tracking: Tracking<'a>,
    encoder: Noise,
    torque_noise: Noise,
    capture: Noise,
    pipeline: Pipeline,
    /// Number of the controller's next sample and of the capture's next frame.
    sample: usize,
    frame: usize,
    /// Joints as the controller sees them: positions, then rates.
    seen: Vec<f64>,
    command: Vec<f64>,
    run: Run,
}

impl Player {
    /// Plays run `index`: the same index gives the same run, bit by bit.
    ///
    /// # Errors
    /// [`SimulateError::Stuck`] where the motion runs away.
    pub fn run(&self, index: usize) -> Result<Run, SimulateError> {
        Playback::new(self, index).play()
    }

    /// Plays all runs of the platform's `repeats`, several at a time.
    ///
    /// # Errors
    /// [`SimulateError::Stuck`] where the motion of one runs away.
    pub fn runs(&self) -> Result<Vec<Run>, SimulateError> {
        parallel::map(self.platform().repeats, &|index| self.run(index))
            .into_iter()
            .collect()
    }
}

impl<'a> Playback<'a> {
    fn new(player: &'a Player, index: usize) -> Self {
        let platform = player.platform();
        let n = player.plant().joint_count();
        let stream = |source| Noise::new(platform.seed, index, source);
        let (plant, y) = start(player, &mut stream(Source::Release));
        Self {
            plant,
            y,
            t: 0.0,
            tracking: Tracking::new(platform.controller, player.reference(), player.tree()),
            encoder: stream(Source::Encoder),
            torque_noise: stream(Source::Torque),
            capture: stream(Source::Capture),
            pipeline: Pipeline {
                n,
                times: VecDeque::new(),
                torques: VecDeque::new(),
            },
            sample: 0,
            frame: 0,
            seen: vec![0.0; 2 * n],
            command: vec![0.0; n],
            run: Run::default(),
            player,
        }
    }

    fn play(mut self) -> Result<Run, SimulateError> {
        let size = self.plant.dynamics.size();
        let reference = self.player.reference();
        let end = reference.time(reference.samples());
        let mut integrator = DormandPrince::new(2 * size, RELATIVE, ABSOLUTE, MAX_STEPS);
        let mut fresh = true;
        loop {
            if self
                .next_sample()
                .is_some_and(|time| time <= self.t + INSTANT)
            {
                self.control()?;
            }
            fresh |= self.pipeline.pop(self.t, &mut self.plant.torque);
            if self.next_frame(end) <= self.t + INSTANT {
                self.record();
            }
            if self.t >= end {
                break;
            }
            let next = self.next_event(end);
            integrator
                .advance(
                    &mut self.plant,
                    [self.t, next],
                    &mut self.y,
                    fresh,
                    Plant::after_step,
                )
                .map_err(|error| match error {
                    IntegrationError::Rate(time, _)
                    | IntegrationError::StepUnderflow(time)
                    | IntegrationError::StepLimit(time) => SimulateError::Stuck { time },
                })?;
            (self.t, fresh) = (next, false);
        }
        self.observe_errors(reference.samples())?;
        [self.run.max_linear_momentum, self.run.max_angular_momentum] = self.plant.found;
        self.run.steps = integrator.taken();
        match self.run.is_finite() {
            true => Ok(self.run),
            false => Err(SimulateError::NotFinite),
        }
    }

    /// Time of the controller's next sample; none after the last.
    fn next_sample(&self) -> Option<f64> {
        let reference = self.player.reference();
        (self.sample < reference.samples()).then(|| reference.time(self.sample))
    }

    /// Time of the capture's next frame, the last being at `end`.
    fn next_frame(&self, end: f64) -> f64 {
        (self.frame as f64 / self.player.platform().capture.rate).min(end)
    }

    /// When the motion has to be halted next.
    fn next_event(&self, end: f64) -> f64 {
        let mut next = self.next_frame(end);
        if let Some(time) = self.next_sample() {
            next = next.min(time);
        }
        if let Some(due) = self.pipeline.times.front() {
            next = next.min(*due);
        }
        // Close to the end is the end.
        if end - next < INSTANT { end } else { next }
    }

    /// Compares the joints with sample `k` of the plan.
    fn observe_errors(&mut self, k: usize) -> Result<(), SimulateError> {
        let joints = &self.y[BASE..self.plant.dynamics.size()];
        for (actual, planned) in joints.iter().zip(self.player.reference().position(k)) {
            let error = (actual - planned).abs();
            if error.is_nan() || error > LOST {
                return Err(SimulateError::Stuck { time: self.t });
            }
            raise_or_nan(&mut self.run.max_joint_error, error);
        }
        Ok(())
    }

    /// One sample of the controller: the joints measured, a torque sent on its way.
    fn control(&mut self) -> Result<(), SimulateError> {
        self.observe_errors(self.sample)?;
        let platform = self.player.platform();
        let (q, v) = self.y.split_at(self.plant.dynamics.size());
        let (positions, rates) = self.seen.split_at_mut(self.command.len());
        for j in 0..self.command.len() {
            positions[j] = q[BASE + j] + self.encoder.draw(platform.encoder.position_noise);
            rates[j] = v[BASE + j] + self.encoder.draw(platform.encoder.rate_noise);
        }
        self.tracking
            .command(self.sample, positions, rates, &mut self.command);
        let actuator = &platform.actuator;
        for value in &mut self.command {
            let limit = actuator.torque_limit;
            *value = value.clamp(-limit, limit) + self.torque_noise.draw(actuator.torque_noise);
        }
        self.pipeline.push(self.t + actuator.delay, &self.command);
        self.sample += 1;
        Ok(())
    }

    /// One frame of the capture.
    fn record(&mut self) {
        let (q, v) = self.y.split_at(self.plant.dynamics.size());
        self.plant.dynamics.place(q, v);
        let capture = &self.player.platform().capture;
        let tracked = self.player.plant().flat(0, &capture.point);
        let (point, _) = self.plant.dynamics.states()[0].point(&tracked);
        let noise = &mut self.capture;
        let mut length = || noise.draw(capture.position_noise);
        let (dx, dy) = (length(), length());
        let run = &mut self.run;
        run.measured.push([
            point.x + dx,
            point.y + dy,
            q[2] + noise.draw(capture.attitude_noise),
        ]);
        run.t.push(self.t);
        run.actual.push([q[0], q[1], q[2]]);
        run.joint_position.push(q[BASE..].to_vec());
        run.joint_torque.push(self.plant.torque.clone());
        self.frame += 1;
    }
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
