//! What no motion can do better than: dynamic programming on a grid of joint angles.

use crate::dynamics::space::Planar;
use crate::dynamics::{Data, Tree};
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

/// A grid over the limits of two joints, with the turn of the base for every move.
///
/// Joints move at up to their largest rate without limits on acceleration, and the range of base
/// attitudes that can be reached at each cell is carried along from step to step: what is left
/// out only helps, so that the results are bounds, up to the grid's error.
#[derive(Debug, Clone)]
pub struct Grid {
    n: usize,
    steps: usize,
    start: usize,
    goal: usize,
    /// Turn of the base for each move that ends at a cell, rad.
    turn: Vec<[f64; 9]>,
}

impl Grid {
    /// `n` by `n` angles over the joint limits of `problem`; `None` unless its arm is planar with
    /// two joints, with finite limits and a fixed duration.
    pub fn new(problem: &Problem, n: usize) -> Option<Self> {
        let tree = Tree::<Planar>::planar(&problem.robot).filter(|tree| tree.joint_count() == 2)?;
        let mut data = Data::<Planar, f64>::new(&tree);
        let (position, rate) = (
            &problem.limits.joint_position,
            &problem.limits.joint_velocity,
        );
        let low = [position[0].lower, position[1].lower];
        let cell = [0, 1].map(|i| (position[i].upper - position[i].lower) / (n - 1) as f64);
        let duration = problem.task.duration;
        if !cell.iter().all(|c| c.is_finite() && *c > 0.0) || !duration.is_fixed() {
            return None;
        }
        let steps = [0, 1].map(|i| duration.upper * rate[i].upper / cell[i]);
        let steps = steps[0].max(steps[1]);
        if !steps.is_finite() {
            return None;
        }
        let mut turn = Vec::with_capacity(n * n);
        for i in 0..n {
            for j in 0..n {
                turn.push(MOVES.map(|[a, b]| {
                    let (a, b) = (a as f64 * cell[0], b as f64 * cell[1]);
                    let angles = [
                        low[0] + i as f64 * cell[0] - 0.5 * a,
                        low[1] + j as f64 * cell[1] - 0.5 * b,
                    ];
                    tree.kinematics(&angles, &mut data);
                    tree.momentum(&mut data);
                    tree.base_rate(&[a, b], &mut data);
                    data.base_rate.x
                }));
            }
        }
        let index = |theta: &[f64]| {
            let near = |i: usize| ((theta[i] - low[i]) / cell[i]).round() as usize;
            near(0) * n + near(1)
        };
        Some(Self {
            n,
            steps: steps as usize,
            start: index(&problem.task.initial_joints),
            goal: index(&problem.task.final_joints),
            turn,
        })
    }

    /// Base attitudes that can be reached at the goal with |η| ≤ `bound` all along, rad; lower
    /// above upper where none can.
    pub fn reachable(&self, bound: f64) -> [f64; 2] {
        let n = self.n as isize;
        let mut range = vec![[f64::INFINITY, f64::NEG_INFINITY]; self.n * self.n];
        let mut next = range.clone();
        range[self.start] = [0.0, 0.0];
        for _ in 0..self.steps {
            for (k, reached) in next.iter_mut().enumerate() {
                *reached = [f64::INFINITY, f64::NEG_INFINITY];
                let (i, j) = (k as isize / n, k as isize % n);
                for ([a, b], turn) in MOVES.iter().zip(self.turn[k]) {
                    let (from_i, from_j) = (i - a, j - b);
                    if !(0..n).contains(&from_i) || !(0..n).contains(&from_j) {
                        continue;
                    }
                    let [low, high] = range[(from_i * n + from_j) as usize].map(|eta| eta + turn);
                    if low <= bound && high >= -bound {
                        reached[0] = reached[0].min(low.max(-bound));
                        reached[1] = reached[1].max(high.min(bound));
                    }
                }
            }
            std::mem::swap(&mut range, &mut next);
        }
        range[self.goal]
    }

    /// Smallest bound on |η| along the path, t_f included, for which the goal can be reached, to
    /// a few hundredths of a degree; rad.
    pub fn smallest_bound(&self) -> f64 {
        let (mut low, mut high) = (0.0, std::f64::consts::FRAC_PI_2);
        for _ in 0..12 {
            let middle = 0.5 * (low + high);
            let [least, most] = self.reachable(middle);
            if least <= most {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    }
}
