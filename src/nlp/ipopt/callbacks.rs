//! The functions Ipopt calls: from C to the [`Nlp`] and the monitor, and no panic back.

#![expect(
    unsafe_code,
    reason = "functions that C calls with pointers, by Ipopt's interface"
)]

use super::interrupt;
use super::ma97_bridge::with_trouble;
use super::structure;
use super::trouble::Trouble;
use crate::nlp::{Control, Deadline, Evaluations, HandOver, Nlp, Progress, Undefined};
use ipopt_sys::{self as ip, Bool, Index, Number, UserDataPtr};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice::{from_raw_parts, from_raw_parts_mut};
use std::time::{Duration, Instant};

/// What the callbacks of one solve share.
pub(super) struct Context<'a> {
    nlp: &'a mut dyn Nlp,
    monitor: &'a mut dyn FnMut(&Progress) -> Control,
    deadline: Deadline,
    /// Whether the multifrontal solver serves, and MUMPS could.
    bridged: bool,
    /// Ipopt need not call the first point new.
    begun: bool,
    record: Record,
}

/// What is left of a solve's callbacks once it has ended.
#[derive(Default)]
pub(super) struct Record {
    /// The payload of the first panic; from then on every callback refuses.
    pub(super) panic: Option<Box<dyn Any + Send>>,
    /// Whether the deadline ended the solve.
    pub(super) late: bool,
    /// Why MUMPS is to go on, where that ended the solve.
    pub(super) hand_over: Option<HandOver>,
    /// The last iteration.
    pub(super) last: Option<Progress>,
    /// Calls of each function.
    pub(super) evaluations: Evaluations,
    /// Time in those calls.
    pub(super) derivatives: Duration,
}

/// The count of one function.
type Counter = fn(&mut Evaluations) -> &mut u32;

impl<'a> Context<'a> {
    pub(super) fn new(
        nlp: &'a mut dyn Nlp,
        monitor: &'a mut dyn FnMut(&Progress) -> Control,
        deadline: Deadline,
        bridged: bool,
    ) -> Self {
        Self {
            nlp,
            monitor,
            deadline,
            bridged,
            begun: false,
            record: Record::default(),
        }
    }

    pub(super) fn finish(self) -> Record {
        self.record
    }

    /// Runs one evaluation; false to Ipopt where the value is undefined, which shortens its step.
    fn evaluate(
        &mut self,
        counter: Counter,
        new_point: Bool,
        body: impl FnOnce(&mut dyn Nlp) -> Result<(), Undefined>,
    ) -> Bool {
        if self.record.panic.is_some() {
            return ip::from_bool(false);
        }
        let begin = Instant::now();
        let new_point = ip::is_true(new_point) || !self.begun;
        self.begun = true;
        let nlp = &mut *self.nlp;
        let outcome = catch_unwind(AssertUnwindSafe(|| {
            if new_point {
                nlp.new_point();
            }
            body(nlp).is_ok()
        }));
        *counter(&mut self.record.evaluations) += 1;
        self.record.derivatives += begin.elapsed();
        self.answer(outcome)
    }

    /// Writes a structure; false to Ipopt where that is not what it was announced as.
    fn structure(&mut self, body: impl FnOnce(&dyn Nlp) -> bool) -> Bool {
        let nlp = &*self.nlp;
        let outcome = catch_unwind(AssertUnwindSafe(|| body(nlp)));
        self.answer(outcome)
    }

    /// Reports an iteration; false to Ipopt to end the solve.
    fn report(&mut self, progress: Progress) -> Bool {
        if self.record.panic.is_some() {
            return ip::from_bool(false);
        }
        self.record.last = Some(progress);
        let monitor = &mut *self.monitor;
        let outcome = catch_unwind(AssertUnwindSafe(|| monitor(&progress) == Control::Continue));
        let go_on = ip::is_true(self.answer(outcome)) && !interrupt::requested();
        self.record.late = go_on && self.deadline.has_passed();
        let go_on = go_on && !self.record.late;
        if self.bridged {
            let reason = with_trouble(Trouble::iterated);
            // An iterate of the restoration phase is none of the programme's own.
            self.record.hand_over = reason.filter(|_| go_on && !progress.restoration);
        }
        ip::from_bool(go_on && self.record.hand_over.is_none())
    }

    fn answer(&mut self, outcome: Result<bool, Box<dyn Any + Send>>) -> Bool {
        ip::from_bool(outcome.unwrap_or_else(|payload| {
            self.record.panic = Some(payload);
            false
        }))
    }
}

/// The context behind Ipopt's user data.
///
/// # Safety
/// `user_data` is the [`Context`] that `Problem::solve` passed on, and nothing else refers
/// to it while the callback runs.
unsafe fn context<'c, 'a: 'c>(user_data: UserDataPtr) -> &'c mut Context<'a> {
    // SAFETY: the caller's promise.
    unsafe { &mut *user_data.cast::<Context<'a>>() }
}

/// # Safety
/// `data` points to `length` numbers that live through the callback, or `length` is 0.
unsafe fn input<'c>(data: *const Number, length: Index) -> &'c [f64] {
    match usize::try_from(length) {
        // SAFETY: the caller's promise.
        Ok(length) if length > 0 => unsafe { from_raw_parts(data, length) },
        _ => &[],
    }
}

/// # Safety
/// `data` points to `length` values that live through the callback and are not referred to
/// otherwise, or `length` is 0.
unsafe fn output<'c, T>(data: *mut T, length: Index) -> &'c mut [T] {
    match usize::try_from(length) {
        // SAFETY: the caller's promise.
        Ok(length) if length > 0 => unsafe { from_raw_parts_mut(data, length) },
        _ => &mut [],
    }
}

pub(super) unsafe extern "C" fn objective(
    n: Index,
    x: *mut Number,
    new_x: Bool,
    value: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes its user data, x of length n and one value to write.
    let (context, x, value) = unsafe { (context(user_data), input(x, n), &mut *value) };
    context.evaluate(
        |of| &mut of.objective,
        new_x,
        |nlp| {
            *value = nlp.objective(x)?;
            Ok(())
        },
    )
}

pub(super) unsafe extern "C" fn gradient(
    n: Index,
    x: *mut Number,
    new_x: Bool,
    values: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes its user data, x and the gradient of length n.
    let (context, x, values) = unsafe { (context(user_data), input(x, n), output(values, n)) };
    context.evaluate(|of| &mut of.gradient, new_x, |nlp| nlp.gradient(x, values))
}

pub(super) unsafe extern "C" fn constraints(
    n: Index,
    x: *mut Number,
    new_x: Bool,
    m: Index,
    values: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes its user data, x of length n and values of length m.
    let (context, x, values) = unsafe { (context(user_data), input(x, n), output(values, m)) };
    context.evaluate(
        |of| &mut of.constraints,
        new_x,
        |nlp| nlp.constraints(x, values),
    )
}

pub(super) unsafe extern "C" fn jacobian(
    n: Index,
    x: *mut Number,
    new_x: Bool,
    _m: Index,
    nonzeros: Index,
    rows: *mut Index,
    columns: *mut Index,
    values: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes its user data.
    let context = unsafe { context(user_data) };
    if values.is_null() {
        // SAFETY: without values, Ipopt passes rows and columns of this length.
        let (rows, columns) = unsafe { (output(rows, nonzeros), output(columns, nonzeros)) };
        return context.structure(|nlp| {
            let fill = |rows: &mut [usize], columns: &mut [usize]| {
                nlp.jacobian_structure(rows, columns);
            };
            structure::write(nlp.size().jacobian_nonzeros, fill, rows, columns)
        });
    }
    // SAFETY: with values, Ipopt passes x of length n and one value a nonzero.
    let (x, values) = unsafe { (input(x, n), output(values, nonzeros)) };
    context.evaluate(|of| &mut of.jacobian, new_x, |nlp| nlp.jacobian(x, values))
}

pub(super) unsafe extern "C" fn hessian(
    n: Index,
    x: *mut Number,
    new_x: Bool,
    sigma: Number,
    m: Index,
    multipliers: *mut Number,
    _new_multipliers: Bool,
    nonzeros: Index,
    rows: *mut Index,
    columns: *mut Index,
    values: *mut Number,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes its user data.
    let context = unsafe { context(user_data) };
    if values.is_null() {
        // SAFETY: without values, Ipopt passes rows and columns of this length.
        let (rows, columns) = unsafe { (output(rows, nonzeros), output(columns, nonzeros)) };
        return context.structure(|nlp| {
            let fill = |rows: &mut [usize], columns: &mut [usize]| {
                nlp.hessian_structure(rows, columns);
            };
            structure::write(nlp.size().hessian_nonzeros, fill, rows, columns)
        });
    }
    // SAFETY: with values, Ipopt passes x of length n, multipliers of length m and one value a
    // nonzero.
    let (x, multipliers, values) =
        unsafe { (input(x, n), input(multipliers, m), output(values, nonzeros)) };
    context.evaluate(
        |of| &mut of.hessian,
        new_x,
        |nlp| nlp.hessian(x, sigma, multipliers, values),
    )
}

pub(super) unsafe extern "C" fn intermediate(
    mode: Index,
    iteration: Index,
    objective: Number,
    primal_infeasibility: Number,
    dual_infeasibility: Number,
    barrier: Number,
    _step_norm: Number,
    regularization: Number,
    dual_step: Number,
    primal_step: Number,
    line_search_trials: Index,
    user_data: UserDataPtr,
) -> Bool {
    // SAFETY: Ipopt passes its user data.
    let context = unsafe { context(user_data) };
    context.report(Progress {
        iteration: u32::try_from(iteration).unwrap_or(0),
        restoration: mode != 0,
        objective,
        primal_infeasibility,
        dual_infeasibility,
        barrier,
        regularization,
        steps: [primal_step, dual_step],
        line_search_trials: u32::try_from(line_search_trials).unwrap_or(0),
    })
}
