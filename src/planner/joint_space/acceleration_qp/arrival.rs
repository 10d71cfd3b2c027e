//! From where a joint can still arrive at rest at its goal, as bounds on its next acceleration.

use crate::ocp::Interval;

/// Where a joint is going.
#[derive(Debug, Clone, Copy)]
pub(super) struct Way {
    /// What is left to the goal, with its sign, rad or m.
    pub left: f64,
    /// Rate, rad/s or m/s.
    pub rate: f64,
    /// Steps left, the next one included.
    pub steps: usize,
    /// Their length, s.
    pub h: f64,
}

/// Distance by which rounding may leave a joint outside the set that it was held in, rad or m.
const ROUNDING: f64 = 1e-12;

impl Way {
    /// Accelerations over the next step after which accelerations within `limits` (which hold zero)
    /// and rates within `rates` still lead to rest at the goal in the steps that are then left;
    /// `None` where none do.
    ///
    /// The rates between now and then lie between two profiles, the largest and the smallest
    /// that start with the rate after the step and end at rest; any distance between those of the
    /// two can be covered. Both grow with the acceleration of the step, which makes the answer an
    /// interval.
    pub fn arriving(&self, limits: &Interval, rates: &Interval) -> Option<Interval> {
        let Self { rate, h, .. } = *self;
        let rest = self.steps.saturating_sub(1) as f64;
        // The rate from which the steps left suffice to come to rest.
        let still = Interval::new(
            rates.lower.max(rest * h * -limits.upper),
            rates.upper.min(rest * h * -limits.lower),
        );
        let low = limits.lower.max((still.lower - rate) / h);
        let high = limits.upper.min((still.upper - rate) / h);
        if !(low.is_finite() && high.is_finite()) || low > high + ROUNDING / (h * h) {
            return None;
        }
        let high = high.max(low);
        let mirrored = |bounds: &Interval| Interval::new(-bounds.upper, -bounds.lower);
        let back = Self {
            left: -self.left,
            rate: -rate,
            ..*self
        };
        let lower = self.least(limits, rates, [low, high])?;
        let upper = -back.least(&mirrored(limits), &mirrored(rates), [-high, -low])?;
        // At the last steps there is one acceleration, up to rounding.
        Some(if lower <= upper {
            Interval::new(lower, upper)
        } else {
            Interval::fixed(0.5 * (lower + upper))
        })
    }

    /// The least acceleration in `range` after which the largest rates lead far enough.
    fn least(&self, limits: &Interval, rates: &Interval, range: [f64; 2]) -> Option<f64> {
        let spare = |a: f64| {
            let Self { left, rate, h, .. } = *self;
            self.farthest(rate + a * h, limits, rates) - (left - h * (rate + 0.5 * h * a))
        };
        let [mut low, mut high] = range;
        if spare(low) >= 0.0 {
            return Some(low);
        }
        if spare(high) < -ROUNDING {
            return None;
        }
        // Halved until no number is left between them.
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return Some(high);
            }
            if spare(middle) >= 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
    }

    /// The largest distance covered after the next step from `rate` to rest.
    fn farthest(&self, rate: f64, limits: &Interval, rates: &Interval) -> f64 {
        let rest = self.steps.saturating_sub(1);
        let at = |i: usize| {
            let gained = rate + i as f64 * self.h * limits.upper;
            let stopping = (rest - i) as f64 * self.h * -limits.lower;
            gained.min(stopping).min(rates.upper)
        };
        let mean = |i: usize| 0.5 * (at(i) + at(i + 1));
        self.h * (0..rest).map(mean).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Drives a joint by what `choose` takes of the bounds; the rest of the way and the rate.
    fn driven(steps: usize, left: f64, choose: impl Fn(usize, Interval) -> f64) -> [f64; 2] {
        let (limits, rates) = (Interval::new(-0.5, 0.8), Interval::new(-0.2, 0.3));
        let mut way = Way {
            left,
            rate: 0.0,
            steps,
            h: 0.1,
        };
        while way.steps > 0 {
            let allowed = way.arriving(&limits, &rates).unwrap();
            let a = choose(way.steps, allowed);
            assert!(
                (limits.lower - 1e-9..=limits.upper + 1e-9).contains(&a),
                "{a}"
            );
            way.left -= way.h * (way.rate + 0.5 * way.h * a);
            way.rate += way.h * a;
            assert!((rates.lower - 1e-9..=rates.upper + 1e-9).contains(&way.rate));
            way.steps -= 1;
        }
        [way.left, way.rate]
    }

    #[test]
    fn whatever_is_chosen_within_the_bounds_arrives() {
        for left in [0.0, 0.7, -0.4, 1.1] {
            for phase in 0..5 {
                let end = driven(60, left, |step, allowed| {
                    let share = (0.5 + 0.5 * ((step * (phase + 1)) as f64).sin()).clamp(0.0, 1.0);
                    allowed.lower + share * (allowed.upper - allowed.lower)
                });
                assert!(end.iter().all(|rest| rest.abs() < 1e-9), "{left}: {end:?}");
            }
            for choose in [
                |_: usize, a: Interval| a.lower,
                |_: usize, a: Interval| a.upper,
            ] {
                let end = driven(60, left, choose);
                assert!(end.iter().all(|rest| rest.abs() < 1e-9), "{left}: {end:?}");
            }
        }
    }

    #[test]
    fn what_is_out_of_reach_is_said() {
        let far = Way {
            left: 2.0,
            rate: 0.0,
            steps: 60,
            h: 0.1,
        };
        // At 0.3 rad/s six seconds lead 1.8 rad far at the most.
        let rates = Interval::symmetric(0.3);
        assert_eq!(far.arriving(&Interval::symmetric(10.0), &rates), None);
    }
}
