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
            Routine::Mc19 => &["mc19ad_", "mc19ad"],
        };
        let found = names.iter().any(|name| {
            // SAFETY: the symbol is only looked for, never called.
            let symbol: Result<Symbol<'_, unsafe extern "C" fn()>, _> =
                unsafe { library.get(name.as_bytes()) };
            symbol.is_ok()
        });
        if found {
            std::mem::forget(library);
        }
        found
    }
}
