//! Curvature of a state along a segment, eq. (29), and where it asks for breakpoints, eq. (31).

use crate::transcription::Discretization;

/// Sample points of the curvature in one segment.
const SAMPLES: usize = 101;

/// Curvature ν(τ) of one state on an even grid over [−1, 1].
#[derive(Debug, Clone)]
pub(super) struct Curvature {
    values: Vec<f64>,
}

impl Curvature {
    /// Curvature of `state` in segment `s`.
    pub fn new(trajectory: &Discretization, s: usize, state: usize) -> Self {
        let basis = trajectory.mesh.rule(s).state();
        let start = trajectory.mesh.start(s);
        let nodes = basis.nodes().len();
        let x: Vec<f64> = (0..nodes)
            .map(|k| trajectory.state(start + k)[state])
            .collect();
        let product = |row: &[f64], v: &[f64]| row.iter().zip(v).map(|(a, b)| a * b).sum::<f64>();
        let rows: Vec<Vec<f64>> = (0..nodes).map(|k| basis.derivative_at_node(k)).collect();
        let first: Vec<f64> = rows.iter().map(|row| product(row, &x)).collect();
        let second: Vec<f64> = rows.iter().map(|row| product(row, &first)).collect();
        let values = (0..SAMPLES)
            .map(|i| {
                let tau = -1.0 + 2.0 * i as f64 / (SAMPLES - 1) as f64;
                let l = basis.basis(tau);
                product(&l, &second).abs() / (1.0 + product(&l, &first).powi(2)).powf(1.5)
            })
            .collect();
        Self { values }
    }

    /// r_s: largest over mean of the samples; 1 where the state is a straight line.
    pub fn ratio(&self) -> f64 {
        let mean = self.values.iter().sum::<f64>() / SAMPLES as f64;
        let max = self.values.iter().copied().fold(0.0, f64::max);
        if max > 0.0 { max / mean } else { 1.0 }
    }

    /// Breakpoints in (−1, 1) that cut the segment into `parts` of equal ∫ν^{1/3}, eq. (31); equal
    /// parts where the curvature is too large to be a number.
    pub fn cuts(&self, parts: usize) -> Vec<f64> {
        let density: Vec<f64> = self.values.iter().map(|v| v.cbrt()).collect();
        let peak = density.iter().copied().fold(0.0, f64::max);
        // A floor keeps parts of a straight stretch from becoming endless.
        let floor = if peak > 0.0 { 1e-3 * peak } else { 1.0 };
        let step = 2.0 / (SAMPLES - 1) as f64;
        let mut cumulative = vec![0.0];
        for pair in density.windows(2) {
            let area = 0.5 * step * (pair[0].max(floor) + pair[1].max(floor));
            cumulative.push(cumulative[cumulative.len() - 1] + area);
        }
        let total = cumulative[SAMPLES - 1];
        if !total.is_finite() {
            return even_cuts(parts);
        }
        (1..parts)
            .map(|i| {
                let goal = total * i as f64 / parts as f64;
                let k = cumulative
                    .partition_point(|&c| c <= goal)
                    .clamp(1, SAMPLES - 1);
                let within = (goal - cumulative[k - 1]) / (cumulative[k] - cumulative[k - 1]);
                -1.0 + step * ((k - 1) as f64 + within)
            })
            .collect()
    }
}

/// Breakpoints in (−1, 1) that cut a segment into so many equal parts.
pub(super) fn even_cuts(parts: usize) -> Vec<f64> {
    let even = |i| -1.0 + 2.0 * i as f64 / parts as f64;
    (1..parts).map(even).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::Mesh;
    use std::f64::consts::FRAC_1_SQRT_2;

    /// The curvature of `state` along a segment of 5 points, τ being its only time.
    fn curvature(state: fn(f64) -> f64) -> Curvature {
        let mesh = Mesh::uniform(1, 5).unwrap();
        let trajectory = Discretization::sample(mesh, 1.0, 1, 0, |fraction, x, _| {
            x[0] = state(2.0 * fraction - 1.0);
        });
        Curvature::new(&trajectory, 0, 0)
    }

    fn assert_near(found: &[f64], expected: &[f64]) {
        assert_eq!(found.len(), expected.len());
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-4, "{found:?}, {expected:?}");
        }
    }

    #[test]
    fn a_parabola_has_the_curvature_of_equation_29() {
        // X = τ²: Ẋ = 2τ, Ẍ = 2, ν = 2/(1 + 4τ²)^{3/2}. At τ = 0 that is 2, at τ = 1/2
        // 2/2^{3/2} = 0.707107, at the ends 2/5^{3/2} = 0.178885.
        let parabola = curvature(|tau| tau * tau);
        for (i, expected) in [
            (0, 0.178_885),
            (50, 2.0),
            (75, FRAC_1_SQRT_2),
            (100, 0.178_885),
        ] {
            assert!((parabola.values[i] - expected).abs() < 1e-5, "{i}");
        }
        // ∫ν dτ from −1 to 1 is [2τ/√(1 + 4τ²)] = 4/√5 = 1.788854. The trapezoidal rule of 101
        // samples, 0.02 apart, gives that to 3·10⁻⁵; it counts the two ends half, so that the sum of
        // the samples is 1.788854/0.02 + 0.178885 = 89.6216, their mean 0.887342, and
        // r = 2/0.887342 = 2.25392.
        assert!(
            (parabola.ratio() - 2.253_92).abs() < 1e-4,
            "{}",
            parabola.ratio()
        );
    }

    #[test]
    fn a_parabola_is_cut_by_equation_31() {
        // ν^{1/3} is proportional to 1/√(1 + 4τ²), its integral F to asinh(2τ). Between ±asinh 2
        // equal steps of F: with 4 parts sinh(asinh(2)/2) = √((√5 − 1)/2) = 0.786151, half of which
        // is τ = 0.393076; with 2 parts τ = 0.
        let parabola = curvature(|tau| tau * tau);
        assert_near(&parabola.cuts(4), &[-0.393_076, 0.0, 0.393_076]);
        assert_near(&parabola.cuts(2), &[0.0]);
        assert_near(&parabola.cuts(1), &[]);
    }

    #[test]
    fn a_straight_line_is_even_and_cut_evenly() {
        let still = curvature(|_| 0.0);
        assert_eq!(still.ratio(), 1.0);
        assert_near(&still.cuts(4), &[-0.5, 0.0, 0.5]);
        // Ẍ is zero but for rounding.
        let line = curvature(|tau| 3.0 * tau - 1.0);
        assert!(line.values.iter().all(|v| *v < 1e-12));
    }

    #[test]
    fn curvature_in_one_half_draws_the_cuts_there() {
        // X = (1 + τ)³: Ẋ = 3(1 + τ)², Ẍ = 6(1 + τ); the peak is where 45(1 + τ)⁴ = 1, at
        // τ = 45^{−1/4} − 1 = −0.613903: 6·0.386097/(1 + 9/45)^{3/2} = 1.762285.
        let cubic = curvature(|tau| (1.0 + tau).powi(3));
        let peak = cubic.values.iter().copied().fold(0.0, f64::max);
        assert!((peak - 1.762_285).abs() < 1e-3, "{peak}");
        assert!(cubic.cuts(2)[0] < -0.3, "{:?}", cubic.cuts(2));
    }

    #[test]
    fn a_curvature_beyond_numbers_is_cut_evenly() {
        let wild = Curvature {
            values: vec![f64::NAN; SAMPLES],
        };
        assert_near(&wild.cuts(4), &[-0.5, 0.0, 0.5]);
    }
}
