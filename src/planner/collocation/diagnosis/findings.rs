//! Which bounds a trajectory exceeds, and by how much.

use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Space;
use crate::numeric::largest_or_nan;
use crate::ocp::{Interval, Limited};
use crate::planner::LimitFinding;
use crate::problem::{LimitId, Problem, Unit};
use crate::system::{Component, ElasticLimit, FreeFloating, ROTATION_ANGLE};
use crate::transcription::Discretization;

/// Excess, relative to the limit, below which it counts as held.
pub(super) const HELD: f64 = 1e-4;

/// Every bound of `limits` that `trajectory` exceeds.
pub(in crate::planner) fn findings<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    limits: &[ElasticLimit],
    trajectory: &Discretization,
) -> Vec<LimitFinding> {
    let reached = Values::of(system, trajectory);
    let mut found: Vec<LimitFinding> = Vec::new();
    for limit in limits {
        if limit.id.component == Component::RotationAngle {
            found.extend(rotations(problem, system, &reached.states));
            continue;
        }
        for &member in &limit.group.members {
            let row = system.bound(member);
            let bound = row.measured_bounds();
            let values = reached.values(member).map(|value| row.measured(value));
            let range = range(values);
            let excess = bound
                .violation(range.lower)
                .max(bound.violation(range.upper));
            if excess <= HELD * limit.group.scale {
                continue;
            }
            let finding = LimitFinding {
                limit: row.id.limit,
                component: row.id.component,
                name: row.quantity.name.clone(),
                unit: row.unit,
                bound,
                excess,
                smallest_bound: widened(bound, range),
                floor: None,
            };
            // One limit may hold at the points and again at t_f, which is none.
            let same = |known: &&mut LimitFinding| {
                (known.limit, known.component) == (finding.limit, finding.component)
            };
            match found.iter_mut().find(same) {
                Some(known) => {
                    known.excess = known.excess.max(excess);
                    known.smallest_bound = widened(known.smallest_bound, range);
                }
                None => found.push(finding),
            }
        }
    }
    found
}

/// Values of all that is bounded, along a trajectory.
struct Values {
    /// One row a node.
    states: Vec<Vec<f64>>,
    /// One row a point; with the value at t_f, kept within its limits.
    controls: Vec<Vec<f64>>,
    path: Vec<Vec<f64>>,
    boundary: Vec<f64>,
    /// States and rows of every way-point.
    way_points: Vec<(Vec<f64>, Vec<f64>)>,
}

impl Values {
    fn of<Sp: Space>(system: &FreeFloating<Sp>, trajectory: &Discretization) -> Self {
        let nodes = 0..=trajectory.mesh.points();
        Self {
            states: nodes.map(|k| trajectory.state(k).to_vec()).collect(),
            controls: crate::system::trajectory(system, trajectory).control,
            path: system.path_values(trajectory),
            boundary: system.end_values(trajectory),
            way_points: system.way_point_values(trajectory),
        }
    }

    fn values(&self, bound: Limited) -> Box<dyn Iterator<Item = f64> + '_> {
        let column = |rows: &'_ [Vec<f64>], i: usize| {
            let values: Vec<f64> = rows.iter().map(|row| row[i]).collect();
            Box::new(values.into_iter())
        };
        let one = |value: f64| Box::new(std::iter::once(value));
        match bound {
            Limited::State(i) => column(&self.states, i),
            Limited::Control(j) => column(&self.controls, j),
            Limited::Path(p) => column(&self.path, p),
            Limited::Terminal(i) => one(self.states[self.states.len() - 1][i]),
            Limited::Boundary(b) => one(self.boundary[b]),
            Limited::WayPointState(w, i) => one(self.way_points[w].0[i]),
            Limited::WayPoint(w, r) => one(self.way_points[w].1[r]),
        }
    }
}

/// The bounds on the rotation angle that `states`, one row a node, exceed.
fn rotations<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
    states: &[Vec<f64>],
) -> Vec<LimitFinding> {
    let attitude = system.attitude();
    let turned: Vec<f64> = states
        .iter()
        .map(|x| {
            attitude
                .squared_rotation_angle(&x[..attitude.count()])
                .sqrt()
        })
        .collect();
    let largest = largest_or_nan(turned.iter().copied());
    let limits = &problem.limits;
    [
        (LimitId::BaseAttitude, &limits.base_attitude, largest),
        (
            LimitId::FinalBaseAttitude,
            &limits.final_base_attitude,
            turned[turned.len() - 1],
        ),
    ]
    .into_iter()
    .map(|(limit, bounds, reached)| (limit, bounds[0].upper, reached))
    .filter(|(_, bound, reached)| reached - bound > HELD * bound.max(1e-3))
    .map(|(limit, bound, reached)| LimitFinding {
        limit,
        component: Component::RotationAngle,
        name: ROTATION_ANGLE.into(),
        unit: Unit::Radian,
        bound: Interval::new(0.0, bound),
        excess: reached - bound,
        smallest_bound: Interval::new(0.0, reached),
        floor: None,
    })
    .collect()
}

fn range(values: impl Iterator<Item = f64>) -> Interval {
    let nothing = Interval::new(f64::INFINITY, f64::NEG_INFINITY);
    values.fold(nothing, |range, value| {
        Interval::new(range.lower.min(value), range.upper.max(value))
    })
}

/// `bound` widened to hold `reached`; symmetric bounds stay symmetric.
fn widened(bound: Interval, reached: Interval) -> Interval {
    let wide = Interval::new(
        bound.lower.min(reached.lower),
        bound.upper.max(reached.upper),
    );
    if bound.lower == -bound.upper {
        Interval::symmetric(wide.upper.max(-wide.lower))
    } else {
        wide
    }
}
