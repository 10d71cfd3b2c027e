//! Our linear solver as Ipopt calls it: through the interface of HSL_MA97.
//!
//! The handles Ipopt keeps are our own boxes, so that there is no state outside them but what
//! this thread counts. Nothing here unwinds into C: a panic is kept, and Ipopt told that the
//! factorisation failed.

use crate::nlp::kkt::{Factors, Inertia, Pattern, Symbolic};
use ipopt_sys::ma97::{self, Control, Info, Reached, Routines};
use std::cell::RefCell;
use std::ffi::{c_double, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice::{from_raw_parts, from_raw_parts_mut};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Ipopt's name of the interface we stand behind.
pub(super) const STANDS_FOR: &str = "ma97";

/// Flag of a singular matrix.
const SINGULAR: c_int = 7;
/// Flag of any failure.
const FAILED: c_int = -1;

/// Analyses kept for the next programme of the same structure, each thread its own.
const KEPT: usize = 4;
/// No analysis with larger factors is kept, numbers.
const LARGEST_KEPT: usize = 1 << 20;

/// Makes our solver what Ipopt finds; says how.
///
/// # Errors
/// In words, where this Ipopt cannot be made to find it.
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

/// What this thread's solver did in one solve.
#[derive(Debug, Default)]
pub(super) struct Count {
    /// Time in analyses, factorisations and solutions.
    pub time: Duration,
    /// Why it could not serve.
    pub failure: Option<String>,
    /// Where the real HSL_MA97 was asked for: its routines, which all calls go to.
    real: Option<Routines>,
}

/// One factorisation as Ipopt asked for it, with the right-hand sides solved for.
#[derive(Debug, Clone)]
pub struct System {
    /// The analysis in use.
    pub symbolic: Arc<Symbolic>,
    /// Values of the pattern's entries.
    pub values: Vec<f64>,
    /// Least part of its column's largest entry that a pivot was to be.
    pub threshold: f64,
    /// What the factorisation found.
    pub inertia: Inertia,
    /// Right-hand sides, in order.
    pub right_hand_sides: Vec<Vec<f64>>,
}

thread_local! {
    static COUNT: RefCell<Count> = RefCell::default();
    static ANALYSES: RefCell<Vec<Analysis>> = const { RefCell::new(Vec::new()) };
    static RECORD: RefCell<Option<Vec<System>>> = const { RefCell::new(None) };
}

/// Runs `body` and returns the systems our solver was given in it on this thread.
///
/// For benchmarks and tests: it costs a copy of every matrix.
pub fn record<T>(body: impl FnOnce() -> T) -> (T, Vec<System>) {
    RECORD.set(Some(Vec::new()));
    let result = body();
    (result, RECORD.take().unwrap_or_default())
}

/// The stretch of this thread's work that belongs to one solve.
pub(super) struct Session {
    /// That of the solve this one is nested in.
    outer: Option<Count>,
}

impl Session {
    pub(super) fn begin(real: Option<Routines>) -> Self {
        let count = Count {
            real,
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

/// An analysis with the memory that belongs to it.
struct Analysis {
    symbolic: Arc<Symbolic>,
    factors: Factors,
}

impl Analysis {
    /// One kept by this thread, or a new one.
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
            }
        })
    }

    /// Kept for the next one of this pattern, if it is not large.
    fn keep(self) {
        if self.symbolic.factor_size() > LARGEST_KEPT {
            return;
        }
        // A thread that ends has nothing to keep any more.
        let _ = ANALYSES.try_with(|kept| {
            let mut kept = kept.borrow_mut();
            if kept.len() == KEPT {
                kept.remove(0);
            }
            kept.push(self);
        });
    }
}

/// What a call is to do: the real HSL's work, or ours with the time counted and panics kept.
fn guarded(info: *mut Info, body: impl FnOnce() -> Outcome) {
    let begin = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(body));
    let mut filled = empty();
    COUNT.with_borrow_mut(|count| {
        count.time += begin.elapsed();
        match outcome {
            Ok(Ok(found)) => filled = found,
            Ok(Err(failure)) => {
                filled.flag = FAILED;
                count.failure.get_or_insert(failure);
            }
            Err(_) => {
                filled.flag = FAILED;
                count.failure.get_or_insert_with(|| "a defect in it".into());
            }
        }
    });
    // SAFETY: Ipopt passes a valid place for what is found.
    unsafe { *info = filled };
}

type Outcome = Result<Info, String>;

fn real() -> Option<Routines> {
    COUNT.with_borrow(|count| count.real)
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
    if let Some(real) = real() {
        // SAFETY: the caller's promise to us is the one to it.
        return unsafe { (real.default_control)(control) };
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
    if let Some(real) = real() {
        // SAFETY: the caller's promise to us is the one to it.
        return unsafe { (real.analyse)(check, n, ptr, row, val, akeep, control, info, order) };
    }
    guarded(info, || {
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
        let pattern = Pattern::new(convert(starts), convert(rows)).map_err(|e| e.to_string())?;
        let analysis = Analysis::of(pattern);
        let mut info = empty();
        info.num_factor = analysis.symbolic.factor_size() as _;
        info.num_flops = 2 * analysis.symbolic.multiplications() as i64 as std::ffi::c_long;
        info.num_sup = analysis.symbolic.fronts() as c_int;
        *akeep = Box::into_raw(Box::new(analysis)).cast();
        Ok(info)
    });
}

/// The analysis behind a handle, with its memory.
///
/// # Safety
/// `akeep` points to a handle that `analyse` made and `finalise` has not freed, or to null; no
/// other reference to it is in use.
unsafe fn analysis<'a>(akeep: *mut *mut c_void) -> Result<&'a mut Analysis, String> {
    // SAFETY: the caller's promise.
    unsafe { (*akeep).cast::<Analysis>().as_mut() }.ok_or_else(|| "there is no analysis".into())
}

/// Factorises the matrix with these values.
fn factorise(analysis: &mut Analysis, values: &[f64], control: &Control) -> Outcome {
    let Analysis { symbolic, factors } = analysis;
    let inertia = factors
        .factor(symbolic, values, control.u)
        .map_err(|error| error.to_string())?;
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
            record.push(System {
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
    if let Some(real) = real() {
        // SAFETY: the caller's promise to us is the one to it.
        return unsafe {
            (real.factor)(
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
    guarded(info, || {
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
    });
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
    if let Some(real) = real() {
        // SAFETY: the caller's promise to us is the one to it.
        return unsafe {
            (real.factor_solve)(
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
    if let Some(real) = real() {
        // SAFETY: the caller's promise to us is the one to it.
        return unsafe { (real.solve)(job, nrhs, x, ldx, akeep, fkeep, control, info) };
    }
    guarded(info, || {
        // SAFETY: Ipopt passes the handle of its analysis.
        let Analysis { symbolic, factors } = unsafe { analysis(akeep)? };
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
    });
}

unsafe extern "C" fn finalise(akeep: *mut *mut c_void, fkeep: *mut *mut c_void) {
    if let Some(real) = real() {
        // SAFETY: the caller's promise to us is the one to it.
        return unsafe { (real.finalise)(akeep, fkeep) };
    }
    // SAFETY: Ipopt passes the place of the handle.
    unsafe { free_akeep(akeep) };
}

unsafe extern "C" fn free_akeep(akeep: *mut *mut c_void) {
    if let Some(real) = real() {
        // SAFETY: the caller's promise to us is the one to it.
        return unsafe { (real.free_akeep)(akeep) };
    }
    // SAFETY: a handle of ours that is not null came from `Box::into_raw`, and is freed once:
    // null takes its place.
    let handle = unsafe { std::mem::replace(&mut *akeep, std::ptr::null_mut()) };
    if !handle.is_null() {
        // SAFETY: as above.
        unsafe { Box::from_raw(handle.cast::<Analysis>()) }.keep();
    }
}
