//! The mesh that a plan begins on.

use crate::collocation::Mesh;
use crate::dynamics::space::Space;
use crate::ocp::Ocp;
use crate::planner::PlanError;
use crate::problem::Problem;
use crate::system::{FreeFloating, System, with_system};
use crate::transcription::Discretization;

/// The first mesh of `problem`, with a breakpoint at every way-point.
///
/// # Errors
/// [`PlanError`] for a mesh that cannot be.
pub(crate) fn first_mesh<Sp: Space>(
    problem: &Problem,
    system: &FreeFloating<Sp>,
) -> Result<Mesh, PlanError> {
    let fractions = system.formulation().way_point_fractions();
    Ok(problem.mesh.first_mesh()?.through(&fractions)?)
}

/// `trajectory` on the first mesh of `problem`: a start that keeps its motion and leaves its points.
///
/// # Errors
/// [`PlanError`] for a mesh that cannot be.
pub fn on_first_mesh(
    problem: &Problem,
    trajectory: &Discretization,
) -> Result<Discretization, PlanError> {
    let mesh = with_system!(&System::new(problem), system => first_mesh(problem, system))?;
    Ok(trajectory.resample(mesh))
}
