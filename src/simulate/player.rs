//! A plan made ready to be played.

use super::SimulateError;
use super::dynamics::{BASE, PlanarDynamics};
use super::plane::PlanarBodies;
use super::platform::Platform;
use super::reference::{PlannedBase, Reference};
use crate::dynamics::Tree;
use crate::dynamics::space::Planar;
use crate::problem::Problem;
use crate::transcription::Discretization;
use crate::verify;
use nalgebra::Vector2;
use std::sync::Arc;

/// A plan on a platform, ready to be played any number of times.
#[derive(Debug, Clone)]
pub struct Player {
    platform: Platform,
    plan: Arc<Discretization>,
    /// As planned for.
    robot: PlanarBodies,
    /// As it stands on the floor.
    plant: PlanarBodies,
    /// The controller's model.
    tree: Tree<Planar>,
    reference: Arc<Reference>,
    /// Planned linear momentum, kg m/s, and angular one about the mass centre, kg m²/s.
    momentum: (Vector2<f64>, f64),
}

/// Most samples of the controller, and most frames of the capture.
const MOST_SAMPLES: f64 = 1e7;

impl Player {
    /// Makes `plan`, whose states are [η, θ, θ̇], ready for `platform`.
    ///
    /// # Errors
    /// [`SimulateError`] where the robot does not move in a plane, or plan and robot do not
    /// belong together.
    pub fn new(
        problem: &Problem,
        plan: &Discretization,
        platform: Platform,
    ) -> Result<Self, SimulateError> {
        let model = &problem.robot;
        let (Some(robot), Some(tree)) = (PlanarBodies::new(model), Tree::planar(model)) else {
            return Err(SimulateError::NotPlanar {
                robot: model.name().into(),
            });
        };
        verify::check(problem, plan)?;
        let (controller, capture) = (&platform.controller, &platform.capture);
        let samples = plan.duration * capture.rate.max(1.0 / controller.period);
        if samples > MOST_SAMPLES {
            return Err(SimulateError::TooManySamples {
                samples,
                most: MOST_SAMPLES,
            });
        }
        let momentum = &problem.task.initial_momentum;
        Ok(Self {
            reference: Arc::new(Reference::new(
                plan,
                robot.joint_count(),
                platform.controller.period,
            )),
            momentum: (
                Vector2::from_column_slice(&momentum.linear),
                momentum.angular[0],
            ),
            plan: Arc::new(plan.clone()),
            plant: robot.clone().carrying(&platform.payload),
            platform,
            robot,
            tree,
        })
    }

    /// The same plan on another platform.
    pub fn on(&self, platform: Platform) -> Self {
        let period = platform.controller.period;
        let reference = if period == self.reference.period() {
            self.reference.clone()
        } else {
            let joints = self.robot.joint_count();
            Arc::new(Reference::new(&self.plan, joints, period))
        };
        Self {
            plant: self.robot.clone().carrying(&platform.payload),
            platform,
            reference,
            ..self.clone()
        }
    }

    /// The platform.
    pub fn platform(&self) -> &Platform {
        &self.platform
    }

    /// Planned position x, y (m) and attitude (rad) of the base at `times` (s).
    pub fn planned(&self, times: &[f64]) -> Vec<[f64; BASE]> {
        let drift = self.momentum.0 / self.robot.total_mass();
        let dynamics = PlanarDynamics::new(self.robot.clone());
        let mut base = PlannedBase::new(&self.plan, drift, dynamics);
        times.iter().map(|t| base.at(*t)).collect()
    }

    pub(super) fn plant(&self) -> &PlanarBodies {
        &self.plant
    }

    pub(super) fn tree(&self) -> &Tree<Planar> {
        &self.tree
    }

    pub(super) fn reference(&self) -> &Reference {
        &self.reference
    }

    pub(super) fn momentum(&self) -> (Vector2<f64>, f64) {
        self.momentum
    }

    /// Planned pose of the base at t₀.
    pub(super) fn start(&self) -> [f64; BASE] {
        self.planned(&[0.0])[0]
    }
}
