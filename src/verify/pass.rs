//! One integration over the whole plan, segment by segment and node by node.

use super::bodies::{BaseMotion, Bodies, orientation};
use super::mass_matrix::{MassMatrix, NotPositiveDefinite};
use super::{Verification, VerifyError};
use crate::dynamics::Model;
use crate::dynamics::attitude::SpatialAttitude;
use crate::integrate::{Dop853, IntegrationError, Ode, Reached};
use crate::problem::Problem;
use crate::transcription::Discretization;
use nalgebra::{UnitQuaternion, Vector3};
use std::ops::ControlFlow;

const RELATIVE: f64 = 1e-12;
const ABSOLUTE: f64 = 1e-14;
/// Most steps in all, and for each node: plans that move as planned need two a node, and one that
/// runs away is ended before it takes longer than its planning.
const STEPS: usize = 10_000;
const STEPS_PER_NODE: usize = 200;

/// The plan at its nodes: what re-integration is compared with.
pub(super) struct Planned<'a> {
    pub model: &'a Model,
    plan: &'a Discretization,
    attitude: SpatialAttitude,
    angles: usize,
    bodies: Bodies,
    /// Fractions of the duration of all nodes.
    fractions: Vec<f64>,
    still: Vec<f64>,
    /// Total momentum in inertial axes, the angular one about the system's mass centre.
    pub linear: Vector3<f64>,
    pub angular: Vector3<f64>,
    pub total_mass: f64,
}

impl<'a> Planned<'a> {
    pub fn new(problem: &'a Problem, plan: &'a Discretization) -> Self {
        let model = &problem.robot;
        let momentum = &problem.task.initial_momentum;
        // In the plane: along its axes, and about its normal.
        let (linear, angular) = match model.plane() {
            Some(plane) => (
                plane.basis * Vector3::new(momentum.linear[0], momentum.linear[1], 0.0),
                plane.basis * Vector3::new(0.0, 0.0, momentum.angular[0]),
            ),
            None => (
                Vector3::from_column_slice(&momentum.linear),
                Vector3::from_column_slice(&momentum.angular),
            ),
        };
        Self {
            linear,
            angular,
            total_mass: model.total_mass(),
            model,
            plan,
            attitude: problem.attitude,
            angles: problem.attitude_sizes().0,
            bodies: Bodies::new(model),
            fractions: plan.mesh.node_fractions(),
            still: vec![0.0; model.joint_count()],
        }
    }

    /// Joint positions and rates at node `k`.
    pub fn joints(&self, k: usize) -> &'a [f64] {
        &self.plan.state(k)[self.angles..]
    }

    /// Orientation and position ζ = −R·r_cm of the base at node `k`.
    pub fn base(&mut self, k: usize) -> (UnitQuaternion<f64>, Vector3<f64>) {
        let orientation = orientation(
            self.model,
            self.attitude,
            &self.plan.state(k)[..self.angles],
        );
        let base = BaseMotion::placed(Vector3::zeros(), orientation);
        self.bodies
            .update(self.model, &base, self.joints(k), &self.still);
        let time = self.fractions[k] * self.plan.duration;
        let drift = self.linear * (time / self.total_mass);
        (orientation, drift - self.bodies.center())
    }

    /// Velocity and angular velocity of the base for the joint rates `dq`, with `mass` and
    /// `bodies` at the current pose and the base's origin at `position`.
    pub fn twist(
        &self,
        mass: &MassMatrix,
        bodies: &Bodies,
        position: &Vector3<f64>,
        dq: &[f64],
    ) -> (Vector3<f64>, Vector3<f64>) {
        let arm = bodies.center() - position;
        mass.with_momentum(dq, &self.linear, &(self.angular + arm.cross(&self.linear)))
    }
}

/// A motion that is integrated along the plan, in τ of each segment.
pub(super) trait Pass: Ode<Error = NotPositiveDefinite> {
    /// What is integrated, for messages.
    const NAME: &'static str;
    /// The state that the plan has at node `k`, to integrate from there.
    fn at(&mut self, k: usize) -> Result<Vec<f64>, NotPositiveDefinite>;
    /// Segment `s` begins.
    fn enter(&mut self, plan: &Discretization, s: usize);
    /// A step was taken.
    fn after_step(&mut self, y: &[f64], found: &mut Verification);
    /// Node `k` is reached.
    fn at_node(&mut self, k: usize, y: &[f64], found: &mut Verification);
}

/// Where an integration begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum From {
    /// At the start of the plan.
    Start,
    /// At the start of each segment anew.
    EachSegment,
}

/// Integrates `pass` over `plan`; `ended` is told what was found after each segment.
pub(super) fn run<P: Pass>(
    mut pass: P,
    plan: &Discretization,
    from: From,
    found: &mut Verification,
    ended: &mut dyn FnMut(&mut Verification),
) -> Result<(), VerifyError> {
    let singular = |time| VerifyError::Singular {
        pass: P::NAME,
        time,
    };
    let mut y = pass.at(0).map_err(|NotPositiveDefinite| singular(0.0))?;
    let mesh = &plan.mesh;
    let limit = STEPS + STEPS_PER_NODE * mesh.points();
    let mut integrator = Dop853::new(y.len(), RELATIVE, ABSOLUTE, limit);
    for s in 0..mesh.segments() {
        pass.enter(plan, s);
        if s > 0 {
            integrator.change_unit(mesh.width(s) / mesh.width(s - 1));
            if from == From::EachSegment {
                let start = pass.at(mesh.start(s));
                let time = mesh.breakpoints()[s] * plan.duration;
                y = start.map_err(|NotPositiveDefinite| singular(time))?;
            }
        }
        let time = |tau| mesh.fraction(s, tau) * plan.duration;
        let nodes = mesh.rule(s).nodes();
        let mut overflow = None;
        let see = |pass: &mut P, reached: Reached<'_>| {
            match reached {
                Reached::Step(y) => pass.after_step(y, found),
                Reached::Node(k, y) => {
                    pass.at_node(mesh.start(s) + k, y, found);
                    overflow = found.overflows().then_some(nodes[k]);
                }
            }
            match overflow {
                Some(_) => ControlFlow::Break(()),
                None => ControlFlow::Continue(()),
            }
        };
        integrator
            .advance(&mut pass, nodes, &mut y, see)
            .map_err(|error| match error {
                IntegrationError::Rate(tau, NotPositiveDefinite) => singular(time(tau)),
                IntegrationError::StepUnderflow(tau) => VerifyError::StepUnderflow {
                    pass: P::NAME,
                    time: time(tau),
                },
                IntegrationError::StepLimit(tau) => VerifyError::StepLimit {
                    pass: P::NAME,
                    time: time(tau),
                    limit,
                },
            })?;
        if let Some(tau) = overflow {
            return Err(VerifyError::Undefined {
                pass: P::NAME,
                time: time(tau),
            });
        }
        ended(found);
    }
    Ok(())
}
