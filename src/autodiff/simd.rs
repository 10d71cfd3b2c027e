//! The widest vector instructions of the machine, found when the program runs.

use pulp::{Arch, NullaryFnOnce};

/// Code worth compiling for wider vectors than every machine has.
///
/// `run` and all it calls must be `#[inline(always)]`: what is not inlined is compiled for the
/// plain instruction set.
pub trait Kernel {
    /// Does the work.
    fn run(self);
}

/// Whether this machine has fused multiply-add together with wide vectors, so that numbers that
/// use it pay.
pub fn has_fused() -> bool {
    !matches!(Arch::new(), Arch::Scalar)
}

/// Runs `kernel`, compiled for the widest vectors of this machine.
#[inline]
pub fn dispatch<K: Kernel>(kernel: K) {
    Arch::new().dispatch(Work(kernel));
}

struct Work<K>(K);

impl<K: Kernel> NullaryFnOnce for Work<K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.0.run();
    }
}
