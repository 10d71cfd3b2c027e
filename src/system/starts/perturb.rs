//! A detour or a loop on top of a trajectory.

use crate::ocp::Interval;
use crate::system::guess::Loop;
use crate::transcription::Discretization;

/// What is put on top of the joints' motion.
#[derive(Debug, Clone)]
pub(super) enum OnTop {
    /// There and back, each joint by so much, between two fractions of the duration.
    Bump {
        offsets: Vec<f64>,
        from: f64,
        to: f64,
    },
    /// A loop of two joints.
    Loop(Loop),
}

impl OnTop {
    /// Adds it at a fraction of the duration, with derivatives by it.
    fn add_at(&self, fraction: f64, q: &mut [f64], dq: &mut [f64], ddq: &mut [f64]) {
        match self {
            Self::Loop(round) => round.add_at(fraction, q, dq, ddq),
            Self::Bump { offsets, from, to } => {
                let width = to - from;
                let p = ((fraction - from) / width).clamp(0.0, 1.0);
                // 64 p³(1 − p)³ is one in the middle and at rest at both ends.
                let r = p * (1.0 - p);
                let [b, db, ddb] = [
                    64.0 * r * r * r,
                    192.0 * r * r * (1.0 - 2.0 * p) / width,
                    384.0 * r * ((1.0 - 2.0 * p).powi(2) - r) / (width * width),
                ];
                for (j, offset) in offsets.iter().enumerate() {
                    q[j] += offset * b;
                    dq[j] += offset * db;
                    ddq[j] += offset * ddb;
                }
            }
        }
    }
}

/// `trajectory` with `on_top`, joints kept within `limits`; its states are the attitude, then the
/// joints' positions and rates, its controls their accelerations.
pub(super) fn perturbed(
    trajectory: &Discretization,
    on_top: &OnTop,
    limits: &[Interval],
) -> Discretization {
    let n = limits.len();
    let mut moved = trajectory.clone();
    let duration = trajectory.duration;
    let (states, points) = (trajectory.states, trajectory.mesh.points());
    let (mut q, mut dq, mut ddq) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for (k, fraction) in trajectory.mesh.node_fractions().into_iter().enumerate() {
        q.fill(0.0);
        dq.fill(0.0);
        ddq.fill(0.0);
        on_top.add_at(fraction, &mut q, &mut dq, &mut ddq);
        let joints = &mut moved.x[(k + 1) * states - 2 * n..(k + 1) * states];
        for j in 0..n {
            joints[j] = limits[j].clamp(joints[j] + q[j]);
            joints[n + j] += dq[j] / duration;
            if k < points {
                moved.u[k * n + j] += ddq[j] / (duration * duration);
            }
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::Mesh;

    /// The rates are the slopes of the positions, the controls those of the rates: on a mesh with
    /// enough points, by the derivatives of its polynomials.
    #[test]
    fn what_is_on_top_moves_as_its_rates_say() {
        let mesh = Mesh::uniform(1, 12).unwrap();
        let still = Discretization::sample(mesh, 2.0, 5, 2, |_, _, _| {});
        let bump = OnTop::Bump {
            offsets: vec![0.5, -0.3],
            from: 0.0,
            to: 1.0,
        };
        let moved = perturbed(&still, &bump, &[Interval::FREE; 2]);
        let (mut x, mut dx, mut u) = ([0.0; 5], [0.0; 5], [0.0; 2]);
        for tau in [-0.7, 0.0, 0.4] {
            moved.state_in(0, tau, &mut x);
            moved.state_derivative_in(0, tau, &mut dx);
            moved.control_in(0, tau, &mut u);
            // τ from −1 to 1 takes two seconds.
            for j in 0..2 {
                assert!((dx[1 + j] - x[3 + j]).abs() < 1e-9);
                assert!((dx[3 + j] - u[j]).abs() < 1e-9);
            }
        }
        moved.state_in(0, 0.0, &mut x);
        assert!((x[1] - 0.5).abs() < 1e-9 && (x[2] + 0.3).abs() < 1e-9);
    }
}
