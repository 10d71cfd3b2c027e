//! Linear maps of angular vectors.

use super::{Algebra, Vector};
use crate::autodiff::{Scalar, Times};

const UNITS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A constant square matrix over angular vectors, by columns; in the plane the first alone.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct AngularMap<Sp: Algebra> {
    columns: [Sp::Angular<f64>; 3],
}

impl<Sp: Algebra> AngularMap<Sp> {
    #[inline(always)]
    pub fn zero() -> Self {
        Self {
            columns: [Sp::Angular::<f64>::zero(); 3],
        }
    }

    /// The map of which `image` says where the axes go.
    #[inline(always)]
    pub fn by_axes(image: impl Fn(&Sp::Angular<f64>) -> Sp::Angular<f64>) -> Self {
        let mut map = Self::zero();
        for (column, unit) in map.columns.iter_mut().zip(&UNITS).take(Sp::ANGLES) {
            *column = image(&Sp::Angular::from_components(unit));
        }
        map
    }

    #[inline(always)]
    pub fn add(&mut self, other: &Self) {
        for (to, from) in self.columns.iter_mut().zip(&other.columns).take(Sp::ANGLES) {
            *to = to.plus(from);
        }
    }

    /// Hands the elements to `visit`.
    #[inline(always)]
    pub fn visit(&mut self, visit: &mut impl FnMut(&mut [f64])) {
        for column in self.columns.iter_mut().take(Sp::ANGLES) {
            visit(column.components_mut());
        }
    }

    /// The image of a vector.
    #[inline(always)]
    pub fn apply<S: Scalar>(&self, vector: &Sp::Angular<S>) -> Sp::Angular<S> {
        let mut image = Sp::Angular::<S>::zero();
        for (column, &v) in self.columns.iter().zip(vector.components()) {
            for (to, &c) in image.components_mut().iter_mut().zip(column.components()) {
                *to = Times::<f64>::plus_times(*to, v, c);
            }
        }
        image
    }

    /// The image of a vector by the transposed matrix.
    #[inline(always)]
    pub fn apply_transposed(&self, vector: &Sp::Angular<f64>) -> Sp::Angular<f64> {
        let mut image = Sp::Angular::<f64>::zero();
        for (to, column) in image.components_mut().iter_mut().zip(&self.columns) {
            *to = column.dot(vector);
        }
        image
    }
}
