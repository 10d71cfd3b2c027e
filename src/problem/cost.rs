//! The cost functional.

use super::components::{ComponentKind, base_sizes};
use crate::dynamics::Model;

/// Weights of the cost functional (14).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Cost {
    /// ‖η(t_f)‖², one weight an angle; by quaternion or modified Rodrigues parameters one weight, of
    /// the squared rotation angle out of the axes that the attitude is counted from.
    pub final_base_attitude: Vec<f64>,
    /// ‖ζ(t_f) − ζ(t₀)‖², one weight a length.
    pub final_base_position: Vec<f64>,
    /// ∫‖η‖² dt, one weight an angle; by quaternion or modified Rodrigues parameters one weight, of
    /// ∫φ² dt of the rotation angle.
    pub base_attitude: Vec<f64>,
    /// ∫‖ζ − ζ(t₀)‖² dt, one weight a length.
    pub base_position: Vec<f64>,
    /// ∫‖η̇‖² dt, one weight an angle; by quaternion or modified Rodrigues parameters ∫‖ω‖² dt, one
    /// a base axis.
    pub base_rate: Vec<f64>,
    /// ∫‖θ̇‖² dt, one weight a joint.
    pub joint_rate: Vec<f64>,
    /// ∫‖u‖² dt, one weight a joint.
    pub control: Vec<f64>,
    /// ∫‖τ‖² dt, one weight a joint.
    pub torque: Vec<f64>,
    /// The largest base angle along the path, rad: of the rotation out of the axes that the attitude is
    /// counted from; one weight.
    pub peak_base_attitude: Vec<f64>,
    /// The largest distance of the base from where it was at t₀, m; one weight.
    pub peak_base_position: Vec<f64>,
    /// The largest ‖η̇‖, by quaternion or modified Rodrigues parameters ‖ω‖, rad/s; one weight.
    pub peak_base_rate: Vec<f64>,
    /// The duration t_f itself, where it is free; 1/s.
    pub duration: f64,
    /// Λ of (14) as a full matrix over [η̇, θ̇], by rows, added to the weights above; symmetric.
    pub rate_matrix: Option<Vec<Vec<f64>>>,
}

/// A term of the cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum CostId {
    /// ‖η(t_f)‖².
    FinalBaseAttitude,
    /// ‖ζ(t_f) − ζ(t₀)‖².
    FinalBasePosition,
    /// ∫‖η‖² dt.
    BaseAttitude,
    /// ∫‖ζ − ζ(t₀)‖² dt.
    BasePosition,
    /// ∫‖η̇‖² dt.
    BaseRate,
    /// ∫‖θ̇‖² dt.
    JointRate,
    /// ∫‖u‖² dt.
    Control,
    /// ∫‖τ‖² dt.
    Torque,
    /// The largest base angle.
    PeakBaseAttitude,
    /// The largest displacement of the base.
    PeakBasePosition,
    /// The largest rate of the base.
    PeakBaseRate,
    /// t_f.
    Duration,
    /// Λ over [η̇, θ̇].
    RateMatrix,
}

impl CostId {
    /// The key in the problem file (`cost.base_rate`).
    pub fn key(self) -> &'static str {
        match self {
            Self::FinalBaseAttitude => "cost.final_base_attitude",
            Self::FinalBasePosition => "cost.final_base_position",
            Self::BaseAttitude => "cost.base_attitude",
            Self::BasePosition => "cost.base_position",
            Self::BaseRate => "cost.base_rate",
            Self::JointRate => "cost.joint_rate",
            Self::Control => "cost.control",
            Self::Torque => "cost.torque",
            Self::PeakBaseAttitude => "cost.peak_base_attitude",
            Self::PeakBasePosition => "cost.peak_base_position",
            Self::PeakBaseRate => "cost.peak_base_rate",
            Self::Duration => "cost.duration",
            Self::RateMatrix => "cost.rate_matrix",
        }
    }

    /// The term as a formula; `rotation` where the attitude is not described by angles
    /// ([`ProblemBuilder::has_rotation_angle`](super::ProblemBuilder::has_rotation_angle)).
    pub fn formula(self, rotation: bool) -> &'static str {
        match self {
            Self::FinalBaseAttitude if rotation => "φ(t_f)²",
            Self::FinalBaseAttitude => "‖η(t_f)‖²",
            Self::FinalBasePosition => "‖Δζ(t_f)‖²",
            Self::BaseAttitude if rotation => "∫φ²",
            Self::BaseAttitude => "∫‖η‖²",
            Self::BasePosition => "∫‖Δζ‖²",
            Self::BaseRate if rotation => "∫‖ω‖²",
            Self::BaseRate => "∫‖η̇‖²",
            Self::JointRate => "∫‖θ̇‖²",
            Self::Control => "∫‖u‖²",
            Self::Torque => "∫‖τ‖²",
            Self::PeakBaseAttitude => "max φ",
            Self::PeakBasePosition => "max ‖Δζ‖",
            Self::PeakBaseRate if rotation => "max ‖ω‖",
            Self::PeakBaseRate => "max ‖η̇‖",
            Self::Duration => "t_f",
            Self::RateMatrix if rotation => "∫[ω, θ̇]ᵀΛ[ω, θ̇]",
            Self::RateMatrix => "∫[η̇, θ̇]ᵀΛ[η̇, θ̇]",
        }
    }

    /// The key within its table (`base_rate`).
    pub fn name(self) -> &'static str {
        let key = self.key();
        key.rsplit_once('.').map_or(key, |(_, name)| name)
    }
}

/// One term of the cost, with `W` its weights: `&Vec<f64>` or `&mut Vec<f64>`.
#[derive(Debug)]
#[non_exhaustive]
pub struct CostEntry<W> {
    /// Which term.
    pub id: CostId,
    /// What there is one weight of.
    pub components: ComponentKind,
    /// The weights.
    pub weights: W,
}

/// The table of all terms that have weights by component. A new one is a line here and a field.
#[rustfmt::skip]
macro_rules! table {
    ($cost:ident, $($borrow:tt)+) => {{
        use ComponentKind::{Base, BaseAttitude, BasePosition, BaseRate, Joint};
        use CostId as Id;
        [
            CostEntry { id: Id::FinalBaseAttitude, components: BaseAttitude, weights: $($borrow)+ $cost.final_base_attitude },
            CostEntry { id: Id::FinalBasePosition, components: BasePosition, weights: $($borrow)+ $cost.final_base_position },
            CostEntry { id: Id::BaseAttitude, components: BaseAttitude, weights: $($borrow)+ $cost.base_attitude },
            CostEntry { id: Id::BasePosition, components: BasePosition, weights: $($borrow)+ $cost.base_position },
            CostEntry { id: Id::BaseRate, components: BaseRate, weights: $($borrow)+ $cost.base_rate },
            CostEntry { id: Id::JointRate, components: Joint, weights: $($borrow)+ $cost.joint_rate },
            CostEntry { id: Id::Control, components: Joint, weights: $($borrow)+ $cost.control },
            CostEntry { id: Id::Torque, components: Joint, weights: $($borrow)+ $cost.torque },
            CostEntry { id: Id::PeakBaseAttitude, components: Base, weights: $($borrow)+ $cost.peak_base_attitude },
            CostEntry { id: Id::PeakBasePosition, components: Base, weights: $($borrow)+ $cost.peak_base_position },
            CostEntry { id: Id::PeakBaseRate, components: Base, weights: $($borrow)+ $cost.peak_base_rate },
        ]
    }};
}

impl Cost {
    /// No cost, for a problem of `robot`.
    pub fn none(robot: &Model) -> Self {
        let n = robot.joint_count();
        let (angles, lengths) = base_sizes(robot);
        Self {
            final_base_attitude: vec![0.0; angles],
            final_base_position: vec![0.0; lengths],
            base_attitude: vec![0.0; angles],
            base_position: vec![0.0; lengths],
            base_rate: vec![0.0; angles],
            joint_rate: vec![0.0; n],
            control: vec![0.0; n],
            torque: vec![0.0; n],
            peak_base_attitude: vec![0.0],
            peak_base_position: vec![0.0],
            peak_base_rate: vec![0.0],
            duration: 0.0,
            rate_matrix: None,
        }
    }

    /// Every term that has weights by component, in the order of the problem file: all but
    /// [`CostId::Duration`] and [`CostId::RateMatrix`].
    pub fn entries(&self) -> impl Iterator<Item = CostEntry<&Vec<f64>>> {
        table!(self, &).into_iter()
    }

    /// The same, to be changed.
    pub fn entries_mut(&mut self) -> impl Iterator<Item = CostEntry<&mut Vec<f64>>> {
        table!(self, &mut).into_iter()
    }
}
