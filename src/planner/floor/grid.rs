//! How little the base can turn: dynamic programming on a grid of joint angles.

use super::Connection;
use crate::largest::largest;
use crate::problem::Problem;

/// One step moves each joint by one cell at most.
const MOVES: [[isize; 2]; 9] = [
    [0, 0],
    [0, 1],
    [0, -1],
    [1, 0],
    [-1, 0],
    [1, 1],
    [1, -1],
    [-1, 1],
    [-1, -1],
];
/// Area in cells that lies, at most, between a path and its steps on the grid, by how many joints
/// move in the step.
const AREA: [f64; 3] = [1.0, 1.25, 1.5];
/// Nodes of the Gauss rule with two of them, on [0, 1].
const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
/// Fewest cells along either joint that say anything.
const FEWEST: usize = 4;

/// What a dynamic programme's result is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Certainty {
    /// That of the motions on the grid.
    Estimate,
    /// That of all motions: at every step the base may turn by what lies between the grid and a path
    /// beside it.
    Bound,
}

/// A grid over the limits of two joints, with the turn of the base for every move.
///
/// Joints move at up to their largest rate without limits on acceleration, and the range of base
/// attitudes that can be reached at each angle is carried along from step to step.
///
/// Derived in docs/algorithms.md#floor-of-the-base-attitude.
#[derive(Debug, Clone)]
pub struct Grid {
    /// Angles of each joint.
    size: [usize; 2],
    steps: usize,
    start: usize,
    goal: usize,
    /// Turn of the base at the start, and from the goal's angles on the grid to the goal, rad.
    ends: [f64; 2],
    /// Turn of the base for each move that ends at an angle, rad.
    turn: [Vec<f64>; 9],
    /// Turn of the base per cell of area around each angle, at most, rad.
    per_cell: Vec<f64>,
    /// Turn of the base from an angle to any that is nearest to it, at most, rad.
    nearby: Vec<f64>,
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
        let angles: Vec<[f64; 2]> = (0..size[0])
            .flat_map(|i| (0..size[1]).map(move |j| [i, j]))
            .map(angle)
            .collect();
        let moves = MOVES.map(|[a, b]| {
            let moved = [a as f64 * cell[0], b as f64 * cell[1]];
            let along =
                |end: &[f64; 2]| turn(&connection, [0, 1].map(|i| end[i] - moved[i]), moved);
            angles.iter().map(along).collect()
        });
        let curvature: Vec<f64> = angles
            .iter()
            .map(|&theta| connection.curvature(theta).abs())
            .collect();
        let area = cell[0] * cell[1];
        let around = |k: usize| {
            // A step and the path beside it stay within two cells of where the step ends.
            let [i, j] = [k / size[1], k % size[1]];
            let rows = i.saturating_sub(2)..=(i + 2).min(size[0] - 1);
            let columns = j.saturating_sub(2)..=(j + 2).min(size[1] - 1);
            let values = rows.flat_map(|i| columns.clone().map(move |j| i * size[1] + j));
            area * largest(values.map(|k| curvature[k]))
        };
        let per_cell: Vec<f64> = (0..angles.len()).map(around).collect();
        let nearby = angles.iter().zip(&per_cell).map(|(&theta, per_cell)| {
            let [a, b] = connection.coefficients(theta);
            0.5 * (a.abs() * cell[0] + b.abs() * cell[1]) + per_cell
        });
        Some(Self {
            size,
            steps: steps as usize,
            start: below[0] * size[1] + below[1],
            goal: goal[0] * size[1] + goal[1],
            ends: [
                task.initial_base_attitude[0],
                turn(&connection, on_grid, rest),
            ],
            nearby: nearby.collect(),
            turn: moves,
            per_cell,
        })
    }

    /// Base attitudes that can be reached at the goal with |η| ≤ `bound` all along, rad; lower
    /// above upper where none can.
    pub fn reachable(&self, bound: f64, certainty: Certainty) -> [f64; 2] {
        let certain = f64::from(certainty == Certainty::Bound);
        let mut range = Ranges::none(self.per_cell.len());
        let mut next = range.clone();
        (range.low[self.start], range.high[self.start]) = (self.ends[0], self.ends[0]);
        let most: Vec<f64> = self
            .nearby
            .iter()
            .map(|turn| bound + certain * turn)
            .collect();
        for _ in 0..self.steps {
            self.step(&range, &mut next, certain);
            next.clamp(&most);
            std::mem::swap(&mut range, &mut next);
        }
        let [low, high] = [&range.low, &range.high].map(|range| range[self.goal] + self.ends[1]);
        [low.max(-bound), high.min(bound)]
    }

    /// The ranges `next` one step after `range`.
    fn step(&self, range: &Ranges, next: &mut Ranges, certain: f64) {
        next.low.fill(f64::INFINITY);
        next.high.fill(f64::NEG_INFINITY);
        let [rows, columns] = self.size.map(|size| size as isize);
        for ([a, b], turn) in MOVES.iter().zip(&self.turn) {
            let slack = certain * AREA[(a.abs() + b.abs()) as usize];
            for i in (*a).max(0)..rows.min(rows + a) {
                let (first, last) = ((*b).max(0), columns.min(columns + b));
                let row = |i: isize, first: isize, last: isize| {
                    (i * columns + first) as usize..(i * columns + last) as usize
                };
                let (to, from) = (row(i, first, last), row(i - a, first - b, last - b));
                let old = range.low[from.clone()].iter().zip(&range.high[from]);
                let new = next.low[to.clone()]
                    .iter_mut()
                    .zip(&mut next.high[to.clone()]);
                let turned = turn[to.clone()].iter().zip(&self.per_cell[to]);
                for (((old_low, old_high), (low, high)), (turn, per_cell)) in
                    old.zip(new).zip(turned)
                {
                    let slack = slack * per_cell;
                    // Comparisons become vector instructions, `min` and `max` of a NaN do not.
                    let (least, most) = (old_low + turn - slack, old_high + turn + slack);
                    *low = if least < *low { least } else { *low };
                    *high = if most > *high { most } else { *high };
                }
            }
        }
    }

    /// Smallest bound on |η| along the path, t_f included, between `low` and `high` for which the
    /// goal can be reached, to `accuracy`; rad.
    pub fn smallest_bound(&self, between: [f64; 2], accuracy: f64, certainty: Certainty) -> f64 {
        let [mut low, mut high] = between;
        while high - low > accuracy {
            let middle = 0.5 * (low + high);
            let [least, most] = self.reachable(middle, certainty);
            if least <= most {
                high = middle;
            } else {
                low = middle;
            }
        }
        match certainty {
            Certainty::Estimate => high,
            Certainty::Bound => low,
        }
    }
}

/// The range of base attitudes at every angle, rad; empty where the lower end is above the upper.
#[derive(Debug, Clone)]
struct Ranges {
    low: Vec<f64>,
    high: Vec<f64>,
}

impl Ranges {
    fn none(count: usize) -> Self {
        Self {
            low: vec![f64::INFINITY; count],
            high: vec![f64::NEG_INFINITY; count],
        }
    }

    /// Keeps what is within ±`most` at every angle.
    fn clamp(&mut self, most: &[f64]) {
        for ((low, high), most) in self.low.iter_mut().zip(&mut self.high).zip(most) {
            let within = *low <= *most && *high >= -most;
            *low = if within {
                low.max(-most)
            } else {
                f64::INFINITY
            };
            *high = if within {
                high.min(*most)
            } else {
                f64::NEG_INFINITY
            };
        }
    }
}

/// Turn of the base along the straight path from `start` by `moved`, rad.
fn turn(connection: &Connection, start: [f64; 2], moved: [f64; 2]) -> f64 {
    let at = |part: f64| {
        let [a, b] = connection.coefficients([0, 1].map(|i| start[i] + part * moved[i]));
        a * moved[0] + b * moved[1]
    };
    0.5 * (at(GAUSS[0]) + at(GAUSS[1]))
}
