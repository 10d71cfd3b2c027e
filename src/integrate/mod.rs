//! Integrators of ordinary differential equations. They know nothing of robots or plans.
//!
//! | file | method | used where |
//! | --- | --- | --- |
//! | `rk4` | classical Runge-Kutta, fixed step | the right-hand side is smooth and the step known |
//! | `dormand_prince` | Dormand-Prince 5(4), adaptive step | an error tolerance has to be met, and the rates jump often |
//! | `dop853` | of eighth order, adaptive step, values within steps | the same where the rates are smooth |
//! | `ode` | what is integrated, and errors | |
//! | `steps` | the lengths of steps of the adaptive methods | |
//!
//! All own their workspace: no step allocates.

mod dop853;
mod dormand_prince;
mod ode;
mod rk4;
mod steps;

pub use dop853::{Dop853, Reached};
pub use dormand_prince::DormandPrince;
pub use ode::{IntegrationError, Ode};
pub use rk4::Rk4;
