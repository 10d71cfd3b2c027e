//! The bridge from Ipopt to the multifrontal solver: it serves the calls that Ipopt makes to HSL_MA97.
//!
//! The handles that Ipopt keeps are boxes of this file. There is no state outside them but what each
//! thread counts of its solve. No panic crosses C: it is caught, and Ipopt is told that the
//! factorisation failed.
//!
//! Derived in docs/algorithms.md#ma97-interface.

#![expect(
    unsafe_code,
    reason = "functions that C calls with pointers, by the interface of HSL_MA97"
)]

use super::trouble::Trouble;
use crate::nlp::kkt::{Factors, Growth, Inertia, Pattern, Symbolic};
use ipopt_sys::ma97::{self, Control, Info, Reached, Routines};
use std::cell::RefCell;
use std::ffi::{c_double, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice::{from_raw_parts, from_raw_parts_mut};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Flag of a singular matrix.
const SINGULAR: c_int = 7;
/// Flag of any failure.
const FAILED: c_int = -1;

/// Analyses that a thread keeps for the next programme with the same structure.
const KEPT: usize = 4;
/// An analysis whose factors have more numbers than this is not kept.
const LARGEST_KEPT: usize = 1 << 20;

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

/// What the calls of one solve come to.
#[derive(Debug, Default)]
pub(super) struct Count {
    /// Time in analyses, factorisations and solutions.
    pub time: Duration,
    /// Whether a call has failed.
    pub failed: bool,
    /// Systems that were singular, and factors that grew.
    pub trouble: Trouble,
    /// The routines of the real HSL_MA97, where all calls go to them.
    hsl: Option<Routines>,
}

/// A KKT system: one factorisation that Ipopt asked for, with the right-hand sides.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct KktSystem {
    /// The analysis in use.
    pub symbolic: Arc<Symbolic>,
    /// Values of the pattern's entries.
    pub values: Vec<f64>,
    /// Pivot threshold.
    pub threshold: f64,
    /// The inertia found.
    pub inertia: Inertia,
    /// Right-hand sides, in the order of the solutions.
    pub right_hand_sides: Vec<Vec<f64>>,
}

thread_local! {
    static COUNT: RefCell<Count> = RefCell::default();
    static ANALYSES: RefCell<Vec<Analysis>> = const { RefCell::new(Vec::new()) };
    static RECORD: RefCell<Option<Vec<KktSystem>>> = const { RefCell::new(None) };
}

/// Runs `body` and returns the systems that the multifrontal solver was given in it, on this thread.
///
/// For benchmarks and tests: it costs a copy of every matrix.
pub fn record<T>(body: impl FnOnce() -> T) -> (T, Vec<KktSystem>) {
    RECORD.set(Some(Vec::new()));
    let result = body();
    (result, RECORD.take().unwrap_or_default())
}

/// One solve on this thread: its calls are counted from `begin` to `end`.
pub(super) struct Session {
    /// The count of the solve that this one is nested in.
    outer: Option<Count>,
}

impl Session {
    pub(super) fn begin(hsl: Option<Routines>) -> Self {
        let count = Count {
            hsl,
            ..Count::default()
        };
        Self {
            outer: Some(COUNT.replace(count)),
        }
    }

    pub(super) fn end(mut self) -> Count {
        COUNT.replace(self.outer.take().unwrap_or_default())
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        if let Some(outer) = self.outer.take() {
            COUNT.set(outer);
        }
    }
}

/// The trouble that this thread's solve has met so far, to be noted at the end of each iteration.
pub(super) fn with_trouble<T>(body: impl FnOnce(&mut Trouble) -> T) -> T {
    COUNT.with_borrow_mut(|count| body(&mut count.trouble))
}

/// An analysis, and the factors of the last matrix with its pattern.
struct Analysis {
    symbolic: Arc<Symbolic>,
    factors: Factors,
    growth: Growth,
}

impl Analysis {
    /// The analysis of `pattern`: one that this thread has kept, or a new one.
    fn of(pattern: Pattern) -> Self {
        let kept = ANALYSES.with_borrow_mut(|kept| {
            let known = kept
                .iter()
                .position(|analysis| *analysis.symbolic.pattern() == pattern);
            known.map(|index| kept.remove(index))
        });
        kept.unwrap_or_else(|| {
            let symbolic = Symbolic::new(pattern);
            Self {
                factors: Factors::new(&symbolic),
                symbolic: Arc::new(symbolic),
                growth: Growth::default(),
            }
        })
    }

    /// Keeps this analysis for the next solve with its pattern, unless it is large.
    fn keep(mut self) {
        // What was found in this solve is not to change the next one.
        self.growth = Growth::default();
        if self.symbolic.factor_size() > LARGEST_KEPT {
            return;
        }
        // This fails while the thread ends, and then nothing is kept.
        let _ = ANALYSES.try_with(|kept| {
            let mut kept = kept.borrow_mut();
            if kept.len() == KEPT {
                kept.remove(0);
            }
            kept.push(self);
        });
    }
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
    COUNT.with_borrow_mut(|count| {
        count.time += begin.elapsed();
        count.failed |= found.is_none();
    });
    let found = found.unwrap_or_else(|| Info {
        flag: FAILED,
        ..empty()
    });
    // SAFETY: the caller's promise.
    unsafe { *info = found };
}

/// The routines of the real HSL_MA97, where this solve is to use them.
fn hsl() -> Option<Routines> {
    COUNT.with_borrow(|count| count.hsl)
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
    RECORD.with_borrow_mut(|record| {
        if let Some(record) = record {
            record.push(KktSystem {
                symbolic: symbolic.clone(),
                values: values.to_vec(),
                threshold: control.u,
                inertia,
                right_hand_sides: Vec::new(),
            });
        }
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
            RECORD.with_borrow_mut(|record| {
                if let Some(system) = record.as_mut().and_then(|all| all.last_mut()) {
                    system.right_hand_sides.push(x.to_vec());
                }
            });
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
