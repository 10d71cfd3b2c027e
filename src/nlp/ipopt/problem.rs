//! One Ipopt problem: created, given options, solved, and freed with the handle.

#![expect(unsafe_code, reason = "calls of Ipopt's C interface")]

use super::IpoptError;
use super::callbacks::{self, Context};
use super::input::Bounds;
use super::structure::count;
use crate::nlp::{Iterate, Size};
use ipopt_sys as ip;
use std::ffi::CStr;
use std::ptr::{NonNull, null_mut};

/// Owns an Ipopt problem whose callbacks expect a [`Context`].
pub(super) struct Problem {
    handle: NonNull<ip::IpoptProblemInfo>,
    size: Size,
}

impl Problem {
    pub(super) fn create(size: Size, bounds: &mut Bounds) -> Result<Self, IpoptError> {
        let variables = count(size.variables, "variables")?;
        let constraints = count(size.constraints, "constraints")?;
        let jacobian = count(size.jacobian_nonzeros, "nonzeros of the Jacobian")?;
        let hessian = count(size.hessian_nonzeros, "nonzeros of the Hessian")?;
        let [variables_lower, variables_upper] = &mut bounds.variables;
        let [constraints_lower, constraints_upper] = &mut bounds.constraints;
        // SAFETY: the bounds have the lengths given with them and are copied; the callbacks have
        // the signatures of the bindings.
        let handle = unsafe {
            ip::CreateIpoptProblem(
                variables,
                variables_lower.as_mut_ptr(),
                variables_upper.as_mut_ptr(),
                constraints,
                constraints_lower.as_mut_ptr(),
                constraints_upper.as_mut_ptr(),
                jacobian,
                hessian,
                0,
                Some(callbacks::objective),
                Some(callbacks::constraints),
                Some(callbacks::gradient),
                Some(callbacks::jacobian),
                Some(callbacks::hessian),
            )
        };
        let handle = NonNull::new(handle).ok_or(IpoptError::Creation {
            variables: size.variables,
            constraints: size.constraints,
            jacobian_nonzeros: size.jacobian_nonzeros,
        })?;
        // SAFETY: the handle is fresh and valid, the callback has the right signature.
        unsafe { ip::SetIntermediateCallback(handle.as_ptr(), Some(callbacks::intermediate)) };
        Ok(Self { handle, size })
    }

    /// Sets a text option; whether Ipopt took it.
    pub(super) fn text(&mut self, name: &CStr, value: &CStr) -> bool {
        // Ipopt only reads the strings, though 3.11 does not say const.
        let (name, value) = (name.as_ptr().cast_mut(), value.as_ptr().cast_mut());
        // SAFETY: the handle is valid, the strings end in NUL and are copied.
        ip::is_true(unsafe { ip::AddIpoptStrOption(self.handle.as_ptr(), name, value) })
    }

    /// Sets a whole-number option; whether Ipopt took it.
    pub(super) fn integer(&mut self, name: &CStr, value: ip::Index) -> bool {
        let name = name.as_ptr().cast_mut();
        // SAFETY: as in `text`.
        ip::is_true(unsafe { ip::AddIpoptIntOption(self.handle.as_ptr(), name, value) })
    }

    /// Sets a real option; whether Ipopt took it.
    pub(super) fn real(&mut self, name: &CStr, value: f64) -> bool {
        let name = name.as_ptr().cast_mut();
        // SAFETY: as in `text`.
        ip::is_true(unsafe { ip::AddIpoptNumOption(self.handle.as_ptr(), name, value) })
    }

    /// Makes Ipopt write what `level` asks for to a file; whether it could be opened.
    pub(super) fn output_file(&mut self, path: &CStr, level: ip::Int) -> bool {
        let path = path.as_ptr().cast_mut();
        // SAFETY: as in `text`.
        ip::is_true(unsafe { ip::OpenIpoptOutputFile(self.handle.as_ptr(), path, level) })
    }

    /// Makes the options set so far take effect, without solving.
    ///
    /// Ipopt reads `print_level` only when a solve begins, and complains about refused options
    /// on standard output before that. Without a start it reads its options and returns.
    pub(super) fn initialise(&mut self) {
        // SAFETY: the handle is valid; with a null start Ipopt returns before it uses any other
        // argument.
        unsafe {
            ip::IpoptSolve(
                self.handle.as_ptr(),
                null_mut(),
                null_mut(),
                null_mut(),
                null_mut(),
                null_mut(),
                null_mut(),
                null_mut(),
            )
        };
    }

    /// Solves from `iterate`, which takes the result; returns Ipopt's status.
    pub(super) fn solve(
        &mut self,
        iterate: &mut Iterate,
        constraints: &mut [f64],
        objective: &mut f64,
        context: &mut Context<'_>,
    ) -> ip::ApplicationReturnStatus {
        assert!(
            iterate.x.len() == self.size.variables
                && iterate.has_multipliers(self.size.constraints)
                && constraints.len() == self.size.constraints
        );
        // SAFETY: the handle is valid, the vectors have the lengths the problem was created
        // with, and `context` is of the type the callbacks expect and outlives the call.
        unsafe {
            ip::IpoptSolve(
                self.handle.as_ptr(),
                iterate.x.as_mut_ptr(),
                constraints.as_mut_ptr(),
                objective,
                iterate.multipliers.as_mut_ptr(),
                iterate.lower_multipliers.as_mut_ptr(),
                iterate.upper_multipliers.as_mut_ptr(),
                (&raw mut *context).cast(),
            )
        }
    }
}

impl Drop for Problem {
    fn drop(&mut self) {
        // SAFETY: the handle is valid and not used again.
        unsafe { ip::FreeIpoptProblem(self.handle.as_ptr()) };
    }
}
