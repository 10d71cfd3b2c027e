//! The grid of joint angles on which it is found how little the base can turn.

use super::Connection;
use crate::dynamics::Data;
use crate::dynamics::space::Planar;
use crate::numeric::largest_or_nan;
use crate::parallel;
use crate::problem::Problem;

/// Moves of one step that are told apart, in cells of each joint; the base turns the other way for their
/// opposites, and not where no joint moves.
pub(super) const MOVES: [[isize; 2]; 4] = [[0, 1], [1, 0], [1, 1], [1, -1]];
/// Nodes of the Gauss rule with two of them, on [0, 1].
const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
/// Fewest cells along either joint that say anything.
const FEWEST: usize = 4;

/// A grid over the limits of two joints, with the turn of the base for every move.
///
/// Joints move at up to their largest rate without limits on acceleration, and the range of base
/// attitudes that can be reached at each angle is carried along from step to step.
///
/// Derived in docs/algorithms.md#floor-of-the-base-attitude.
#[derive(Debug, Clone)]
pub struct Grid {
    /// Angles of each joint.
    pub(super) size: [usize; 2],
    pub(super) steps: usize,
    /// Where the way begins and ends, counted from the first angle of each joint.
    pub(super) start: [usize; 2],
    pub(super) goal: [usize; 2],
    /// Turn of the base at the start, and from the goal's angles on the grid to the goal, rad.
    pub(super) ends: [f64; 2],
    /// Turn of the base for each of [`MOVES`] that ends at an angle, rad.
    pub(super) turn: [Vec<f64>; 4],
    /// Turn of the base per cell of area around each angle, at most, rad.
    pub(super) per_cell: Vec<f64>,
    /// Turn of the base from an angle to any that is nearest to it, at most, rad.
    pub(super) nearby: Vec<f64>,
}

impl Grid {
    /// A grid over the joint limits, and over what is in reach, of so many angles and steps together
    /// that a sweep takes `work` of them at most.
    ///
    /// `None` unless the arm is planar with two joints whose rates are limited, goes to a given goal
    /// in a limited time, and the system has no momentum.
    pub fn new(problem: &Problem, work: f64) -> Option<Self> {
        let connection = Connection::new(&problem.robot)?;
        let task = &problem.task;
        let (duration, momentum) = (task.duration.upper, &task.initial_momentum);
        let still = momentum.is_zero() && !task.free_joints.contains(&true);
        if !still {
            return None;
        }
        let ends = [0, 1].map(|i| [task.initial_joints[i], task.final_joints[i]]);
        let rates = [0, 1].map(|i| {
            let bounds = problem.limits.joint_velocity[i];
            bounds.upper.max(-bounds.lower)
        });
        let range = [0, 1].map(|i| {
            let bounds = problem.limits.joint_position[i];
            let middle = 0.5 * (ends[i][0] + ends[i][1]);
            let reach = 0.5 * rates[i] * duration;
            [
                bounds.lower.max(middle - reach),
                bounds.upper.min(middle + reach),
            ]
        });
        let width = |i: usize| (range[i][1] - range[i][0]) / rates[i];
        let step = (width(0) * width(1) * duration / work).cbrt();
        let steps = (duration / step).ceil();
        if !(steps.is_finite() && steps >= 1.0 && steps < work) {
            return None;
        }
        let cell = rates.map(|rate| rate * duration / steps);
        // The angles nearest to those within the range, counted from the start.
        let count = |i: usize, to: f64| ((to - ends[i][0]).abs() / cell[i] + 0.5).floor();
        let below = [0, 1].map(|i| count(i, range[i][0]) as usize);
        let size = [0, 1].map(|i| below[i] + count(i, range[i][1]) as usize + 1);
        if size.iter().any(|&size| size <= FEWEST) {
            return None;
        }
        let angle =
            |k: [usize; 2]| [0, 1].map(|i| ends[i][0] + (k[i] as f64 - below[i] as f64) * cell[i]);
        let goal = [0, 1].map(|i| {
            let cells = ((ends[i][1] - ends[i][0]) / cell[i]).round();
            (below[i] as f64 + cells) as usize
        });
        // Out of reach in the time there is.
        if (0..2).any(|i| goal[i] >= size[i]) {
            return None;
        }
        let on_grid = angle(goal);
        let rest = [0, 1].map(|i| ends[i][1] - on_grid[i]);
        let turns = |[a, b]: [isize; 2]| {
            let moved = [a as f64 * cell[0], b as f64 * cell[1]];
            by_rows(size, &|i| {
                let mut data = connection.scratch();
                let mut along = |j| {
                    let end = angle([i, j]);
                    turn(
                        &connection,
                        &mut data,
                        [0, 1].map(|i| end[i] - moved[i]),
                        moved,
                    )
                };
                (0..size[1]).map(&mut along).collect()
            })
        };
        let row = |i: usize| (0..size[1]).map(move |j| [i, j]);
        let curvature = by_rows(size, &|i| {
            let at = |k| connection.curvature(angle(k)).abs();
            row(i).map(at).collect()
        });
        let area = cell[0] * cell[1];
        let stride = stride(size);
        let per_cell = by_rows(size, &|i| {
            // A step and the path beside it stay within two cells of where the step ends.
            let around = |[i, j]: [usize; 2]| {
                let rows = i.saturating_sub(2)..=(i + 2).min(size[0] - 1);
                let columns = j.saturating_sub(2)..=(j + 2).min(size[1] - 1);
                let values = rows.flat_map(|i| columns.clone().map(move |j| place(stride, [i, j])));
                area * largest_or_nan(values.map(|k| curvature[k]))
            };
            row(i).map(around).collect()
        });
        let nearby = by_rows(size, &|i| {
            let to_nearest = |k| {
                let [a, b] = connection.coefficients(angle(k));
                0.5 * (a.abs() * cell[0] + b.abs() * cell[1]) + per_cell[place(stride, k)]
            };
            row(i).map(to_nearest).collect()
        });
        Some(Self {
            size,
            steps: steps as usize,
            start: below,
            goal,
            ends: [
                task.initial_base_attitude[0],
                turn(&connection, &mut connection.scratch(), on_grid, rest),
            ],
            nearby,
            turn: MOVES.map(turns),
            per_cell,
        })
    }
}

/// Numbers from one row of the grid to the next: its angles, and one on either side.
pub(super) fn stride(size: [usize; 2]) -> usize {
    size[1] + 2
}

/// Where the numbers of an angle stand.
pub(super) fn place(stride: usize, [i, j]: [usize; 2]) -> usize {
    (i + 1) * stride + j + 1
}

/// A number at every angle, given by rows; 0 around them.
fn by_rows(size: [usize; 2], row: &(impl Fn(usize) -> Vec<f64> + Sync)) -> Vec<f64> {
    let stride = stride(size);
    let mut all = vec![0.0; (size[0] + 2) * stride];
    for (i, row) in parallel::map(size[0], row).into_iter().enumerate() {
        let first = place(stride, [i, 0]);
        all[first..first + size[1]].copy_from_slice(&row);
    }
    all
}

/// Turn of the base along the straight path from `start` by `moved`, rad.
fn turn(
    connection: &Connection,
    data: &mut Data<Planar, f64>,
    start: [f64; 2],
    moved: [f64; 2],
) -> f64 {
    let mut at = |part: f64| {
        let [a, b] = connection.coefficients_in(data, [0, 1].map(|i| start[i] + part * moved[i]));
        a * moved[0] + b * moved[1]
    };
    0.5 * (at(GAUSS[0]) + at(GAUSS[1]))
}
