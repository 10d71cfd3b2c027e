//! An optimal control problem behind a vtable.

use super::functions::{EndsShape, Of, Part, PointShape, WayPointShape};
use super::{Ends, Formulation, InteriorPoint, Ocp, Point, PointDerivatives};
use crate::autodiff::{Function, SparseDerivatives, Sparsity};

/// The side of [`Ocp`] that works with numbers alone, for every type that implements it.
///
/// Transcription and refinement see a problem by it: so they are compiled once and not for each
/// problem, which would take longer than all else. A `&problem` becomes a `&dyn DynOcp` by itself.
pub trait DynOcp: Sync {
    /// [`Ocp::formulation`].
    fn formulation(&self) -> Formulation;

    /// [`Ocp::has_branches`].
    fn has_branches(&self) -> bool;

    /// [`Ocp::derivatives`].
    fn own_derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>>;

    /// The functions, with scratch of their own.
    fn functions(&self) -> Box<dyn Functions + '_>;

    /// The pattern of `part` by its operations: [`Sparsity::traced`].
    fn trace(&self, part: Part, formulation: &Formulation, used: &[bool], at: &[f64]) -> Sparsity;

    /// The derivatives of `part` with this pattern, by dual numbers: [`SparseDerivatives`].
    fn differentiate(
        &self,
        part: Part,
        formulation: &Formulation,
        sparsity: Sparsity,
    ) -> Box<dyn Derivatives + '_>;
}

/// Values of a problem's functions; one is made for each thread that evaluates.
pub trait Functions: Send {
    /// [`Ocp::continuous`].
    fn continuous(&mut self, point: Point<'_, f64>, rates: &mut [f64], path: &mut [f64]) -> f64;

    /// [`Ocp::integrands`], right after [`Functions::continuous`] at the same point.
    fn integrands(&mut self, point: Point<'_, f64>, integrands: &mut [f64]);

    /// [`Ocp::boundary`].
    fn boundary(&mut self, ends: Ends<'_, f64>, rows: &mut [f64]) -> f64;

    /// [`Ocp::way_point`].
    fn way_point(&mut self, point: InteriorPoint<'_, f64>, rows: &mut [f64]);
}

/// Values, sparse Jacobian and sparse weighted Hessian of one [`Part`]; one is made for each thread
/// that evaluates.
pub trait Derivatives: Send {
    /// The nonzero pattern.
    fn sparsity(&self) -> &Sparsity;

    /// Values at `v`, into `out`.
    fn values(&mut self, v: &[f64], out: &mut [f64]);

    /// Nonzeros of the Jacobian at `v`, output by output, into `out`.
    fn jacobian(&mut self, v: &[f64], out: &mut [f64]);

    /// Nonzeros of Σ weightsᵢ ∇²fᵢ at `v`, in the order of [`Sparsity::hessian`], into `out`.
    fn hessian(&mut self, v: &[f64], weights: &[f64], out: &mut [f64]);
}

impl<O: Ocp> DynOcp for O {
    fn formulation(&self) -> Formulation {
        Ocp::formulation(self)
    }

    fn has_branches(&self) -> bool {
        Ocp::has_branches(self)
    }

    fn own_derivatives(&self) -> Option<Box<dyn PointDerivatives + '_>> {
        self.derivatives()
    }

    fn functions(&self) -> Box<dyn Functions + '_> {
        Box::new(WithScratch {
            scratch: self.scratch(),
            ocp: self,
        })
    }

    fn trace(&self, part: Part, formulation: &Formulation, used: &[bool], at: &[f64]) -> Sparsity {
        let ocp = self;
        match part {
            Part::Point => {
                let shape = PointShape::of(formulation);
                Sparsity::traced(&Of { ocp, shape }, used, at)
            }
            Part::Ends => {
                let shape = EndsShape::of(formulation);
                Sparsity::traced(&Of { ocp, shape }, used, at)
            }
            Part::WayPoint(index) => {
                let shape = WayPointShape::of(formulation, index);
                Sparsity::traced(&Of { ocp, shape }, used, at)
            }
        }
    }

    fn differentiate(
        &self,
        part: Part,
        formulation: &Formulation,
        sparsity: Sparsity,
    ) -> Box<dyn Derivatives + '_> {
        let ocp = self;
        match part {
            Part::Point => {
                let shape = PointShape::of(formulation);
                Differentiated::boxed(Of { ocp, shape }, sparsity)
            }
            Part::Ends => {
                let shape = EndsShape::of(formulation);
                Differentiated::boxed(Of { ocp, shape }, sparsity)
            }
            Part::WayPoint(index) => {
                let shape = WayPointShape::of(formulation, index);
                Differentiated::boxed(Of { ocp, shape }, sparsity)
            }
        }
    }
}

struct WithScratch<'a, O: Ocp> {
    ocp: &'a O,
    scratch: O::Scratch<f64>,
}

impl<O: Ocp> Functions for WithScratch<'_, O> {
    fn continuous(&mut self, point: Point<'_, f64>, rates: &mut [f64], path: &mut [f64]) -> f64 {
        self.ocp.continuous(point, &mut self.scratch, rates, path)
    }

    fn integrands(&mut self, point: Point<'_, f64>, integrands: &mut [f64]) {
        self.ocp.integrands(point, &mut self.scratch, integrands);
    }

    fn boundary(&mut self, ends: Ends<'_, f64>, rows: &mut [f64]) -> f64 {
        self.ocp.boundary(ends, &mut self.scratch, rows)
    }

    fn way_point(&mut self, point: InteriorPoint<'_, f64>, rows: &mut [f64]) {
        self.ocp.way_point(point, &mut self.scratch, rows);
    }
}

/// A function with its derivatives.
struct Differentiated<F: Function> {
    function: F,
    derivatives: SparseDerivatives<F>,
}

impl<F: Function + Send> Differentiated<F> {
    fn boxed<'a>(function: F, sparsity: Sparsity) -> Box<dyn Derivatives + 'a>
    where
        F: 'a,
    {
        Box::new(Self {
            derivatives: SparseDerivatives::new(&function, sparsity),
            function,
        })
    }
}

impl<F: Function + Send> Derivatives for Differentiated<F> {
    fn sparsity(&self) -> &Sparsity {
        self.derivatives.sparsity()
    }

    fn values(&mut self, v: &[f64], out: &mut [f64]) {
        self.derivatives.values(&self.function, v, out);
    }

    fn jacobian(&mut self, v: &[f64], out: &mut [f64]) {
        self.derivatives.jacobian(&self.function, v, out);
    }

    fn hessian(&mut self, v: &[f64], weights: &[f64], out: &mut [f64]) {
        self.derivatives.hessian(&self.function, v, weights, out);
    }
}
