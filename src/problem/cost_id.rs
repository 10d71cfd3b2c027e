//! The name of a term of the cost.

/// A term of the cost (14), by its key in the problem file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum CostId {
    /// ‖η(t_f)‖².
    FinalBaseAttitude,
    /// ‖ζ(t_f) − ζ(t₀)‖².
    FinalBasePosition,
    /// ∫‖η̇‖² dt.
    BaseRate,
    /// ∫‖θ̇‖² dt.
    JointRate,
    /// ∫‖u‖² dt.
    Control,
    /// ∫‖τ‖² dt.
    Torque,
    /// t_f.
    Duration,
    /// ∫[η̇, θ̇]ᵀΛ[η̇, θ̇] dt.
    RateMatrix,
}
