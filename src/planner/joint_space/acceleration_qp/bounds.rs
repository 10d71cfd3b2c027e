//! Limits on position, rate and control of a joint as bounds on its acceleration over one step.

use crate::ocp::Interval;

/// One joint at the start of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Joint {
    /// Position, rad or m.
    pub q: f64,
    /// Rate, rad/s or m/s.
    pub rate: f64,
    /// What u exceeds the acceleration by, (H⁻¹Cθ̇)ⱼ of (7).
    pub coriolis: f64,
    /// Limits on position, rate and control.
    pub position: Interval,
    /// Limits on the rate.
    pub velocity: Interval,
    /// Limits on the control.
    pub control: Interval,
}

impl Joint {
    /// Accelerations that, held over `h` seconds, keep all limits: the position's so that the
    /// joint can still stop in front of them. Where they contradict each other the control's comes
    /// first, then the rate's.
    ///
    /// A. Del Prete, "Joint position and velocity bounds in discrete-time acceleration/torque
    /// control of robot manipulators", doi:10.1109/LRA.2017.2738321, has the question in full; a
    /// plan may take a cautious share of the control for stopping.
    pub fn acceleration(&self, h: f64) -> Interval {
        let control = shifted(&self.control, self.coriolis);
        let rate = Interval::new(
            (self.velocity.lower - self.rate) / h,
            (self.velocity.upper - self.rate) / h,
        );
        let upper = stopping(self.position.upper - self.q, self.rate, -control.lower, h);
        let lower = -stopping(self.q - self.position.lower, -self.rate, control.upper, h);
        narrowed(narrowed(control, rate), Interval::new(lower, upper))
    }
}

/// Share of the control's limit that stopping may count on; the rest is for what the Coriolis
/// term does in the meantime.
pub(super) const BRAKE: f64 = 0.5;

/// Largest acceleration towards a limit `room` away, at `rate` towards it, after which the joint
/// still stops in front of it with a deceleration of a share of `brake`.
fn stopping(room: f64, rate: f64, brake: f64, h: f64) -> f64 {
    if room == f64::INFINITY {
        return f64::INFINITY;
    }
    let brake = (BRAKE * brake).max(0.0);
    if brake == f64::INFINITY {
        // Stopping within the next step.
        return (room - 1.5 * h * rate) / (h * h);
    }
    // After the step: rate v = rate + a h, room left room − h (rate + v)/2, and v² ≤ 2·brake·left.
    let half = 0.5 * brake * h;
    let left = half * half + brake * (2.0 * room - h * rate);
    let v = if left > 0.0 { left.sqrt() - half } else { 0.0 };
    (v - rate) / h
}

fn shifted(bounds: &Interval, by: f64) -> Interval {
    Interval::new(bounds.lower - by, bounds.upper - by)
}

/// What both allow, or the end of `first` nearest to `second` where they are apart.
pub(super) fn narrowed(first: Interval, second: Interval) -> Interval {
    Interval::new(first.clamp(second.lower), first.clamp(second.upper))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_that_takes_all_it_may_stops_in_front_of_its_limit() {
        let mut joint = Joint {
            q: 0.0,
            rate: 0.0,
            coriolis: 0.0,
            position: Interval::symmetric(1.0),
            velocity: Interval::symmetric(0.7),
            control: Interval::symmetric(0.5),
        };
        let h = 0.1;
        let mut fastest: f64 = 0.0;
        for _ in 0..200 {
            let allowed = joint.acceleration(h);
            assert!(allowed.lower <= allowed.upper && allowed.upper.abs() <= 0.5 + 1e-12);
            let a = allowed.upper;
            joint.q += h * joint.rate + 0.5 * a * h * h;
            joint.rate += a * h;
            fastest = fastest.max(joint.rate);
            assert!(joint.q <= 1.0 + 1e-12 && joint.rate <= 0.7 + 1e-12);
        }
        // In front of it the joint rests up to what braking changes in half a step.
        let still = 0.5 * h * BRAKE * 0.5;
        assert!(joint.q > 0.99 && joint.rate.abs() < still, "{joint:?}");
        assert!(fastest > 0.5);
    }

    #[test]
    fn the_control_comes_first() {
        let joint = Joint {
            q: 0.0,
            rate: 2.0,
            coriolis: 0.1,
            position: Interval::FREE,
            velocity: Interval::symmetric(1.0),
            control: Interval::symmetric(0.5),
        };
        assert_eq!(joint.acceleration(0.1), Interval::new(-0.6, -0.6));
    }
}
