//! The bridge from Ipopt to the multifrontal solver: it serves the calls that Ipopt makes to HSL_MA97.
//!
//! The handles that Ipopt keeps are boxes of `analyses`. There is no state outside them but what each
//! thread counts of its solve and keeps for the next one. No panic crosses C: it is caught, and Ipopt
//! is told that the factorisation failed.
//!
//! | file | does |
//! | --- | --- |
//! | `analyses` | an analysis with its factors, kept by each thread for the next solve |
//! | `session` | what a thread counts of its solve |
//! | `record` | the systems of a solve, for benchmarks and tests |
//!
//! Derived in docs/algorithms.md#ma97-interface.

#![expect(
    unsafe_code,
    reason = "functions that C calls with pointers, by the interface of HSL_MA97"
)]

mod analyses;
mod record;
mod session;

pub use record::{KktSystem, record};
pub(super) use session::{Session, with_trouble};

use crate::nlp::kkt::{Growth, Pattern};
use analyses::Analysis;
use ipopt_sys::ma97::{self, Control, Info, Reached, Routines};
use session::hsl;
use std::ffi::{c_double, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice::{from_raw_parts, from_raw_parts_mut};
use std::time::Instant;

/// Flag of a singular matrix.
const SINGULAR: c_int = 7;
/// Flag of any failure.
const FAILED: c_int = -1;

/// Registers these functions as HSL_MA97; returns how Ipopt reaches them.
///
/// # Errors
/// In words, why this Ipopt cannot reach them.
pub(super) fn register() -> Result<Reached, String> {
    ma97::register(&Routines {
        default_control,
        analyse,
        factor,
        factor_solve,
        solve,
        finalise,
        free_akeep,
    })
}

/// A call that cannot be served.
struct Failed;

/// Does one call's work: counts its time, catches panics, and writes `info`.
///
/// # Safety
/// `info` is valid for writing.
unsafe fn serve(info: *mut Info, body: impl FnOnce() -> Result<Info, Failed>) {
    let begin = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(body));
    let found = outcome.ok().and_then(Result::ok);
    session::served(begin.elapsed(), found.is_none());
    let found = found.unwrap_or_else(|| Info {
        flag: FAILED,
        ..empty()
    });
    // SAFETY: the caller's promise.
    unsafe { *info = found };
}

fn empty() -> Info {
    Info {
        flag: 0,
        flag68: 0,
        flag77: 0,
        matrix_dup: 0,
        matrix_rank: 0,
        matrix_outrange: 0,
        matrix_missing_diag: 0,
        maxdepth: 0,
        maxfront: 0,
        num_delay: 0,
        num_factor: 0,
        num_flops: 0,
        num_neg: 0,
        num_sup: 0,
        num_two: 0,
        ordering: 1,
        stat: 0,
        ispare: [0; 5],
        rspare: [0.0; 10],
    }
}

unsafe extern "C" fn default_control(control: *mut Control) {
    if let Some(hsl) = hsl() {
        // SAFETY: what the caller promises is what HSL_MA97 asks for.
        return unsafe { (hsl.default_control)(control) };
    }
    let defaults = Control {
        f_arrays: 0,
        action: 1,
        nemin: 8,
        multiplier: 1.1,
        ordering: 1,
        print_level: -1,
        scaling: 0,
        small: 1e-20,
        u: 0.01,
        unit_diagnostics: -1,
        unit_error: -1,
        unit_warning: -1,
        factor_min: 20_000_000,
        solve_blas3: 0,
        solve_min: 100_000,
        solve_mf: 0,
        consist_tol: f64::EPSILON,
        ispare: [0; 5],
        rspare: [0.0; 10],
    };
    // SAFETY: Ipopt passes a valid place for the settings.
    unsafe { *control = defaults };
}

unsafe extern "C" fn analyse(
    check: c_int,
    n: c_int,
    ptr: *const c_int,
    row: *const c_int,
    val: *mut c_double,
    akeep: *mut *mut c_void,
    control: *const Control,
    info: *mut Info,
    order: *mut c_int,
) {
    if let Some(hsl) = hsl() {
        // SAFETY: what the caller promises is what HSL_MA97 asks for.
        return unsafe { (hsl.analyse)(check, n, ptr, row, val, akeep, control, info, order) };
    }
    let body = || {
        // SAFETY: Ipopt passes n + 1 starts and as many rows as the last of them says, a valid
        // control, and a place for the handle.
        let (starts, rows, akeep, control) = unsafe {
            let starts = from_raw_parts(ptr, n as usize + 1);
            let base = c_int::from((*control).f_arrays != 0);
            let count = (starts[n as usize] - base) as usize;
            // Without entries there need be no array.
            let rows = if count == 0 {
                &[]
            } else {
                from_raw_parts(row, count)
            };
            (starts, rows, &mut *akeep, &*control)
        };
        let base = c_int::from(control.f_arrays != 0);
        let convert = |list: &[c_int]| list.iter().map(|&i| (i - base) as u32).collect();
        let pattern = Pattern::new(convert(starts), convert(rows)).map_err(|_| Failed)?;
        let analysis = Analysis::of(pattern);
        let mut info = empty();
        info.num_factor = analysis.symbolic.factor_size() as _;
        info.num_flops = 2 * analysis.symbolic.multiplications() as i64 as std::ffi::c_long;
        info.num_sup = analysis.symbolic.fronts() as c_int;
        *akeep = Box::into_raw(Box::new(analysis)).cast();
        Ok(info)
    };
    // SAFETY: Ipopt passes a valid place for what is found.
    unsafe { serve(info, body) };
}

/// The analysis behind a handle, with its memory.
///
/// # Safety
/// `akeep` points to a handle that `analyse` made and `finalise` has not freed, or to null; no
/// other reference to it is in use.
unsafe fn analysis<'a>(akeep: *mut *mut c_void) -> Result<&'a mut Analysis, Failed> {
    // SAFETY: the caller's promise.
    unsafe { (*akeep).cast::<Analysis>().as_mut() }.ok_or(Failed)
}

/// Factorises the matrix with these values.
fn factorise(analysis: &mut Analysis, values: &[f64], control: &Control) -> Result<Info, Failed> {
    let Analysis {
        symbolic,
        factors,
        growth,
    } = analysis;
    let inertia = growth
        .factor(factors, symbolic, values, control.u)
        .map_err(|_| Failed)?;
    with_trouble(|trouble| trouble.factorised(inertia.zero > 0, Growth::of(symbolic, &inertia)));
    let mut info = empty();
    info.num_neg = inertia.negative as c_int;
    info.num_two = inertia.two_by_two as c_int;
    info.num_delay = inertia.delayed as c_int;
    info.matrix_rank = (symbolic.len() - inertia.zero) as c_int;
    info.num_factor = symbolic.factor_size() as _;
    if inertia.zero > 0 {
        info.flag = SINGULAR;
    }
    record::factorised(|| KktSystem {
        symbolic: symbolic.clone(),
        values: values.to_vec(),
        threshold: control.u,
        inertia,
        right_hand_sides: Vec::new(),
    });
    Ok(info)
}

unsafe extern "C" fn factor(
    matrix_type: c_int,
    ptr: *const c_int,
    row: *const c_int,
    val: *const c_double,
    akeep: *mut *mut c_void,
    fkeep: *mut *mut c_void,
    control: *const Control,
    info: *mut Info,
    scale: *const c_double,
) {
    if let Some(hsl) = hsl() {
        // SAFETY: what the caller promises is what HSL_MA97 asks for.
        return unsafe {
            (hsl.factor)(
                matrix_type,
                ptr,
                row,
                val,
                akeep,
                fkeep,
                control,
                info,
                scale,
            )
        };
    }
    let body = || {
        // SAFETY: Ipopt passes the handle of its analysis, one value an entry of the pattern
        // analysed, and a valid control.
        let (analysis, control) = unsafe { (analysis(akeep)?, &*control) };
        let count = analysis.symbolic.pattern().nonzeros();
        // SAFETY: as above; without entries there need be no array.
        let values = if count == 0 {
            &[]
        } else {
            unsafe { from_raw_parts(val, count) }
        };
        factorise(analysis, values, control)
    };
    // SAFETY: Ipopt passes a valid place for what is found.
    unsafe { serve(info, body) };
}

unsafe extern "C" fn factor_solve(
    matrix_type: c_int,
    ptr: *const c_int,
    row: *const c_int,
    val: *const c_double,
    nrhs: c_int,
    x: *mut c_double,
    ldx: c_int,
    akeep: *mut *mut c_void,
    fkeep: *mut *mut c_void,
    control: *const Control,
    info: *mut Info,
    scale: *const c_double,
) {
    if let Some(hsl) = hsl() {
        // SAFETY: what the caller promises is what HSL_MA97 asks for.
        return unsafe {
            (hsl.factor_solve)(
                matrix_type,
                ptr,
                row,
                val,
                nrhs,
                x,
                ldx,
                akeep,
                fkeep,
                control,
                info,
                scale,
            )
        };
    }
    // SAFETY: the arguments are the caller's, each passed on as what it is.
    unsafe {
        factor(
            matrix_type,
            ptr,
            row,
            val,
            akeep,
            fkeep,
            control,
            info,
            scale,
        );
        if (*info).flag == 0 {
            let found = *info;
            solve(0, nrhs, x, ldx, akeep, fkeep, control, info);
            if (*info).flag == 0 {
                *info = found;
            }
        }
    }
}

unsafe extern "C" fn solve(
    job: c_int,
    nrhs: c_int,
    x: *mut c_double,
    ldx: c_int,
    akeep: *mut *mut c_void,
    fkeep: *mut *mut c_void,
    control: *const Control,
    info: *mut Info,
) {
    if let Some(hsl) = hsl() {
        // SAFETY: what the caller promises is what HSL_MA97 asks for.
        return unsafe { (hsl.solve)(job, nrhs, x, ldx, akeep, fkeep, control, info) };
    }
    let body = || {
        // SAFETY: Ipopt passes the handle of its analysis.
        let Analysis {
            symbolic, factors, ..
        } = unsafe { analysis(akeep)? };
        for right in 0..nrhs as usize {
            // SAFETY: Ipopt passes `nrhs` right-hand sides, `ldx` apart, as long as the matrix.
            let x = unsafe { from_raw_parts_mut(x.add(right * ldx as usize), symbolic.len()) };
            record::asked(x);
            factors.solve(symbolic, x);
        }
        Ok(empty())
    };
    // SAFETY: Ipopt passes a valid place for what is found.
    unsafe { serve(info, body) };
}

unsafe extern "C" fn finalise(akeep: *mut *mut c_void, fkeep: *mut *mut c_void) {
    if let Some(hsl) = hsl() {
        // SAFETY: what the caller promises is what HSL_MA97 asks for.
        return unsafe { (hsl.finalise)(akeep, fkeep) };
    }
    // SAFETY: Ipopt passes the place of the handle.
    unsafe { free_akeep(akeep) };
}

unsafe extern "C" fn free_akeep(akeep: *mut *mut c_void) {
    if let Some(hsl) = hsl() {
        // SAFETY: what the caller promises is what HSL_MA97 asks for.
        return unsafe { (hsl.free_akeep)(akeep) };
    }
    // SAFETY: a handle that is not null came from `Box::into_raw`, and is freed once:
    // null takes its place.
    let handle = unsafe { std::mem::replace(&mut *akeep, std::ptr::null_mut()) };
    if !handle.is_null() {
        // SAFETY: as above.
        unsafe { Box::from_raw(handle.cast::<Analysis>()) }.keep();
    }
}
