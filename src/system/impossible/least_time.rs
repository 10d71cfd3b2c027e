//! The least time that the joints take from one place of the task to the next.
//!
//! A joint is no faster than its rate limit. Nor does it outrun the energy of the arm: without
//! angular momentum the norm of the rates in the metric of H rises and falls by at most ‖u‖, or by at
//! most the norm of the torques in the metric of H⁻¹, and both are bounded at all joint positions.
//! The control of a joint alone bounds nothing, since the others swing it too.
//!
//! Derived in docs/algorithms.md#least-time.

use super::ramp::{compatible, farthest};
use crate::dynamics::Data;
use crate::dynamics::space::Space;
use crate::ocp::Interval;
use crate::problem::{Impossible, LimitId, Place, Problem, Unit};
use crate::system::plant::Plant;

/// Part by which a way may be longer than what can be gone: rounding, of the file as well.
const ROOM: f64 = 1e-6;
/// Halvings after which a least time has all digits that are shown.
const HALVINGS: usize = 60;
/// Factor of the duration beyond which no time is enough.
const ENDLESS: f64 = 1e9;

pub(super) fn reasons<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Vec<Impossible> {
    let stops = Stops::of(problem);
    let pushes = pushes(problem, plant);
    let available = problem.task.duration.upper;
    let mut found: Vec<Impossible> = pushes
        .iter()
        .filter_map(|push| push.too_short_to_stop(available))
        .collect();
    if !found.is_empty() {
        return found;
    }
    for joint in 0..plant.joints() {
        for leg in stops.legs(problem, joint) {
            found.extend(leg.too_short(problem, &stops, &pushes));
        }
    }
    found
}

/// The limits that no duration is long enough for: those of zero.
pub(super) fn endless<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Vec<LimitId> {
    let stops = Stops::of(problem);
    let pushes = pushes(problem, plant);
    let unstopped = pushes.iter().filter(|push| push.never_stops());
    let mut found: Vec<LimitId> = unstopped.map(|push| push.limit).collect();
    for leg in (0..plant.joints()).flat_map(|joint| stops.legs(problem, joint)) {
        let least = leg.least_times(problem, &stops, &pushes);
        let endless = least.filter(|(_, least)| *least == f64::INFINITY);
        found.extend(endless.map(|(limit, _)| limit));
    }
    found.dedup();
    found
}

/// When the task says where the arm is, as parts of the duration.
struct Stops {
    fractions: Vec<f64>,
}

impl Stops {
    fn of(problem: &Problem) -> Self {
        let task = &problem.task;
        let points = task.way_points.iter();
        let fractions = points.map(|point| point.fraction(&task.duration));
        Self {
            fractions: [0.0].into_iter().chain(fractions).chain([1.0]).collect(),
        }
    }

    /// The ways of joint `j` between the places at which its position is given.
    fn legs(&self, problem: &Problem, j: usize) -> Vec<Leg> {
        let task = &problem.task;
        let points = task.way_points.iter().map(|point| point.joints[j]);
        let goal = (!task.free_joints[j]).then_some(task.final_joints[j]);
        let all = [Some(task.initial_joints[j])]
            .into_iter()
            .chain(points)
            .chain([goal]);
        let given: Vec<(usize, f64)> = all
            .enumerate()
            .filter_map(|(stop, position)| Some((stop, position?)))
            .collect();
        let legs = given.windows(2).map(|ends| Leg {
            joint: j,
            stops: [ends[0].0, ends[1].0],
            positions: [ends[0].1, ends[1].1],
        });
        legs.collect()
    }

    fn place(&self, stop: usize) -> Place {
        match stop {
            0 => Place::Start,
            _ if stop + 1 == self.fractions.len() => Place::Goal,
            _ => Place::WayPoint(stop - 1),
        }
    }
}

/// What changes the energy of the arm: the controls or the torques, at most.
struct Push {
    limit: LimitId,
    /// Largest change of the norm of the rates, 1/s.
    slope: f64,
    /// Largest norm of the rates at every stop; infinite where nothing is said of it.
    speeds: Vec<f64>,
    /// The largest rate of each joint where that norm is one; infinite where unknown.
    swing: Vec<f64>,
}

impl Push {
    /// Whether the arm moves at the start, by a known amount, and cannot be slowed.
    fn never_stops(&self) -> bool {
        self.slope == 0.0 && self.speeds[0] > 0.0 && self.speeds[0].is_finite()
    }

    /// Whether the arm cannot come to rest within `available` seconds.
    fn too_short_to_stop(&self, available: f64) -> Option<Impossible> {
        let least = self.speeds[0] / self.slope;
        let too_long = least.is_finite() && least > available * (1.0 + ROOM);
        too_long.then_some(Impossible::TooShortToStop {
            limit: self.limit,
            least,
            available,
        })
    }
}

/// Those that are known of `problem`: none with an angular momentum, whose energy the arm can take
/// up.
fn pushes<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Vec<Push> {
    let (limits, tree) = (&problem.limits, &plant.tree);
    let controls = sizes(&limits.control);
    let torques = sizes(&limits.torque);
    let finite = |sizes: &[f64]| sizes.iter().all(|size| size.is_finite());
    if plant.drift.angular().is_some() || !(finite(&controls) || finite(&torques)) {
        return Vec::new();
    }
    let positions = limits.joint_position.iter();
    let ranges: Vec<[f64; 2]> = positions.map(|bound| [bound.lower, bound.upper]).collect();
    let swing: Vec<f64> = (ranges.iter().enumerate())
        .map(|(j, range)| match tree.largest_mobility(j, *range) {
            Some(mobility) => mobility.sqrt(),
            None => f64::INFINITY,
        })
        .collect();
    let speeds = speeds(problem, plant, &ranges);
    let by_torque: f64 = torques.iter().zip(&swing).map(|(t, s)| t * s).sum();
    let by_control = tree.largest_energy(&controls, &ranges).sqrt();
    [(LimitId::Control, by_control), (LimitId::Torque, by_torque)]
        .into_iter()
        .filter(|(_, slope)| slope.is_finite())
        .map(|(limit, slope)| Push {
            limit,
            slope,
            speeds: speeds.clone(),
            swing: swing.clone(),
        })
        .collect()
}

/// The largest norm of the rates at the start, at each way-point and at the goal.
fn speeds<Sp: Space>(problem: &Problem, plant: &Plant<Sp>, ranges: &[[f64; 2]]) -> Vec<f64> {
    let task = &problem.task;
    let n = plant.joints();
    let mut data = Data::<Sp, f64>::new(&plant.tree);
    plant.tree.kinematics(&task.initial_joints, &mut data);
    plant.tree.momentum(&mut data);
    plant.tree.mass_matrix(&mut data);
    let rates = &task.initial_rates;
    let energy = |i: usize| {
        let row = (0..n).map(|j| data.mass_matrix[i.max(j) * n + i.min(j)] * rates[j]);
        rates[i] * row.sum::<f64>()
    };
    let at_start = (0..n).map(energy).sum::<f64>().max(0.0).sqrt();
    let points = task.way_points.iter().map(|point| {
        let rates: Option<Vec<f64>> = point.joint_rates.iter().map(|r| r.map(f64::abs)).collect();
        match rates {
            Some(rates) if rates.iter().all(|rate| *rate == 0.0) => 0.0,
            Some(rates) => plant.tree.largest_energy(&rates, ranges).sqrt(),
            None => f64::INFINITY,
        }
    });
    let all = [at_start].into_iter().chain(points).chain([0.0]);
    // What is not known is no limit.
    all.map(|speed| if speed.is_nan() { f64::INFINITY } else { speed })
        .collect()
}

/// The larger magnitude of each bound.
fn sizes(bounds: &[Interval]) -> Vec<f64> {
    let size = |bound: &Interval| bound.lower.abs().max(bound.upper.abs());
    bounds.iter().map(size).collect()
}

/// The way of a joint from one stop at which its position is given to the next.
struct Leg {
    joint: usize,
    stops: [usize; 2],
    positions: [f64; 2],
}

impl Leg {
    /// Whether there is too little time for it, for whichever limit it takes longest.
    fn too_short(&self, problem: &Problem, stops: &Stops, pushes: &[Push]) -> Option<Impossible> {
        let duration = problem.task.duration.upper;
        let (limit, least) = self
            .least_times(problem, stops, pushes)
            .filter(|(_, least)| least.is_finite())
            .reduce(|a, b| if b.1 > a.1 { b } else { a })?;
        let part = stops.fractions[self.stops[1]] - stops.fractions[self.stops[0]];
        let joint = &problem.robot.joints()[self.joint];
        (least > duration).then(|| Impossible::TooShort {
            joint: joint.name.clone(),
            unit: Unit::position(joint.kind),
            between: self.stops.map(|stop| stops.place(stop)),
            positions: self.positions,
            limit,
            rate: self.most(problem),
            least: part * least,
            available: part * duration,
        })
    }

    /// The least duration by each limit.
    fn least_times(
        &self,
        problem: &Problem,
        stops: &Stops,
        pushes: &[Push],
    ) -> impl Iterator<Item = (LimitId, f64)> {
        let alone = (LimitId::JointVelocity, None);
        let pushed = pushes.iter().map(|push| (push.limit, Some(push)));
        let limits = [alone].into_iter().chain(pushed);
        limits.map(|(limit, push)| (limit, self.least(problem, stops, push)))
    }

    /// The least duration in which it can be gone: no longer than that of the task where it can be
    /// gone in that; infinite where no time is enough.
    fn least(&self, problem: &Problem, stops: &Stops, push: Option<&Push>) -> f64 {
        let way = self.positions[1] - self.positions[0];
        let most = self.most(problem);
        let gone = |duration: f64| self.farthest(duration, most, stops, push);
        let enough = |duration: f64| gone(duration) * (1.0 + ROOM) >= way.abs();
        let available = problem.task.duration.upper;
        if way == 0.0 || enough(available) {
            return available;
        }
        let mut bracket = [available, 2.0 * available];
        while !enough(bracket[1]) {
            bracket = [bracket[1], 2.0 * bracket[1]];
            if bracket[1] > ENDLESS * available {
                return f64::INFINITY;
            }
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (bracket[0] + bracket[1]);
            bracket[usize::from(enough(middle))] = middle;
        }
        bracket[1]
    }

    /// The largest rate in the direction of the way.
    fn most(&self, problem: &Problem) -> f64 {
        let bound = problem.limits.joint_velocity[self.joint];
        match self.positions[1] > self.positions[0] {
            true => bound.upper.max(0.0),
            false => (-bound.lower).max(0.0),
        }
    }

    /// The farthest that the joint gets on this leg of a task of `duration` seconds, at a rate of at
    /// most `most`.
    fn farthest(&self, duration: f64, most: f64, stops: &Stops, push: Option<&Push>) -> f64 {
        let times: Vec<f64> = stops.fractions.iter().map(|part| part * duration).collect();
        let Some(push) = push else {
            return most * (times[self.stops[1]] - times[self.stops[0]]);
        };
        let swing = push.swing[self.joint];
        if swing == f64::INFINITY {
            return most * (times[self.stops[1]] - times[self.stops[0]]);
        }
        let speeds = compatible(&times, &push.speeds, push.slope);
        let between = self.stops[0]..self.stops[1];
        between
            .map(|k| {
                let ends = [swing * speeds[k], swing * speeds[k + 1]];
                farthest(times[k + 1] - times[k], most, swing * push.slope, ends)
            })
            .sum()
    }
}
