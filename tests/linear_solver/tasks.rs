//! Problems whose conditions depend on each other.

use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::ocp::{Formulation, Interval, Ocp, Point, Quantity, WayPoint};

/// A rigid body turns from rest to rest about an oblique axis on the least torque; its attitude is a
/// quaternion.
pub struct Slew {
    pub angle: f64,
    pub torque: Interval,
    pub duration: Interval,
    /// Components of the quaternion that are fixed at the end.
    pub fixed: [bool; 4],
    /// Half the angle at half time, all components fixed.
    pub halfway: bool,
}

impl Slew {
    pub fn new(angle: f64, torque: f64) -> Self {
        Self {
            angle,
            torque: Interval::symmetric(torque),
            duration: Interval::fixed(10.0),
            fixed: [true; 4],
            halfway: false,
        }
    }

    /// The quaternion of a turn by `angle`.
    pub fn quaternion(angle: f64) -> [f64; 4] {
        let (sin, cos) = (0.5 * angle).sin_cos();
        [cos, 0.6 * sin, 0.0, 0.8 * sin]
    }
}

/// Moments of inertia.
const INERTIA: [f64; 3] = [2.0, 3.0, 4.0];

impl Ocp for Slew {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let mut formulation = Formulation::over(self.duration);
        let [start, end] = [0.0, self.angle].map(Self::quaternion);
        let still = Interval::fixed(0.0);
        for i in 0..4 {
            let component = Quantity::new(format!("q{i}"), Interval::FREE);
            let end = match self.fixed[i] {
                true => Interval::fixed(end[i]),
                false => Interval::FREE,
            };
            formulation = formulation.state(component, Interval::fixed(start[i]), end);
        }
        for i in 0..3 {
            let rate = Quantity::new(format!("rate {i}"), Interval::FREE);
            formulation = formulation.state(rate, still, still);
        }
        for i in 0..3 {
            formulation = formulation.control(Quantity::new(format!("torque {i}"), self.torque));
        }
        if self.halfway {
            let there = Self::quaternion(0.5 * self.angle).map(Interval::fixed);
            formulation = formulation.way_point(WayPoint {
                fraction: 0.5,
                states: [&there[..], &[Interval::FREE; 3]].concat(),
                rows: vec![],
            });
        }
        formulation
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        let (q, w) = point.x.split_at(4);
        rates[0] = (q[1] * w[0] + q[2] * w[1] + q[3] * w[2]) * -0.5;
        rates[1] = (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]) * 0.5;
        rates[2] = (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]) * 0.5;
        rates[3] = (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]) * 0.5;
        let mut cost = S::zero();
        for (i, &torque) in point.u.iter().enumerate() {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let gyroscopic = w[j] * w[k] * (INERTIA[k] - INERTIA[j]);
            rates[4 + i] = (torque - gyroscopic) * INERTIA[i].recip();
            cost += torque.square();
        }
        cost
    }
}

/// Three vessels joined in a row by pumps: what they hold together does not change.
pub struct Vessels {
    /// Contents of all vessels at the end.
    pub end: [f64; 3],
}

impl Vessels {
    pub const START: [f64; 3] = [6.0, 3.0, 1.0];
}

impl Ocp for Vessels {
    type Scratch<S: Scalar> = ();

    fn formulation(&self) -> Formulation {
        let mut formulation = Formulation::over(Interval::fixed(2.0));
        for (i, (start, end)) in Self::START.into_iter().zip(self.end).enumerate() {
            let vessel = Quantity::new(format!("vessel {i}"), Interval::FREE);
            formulation = formulation.state(vessel, Interval::fixed(start), Interval::fixed(end));
        }
        let pump = |name| Quantity::new(name, Interval::FREE);
        formulation.control(pump("first")).control(pump("second"))
    }

    fn scratch<S: Scalar>(&self) {}

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        _: &mut (),
        rates: &mut [S],
        _: &mut [S],
    ) -> S {
        let [first, second] = [point.u[0], point.u[1]];
        rates[0] = -first;
        rates[1] = first - second;
        rates[2] = second;
        first.square() + second.square()
    }
}
