//! Why a plan could not be replayed.

/// A plan that could not be replayed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DispersionError {
    /// The plan is not one of this robot.
    #[error(transparent)]
    Plan(#[from] crate::verify::VerifyError),
    /// No step is short enough.
    #[error(
        "the base cannot be followed at {:.3} of the plan's duration: no step is short enough; its motion is out of range there, give smaller momentum or errors",
        .fraction
    )]
    TooFast {
        /// Fraction of the duration.
        fraction: f64,
    },
    /// A sample whose base turns far faster than those that the steps were chosen for.
    #[error(
        "sample {index} cannot be replayed: its base turns far faster than those of the first samples; give distributions of momentum with shorter tails"
    )]
    Sample {
        /// The sample, counted from 0.
        index: u64,
    },
    /// Too few or too many samples.
    #[error("{found} samples, expected from 1 to {most}")]
    Count {
        /// How many were asked for.
        found: u64,
        /// The most there may be.
        most: u64,
    },
    /// It was told to stop.
    #[error("interrupted after {samples} samples")]
    Interrupted {
        /// Samples that were done.
        samples: u64,
    },
    /// A perturbed robot that cannot be.
    #[error("a perturbed robot: {0}")]
    Model(#[from] crate::dynamics::ModelError),
    /// Mass properties of a perturbed body that cannot be.
    #[error("body '{body}' perturbed: {cause}")]
    Inertia {
        /// Name of the body.
        body: String,
        /// What is wrong with it.
        cause: crate::dynamics::InertiaError,
    },
}
