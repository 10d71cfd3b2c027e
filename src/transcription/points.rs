//! All collocation points at one iterate, on several threads where that pays.

use super::Patterns;
use super::node_derivatives::NodeDerivatives;
use crate::ocp::{DynOcp, Formulation, PointShape, Shape};
use crate::parallel;

/// Least work, in points times inputs squared, that is worth waking threads for.
const LEAST_WORK: usize = 12_000;
/// Values take about this part of the time of derivatives.
const VALUES: usize = 10;
/// Pieces for each thread to take, so that one that comes late has less to do.
const SHARES: usize = 8;
/// Most threads.
const MOST: usize = 8;
/// Most numbers that first derivatives of all points leave to second ones: 8 MiB. More would come from
/// memory no sooner than they are computed, and none are kept.
const MOST_KEPT: usize = 1 << 20;

/// Evaluates every point, each by itself, so that results do not depend on the number of threads.
pub(super) struct Points<'a> {
    /// Fractions of the duration of the collocation points.
    fractions: Vec<f64>,
    /// First variable of each collocation point.
    starts: Vec<usize>,
    shape: PointShape,
    workers: Vec<Worker<'a>>,
    work: usize,
    /// What first derivatives leave to second ones, a piece for each of the first points.
    kept: Vec<f64>,
}

/// What one thread needs.
struct Worker<'a> {
    derivatives: NodeDerivatives<'a>,
    inputs: Vec<f64>,
}

/// The unknowns that all points share.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shared<'v> {
    pub initial_time: f64,
    pub duration: f64,
    pub parameters: &'v [f64],
}

/// An iterate.
#[derive(Clone, Copy)]
struct Iterate<'v> {
    shape: PointShape,
    x: &'v [f64],
    shared: Shared<'v>,
}

impl<'a> Points<'a> {
    pub fn new(
        ocp: &'a dyn DynOcp,
        formulation: &Formulation,
        derivatives: NodeDerivatives<'a>,
        patterns: &Patterns,
        fractions: Vec<f64>,
        starts: Vec<usize>,
    ) -> Self {
        let shape = PointShape::of(formulation);
        let work = fractions.len() * shape.inputs().pow(2);
        let worker = |derivatives| Worker {
            derivatives,
            inputs: vec![0.0; shape.inputs()],
        };
        let piece = derivatives.kept();
        let all = piece * fractions.len();
        let kept = vec![0.0; if all > MOST_KEPT { 0 } else { all }];
        let mut workers = vec![worker(derivatives)];
        if work >= LEAST_WORK {
            let count = parallel::most_threads().min(MOST);
            let another = || {
                worker(NodeDerivatives::new(
                    ocp,
                    formulation,
                    patterns.node.clone(),
                ))
            };
            workers.resize_with(count, another);
        }
        Self {
            fractions,
            starts,
            shape,
            workers,
            work,
            kept,
        }
    }

    pub fn fractions(&self) -> &[f64] {
        &self.fractions
    }

    pub fn derivatives(&self) -> &NodeDerivatives<'a> {
        &self.workers[0].derivatives
    }

    /// Outputs of every point, by points.
    pub fn values(&mut self, x: &[f64], shared: Shared<'_>, out: &mut [f64]) {
        let count = match self.work < VALUES * LEAST_WORK {
            true => 1,
            false => self.count(),
        };
        let shape = self.shape;
        let iterate = Iterate { shape, x, shared };
        self.each(count, iterate, out, |worker, _, _, out| {
            worker.derivatives.values(&worker.inputs, out);
        });
    }

    /// Jacobian nonzeros of every point, by points.
    pub fn jacobians(&mut self, x: &[f64], shared: Shared<'_>, out: &mut [f64]) {
        let shape = self.shape;
        let iterate = Iterate { shape, x, shared };
        self.each(self.count(), iterate, out, |worker, _, kept, out| {
            worker.derivatives.jacobian(&worker.inputs, out);
            worker.derivatives.keep(kept);
        });
    }

    /// Weighted Hessians of every point, by points.
    pub fn hessians(&mut self, x: &[f64], shared: Shared<'_>, weights: &[f64], out: &mut [f64]) {
        let shape = self.shape;
        let iterate = Iterate { shape, x, shared };
        let width = shape.outputs();
        self.each(self.count(), iterate, out, |worker, k, kept, out| {
            let weights = &weights[k * width..(k + 1) * width];
            worker.derivatives.recall(kept);
            worker.derivatives.hessian(&worker.inputs, weights, out);
        });
    }

    /// How many workers have a thread at this moment.
    fn count(&self) -> usize {
        self.workers.len().min(parallel::thread_count())
    }

    /// Calls `body` for every point with its piece of what is kept, or none, and its part of `out`,
    /// its inputs being loaded.
    fn each(
        &mut self,
        count: usize,
        iterate: Iterate<'_>,
        out: &mut [f64],
        body: impl Fn(&mut Worker<'a>, usize, &mut [f64], &mut [f64]) + Sync,
    ) {
        let points = self.fractions.len();
        let width = out.len() / points;
        if width == 0 {
            return;
        }
        let (fractions, starts) = (&self.fractions, &self.starts);
        let visit = |worker: &mut Worker<'a>, k: usize, kept: &mut [f64], out: &mut [f64]| {
            iterate.load(starts[k], fractions[k], &mut worker.inputs);
            body(worker, k, kept, out);
        };
        let workers = &mut self.workers[..count];
        let piece = workers[0].derivatives.kept().max(1);
        let keeping = self.kept.len() / piece;
        let (kept, out) = (&mut self.kept, out.split_at_mut(keeping * width));
        let share = keeping.div_ceil(SHARES * count).max(1);
        let shares = out.0.chunks_mut(share * width);
        let shares = shares.zip(kept.chunks_mut(share * piece)).enumerate();
        parallel::for_each(workers, shares, |worker, (s, (out, kept))| {
            let pieces = kept.chunks_exact_mut(piece);
            for (k, (kept, out)) in (s * share..).zip(pieces.zip(out.chunks_exact_mut(width))) {
                visit(worker, k, kept, out);
            }
        });
        let share = (points - keeping).div_ceil(SHARES * count).max(1);
        let shares = out.1.chunks_mut(share * width).enumerate();
        parallel::for_each(workers, shares, |worker, (s, out)| {
            for (k, out) in (keeping + s * share..).zip(out.chunks_exact_mut(width)) {
                visit(worker, k, &mut [], out);
            }
        });
    }
}

impl Iterate<'_> {
    /// Inputs (x, u, p, t) of the point whose variables begin at `start`.
    fn load(&self, start: usize, fraction: f64, inputs: &mut [f64]) {
        let width = self.shape.own();
        let time = self.shape.time();
        inputs[..width].copy_from_slice(&self.x[start..start + width]);
        inputs[width..time].copy_from_slice(self.shared.parameters);
        inputs[time] = self.shared.initial_time + fraction * self.shared.duration;
    }
}
