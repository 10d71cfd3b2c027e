//! Bindings to the C interface of the system Ipopt.
//!
//! bindgen makes them at build time from the headers that pkg-config finds, so that one source
//! serves Ipopt 3.11 to 3.14. [`Bool`], [`Index`] and [`Number`] exist in all of them, though a
//! `Bool` is a C `int` in 3.11 and a C `bool` in 3.14: [`from_bool`] and [`is_true`] convert.

#![expect(
    unsafe_code,
    reason = "bindings to C, and functions of libraries looked up at run time"
)]
#![warn(missing_debug_implementations)]

pub mod hsl;
pub mod ma97;
pub mod usage;

#[allow(
    missing_docs,
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    clippy::all
)]
mod bindings {
    include!(concat!(env!("OUT_DIR"), "/bindings.rs"));
}

pub use bindings::*;

/// Version of the Ipopt these bindings were made from, such as `3.11.9`.
pub const VERSION: &str = env!("IPOPT_SYS_VERSION");

// Builds of Ipopt with 64-bit indices or single precision need other linear algebra all through.
const _: () = assert!(
    size_of::<Index>() == 4,
    "this Ipopt was built with 64-bit indices"
);
const _: () = assert!(
    size_of::<Number>() == 8,
    "this Ipopt was built in single precision"
);

/// A truth value as Ipopt's C interface has it.
#[allow(clippy::useless_conversion)]
pub fn from_bool(value: bool) -> Bool {
    Bool::from(value)
}

/// Whether a truth value from Ipopt's C interface is true.
pub fn is_true(value: Bool) -> bool {
    value != Bool::default()
}
