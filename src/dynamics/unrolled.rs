//! Loops over joints, compiled once more for two joints: the compiler unrolls them then.

/// Calls `$call` with `$n` the number of joints `$count`; where that is two and the numbers of type
/// `$S` are plain, by a call of its own in which it is a constant.
///
/// What is called must be `#[inline(always)]`.
macro_rules! by_count {
    ($S:ty, $count:expr, $n:ident => $call:expr) => {
        if $count == 2 && size_of::<$S>() == size_of::<f64>() {
            let $n = 2;
            $call
        } else {
            let $n = $count;
            $call
        }
    };
}

pub(super) use by_count;
