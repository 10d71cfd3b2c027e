//! The planned motion as the controller and the report need it.

use super::dynamics::{BASE, PlanarDynamics};
use crate::transcription::Discretization;
use nalgebra::Vector2;

/// The planned joint path at the controller's samples.
///
/// Rates are those of the polynomial θ(t), which is what the joints then truly do; the planned
/// rates θ̇ agree with them at the collocation points only.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    duration: f64,
    period: f64,
    joints: usize,
    positions: Vec<f64>,
    rates: Vec<f64>,
}

impl Reference {
    /// Samples `plan` every `period` (s) and at its end.
    pub fn new(plan: &Discretization, joints: usize, period: f64) -> Self {
        let mut reference = Self {
            duration: plan.duration,
            period,
            joints,
            positions: Vec::new(),
            rates: Vec::new(),
        };
        let mut x = vec![0.0; plan.states];
        let angles = plan.states - 2 * joints;
        let theta = angles..angles + joints;
        for k in 0..=reference.samples() {
            let (s, tau) = plan.mesh.locate(reference.time(k) / plan.duration);
            plan.state_in(s, tau, &mut x);
            reference.positions.extend_from_slice(&x[theta.clone()]);
            plan.state_derivative_in(s, tau, &mut x);
            let unit = 0.5 * plan.mesh.width(s) * plan.duration;
            reference
                .rates
                .extend(x[theta.clone()].iter().map(|rate| rate / unit));
        }
        reference
    }

    /// Sampling period, s.
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Number of samples before the end.
    pub fn samples(&self) -> usize {
        // A last sample shorter than a millionth of the others is rounding.
        ((self.duration / self.period - 1e-6).ceil() as usize).max(1)
    }

    /// Time of sample `k`, s; the end for the one after the last.
    pub fn time(&self, k: usize) -> f64 {
        (k as f64 * self.period).min(self.duration)
    }

    /// Positions at sample `k`; length n.
    pub fn position(&self, k: usize) -> &[f64] {
        &self.positions[k * self.joints..(k + 1) * self.joints]
    }

    /// Rates at sample `k`; length n.
    pub fn rate(&self, k: usize) -> &[f64] {
        &self.rates[k * self.joints..(k + 1) * self.joints]
    }

    /// Mean acceleration of joint `j` from sample `k` to the next: what a torque that is held
    /// has to give.
    pub fn acceleration(&self, k: usize, j: usize) -> f64 {
        let span = self.time(k + 1) - self.time(k);
        (self.rate(k + 1)[j] - self.rate(k)[j]) / span
    }
}

/// The planned pose of the base.
pub(super) struct PlannedBase<'a> {
    plan: &'a Discretization,
    /// Velocity of the system's mass centre, m/s.
    drift: Vector2<f64>,
    dynamics: PlanarDynamics,
    x: Vec<f64>,
    still: Vec<f64>,
}

impl<'a> PlannedBase<'a> {
    pub fn new(plan: &'a Discretization, drift: Vector2<f64>, dynamics: PlanarDynamics) -> Self {
        Self {
            plan,
            drift,
            x: vec![0.0; plan.states],
            still: vec![0.0; dynamics.size()],
            dynamics,
        }
    }

    /// Position x, y (m) and attitude (rad) at time `t`: ζ = −R(η)·r_cm, Remark 1.
    pub fn at(&mut self, t: f64) -> [f64; BASE] {
        let (s, tau) = self
            .plan
            .mesh
            .locate((t / self.plan.duration).clamp(0.0, 1.0));
        self.plan.state_in(s, tau, &mut self.x);
        let n = self.dynamics.size() - BASE;
        let mut q = vec![0.0; BASE];
        q[2] = self.x[0];
        q.extend_from_slice(&self.x[1..1 + n]);
        self.dynamics.place(&q, &self.still);
        let position = self.drift * t - self.dynamics.center();
        [position.x, position.y, self.x[0]]
    }
}
