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

    /// r_s: largest over mean; 1 where the state is a straight line.
    pub fn ratio(&self) -> f64 {
        let mean = self.values.iter().sum::<f64>() / SAMPLES as f64;
        let max = self.values.iter().copied().fold(0.0, f64::max);
        if max > 0.0 { max / mean } else { 1.0 }
    }

    /// Breakpoints in (−1, 1) that cut the segment into `parts` of equal ∫ν^{1/3}, eq. (31).
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
