//! How many points a segment needs: from the decay of the Legendre coefficients of the rates in it.

use crate::collocation::Rule;
use crate::transcription::Discretization;

/// Coefficients looked at.
const COEFFICIENTS: usize = 24;
/// Points of the quadrature that they are computed with.
const QUADRATURE: usize = 48;
/// Decades by which a coefficient is smaller than the one before, where nothing is known.
const USUAL_DECAY: f64 = 0.5;
/// The least and the most that is believed of a fit.
const LEAST_DECAY: f64 = 0.15;
const MOST_DECAY: f64 = 1.5;
/// Part of the tolerance that the degree is chosen for: the fit is of sizes, not of bounds.
const DEGREE_AIM: f64 = 0.3;

/// Sizes of the Legendre coefficients of dX/dτ on the part `from..to` of the duration, the largest over
/// all states, each being the larger one of two neighbours: one of them may vanish by symmetry.
fn sizes(trajectory: &Discretization, from: f64, to: f64) -> Vec<f64> {
    let rule = Rule::new(QUADRATURE);
    let n = trajectory.states;
    let mut coefficients = vec![vec![0.0; n]; COEFFICIENTS + 1];
    let mut rates = vec![0.0; n];
    for (&tau, &weight) in rule.points().iter().zip(rule.weights()) {
        let (s, old) = trajectory
            .mesh
            .locate(from + 0.5 * (tau + 1.0) * (to - from));
        trajectory.state_derivative_in(s, old, &mut rates);
        let scale = (to - from) / trajectory.mesh.width(s);
        let (mut before, mut now) = (0.0, 1.0);
        for (degree, sums) in coefficients.iter_mut().enumerate() {
            let d = degree as f64;
            for (sum, rate) in sums.iter_mut().zip(&rates) {
                *sum += (d + 0.5) * weight * now * scale * rate;
            }
            (before, now) = (now, ((2.0 * d + 1.0) * tau * now - d * before) / (d + 1.0));
        }
    }
    let largest = |row: &Vec<f64>| row.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let each: Vec<f64> = coefficients.iter().map(largest).collect();
    each.windows(2).map(|pair| pair[0].max(pair[1])).collect()
}

/// log₁₀ of the coefficients as a straight line over their number: its value at zero, and decades a
/// coefficient. Only what stands above `noise` counts.
fn line(sizes: &[f64], noise: f64) -> Option<(f64, f64)> {
    let last = sizes.iter().position(|&size| size <= noise);
    let known = &sizes[..last.unwrap_or(sizes.len())];
    if known.len() < 3 {
        return None;
    }
    let n = known.len() as f64;
    let mean_x = (n - 1.0) / 2.0;
    let logs: Vec<f64> = known.iter().map(|size| size.log10()).collect();
    let mean_y = logs.iter().sum::<f64>() / n;
    let moved = logs.iter().enumerate().map(|(i, y)| (i as f64 - mean_x, y));
    let (xy, xx) = moved.fold((0.0, 0.0), |(xy, xx), (x, y)| (xy + x * y, xx + x * x));
    let decay = (-xy / xx).clamp(LEAST_DECAY, MOST_DECAY);
    Some((mean_y + decay * mean_x, decay))
}

/// Points of a segment from `from` to `to`, `noise` being the error of the trajectory there.
pub(super) fn needed(
    trajectory: &Discretization,
    (from, to): (f64, f64),
    noise: f64,
    tolerance: f64,
    least: usize,
) -> usize {
    let sizes = sizes(trajectory, from, to);
    match line(&sizes, noise.max(tolerance * DEGREE_AIM)) {
        Some((start, decay)) => {
            let points = (start - (DEGREE_AIM * tolerance).log10()) / decay;
            (points.ceil().max(0.0) as usize + 1).max(least)
        }
        None => least,
    }
}

/// Decades that the error of segment `s` falls by with another point.
pub(super) fn decay(trajectory: &Discretization, s: usize) -> f64 {
    let breakpoints = trajectory.mesh.breakpoints();
    let mut sizes = sizes(trajectory, breakpoints[s], breakpoints[s + 1]);
    sizes.truncate(trajectory.mesh.rule(s).len());
    line(&sizes, 0.0).map_or(USUAL_DECAY, |(_, decay)| decay)
}
