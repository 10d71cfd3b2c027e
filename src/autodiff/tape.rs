//! The record of operations behind traced numbers, one a thread.

use std::cell::RefCell;
use std::marker::PhantomData;
use std::sync::atomic::{AtomicU64, Ordering};

/// One recorded quantity: on which tape, and where.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Node {
    tape: u64,
    pub index: usize,
}

/// How a recorded quantity follows from those before it, by their indices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operation {
    /// A variable, by its number.
    Variable(usize),
    /// What varies, but no derivative is taken by.
    Parameter,
    /// A sum, or either of both: straight in both.
    Linear(usize, usize),
    /// The product of both.
    Product(usize, usize),
    /// The first over the second.
    Quotient(usize, usize),
    /// Any function of one quantity that may bend.
    Univariate(usize),
}

struct Tape {
    id: u64,
    operations: Vec<Operation>,
    /// Whether a recorded quantity was asked for its value.
    inspected: bool,
}

/// What a recording found.
#[derive(Debug, Default)]
pub(super) struct Recorded {
    pub operations: Vec<Operation>,
    /// Whether a recorded quantity was asked for its value: other values may lead to other operations.
    pub inspected: bool,
}

thread_local! {
    /// What this thread records at the moment.
    static TAPE: RefCell<Option<Tape>> = const { RefCell::new(None) };
}

/// Tapes made so far, in all threads: no two have the same number.
static MADE: AtomicU64 = AtomicU64::new(0);

/// Records what this thread does with traced numbers until it is finished or dropped.
///
/// Inside another recording it stands in for that one, whose numbers must then not be used.
#[derive(Debug)]
pub(super) struct Recording {
    outer: Option<Tape>,
    /// Bound to its thread.
    here: PhantomData<*const ()>,
}

impl Recording {
    pub fn start() -> Self {
        let tape = Tape {
            id: MADE.fetch_add(1, Ordering::Relaxed),
            operations: Vec::new(),
            inspected: false,
        };
        Self {
            outer: TAPE.with(|current| current.borrow_mut().replace(tape)),
            here: PhantomData,
        }
    }

    /// All operations since the start; the numbers made of them are of no use any more.
    pub fn finish(self) -> Recorded {
        let tape = TAPE.with(|current| current.borrow_mut().take());
        let recorded = |tape: Tape| Recorded {
            operations: tape.operations,
            inspected: tape.inspected,
        };
        tape.map(recorded).unwrap_or_default()
    }
}

impl Drop for Recording {
    fn drop(&mut self) {
        TAPE.with(|current| *current.borrow_mut() = self.outer.take());
    }
}

impl std::fmt::Debug for Tape {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "tape {} of {}", self.id, self.operations.len())
    }
}

/// Notes that the value of a recorded quantity was asked for.
pub(super) fn inspect() {
    TAPE.with(|current| {
        if let Some(tape) = current.borrow_mut().as_mut() {
            tape.inspected = true;
        }
    });
}

/// Appends a quantity without predecessors to this thread's tape.
pub(super) fn source(operation: Operation) -> Node {
    append([], |[]| operation)
}

/// Appends what `operation` makes of the indices of `operands`.
///
/// # Panics
/// Where an operand is not of this thread's present recording.
pub(super) fn append<const N: usize>(
    operands: [Node; N],
    operation: impl FnOnce([usize; N]) -> Operation,
) -> Node {
    TAPE.with(|current| {
        let mut current = current.borrow_mut();
        let tape = current
            .as_mut()
            .expect("traced numbers are for use while a thread records them");
        assert!(
            operands.iter().all(|node| node.tape == tape.id),
            "a traced number of another recording or of another thread is used"
        );
        tape.operations
            .push(operation(operands.map(|node| node.index)));
        Node {
            tape: tape.id,
            index: tape.operations.len() - 1,
        }
    })
}
