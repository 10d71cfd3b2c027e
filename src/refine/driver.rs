//! Solves on one mesh after another until the error is within the tolerance.

use super::transfer::{Duals, resample, saved_layout};
use super::violation::worst_of_each;
use super::{
    Bounded, Method, Record, Settings, Violation, midpoint_errors, quadrature_error, refine,
    violations,
};
use crate::collocation::Mesh;
use crate::nlp::{self, Control, Iterate, Progress, Statistics, Status, ipopt};
use crate::ocp::Ocp;
use crate::transcription::{Discretization, Layout, Patterns, Transcription};
use std::time::Instant;

/// Barrier parameter that a refined mesh starts with, as a part of the solver's tolerance: so far
/// below it that the first barrier problem is the last, and costs are as exact as from a cold start.
const REFINED_BARRIER: f64 = 0.1;

/// Part of its size by which a bound may be exceeded between the nodes of a mesh that counts.
const FAR: f64 = 0.05;

/// A step of the loop, for a monitor.
#[derive(Debug, Clone, Copy)]
pub enum Event<'a> {
    /// A mesh iteration begins.
    Mesh {
        /// Counted from 1.
        iteration: usize,
        /// Number of segments.
        segments: usize,
        /// Number of collocation points.
        points: usize,
    },
    /// An iteration of the solver on the current mesh.
    Solver(&'a Progress),
    /// A mesh iteration ended.
    Solved(&'a Record),
}

/// Where the loop starts from.
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// The first mesh and a trajectory on it.
    pub trajectory: Discretization,
    /// Multipliers that belong to the trajectory, for a warm start.
    pub iterate: Option<Iterate>,
}

/// Where the loop ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The last trajectory.
    pub trajectory: Discretization,
    /// Its primal and dual values.
    pub iterate: Iterate,
    /// How the last solve ended.
    pub status: Status,
    /// Objective of the last solve.
    pub objective: f64,
    /// One record a mesh iteration.
    pub records: Vec<Record>,
    /// Whether the last solve succeeded with its largest error within the tolerance, and no bound is
    /// far exceeded between the nodes.
    pub converged: bool,
    /// The worst violation of every bound that is exceeded between the nodes by more than
    /// [`Settings::bound_tolerance`].
    pub violations: Vec<Violation>,
    /// Times of all solves together.
    pub statistics: Statistics,
}

impl Outcome {
    /// Largest error (28) on the last mesh.
    pub fn max_error(&self) -> f64 {
        self.records
            .last()
            .map_or(f64::INFINITY, |record| record.max_error)
    }
}

/// One problem with its settings, ready to be solved on a sequence of meshes.
pub struct Refinement<'a, O: Ocp> {
    /// The problem.
    pub ocp: &'a O,
    /// Its sparsity.
    pub patterns: &'a Patterns,
    /// Mesh and refinement.
    pub settings: &'a Settings,
    /// The solver.
    pub solver: &'a nlp::Settings,
}

impl<O: Ocp> Refinement<'_, O> {
    /// A straight line between the ends of every state on the first mesh, at rest controls.
    ///
    /// # Errors
    /// Where the settings give no mesh.
    pub fn straight_start(&self) -> Result<Start, crate::collocation::MeshError> {
        let formulation = self.ocp.formulation();
        let fractions = formulation.way_point_fractions();
        let mesh = self.settings.first_mesh()?.through(&fractions)?;
        let (states, controls) = formulation.widths();
        let duration = formulation.duration.center();
        let trajectory = Discretization::sample(mesh, duration, states, controls, |part, x, u| {
            for (i, value) in x.iter_mut().enumerate() {
                let bounds = &formulation.states[i].bounds;
                let start = formulation.initial[i].intersect(bounds).center();
                let end = formulation.terminal[i].intersect(bounds).center();
                *value = start + part * (end - start);
            }
            for (value, control) in u.iter_mut().zip(&formulation.controls) {
                *value = control.bounds.clamp(0.0);
            }
        });
        Ok(Start {
            trajectory,
            iterate: None,
        })
    }

    /// Solves on the start's mesh, with a breakpoint at every way-point, then on refined ones.
    ///
    /// Meshes follow while the error is above the tolerance, and while a state or a path row of the
    /// states exceeds its bounds between the nodes; should a mesh for the sake of the latter fail,
    /// the last one that converged counts.
    ///
    /// The monitor is told of each step and can stop the loop. A failed solve ends it; the
    /// outcome then holds the last trajectory all the same.
    ///
    /// # Errors
    /// What the solver refuses before it begins.
    ///
    /// # Panics
    /// Where the fractions of the way-points do not rise from above 0 to below 1.
    pub fn run(
        &self,
        start: &Start,
        monitor: &mut dyn FnMut(Event<'_>) -> Control,
    ) -> Result<Outcome, ipopt::IpoptError> {
        let mut records: Vec<Record> = Vec::new();
        let mut statistics = Statistics::default();
        let mut trajectory = self.at_way_points(&start.trajectory);
        let mut previous: Option<(Mesh, Layout, Iterate)> = None;
        let mut within_before: Option<Outcome> = None;
        loop {
            let began = Instant::now();
            let mesh = trajectory.mesh.clone();
            let event = Event::Mesh {
                iteration: records.len() + 1,
                segments: mesh.segments(),
                points: mesh.points(),
            };
            let stopped = monitor(event) == Control::Stop;
            let mut program = Transcription::new(self.ocp, self.patterns, mesh.clone());
            let x = program.pack(&trajectory);
            let mut settings = self.solver.clone();
            let iterate = match (&previous, &start.iterate) {
                (Some((old, layout, iterate)), _) => {
                    settings.warm_start = Some(REFINED_BARRIER * settings.tolerance);
                    Duals::new(old, layout, iterate).on(&mesh, program.layout(), x)
                }
                (None, Some(warm)) if settings.warm_start.is_some() => {
                    match saved_layout(warm, program.layout()) {
                        Some(old) if old == *program.layout() => Iterate { x, ..warm.clone() },
                        Some(old) => Duals::new(&mesh, &old, warm).on(&mesh, program.layout(), x),
                        None => Iterate::primal(x),
                    }
                }
                _ => Iterate::primal(x),
            };
            if !iterate.has_multipliers(program.layout().rows()) {
                settings.warm_start = None;
            }
            let mut solve = |settings: &nlp::Settings, iterate: &Iterate| {
                let solution = ipopt::solve(&mut program, settings, iterate, &mut |progress| {
                    if stopped {
                        Control::Stop
                    } else {
                        monitor(Event::Solver(progress))
                    }
                });
                if let Ok(solution) = &solution {
                    statistics.add(&solution.statistics);
                }
                solution
            };
            let mut solution = solve(&settings, &iterate)?;
            let mut nlp_iterations = solution.statistics.iterations;
            let gave_up = !solution.status.is_solved() && solution.status != Status::Interrupted;
            if gave_up && settings.warm_start.take().is_some() {
                // Multipliers may mislead; the same trajectory without them has every chance of
                // a cold start.
                solution = solve(&settings, &Iterate::primal(iterate.x))?;
                nlp_iterations += solution.statistics.iterations;
            }
            trajectory = program.unpack(&solution.iterate.x);
            let errors = midpoint_errors(self.ocp, &trajectory);
            let max_error = errors.max();
            let usable = solution.status.is_solved();
            let within = usable && max_error <= self.settings.tolerance;
            let outside = violations(self.ocp, &trajectory);
            let removable = self.removable(&outside);
            let farthest = FAR.max(self.settings.bound_tolerance);
            let held = removable.iter().flatten().all(|v| v.relative <= farthest);
            let last = match self.settings.method {
                Method::Adaptive => records.len() + 1 >= self.settings.max_iterations,
                Method::Global => within,
            };
            let next = if !usable || last {
                None
            } else {
                refine(self.settings, &trajectory, &errors, &removable)
            };
            let largest = outside.iter().flatten().map(|v| v.relative);
            records.push(Record {
                points: mesh.points(),
                segments: mesh.segments(),
                breakpoints: mesh.breakpoints().to_vec(),
                quadrature_error: quadrature_error(self.ocp, &trajectory),
                segment_errors: errors.by_segment,
                max_error,
                max_violation: largest.fold(0.0, f64::max),
                objective: solution.objective,
                nlp_iterations,
                nlp_status: solution.status,
                time: began.elapsed(),
                decisions: next.as_ref().map_or_else(Vec::new, |(_, d)| d.clone()),
            });
            let halt = monitor(Event::Solved(&records[records.len() - 1])) == Control::Stop;
            let outcome = Outcome {
                trajectory,
                iterate: solution.iterate,
                status: solution.status,
                objective: solution.objective,
                records: records.clone(),
                converged: within && held,
                violations: worst_of_each(&outside, self.settings.bound_tolerance),
                statistics,
            };
            match next {
                Some((finer, _)) if !halt => {
                    trajectory = resample(&outcome.trajectory, finer);
                    previous = Some((mesh, program.layout().clone(), outcome.iterate.clone()));
                    within_before = Some(outcome).filter(|o| o.converged).or(within_before);
                }
                _ => {
                    return Ok(match within_before {
                        Some(before) if !outcome.converged => Outcome {
                            statistics,
                            ..before
                        },
                        _ => outcome,
                    });
                }
            }
        }
    }

    /// The violations that another mesh removes: those of states and of rows of the states. A row
    /// of the controls overshoots where these switch, however narrow the segment.
    fn removable(&self, outside: &[Vec<Violation>]) -> Vec<Vec<Violation>> {
        let formulation = self.ocp.formulation();
        let removable = |violation: &&Violation| match violation.what {
            Bounded::State(_) => true,
            Bounded::Path(p) => self.patterns.path_is_continuous(&formulation, p),
        };
        outside
            .iter()
            .map(|segment| segment.iter().filter(removable).copied().collect())
            .collect()
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
