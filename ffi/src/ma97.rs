//! The C interface of HSL_MA97, by which Ipopt takes a linear solver that is not its own.
//!
//! Ipopt knows this interface and looks its functions up when a solve begins. Up to 3.13 they can
//! be registered in the process; from 3.14 on Ipopt opens a shared library. There one is kept in
//! memory that hands every call back to what is registered: see `bridge.c`.

use std::ffi::{CStr, CString, c_double, c_int, c_long, c_void};
use std::sync::OnceLock;

/// `ma97_control`.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Control {
    /// Whether indices count from 1.
    pub f_arrays: c_int,
    /// Whether a singular matrix is only warned of.
    pub action: c_int,
    /// Least number of pivots of a node.
    pub nemin: c_int,
    /// Room for delayed pivots.
    pub multiplier: c_double,
    /// Which ordering to use.
    pub ordering: c_int,
    /// Level of printing.
    pub print_level: c_int,
    /// Which scaling to use.
    pub scaling: c_int,
    /// What counts as zero.
    pub small: c_double,
    /// Least part of its column's largest entry that a pivot may be.
    pub u: c_double,
    /// Fortran unit.
    pub unit_diagnostics: c_int,
    /// Fortran unit.
    pub unit_error: c_int,
    /// Fortran unit.
    pub unit_warning: c_int,
    /// Size from which a factorisation runs in parallel.
    pub factor_min: c_long,
    /// Whether several right-hand sides go through BLAS 3.
    pub solve_blas3: c_int,
    /// Size from which a solution runs in parallel.
    pub solve_min: c_long,
    /// Whether a solution is multifrontal.
    pub solve_mf: c_int,
    /// What counts as consistent.
    pub consist_tol: c_double,
    /// Not in use.
    pub ispare: [c_int; 5],
    /// Not in use.
    pub rspare: [c_double; 10],
}

/// `ma97_info`.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Info {
    /// 0, a warning above or an error below it.
    pub flag: c_int,
    /// Flag of the ordering.
    pub flag68: c_int,
    /// Flag of the scaling.
    pub flag77: c_int,
    /// Entries that stand twice.
    pub matrix_dup: c_int,
    /// Rank.
    pub matrix_rank: c_int,
    /// Entries out of range.
    pub matrix_outrange: c_int,
    /// Diagonal entries missing.
    pub matrix_missing_diag: c_int,
    /// Depth of the tree.
    pub maxdepth: c_int,
    /// Order of the largest front.
    pub maxfront: c_int,
    /// Delayed pivots.
    pub num_delay: c_int,
    /// Entries of the factors.
    pub num_factor: c_long,
    /// Operations.
    pub num_flops: c_long,
    /// Negative eigenvalues.
    pub num_neg: c_int,
    /// Supernodes.
    pub num_sup: c_int,
    /// Pivots of order two.
    pub num_two: c_int,
    /// Ordering used.
    pub ordering: c_int,
    /// Status of an allocation.
    pub stat: c_int,
    /// Not in use.
    pub ispare: [c_int; 5],
    /// Not in use.
    pub rspare: [c_double; 10],
}

/// `ma97_default_control_d`.
pub type DefaultControl = unsafe extern "C" fn(*mut Control);
/// `ma97_analyse_d`: check, n, ptr, row, val, akeep, control, info, order.
pub type Analyse = unsafe extern "C" fn(
    c_int,
    c_int,
    *const c_int,
    *const c_int,
    *mut c_double,
    *mut *mut c_void,
    *const Control,
    *mut Info,
    *mut c_int,
);
/// `ma97_factor_d`: matrix type, ptr, row, val, akeep, fkeep, control, info, scale.
pub type Factor = unsafe extern "C" fn(
    c_int,
    *const c_int,
    *const c_int,
    *const c_double,
    *mut *mut c_void,
    *mut *mut c_void,
    *const Control,
    *mut Info,
    *const c_double,
);
/// `ma97_factor_solve_d`: matrix type, ptr, row, val, nrhs, x, ldx, akeep, fkeep, control, info,
/// scale.
pub type FactorSolve = unsafe extern "C" fn(
    c_int,
    *const c_int,
    *const c_int,
    *const c_double,
    c_int,
    *mut c_double,
    c_int,
    *mut *mut c_void,
    *mut *mut c_void,
    *const Control,
    *mut Info,
    *const c_double,
);
/// `ma97_solve_d`: job, nrhs, x, ldx, akeep, fkeep, control, info.
pub type Solve = unsafe extern "C" fn(
    c_int,
    c_int,
    *mut c_double,
    c_int,
    *mut *mut c_void,
    *mut *mut c_void,
    *const Control,
    *mut Info,
);
/// `ma97_finalise_d`: akeep, fkeep.
pub type Finalise = unsafe extern "C" fn(*mut *mut c_void, *mut *mut c_void);
/// `ma97_free_akeep_d`.
pub type FreeAkeep = unsafe extern "C" fn(*mut *mut c_void);

/// A linear solver behind the interface of HSL_MA97.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Routines {
    /// Fills the settings.
    pub default_control: DefaultControl,
    /// Analyses a pattern.
    pub analyse: Analyse,
    /// Factorises a matrix.
    pub factor: Factor,
    /// Factorises a matrix and solves.
    pub factor_solve: FactorSolve,
    /// Solves.
    pub solve: Solve,
    /// Frees both handles.
    pub finalise: Finalise,
    /// Frees the analysis.
    pub free_akeep: FreeAkeep,
}

/// How Ipopt reaches what was registered.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Reached {
    /// By itself: `linear_solver = ma97` is enough.
    InProcess,
    /// By this value of its option `hsllib`.
    Library(CString),
}

/// Makes `routines` what Ipopt finds as HSL_MA97, for the rest of the process.
///
/// Only the first call's routines count.
///
/// # Errors
/// In words, where Ipopt cannot be made to find them.
pub fn register(routines: &Routines) -> Result<Reached, String> {
    static DONE: OnceLock<Result<Reached, String>> = OnceLock::new();
    DONE.get_or_init(|| imp::register(routines)).clone()
}

/// The value of Ipopt's option `hsllib` or the loader's default, as a library that is a real
/// HSL; `None` where there is none with HSL_MA97.
///
/// It stays loaded.
pub fn installed(library: Option<&CStr>) -> Option<Routines> {
    use libloading::{Library, Symbol, library_filename};
    let name = match library {
        Some(name) => name.to_str().ok()?.into(),
        None => library_filename("hsl"),
    };
    // SAFETY: Ipopt itself would load this library and run its initialisers.
    let library = unsafe { Library::new(name) }.ok()?;
    // SAFETY: the functions have these signatures in every release of HSL_MA97's C interface.
    let routines = unsafe {
        let find =
            |name: &[u8]| -> Option<Symbol<'_, unsafe extern "C" fn()>> { library.get(name).ok() };
        Routines {
            default_control: std::mem::transmute::<unsafe extern "C" fn(), DefaultControl>(*find(
                b"ma97_default_control_d",
            )?),
            analyse: std::mem::transmute::<unsafe extern "C" fn(), Analyse>(*find(
                b"ma97_analyse_d",
            )?),
            factor: std::mem::transmute::<unsafe extern "C" fn(), Factor>(*find(b"ma97_factor_d")?),
            factor_solve: std::mem::transmute::<unsafe extern "C" fn(), FactorSolve>(*find(
                b"ma97_factor_solve_d",
            )?),
            solve: std::mem::transmute::<unsafe extern "C" fn(), Solve>(*find(b"ma97_solve_d")?),
            finalise: std::mem::transmute::<unsafe extern "C" fn(), Finalise>(*find(
                b"ma97_finalise_d",
            )?),
            free_akeep: std::mem::transmute::<unsafe extern "C" fn(), FreeAkeep>(*find(
                b"ma97_free_akeep_d",
            )?),
        }
    };
    std::mem::forget(library);
    Some(routines)
}

#[cfg(ipopt_hsl_loader)]
mod imp {
    use super::{Reached, Routines};
    use crate::bindings;
    use std::mem::transmute;

    pub(super) fn register(routines: &Routines) -> Result<Reached, String> {
        // SAFETY: the header's functions have the signatures of `Routines`, its opaque structs
        // being `Control` and `Info`; the loader only keeps the pointers.
        unsafe {
            bindings::LSL_setMA97(
                transmute::<super::DefaultControl, bindings::ma97_default_control_t>(
                    routines.default_control,
                ),
                transmute::<super::Analyse, bindings::ma97_analyse_t>(routines.analyse),
                transmute::<super::Factor, bindings::ma97_factor_t>(routines.factor),
                transmute::<super::FactorSolve, bindings::ma97_factor_solve_t>(
                    routines.factor_solve,
                ),
                transmute::<super::Solve, bindings::ma97_solve_t>(routines.solve),
                transmute::<super::Finalise, bindings::ma97_finalise_t>(routines.finalise),
                transmute::<super::FreeAkeep, bindings::ma97_free_akeep_t>(routines.free_akeep),
            );
        }
        Ok(Reached::InProcess)
    }
}

#[cfg(ipopt_bridge)]
mod imp {
    use super::{Reached, Routines};
    use libloading::{Library, Symbol};
    use std::ffi::CString;
    use std::fs::File;
    use std::io::Write;
    use std::os::fd::{AsRawFd, FromRawFd};

    /// The shared library made of `bridge.c`.
    static BRIDGE: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/bridge.so"));

    pub(super) fn register(routines: &Routines) -> Result<Reached, String> {
        let failed = |what: &str, error: &dyn std::fmt::Display| format!("{what}: {error}");
        // SAFETY: a valid name; the result is checked.
        let descriptor = unsafe { libc::memfd_create(c"ma97".as_ptr(), libc::MFD_CLOEXEC) };
        if descriptor < 0 {
            let error = std::io::Error::last_os_error();
            return Err(failed("no memory file can be made", &error));
        }
        // SAFETY: the descriptor is fresh and nobody else's.
        let mut file = unsafe { File::from_raw_fd(descriptor) };
        file.write_all(BRIDGE)
            .map_err(|error| failed("the memory file cannot be written", &error))?;
        let path = format!("/proc/self/fd/{}", file.as_raw_fd());
        // SAFETY: the library has no initialisers.
        let library = unsafe { Library::new(&path) }
            .map_err(|error| failed("the library kept in memory cannot be loaded", &error))?;
        // SAFETY: the signature is that of `bridge.c`, which copies what the pointer points to.
        unsafe {
            let register: Symbol<'_, unsafe extern "C" fn(*const Routines)> = library
                .get(b"ipopt_sys_register_ma97")
                .map_err(|error| failed("the library kept in memory is not whole", &error))?;
            register(routines);
        }
        // Ipopt opens the same path, and the loader knows the same file again.
        std::mem::forget(library);
        std::mem::forget(file);
        Ok(Reached::Library(
            CString::new(path).expect("no NUL in a path"),
        ))
    }
}

#[cfg(not(any(ipopt_hsl_loader, ipopt_bridge)))]
mod imp {
    use super::{Reached, Routines};

    pub(super) fn register(_: &Routines) -> Result<Reached, String> {
        Err("this Ipopt takes linear solvers from libraries only, which needs Linux".into())
    }
}
