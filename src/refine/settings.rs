//! Settings of the mesh and its refinement.

use super::Method;
use crate::collocation::Mesh;

/// What the error (28) of a state is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum ErrorMeasure {
    /// The state's scale, so that its unit plays no part. A scale of one makes no difference.
    #[default]
    Relative,
    /// The state's unit, as in the paper.
    Paper,
}

impl ErrorMeasure {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Relative, Self::Paper];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Relative => "relative",
            Self::Paper => "paper",
        }
    }
}

/// How the adaptive method chooses its meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Law {
    /// As in the paper: by errors and curvature.
    #[default]
    Paper,
    /// By where controls switch, and as in the paper where they do not.
    Structure,
}

impl Law {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Paper, Self::Structure];

    /// The name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Structure => "structure",
        }
    }
}

/// First mesh, tolerance and refinement law. Each field says its default.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Method. Default adaptive.
    pub method: Method,
    /// How the adaptive method chooses its meshes. Default the paper's law.
    pub law: Law,
    /// Equal segments of the first mesh. Default 10. The global method has one.
    pub segments: usize,
    /// LGR points in each segment of the first mesh, and the fewest in each part of a divided one.
    /// Default 5.
    pub points: usize,
    /// Tolerance ε_d on the largest error (28). Default 1e-5.
    pub tolerance: f64,
    /// Part of |J| within which the estimated error of J, [`Record::objective_error`](super::Record::objective_error),
    /// has to be as well. Default `None`: whatever it is.
    pub objective_tolerance: Option<f64>,
    /// What that error is measured in. Default the scale of each state.
    pub error: ErrorMeasure,
    /// Part of a bound's size by which states and path rows may exceed it between the nodes before
    /// the adaptive method refines there. Default 1e-3.
    pub bound_tolerance: f64,
    /// Largest number of mesh iterations of the adaptive method, the first included. Default
    /// `None`: as many as it takes while the error falls or the cost still moves, 40 at most.
    pub max_iterations: Option<usize>,
    /// Largest number of LGR points in one segment of the adaptive method. Default 20.
    pub max_points: usize,
    /// λ₁ of (30). Default 2.
    pub lambda1: f64,
    /// λ₂ of (32). Default 3.
    pub lambda2: f64,
    /// Curvature ratio r_max above which a segment is divided. Default 1.5.
    pub r_max: f64,
    /// LGR points the global method starts with; raised by (32). Default 20.
    pub global_points: usize,
    /// Largest number of LGR points of the global method. Default 80.
    pub max_global_points: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            method: Method::Adaptive,
            law: Law::Paper,
            segments: 10,
            points: 5,
            tolerance: 1e-5,
            objective_tolerance: None,
            error: ErrorMeasure::Relative,
            bound_tolerance: 1e-3,
            max_iterations: None,
            max_points: 20,
            lambda1: 2.0,
            lambda2: 3.0,
            r_max: 1.5,
            global_points: 20,
            max_global_points: 80,
        }
    }
}

impl Settings {
    /// Checks every field.
    ///
    /// # Errors
    /// [`SettingError`] for the first that cannot be.
    pub fn validate(&self) -> Result<(), SettingError> {
        let at_least_one = [
            ("segments", self.segments),
            ("points", self.points),
            ("max_iterations", self.max_iterations.unwrap_or(1)),
            ("global_points", self.global_points),
        ];
        for (key, value) in at_least_one {
            if value == 0 {
                return wrong(key, value, "a whole number of at least 1");
            }
        }
        if self.max_points < self.points {
            let expected = format!("at least mesh.points, {}", self.points);
            return wrong("max_points", self.max_points, &expected);
        }
        if self.max_global_points < self.global_points {
            let expected = format!("at least mesh.global_points, {}", self.global_points);
            return wrong("max_global_points", self.max_global_points, &expected);
        }
        let (most, all) = (Mesh::MOST_POINTS, self.segments.saturating_mul(self.points));
        if all > most {
            let found = format!("{} of {} points", self.segments, self.points);
            let expected = format!("at most {most} points in all segments together");
            return wrong("segments", found, &expected);
        }
        let above_zero = [
            ("tolerance", self.tolerance),
            (
                "objective_tolerance",
                self.objective_tolerance.unwrap_or(1.0),
            ),
            ("bound_tolerance", self.bound_tolerance),
            ("lambda1", self.lambda1),
            ("lambda2", self.lambda2),
        ];
        for (key, value) in above_zero {
            if !(value.is_finite() && value > 0.0) {
                return wrong(key, value, "a finite number above zero");
            }
        }
        if !(self.r_max.is_finite() && self.r_max >= 1.0) {
            return wrong("r_max", self.r_max, "a finite ratio of at least 1");
        }
        Ok(())
    }
}

/// A setting that cannot be.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {found}; expected {expected}")]
#[non_exhaustive]
pub struct SettingError {
    /// The field.
    pub key: &'static str,
    /// What stands there.
    pub found: String,
    /// What was expected.
    pub expected: String,
}

fn wrong(key: &'static str, found: impl ToString, expected: &str) -> Result<(), SettingError> {
    Err(SettingError {
        key,
        found: found.to_string(),
        expected: expected.into(),
    })
}
