//! What a refinement law is: from the solution on one mesh to the next mesh.

use super::{Decision, Errors, Facts, Record, Violation};
use crate::collocation::{Mesh, MeshError};
use crate::transcription::{Discretization, Structure};

/// What is known of the solution on one mesh.
#[derive(Debug, Clone, Copy)]
pub struct Assessment<'a> {
    /// The solution in the units that errors are measured in.
    pub trajectory: &'a Discretization,
    /// Its errors (28).
    pub errors: &'a Errors,
    /// The mesh before with its errors, where there was one.
    pub before: Option<(&'a Mesh, &'a Errors)>,
    /// Bounds exceeded between the nodes that another mesh can mend, by segments.
    pub violations: &'a [Vec<Violation>],
    /// The solution in the problem's own units.
    pub solution: &'a Discretization,
    /// What the solution was made with.
    pub structure: &'a Structure,
    /// Whether a solve with a structure has failed before.
    pub structure_failed: bool,
    /// What is known of the problem.
    pub facts: Option<&'a Facts<'a>>,
    /// Tolerance on the largest error.
    pub tolerance: f64,
}

/// A finer mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Refined {
    /// The mesh.
    pub mesh: Mesh,
    /// What was decided for each segment of the mesh before.
    pub decisions: Vec<Decision>,
    /// What it knows of where the solution switches.
    pub structure: Structure,
}

/// A rule that chooses the meshes. Errors of its assessment may be NaN, which is no small error.
pub trait RefinementLaw {
    /// The mesh to begin with.
    ///
    /// # Errors
    /// [`MeshError`] where a count is zero.
    fn first_mesh(&self) -> Result<Mesh, MeshError>;

    /// The first mesh and the bounds on its refinement, in words.
    fn describe(&self) -> String;

    /// Whether the mesh iteration of the last of `records` is the last, whatever its errors; its
    /// decisions are not taken yet. There is at least one record.
    fn is_last(&self, records: &[Record]) -> bool;

    /// The next mesh, which has a breakpoint at every way-point; `None` where the law can do no
    /// more.
    fn refine(&self, assessment: &Assessment<'_>) -> Option<Refined>;
}
