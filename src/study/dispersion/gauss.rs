//! Gauss-Legendre collocation: the implicit Runge-Kutta methods of order 2s, with weights for any
//! place within a step.

use crate::collocation::Barycentric;
use std::f64::consts::PI;

/// The method with s stages, on [0, 1].
#[derive(Debug, Clone)]
pub(super) struct Gauss {
    /// Places of the stages.
    pub nodes: Vec<f64>,
    /// Integral of each stage's Lagrange polynomial from 0 to every stage, by rows: the method's
    /// matrix.
    pub matrix: Vec<f64>,
    /// The same from 0 to 1.
    pub weights: Vec<f64>,
    basis: Barycentric,
}

impl Gauss {
    /// With that many stages, at least 1.
    pub fn new(stages: usize) -> Self {
        let nodes = nodes(stages);
        let mut gauss = Self {
            basis: Barycentric::new(nodes.iter().map(|c| 2.0 * c - 1.0).collect()),
            matrix: Vec::new(),
            weights: Vec::new(),
            nodes,
        };
        gauss.matrix = gauss.nodes.iter().flat_map(|c| gauss.to(*c)).collect();
        gauss.weights = gauss.to(1.0);
        gauss
    }

    /// Integral of each stage's Lagrange polynomial from 0 to `place`.
    pub fn to(&self, place: f64) -> Vec<f64> {
        let stages = self.nodes.len();
        let mut sums = vec![0.0; stages];
        // A rule of as many points is exact for them.
        for (at, weight) in self.nodes.iter().zip(quadrature(&self.nodes)) {
            let values = self.basis.basis(2.0 * at * place - 1.0);
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += weight * place * value;
            }
        }
        sums
    }
}

/// Legendre's polynomial of that degree at x and its derivative.
fn legendre(degree: usize, x: f64) -> [f64; 2] {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=degree {
        let k = k as f64;
        (before, value) = (
            value,
            ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k,
        );
    }
    let slope = degree as f64 * (x * value - before) / (x * x - 1.0);
    [value, slope]
}

fn nodes(stages: usize) -> Vec<f64> {
    if stages == 1 {
        return vec![0.5];
    }
    let root = |i: usize| {
        let mut x = -(PI * (i as f64 + 0.75) / (stages as f64 + 0.5)).cos();
        // Newton's method from so near meets rounding within five steps.
        for _ in 0..10 {
            let [value, slope] = legendre(stages, x);
            x -= value / slope;
        }
        0.5 * (1.0 + x)
    };
    (0..stages).map(root).collect()
}

/// Weights of the quadrature on [0, 1] with these points.
fn quadrature(nodes: &[f64]) -> Vec<f64> {
    let stages = nodes.len();
    let weight = |c: &f64| {
        if stages == 1 {
            return 1.0;
        }
        let x = 2.0 * c - 1.0;
        let [_, slope] = legendre(stages, x);
        1.0 / ((1.0 - x * x) * slope * slope)
    };
    nodes.iter().map(weight).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        for stages in 1..=12 {
            let gauss = Gauss::new(stages);
            // The quadrature to degree 2s − 1, places within to degree s − 1.
            for degree in 0..2 * stages {
                let power = |c: &f64| c.powi(degree as i32);
                let sum: f64 = gauss
                    .nodes
                    .iter()
                    .zip(&gauss.weights)
                    .map(|(c, w)| w * power(c))
                    .sum();
                assert!((sum - 1.0 / (degree as f64 + 1.0)).abs() < 1e-14);
                if degree < stages {
                    let place = 0.37;
                    let weights = gauss.to(place);
                    let sum: f64 = gauss
                        .nodes
                        .iter()
                        .zip(weights)
                        .map(|(c, w)| w * power(c))
                        .sum();
                    let expected = place.powi(degree as i32 + 1) / (degree as f64 + 1.0);
                    assert!((sum - expected).abs() < 1e-14, "{stages} {degree}");
                }
            }
        }
    }

    #[test]
    fn two_stages_are_those_of_textbooks() {
        let gauss = Gauss::new(2);
        let third = 3f64.sqrt() / 6.0;
        assert!((gauss.nodes[0] - (0.5 - third)).abs() < 1e-15);
        for (found, expected) in gauss
            .matrix
            .iter()
            .zip([0.25, 0.25 - third, 0.25 + third, 0.25])
        {
            assert!((found - expected).abs() < 1e-15);
        }
    }
}
