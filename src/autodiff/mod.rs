//! Forward automatic differentiation by dual numbers, written by hand.
//!
//! Model code is written once, generic over [`Scalar`], and evaluated with `f64` for values, with
//! [`Dual`] for first derivatives in several directions at a time, and with [`HyperDual`] for
//! blocks of second derivatives. Derivatives are exact to rounding: no step size is involved.
//! [`SparseDerivatives`] sweeps a [`Function`] so that only its nonzeros are computed; which those
//! are, [`Sparsity`] finds by one evaluation with [`Trace`].
//!
//! Derived in docs/algorithms.md#dual-numbers and docs/algorithms.md#sparsity.

mod dependence;
mod dual;
mod function;
mod hyper_dual;
mod mixed;
mod scalar;
mod simd;
mod sparse;
mod sparsity;
mod tape;
mod times;
mod trace;

pub use dual::Dual;
pub use function::Function;
pub use hyper_dual::HyperDual;
pub use mixed::Real;
pub use scalar::Scalar;
pub use simd::{Kernel, dispatch, has_fused};
pub use sparse::SparseDerivatives;
pub use sparsity::Sparsity;
pub use times::Times;
pub use trace::Trace;
