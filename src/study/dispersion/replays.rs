//! A plan replayed under perturbations: the base's motion of as many samples as are asked for.

use super::base_rate::Frame;
use super::chain::Chain;
use super::draws::Draws;
use super::error::DispersionError;
use super::figures::Figures;
use super::follow::{Looking, follow};
use super::lanes::{LANES, Lanes, Quaternion, Vector};
use super::path::Path;
use super::perturbed::Perturbed;
use super::sample::Sample;
use super::schedule::Schedule;
use super::step::Bases;
use super::watch::{Watched, Watching};
use crate::config::Dispersion;
use crate::nlp::Control;
use crate::parallel;
use crate::problem::Problem;
use crate::system::{Metrics, WatchedPose, metrics_of, watched_poses};
use crate::transcription::Discretization;
use crate::verify;
use nalgebra::{UnitQuaternion, Vector3};

/// Most samples of one run.
pub const MOST_SAMPLES: u64 = 10_000_000;
/// Groups of lanes that one thread replays before it looks around.
const GROUPS: usize = 32;
/// Pieces of work handed out at a time.
const PIECES: usize = 64;

/// What the replays of a plan have in common.
#[derive(Debug)]
pub struct Replays<'a> {
    problem: &'a Problem,
    chain: Chain,
    pub(super) draws: Draws,
    momentum: [[f64; 3]; 2],
    schedule: Schedule,
    watched: Vec<Watched>,
    start: Bases,
    /// The plan's last orientation and, in the plane, angle.
    planned: ([f64; 4], f64),
    metrics: Metrics,
    drift: [f64; 2],
}

impl<'a> Replays<'a> {
    /// Replays of `plan` for `problem` under `dispersion`, of numbers drawn by `seed`. The steps are
    /// chosen here, once: for the nominal robot and the first three samples.
    ///
    /// # Errors
    /// [`DispersionError::Plan`] where plan and robot do not belong together,
    /// [`DispersionError::TooFast`] where no step is short enough for the base's motion.
    pub fn new(
        problem: &'a Problem,
        plan: &Discretization,
        dispersion: &Dispersion,
        seed: u64,
    ) -> Result<Self, DispersionError> {
        verify::check(problem, plan)?;
        let chain = Chain::new(&problem.robot);
        let draws = Draws::new(dispersion, chain.planar, seed);
        let momentum = momentum(problem);
        let planar = chain.planar;
        let poses = watched_poses(problem, plan);
        let fractions: Vec<f64> = poses.iter().map(|pose| pose.fraction).collect();
        let orientations: Vec<[f64; 4]> = poses
            .iter()
            .map(|pose| orientation(problem, planar, pose))
            .collect();
        let angle = |pose: &WatchedPose| if planar { pose.attitude[0] } else { 0.0 };
        let start = Bases {
            orientation: Quaternion::of(orientations[0]),
            position: Vector::ZERO,
            angle: Lanes::of(angle(&poses[0])),
        };

        let mut probe = Perturbed::new(&chain, &draws);
        probe.draw(&chain, &draws, &momentum, 0);
        probe.set_nominal(&chain, &momentum, 0);
        let parameters = problem.attitude_sizes().0;
        let path = Path::new(plan, parameters, chain.links.len());
        let schedule = Schedule::new(&chain, &path, &fractions, &probe, &start)?;

        let mut replays = Self {
            problem,
            draws,
            momentum,
            schedule,
            watched: Vec::new(),
            start,
            planned: (
                orientations[poses.len() - 1],
                angle(&poses[poses.len() - 1]),
            ),
            metrics: metrics_of(problem, plan),
            drift: [0.0; 2],
            chain,
        };
        let mut nominal = Perturbed::new(&replays.chain, &replays.draws);
        for l in 0..LANES {
            nominal.set_nominal(&replays.chain, &replays.momentum, l);
        }
        let replayed = replays.recorded(&nominal);
        for ((pose, orientation), bases) in poses.iter().zip(&orientations).zip(&replayed) {
            let (watched, turned) = correction(
                &poses[0],
                pose,
                orientation,
                planar.then(|| angle(pose)),
                bases,
            );
            let moved = Vector3::from(watched.shift).norm();
            replays.drift = [replays.drift[0].max(turned), replays.drift[1].max(moved)];
            replays.watched.push(watched);
        }
        Ok(replays)
    }

    /// The plan's own figures.
    pub fn planned(&self) -> &Metrics {
        &self.metrics
    }

    /// How far the nominal replay leaves the plan, rad and m: the plan's collocation error along its
    /// joint path. Every sample is corrected by it, so that nothing perturbed gives the plan.
    pub fn drift(&self) -> [f64; 2] {
        self.drift
    }

    /// Error of the nominal replay by its own steps, rad and m.
    pub fn step_error(&self) -> f64 {
        self.schedule.error
    }

    /// Steps of a replay, and the times at which the momentum of all bodies is computed.
    pub fn steps(&self) -> [usize; 2] {
        [self.schedule.steps.len(), self.schedule.stages()]
    }

    /// The sample at `index` taken apart.
    ///
    /// # Errors
    /// [`DispersionError::Inertia`] or [`DispersionError::Model`] where it is no robot.
    pub fn sample(&self, index: u64) -> Result<Sample, DispersionError> {
        let mut values = vec![0.0; self.draws.count];
        self.draws.draw(index, &mut values);
        let model = &self.problem.robot;
        Sample::new(model, &self.chain, &self.draws, &self.momentum, &values)
    }

    /// Figures of the first `count` samples, in their order. Those of each depend on the seed and its
    /// index alone, not on `count` or on the number of threads. `monitor` is told how many are done.
    ///
    /// # Errors
    /// [`DispersionError::Count`], [`DispersionError::Interrupted`] where `monitor` says stop, and
    /// [`DispersionError::Sample`].
    pub fn run(
        &self,
        count: u64,
        monitor: &mut dyn FnMut(u64) -> Control,
    ) -> Result<Vec<Figures>, DispersionError> {
        if !(1..=MOST_SAMPLES).contains(&count) {
            return Err(DispersionError::Count {
                found: count,
                most: MOST_SAMPLES,
            });
        }
        let count = count as usize;
        let mut figures = Vec::with_capacity(count);
        let piece = GROUPS * LANES;
        while figures.len() < count {
            let first = figures.len();
            let pieces = PIECES.min((count - first).div_ceil(piece));
            let done = parallel::map(pieces, &|p| {
                self.piece(
                    (first + p * piece) as u64,
                    (count - first - p * piece).min(piece),
                )
            });
            for piece in done {
                figures.extend(piece);
            }
            if let Some(bad) = figures[first..]
                .iter()
                .position(|found| !found.are_finite())
            {
                return Err(DispersionError::Sample {
                    index: (first + bad) as u64,
                });
            }
            if monitor(figures.len() as u64) == Control::Stop && figures.len() < count {
                return Err(DispersionError::Interrupted {
                    samples: figures.len() as u64,
                });
            }
        }
        Ok(figures)
    }

    /// Figures of `count` samples from `first` on.
    fn piece(&self, first: u64, count: usize) -> Vec<Figures> {
        let mut robots = Perturbed::new(&self.chain, &self.draws);
        let mut frames = vec![Frame::BASE; self.chain.links.len()];
        let mut figures = Vec::with_capacity(count);
        for from in (0..count).step_by(LANES) {
            robots.draw(
                &self.chain,
                &self.draws,
                &self.momentum,
                first + from as u64,
            );
            let mut watching = Watching::new(self.chain.planar, &self.start);
            let mut bases = self.start;
            let solved = follow(
                &self.schedule.steps,
                &self.chain,
                &robots,
                &mut frames,
                &mut bases,
                Looking::Figures(&self.watched, &mut watching),
            );
            for l in 0..LANES.min(count - from) {
                figures.push(match solved {
                    true => watching.figures(l, &self.planned),
                    false => Figures {
                        max_base_attitude: f64::NAN,
                        ..Figures::default()
                    },
                });
            }
        }
        figures
    }

    /// The bases of `robots` at all times that are looked at.
    fn recorded(&self, robots: &Perturbed) -> Vec<Bases> {
        let mut found = Vec::with_capacity(self.watched.len());
        let mut frames = vec![Frame::BASE; self.chain.links.len()];
        let mut bases = self.start;
        follow(
            &self.schedule.steps,
            &self.chain,
            robots,
            &mut frames,
            &mut bases,
            Looking::Poses(&mut found),
        );
        found
    }
}

/// The plan's own momentum, linear and angular.
fn momentum(problem: &Problem) -> [[f64; 3]; 2] {
    let own = &problem.task.initial_momentum;
    let mut momentum = [[0.0; 3]; 2];
    for (component, value) in momentum[0].iter_mut().zip(&own.linear) {
        *component = *value;
    }
    let skipped = 3 - own.angular.len();
    for (component, value) in momentum[1][skipped..].iter_mut().zip(&own.angular) {
        *component = *value;
    }
    momentum
}

/// The planned orientation as w, x, y, z; in the plane about z.
fn orientation(problem: &Problem, planar: bool, pose: &WatchedPose) -> [f64; 4] {
    let turn = match planar {
        true => UnitQuaternion::from_axis_angle(&Vector3::z_axis(), pose.attitude[0]),
        false => problem.attitude.to_quaternion(&pose.attitude),
    };
    [turn.w, turn.i, turn.j, turn.k]
}

/// What takes the nominal replay's `bases` to the plan's `pose`, whose angle in the plane is `angle`, and
/// how far it turns, rad.
fn correction(
    first: &WatchedPose,
    pose: &WatchedPose,
    orientation: &[f64; 4],
    angle: Option<f64>,
    bases: &Bases,
) -> (Watched, f64) {
    let [w, x, y, z] = *orientation;
    let planned = nalgebra::Quaternion::new(w, x, y, z);
    let [w, x, y, z] = bases.orientation.normalised().lane(0);
    let replayed = nalgebra::Quaternion::new(w, x, y, z);
    let turn = planned * replayed.conjugate();
    // A quaternion and its negative are one rotation.
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let mut shift = bases.position.lane(0).map(|moved| -moved);
    let planned = pose.position.iter().zip(&first.position);
    for (shift, (at, start)) in shift.iter_mut().zip(planned) {
        *shift += at - start;
    }
    let watched = Watched {
        turn: [turn.w, turn.i, turn.j, turn.k],
        shift,
        // In space there is no such angle.
        angle: angle.map_or(0.0, |angle| angle - bases.angle.0[0]),
    };
    let turned = 2.0 * turn.imag().norm().atan2(turn.w);
    (watched, turned.max(watched.angle.abs()))
}
