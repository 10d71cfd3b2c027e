//! Symmetric matrices by their elements.

use nalgebra::Matrix3;

/// A symmetric 3×3 matrix by its six elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Symmetric<S> {
    /// Diagonal xx, yy, zz.
    pub diagonal: [S; 3],
    /// Off the diagonal yz, xz, xy: the element without that index.
    pub products: [S; 3],
}

impl Symmetric<f64> {
    /// From a full matrix, of which the lower triangle is not read.
    pub fn from_matrix(m: &Matrix3<f64>) -> Self {
        Self {
            diagonal: [m[(0, 0)], m[(1, 1)], m[(2, 2)]],
            products: [m[(1, 2)], m[(0, 2)], m[(0, 1)]],
        }
    }
}
