//! A problem, ready to be solved on one mesh after another until the error is within the tolerance.

use super::mesh_loop::MeshLoop;
use super::mesh_solve::MeshSolver;
use super::start::straight;
use super::transfer::resample;
use super::{Event, Facts, Outcome, Settings, SolveError, Start, start_check};
use crate::nlp::{self, Control, Deadline};
use crate::ocp::DynOcp;
use crate::transcription::{Discretization, Patterns, integrals};
use std::fmt;

/// One problem with its settings, ready to be solved on a sequence of meshes.
pub struct Refinement<'a> {
    /// The problem.
    pub ocp: &'a dyn DynOcp,
    /// Its sparsity.
    pub patterns: &'a Patterns,
    /// Mesh and refinement.
    pub settings: &'a Settings,
    /// The solver.
    pub solver: &'a nlp::Settings,
}

impl fmt::Debug for Refinement<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Refinement")
            .field("settings", &self.settings)
            .field("solver", &self.solver)
            .finish_non_exhaustive()
    }
}

impl Refinement<'_> {
    /// A straight line between the ends of every state on the first mesh, with all controls zero or as near to
    /// it as their bounds allow.
    ///
    /// # Errors
    /// Where the settings give no mesh.
    pub fn straight_start(&self) -> Result<Start, crate::collocation::MeshError> {
        let formulation = self.ocp.formulation();
        let fractions = formulation.way_point_fractions();
        let mesh = self.settings.first_mesh()?.through(&fractions)?;
        Ok(Start {
            trajectory: straight(&formulation, mesh),
            iterate: None,
        })
    }

    /// Solves on the start's mesh, with a breakpoint at every way-point, then on refined ones.
    ///
    /// Meshes follow while the error is above the tolerance, and while a state or a path row of the
    /// states exceeds its bounds between the nodes; should a mesh for the sake of the latter fail,
    /// the last one that converged counts.
    ///
    /// The monitor is told of each step and can stop the loop, and so does the solver's time limit,
    /// which is one for all meshes together. Where they cut a solve short, the last mesh that was
    /// solved counts. A failed solve ends the loop; the outcome then holds the last trajectory all
    /// the same.
    ///
    /// # Errors
    /// [`SolveError`]: a formulation or a start that cannot be, an output that is never written, and
    /// what the solver refuses before it begins.
    pub fn run(
        &self,
        start: &Start,
        monitor: &mut dyn FnMut(Event<'_>) -> Control,
    ) -> Result<Outcome, SolveError> {
        let trajectory = self.begun(&start.trajectory)?;
        let formulation = self.ocp.formulation();
        let facts = Facts::of(self.ocp, &formulation, self.patterns);
        let solver = MeshSolver {
            ocp: self.ocp,
            settings: self.solver,
            start,
            deadline: Deadline::after(self.solver.time_limit),
        };
        let mut meshes = MeshLoop::new(solver, self.patterns, self.settings, &facts, trajectory);
        loop {
            if let Some(outcome) = meshes.step(monitor)? {
                return Ok(outcome);
            }
        }
    }

    /// `start` as the loop begins with it: of this problem, with a node at every way-point and the
    /// integrals that it has.
    fn begun(&self, start: &Discretization) -> Result<Discretization, SolveError> {
        let formulation = self.ocp.formulation();
        formulation.validate()?;
        let (found, expected) = ((start.states, start.controls), formulation.widths());
        if found != expected {
            return Err(SolveError::Start { found, expected });
        }
        let (found, expected) = (start.parameters.len(), formulation.parameters.len());
        if found != expected {
            return Err(SolveError::StartParameters { found, expected });
        }
        let mut trajectory = self.at_way_points(start);
        trajectory.initial_time = formulation.initial_time.clamp(trajectory.initial_time);
        start_check::written(self.ocp, &formulation, &trajectory)?;
        trajectory.integrals = integrals(self.ocp, &formulation, &trajectory);
        Ok(trajectory)
    }

    /// The trajectory on a mesh with a breakpoint at every way-point; as it is where its mesh has
    /// them all.
    fn at_way_points(&self, start: &Discretization) -> Discretization {
        let fractions = self.ocp.formulation().way_point_fractions();
        let mesh = start.mesh.through(&fractions);
        let mesh = mesh.expect("way-points rise between the ends");
        if mesh == start.mesh {
            start.clone()
        } else {
            resample(start, mesh)
        }
    }
}
