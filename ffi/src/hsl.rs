//! Whether Ipopt can reach a routine of the HSL.
//!
//! Ipopt looks for these routines when it first needs them, and for MC19, as for HSL_MA97 in
//! [`crate::ma97`], it does not survive finding none: 3.11 ends the process, 3.14 reads a null
//! pointer. So ask first.

use std::ffi::CStr;
use std::sync::{Mutex, PoisonError};

/// A routine whose absence Ipopt does not survive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Routine {
    /// The scaling MC19.
    Mc19,
    /// The linear solver MA27.
    Ma27,
    /// The linear solver MA57.
    Ma57,
    /// The linear solver HSL_MA77.
    Ma77,
    /// The linear solver HSL_MA86.
    Ma86,
}

/// Whether the HSL library is there and yet lacks `routine`: Ipopt loads it then and ends the process
/// at the first call. Where there is no library at all, Ipopt says so itself, or has the routine built
/// in.
pub fn incomplete(routine: Routine, library: Option<&CStr>) -> bool {
    let name = match library.map(CStr::to_str) {
        Some(Ok(name)) => name.into(),
        Some(Err(_)) => return false,
        None => libloading::library_filename("hsl"),
    };
    // SAFETY: Ipopt itself would load this library and run its initialisers.
    let there = unsafe { libloading::Library::new(name) }.is_ok();
    there && !available(routine, library)
}

/// Whether Ipopt can reach `routine`: registered in this process, or in the HSL library.
///
/// `library` is the value of Ipopt's option `hsllib`, where it is set. A library that is found
/// stays loaded, so that Ipopt then finds the same one.
pub fn available(routine: Routine, library: Option<&CStr>) -> bool {
    // The loader of 3.11 does not expect two threads.
    static LOADER: Mutex<()> = Mutex::new(());
    let _alone = LOADER.lock().unwrap_or_else(PoisonError::into_inner);
    imp::available(routine, library)
}

#[cfg(ipopt_hsl_loader)]
mod imp {
    use super::Routine;
    use crate::bindings;
    use std::ffi::CStr;
    use std::ptr::null;

    pub(super) fn available(routine: Routine, library: Option<&CStr>) -> bool {
        let registered = || {
            // SAFETY: reads a pointer inside the loader and has no preconditions.
            0 != unsafe {
                match routine {
                    Routine::Mc19 => bindings::LSL_isMC19available(),
                    Routine::Ma27 => bindings::LSL_isMA27available(),
                    Routine::Ma57 => bindings::LSL_isMA57available(),
                    Routine::Ma77 => bindings::LSL_isMA77available(),
                    Routine::Ma86 => bindings::LSL_isMA86available(),
                }
            }
        };
        if registered() {
            return true;
        }
        // SAFETY: reads a handle inside the loader and has no preconditions.
        if 0 != unsafe { bindings::LSL_isHSLLoaded() } {
            return false;
        }
        let mut message = [0; 256];
        // SAFETY: a null name stands for the loader's default; the message has the length given.
        let failure = unsafe {
            bindings::LSL_loadHSL(
                library.map_or(null(), CStr::as_ptr),
                message.as_mut_ptr(),
                message.len() as _,
            )
        };
        failure == 0 && registered()
    }
}

#[cfg(not(ipopt_hsl_loader))]
mod imp {
    use super::Routine;
    use libloading::{Library, Symbol, library_filename};
    use std::ffi::{CStr, OsString};

    pub(super) fn available(routine: Routine, library: Option<&CStr>) -> bool {
        let name = library
            .and_then(|name| name.to_str().ok())
            .map(OsString::from);
        // SAFETY: Ipopt itself is about to load this library and run its initialisers.
        let Ok(library) =
            (unsafe { Library::new(name.unwrap_or_else(|| library_filename("hsl"))) })
        else {
            return false;
        };
        let names: &[&str] = match routine {
            Routine::Mc19 => &["mc19ad"],
            Routine::Ma27 => &["ma27ad", "ma27bd", "ma27cd", "ma27id"],
            Routine::Ma57 => &["ma57ad", "ma57bd", "ma57cd", "ma57ed", "ma57id"],
            Routine::Ma77 => &[
                "ma77_default_control_d",
                "ma77_open_d",
                "ma77_analyse_d",
                "ma77_factor_d",
                "ma77_factor_solve_d",
                "ma77_finalise_d",
                "mc68_default_control_i",
                "mc68_order_i",
            ],
            Routine::Ma86 => &[
                "ma86_default_control_d",
                "ma86_analyse_d",
                "ma86_factor_d",
                "ma86_factor_solve_d",
                "ma86_finalise_d",
                "mc68_default_control_i",
                "mc68_order_i",
            ],
        };
        let is_there = |name: String| {
            // SAFETY: the symbol is only looked for, never called.
            let symbol: Result<Symbol<'_, unsafe extern "C" fn()>, _> =
                unsafe { library.get(name.as_bytes()) };
            symbol.is_ok()
        };
        // Fortran compilers add an underscore.
        let found = names
            .iter()
            .all(|name| is_there(format!("{name}_")) || is_there((*name).to_owned()));
        if found {
            std::mem::forget(library);
        }
        found
    }
}
