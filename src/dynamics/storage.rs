//! Room for one item a joint: on the heap for any number of joints, or in place for a number that
//! the compiler knows, which then unrolls the loops over joints.

use std::fmt::Debug;
use std::ops::{Deref, DerefMut};

/// Where items of the joints are kept.
pub trait Storage: Debug + Send + Sync + 'static {
    /// One item a joint.
    type Array<T: Clone + Debug + Send + Sync>: DerefMut<Target = [T]> + Clone + Debug + Send + Sync;

    /// `count` times `item`.
    fn array<T: Clone + Debug + Send + Sync>(item: T, count: usize) -> Self::Array<T>;
}

/// Any number of joints.
#[derive(Debug, Clone)]
pub struct Heap;

impl Storage for Heap {
    type Array<T: Clone + Debug + Send + Sync> = Vec<T>;

    fn array<T: Clone + Debug + Send + Sync>(item: T, count: usize) -> Vec<T> {
        vec![item; count]
    }
}

/// `JOINTS` joints.
#[derive(Debug, Clone)]
pub struct InPlace<const JOINTS: usize>;

impl<const JOINTS: usize> Storage for InPlace<JOINTS> {
    type Array<T: Clone + Debug + Send + Sync> = Items<T, JOINTS>;

    /// # Panics
    /// Where `count` is not `JOINTS`.
    fn array<T: Clone + Debug + Send + Sync>(item: T, count: usize) -> Items<T, JOINTS> {
        assert_eq!(count, JOINTS, "the number of joints");
        Items(std::array::from_fn(|_| item.clone()))
    }
}

/// An array that is used as a slice.
#[derive(Debug, Clone)]
pub struct Items<T, const COUNT: usize>([T; COUNT]);

impl<T, const COUNT: usize> Deref for Items<T, COUNT> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T, const COUNT: usize> DerefMut for Items<T, COUNT> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}
