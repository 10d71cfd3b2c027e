//! The free-floating manipulator as an optimal control problem, eq. (7) to (18).

mod cost;
mod derivatives;
mod drift;
mod formulation;
mod goal_error;
mod guess;
mod limits;
mod motion;
mod program;
mod quintic;
mod row_values;
mod rows;
mod straight_line;
mod trajectory;

pub use cost::{CostTerms, JointEffort};
pub use goal_error::{Reached, reached};
pub use guess::through;
pub use motion::{Metrics, Trajectory};
pub use straight_line::{StraightLine, straight_line, straight_motion};
pub use trajectory::{resampled, turned};

pub(crate) use goal_error::gaps;
pub(crate) use guess::{JointPath, along};
pub(crate) use quintic::quintic;
pub(crate) use rows::{ROTATION, TurnLimits, rotation_rows};
pub(crate) use trajectory::{metrics, trajectory};

use crate::autodiff::Scalar;
use crate::dynamics::attitude::{Attitude, PlanarAngle};
use crate::dynamics::space::{Planar, Space, Spatial};
use crate::dynamics::{Data, Tree};
use crate::ocp::{Formulation, Interval};
use crate::problem::{self, Problem};
use drift::Drift;
use formulation::formulation;
use rows::{GoalRows, KeepOutRow};

use program::torques;

/// States x = [η, θ, θ̇], controls u = H⁻¹τ.
///
/// The paper's state is [θ, θ̇]; the base attitude joins it because its limits (10) and its cost
/// (14) need it. Path rows, where limited: the rates η̇ (or ω, where η are no angles), the torques
/// τ = Hu, the rotation angle, the pairs kept apart.
#[derive(Debug, Clone)]
pub struct FreeFloating<Sp: Space> {
    tree: Tree<Sp>,
    pub(super) attitude: Sp::Attitude,
    formulation: Formulation,
    pub(super) cost: problem::Cost,
    start_position: Sp::Linear<f64>,
    pub(super) rate_rows: bool,
    pub(super) torque_rows: bool,
    pub(super) torque_cost: bool,
    goal: Option<GoalRows<Sp>>,
    /// Goal at each way-point.
    way_points: Vec<Option<GoalRows<Sp>>>,
    pub(super) drift: Drift<Sp>,
    turn: TurnLimits,
    pub(super) keep_out: Vec<KeepOutRow<Sp>>,
}

impl FreeFloating<Planar> {
    /// The planar form of `problem`, or `None` where its motion leaves the plane.
    pub fn planar(problem: &Problem) -> Option<Self> {
        let tree = Tree::planar(&problem.robot)?;
        Some(Self::new(problem, tree, PlanarAngle))
    }
}

impl FreeFloating<Spatial> {
    /// The spatial form of `problem`.
    pub fn spatial(problem: &Problem) -> Self {
        let tree = Tree::spatial(&problem.robot);
        Self::new(problem, tree, problem.attitude)
    }
}

impl<Sp: Space> FreeFloating<Sp> {
    fn new(problem: &Problem, tree: Tree<Sp>, attitude: Sp::Attitude) -> Self {
        let limits = &problem.limits;
        let limited = |bounds: &[Interval]| bounds.iter().any(|b| !b.is_free());
        let rate_rows = limited(&limits.base_rate);
        let torque_rows = limited(&limits.torque);
        let mut data = Data::<Sp, f64>::new(&tree);
        tree.kinematics(&problem.task.initial_joints, &mut data);
        tree.momentum(&mut data);
        let start_position = attitude.base_position(attitude.start(), &data.system_center);
        let goal = problem.task.end_effector.as_ref();
        let goal = goal.map(|goal| GoalRows::new(goal, start_position));
        let turn = TurnLimits::new::<Sp>(problem, attitude);
        let mut formulation = formulation::<Sp>(problem, (attitude, &turn), rate_rows, torque_rows);
        formulation.path.extend(turn.path());
        let points = problem.task.way_points.iter().enumerate();
        let (passed, way_points) = points
            .map(|(i, point)| {
                rows::formulate(
                    point,
                    i,
                    &problem.task.duration,
                    attitude.count(),
                    start_position,
                )
            })
            .unzip();
        formulation.way_points = passed;
        let pairs = limits.keep_out.iter();
        let keep_out: Vec<_> = pairs.map(|pair| KeepOutRow::new(pair, &tree)).collect();
        formulation
            .path
            .extend(keep_out.iter().map(KeepOutRow::quantity));
        formulation.boundary = goal.iter().flat_map(GoalRows::quantities).collect();
        formulation.boundary.extend(turn.ends());
        // Path rows do not reach t_f, which is no collocation point.
        formulation
            .boundary
            .extend(keep_out.iter().map(KeepOutRow::quantity));
        Self {
            formulation,
            cost: problem.cost.clone(),
            start_position,
            goal,
            turn,
            way_points,
            keep_out,
            drift: Drift::new(&problem.task.initial_momentum, tree.total_mass()),
            rate_rows,
            torque_rows,
            torque_cost: problem.cost.torque.iter().any(|w| *w > 0.0),
            attitude,
            tree,
        }
    }

    /// The dynamics behind the problem.
    pub fn tree(&self) -> &Tree<Sp> {
        &self.tree
    }

    /// How the base attitude is described.
    pub fn attitude(&self) -> Sp::Attitude {
        self.attitude
    }

    /// The base's angular velocity for the joint rates and the system's momentum, into `data`;
    /// needs [`Tree::momentum`].
    pub fn base_rate<S: Scalar>(&self, eta: &[S], dtheta: &[S], data: &mut Data<Sp, S>) {
        self.tree.base_rate(dtheta, data);
        self.drift.tumble(self.attitude, eta, data);
    }

    /// Moves an inertial position with the system's mass centre, `t` seconds after t₀.
    pub fn carry<S: Scalar>(&self, t: S, position: &mut [S]) {
        self.drift.carry(t, position);
    }

    /// Number of joints n.
    pub fn joint_count(&self) -> usize {
        self.tree.joint_count()
    }
}
