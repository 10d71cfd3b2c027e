//! Small pieces that many folders compute with.
//!
//! | file | has |
//! | --- | --- |
//! | `largest` | maxima in which NaN is not lost |
//! | `random` | seeds of streams of random numbers, numbers with a normal distribution |

mod largest;
mod random;

pub(crate) use largest::{largest_or_nan, raise_or_nan};
pub(crate) use random::{mix, standard_normal};
