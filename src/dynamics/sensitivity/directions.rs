//! Derivatives in all directions, one number after the other, from which sweeps take theirs.

use crate::autodiff::Dual;
use crate::dynamics::Storage;
use crate::dynamics::algebra::{Algebra, Force, Vector};

/// Place of a direction in the sweep of `N` that starts at direction `start`.
#[inline(always)]
pub(super) fn in_sweep<const N: usize>(start: usize, direction: usize) -> Option<usize> {
    direction.checked_sub(start).filter(|&place| place < N)
}

/// What the joints change while the motion of the base is held.
#[derive(Debug)]
pub(super) struct Directions<Sp: Algebra, J: Storage> {
    /// In momentum and force of the whole.
    pub momentum: ForceRow<Sp>,
    pub force: ForceRow<Sp>,
    /// In the force of each joint. What a joint does not reach stays zero.
    pub joints: J::Array<Row>,
}

impl<Sp: Algebra, J: Storage> Directions<Sp, J> {
    /// Room for `n` joints and `width` directions, those included that fill the last sweep up.
    pub fn new(n: usize, width: usize) -> Self {
        Self {
            momentum: ForceRow::new(width),
            force: ForceRow::new(width),
            joints: J::array(Row(vec![0.0; width]), n),
        }
    }
}

/// Derivatives of one number.
#[derive(Debug, Clone)]
pub(super) struct Row(pub Vec<f64>);

impl Row {
    /// Those in the sweep that starts at direction `start`, with the value zero.
    #[inline(always)]
    pub fn sweep<const N: usize, const FUSED: bool>(&self, start: usize) -> Dual<N, FUSED> {
        let mut gradient = [0.0; N];
        gradient.copy_from_slice(&self.0[start..][..N]);
        Dual {
            gradient,
            value: 0.0,
        }
    }
}

/// Derivatives of a force, one component after the other.
#[derive(Debug)]
pub(super) struct ForceRow<Sp: Algebra> {
    components: Row,
    width: usize,
    space: std::marker::PhantomData<Sp>,
}

impl<Sp: Algebra> ForceRow<Sp> {
    fn new(width: usize) -> Self {
        Self {
            components: Row(vec![0.0; (Sp::ANGLES + Sp::LENGTHS) * width]),
            width,
            space: std::marker::PhantomData,
        }
    }

    /// Makes `by` the derivative in `direction`.
    #[inline(always)]
    pub fn set(&mut self, direction: usize, by: &Force<Sp, f64>) {
        let components = by.angular.components().iter().chain(by.linear.components());
        for (row, &by) in self
            .components
            .0
            .chunks_exact_mut(self.width)
            .zip(components)
        {
            row[direction] = by;
        }
    }

    /// The force with its derivatives in the sweep that starts at direction `start`, with the
    /// value zero.
    #[inline(always)]
    pub fn sweep<const N: usize, const FUSED: bool>(
        &self,
        start: usize,
    ) -> Force<Sp, Dual<N, FUSED>> {
        let mut force: Force<Sp, Dual<N, FUSED>> = Force::zero();
        let angular = force.angular.components_mut().iter_mut();
        for (i, to) in angular.enumerate() {
            *to = self.components.sweep(i * self.width + start);
        }
        let linear = force.linear.components_mut().iter_mut();
        for (i, to) in (Sp::ANGLES..).zip(linear) {
            *to = self.components.sweep(i * self.width + start);
        }
        force
    }
}
