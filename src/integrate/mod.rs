//! Integrators of ordinary differential equations. They know nothing of robots or plans.
//!
//! | file | method | used where |
//! | --- | --- | --- |
//! | `rk4` | classical Runge-Kutta, fixed step | the right-hand side is smooth and the step known |
//! | `dormand_prince` | Dormand-Prince 5(4), adaptive step | an error tolerance has to be met |
//!
//! Both own their workspace: no step allocates.

mod dormand_prince;
mod rk4;

pub use dormand_prince::{DormandPrince, IntegrationError, Ode};
pub use rk4::Rk4;
