//! The free-floating manipulator as an optimal control problem, eq. (7) to (18): its physics, its
//! rows, its cost terms and the formulation they make.

use super::cost::{self, EndCost, EndTerm, PathCost, PathTerm};
use super::formulation::{Bounded, formulation};
use super::instant::Needs;
use super::plant::Plant;
use super::rows::{self, EndBlock, EndRows, PathBlock, PathRows, Row, WayPointRows};
use crate::autodiff::Scalar;
use crate::dynamics::attitude::PlanarAngle;
use crate::dynamics::space::{Planar, Space, Spatial};
use crate::dynamics::{Data, Tree};
use crate::ocp::Formulation;
use crate::problem::Problem;

/// States x = [η, θ, θ̇], controls u = H⁻¹τ.
///
/// The paper's state is [θ, θ̇]; the base attitude joins it because its limits (10) and its cost
/// (14) need it.
#[derive(Debug, Clone)]
pub struct FreeFloating<Sp: Space> {
    pub(super) plant: Plant<Sp>,
    pub(super) path: Vec<PathBlock<Sp>>,
    pub(super) end: Vec<EndBlock<Sp>>,
    pub(super) way_points: Vec<WayPointRows<Sp>>,
    pub(super) path_cost: Vec<PathCost>,
    pub(super) end_cost: Vec<EndCost>,
    /// What rows and terms need beyond the state.
    pub(super) needs: Needs,
    pub(super) bounded: Bounded,
    pub(super) formulation: Formulation,
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
        let plant = Plant::new(problem, tree, attitude);
        let path = rows::path(problem, &plant);
        let end = rows::end(problem, &plant);
        let points = 0..problem.task.way_points.len();
        let way_points: Vec<_> = points
            .map(|index| rows::way_point(problem, &plant, index))
            .collect();
        let path_cost = cost::path(problem, &plant);
        let end_cost = cost::end(problem, &plant);
        let needs = [
            path.iter().map(PathRows::needs).collect::<Vec<_>>(),
            end.iter().map(EndRows::needs).collect(),
            path_cost.iter().map(PathTerm::<Sp>::needs).collect(),
            end_cost.iter().map(EndTerm::<Sp>::needs).collect(),
        ];
        let bounded = Bounded::new(problem, &plant, &path, &end);
        Self {
            formulation: formulation(problem, &plant, &bounded, &way_points),
            needs: needs
                .concat()
                .into_iter()
                .fold(Needs::default(), Needs::and),
            bounded,
            path,
            end,
            way_points,
            path_cost,
            end_cost,
            plant,
        }
    }

    /// The same robot with its attitude described in the same way, under the task, the limits and the cost of
    /// `problem`.
    pub(crate) fn of(&self, problem: &Problem) -> Self {
        Self::new(problem, self.plant.tree.clone(), self.plant.attitude)
    }

    /// The dynamics behind the problem.
    pub fn tree(&self) -> &Tree<Sp> {
        &self.plant.tree
    }

    /// How the base attitude is described.
    pub fn attitude(&self) -> Sp::Attitude {
        self.plant.attitude
    }

    /// The attitude parameters at t₀.
    pub fn start_attitude(&self) -> &[f64] {
        &self.plant.start_attitude
    }

    /// How fast the base turns at t₀ with the momentum it has and its joints at rest, rad/s.
    pub fn tumble_rate(&self) -> f64 {
        self.plant.tumble_rate
    }

    /// The base's angular velocity for the joint rates and the system's momentum, into `data`;
    /// needs [`Tree::momentum`].
    pub fn base_rate<S: Scalar>(&self, eta: &[S], dtheta: &[S], data: &mut Data<Sp, S>) {
        self.plant.base_rate(eta, dtheta, data);
    }

    /// The base position, `t` seconds after t₀, inertial axes, m; needs [`Tree::momentum`].
    pub fn base_position<S: Scalar>(&self, eta: &[S], t: S, data: &Data<Sp, S>) -> Sp::Linear<S> {
        self.plant.base_position(eta, t, &data.system_center)
    }

    /// Number of joints n.
    pub fn joint_count(&self) -> usize {
        self.plant.joints()
    }

    /// The states with their bounds along the path.
    pub fn states(&self) -> &[Row] {
        &self.bounded.states
    }

    /// The path rows.
    pub fn path_rows(&self) -> &[Row] {
        &self.bounded.path
    }
}
