//! The classical Runge-Kutta method of fourth order.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, "Solving Ordinary Differential Equations I", table II.1.2.

/// For each stage: its place in the step, and its weight in units of a sixth of the step.
const STAGES: [(f64, f64); 4] = [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)];

/// The classical Runge-Kutta method with its workspace.
///
/// ```
/// use ffsm_ipopt::integrate::Rk4;
///
/// // ẏ = −y from y(0) = 1.
/// let mut y = [1.0];
/// Rk4::new(1).integrate(|_t, y, dy| dy[0] = -y[0], [0.0, 1.0], 100, &mut y);
/// assert!((y[0] - (-1.0_f64).exp()).abs() < 1e-10);
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rk4 {
    /// Where the current stage is evaluated.
    at: Vec<f64>,
    /// Rate of the last stage.
    rate: Vec<f64>,
    /// The sum of the stages so far.
    next: Vec<f64>,
}

impl Rk4 {
    /// A workspace for `size` equations.
    pub fn new(size: usize) -> Self {
        Self {
            at: vec![0.0; size],
            rate: vec![0.0; size],
            next: vec![0.0; size],
        }
    }

    /// Carries `y` from `t` to `t + h`. `rate` is given t and y and writes dy/dt.
    ///
    /// # Panics
    /// Where `y` has not the length of the workspace.
    pub fn step(
        &mut self,
        mut rate: impl FnMut(f64, &[f64], &mut [f64]),
        t: f64,
        h: f64,
        y: &mut [f64],
    ) {
        self.next.copy_from_slice(y);
        self.rate.fill(0.0);
        for (place, weight) in STAGES {
            for ((at, y), k) in self.at.iter_mut().zip(&*y).zip(&self.rate) {
                *at = y + place * h * k;
            }
            rate(t + place * h, &self.at, &mut self.rate);
            for (next, k) in self.next.iter_mut().zip(&self.rate) {
                *next += weight * h / 6.0 * k;
            }
        }
        y.copy_from_slice(&self.next);
    }

    /// Carries `y` from `start` to `end` in `steps` equal steps; `end` may be before `start`.
    ///
    /// # Panics
    /// Where `y` has not the length of the workspace.
    pub fn integrate(
        &mut self,
        mut rate: impl FnMut(f64, &[f64], &mut [f64]),
        [start, end]: [f64; 2],
        steps: usize,
        y: &mut [f64],
    ) {
        let h = (end - start) / steps as f64;
        for k in 0..steps {
            self.step(&mut rate, start + k as f64 * h, h, y);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ẏ₁ = y₂, ẏ₂ = −y₁ + cos t from (0, 0): y₁ = t·sin(t)/2.
    fn resonance(t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = -y[0] + t.cos();
    }

    #[test]
    fn one_step_is_that_of_the_tableau() {
        // ẏ = y: k₁ = 1, k₂ = 1 + h/2, k₃ = 1 + h/2 + h²/4, k₄ = 1 + h + h²/2 + h³/4, and
        // y + h/6·(k₁ + 2k₂ + 2k₃ + k₄) = 1 + h + h²/2 + h³/6 + h⁴/24.
        let mut y = [1.0];
        Rk4::new(1).step(|_, y, dy| dy[0] = y[0], 0.0, 0.5, &mut y);
        assert!((y[0] - 1.648_437_5).abs() < 1e-15, "{y:?}");
        // ẏ = t³ is integrated exactly, being Simpson's rule.
        let mut y = [0.0];
        Rk4::new(1).step(|t, _, dy| dy[0] = t.powi(3), 1.0, 2.0, &mut y);
        assert!((y[0] - 20.0).abs() < 1e-13, "{y:?}");
    }

    #[test]
    fn the_error_falls_with_the_fourth_power_of_the_step() {
        let error = |steps| {
            let mut y = [0.0; 2];
            Rk4::new(2).integrate(resonance, [0.0, 4.0], steps, &mut y);
            (y[0] - 2.0 * 4.0_f64.sin()).abs()
        };
        let ratio = error(100) / error(200);
        assert!((ratio - 16.0).abs() < 0.5, "{ratio}");
    }

    #[test]
    fn backwards_leads_to_the_start() {
        let mut y = [0.3, -0.7];
        let mut rk4 = Rk4::new(2);
        rk4.integrate(resonance, [0.0, 1.0], 200, &mut y);
        rk4.integrate(resonance, [1.0, 0.0], 200, &mut y);
        assert!((y[0] - 0.3).abs() < 1e-10 && (y[1] + 0.7).abs() < 1e-10);
    }
}
