//! The joints' tracking controller.
//!
//! B. Siciliano, L. Sciavicco, L. Villani, G. Oriolo, "Robotics", doi:10.1007/978-1-84628-642-1,
//! section 8.5.2 (inverse dynamics control), here with the reduced inertia matrix of (6).

use super::platform::{Controller, Law};
use super::reference::Reference;
use crate::dynamics::space::Planar;
use crate::dynamics::{Data, Tree};

/// The controller of one run.
pub(super) struct Tracking<'a> {
    controller: Controller,
    reference: &'a Reference,
    tree: &'a Tree<Planar>,
    data: Data<Planar, f64>,
    /// Diagonal of H at the start.
    scale: Vec<f64>,
    wanted: Vec<f64>,
    /// Positions and rates halfway to the next sample.
    halfway: Vec<f64>,
}

impl<'a> Tracking<'a> {
    pub fn new(controller: Controller, reference: &'a Reference, tree: &'a Tree<Planar>) -> Self {
        let n = tree.joint_count();
        let mut data = Data::new(tree);
        tree.kinematics(reference.position(0), &mut data);
        tree.momentum(&mut data);
        tree.mass_matrix(&mut data);
        Self {
            controller,
            reference,
            tree,
            scale: (0..n).map(|j| data.mass_matrix[j * n + j]).collect(),
            data,
            wanted: vec![0.0; n],
            halfway: vec![0.0; 2 * n],
        }
    }

    /// Writes the torque to be held from sample `k` on, for measured positions and rates.
    pub fn command(&mut self, k: usize, q: &[f64], dq: &[f64], torque: &mut [f64]) {
        let n = q.len();
        let Controller {
            law,
            bandwidth,
            damping_ratio,
            ..
        } = self.controller;
        let reference = self.reference;
        let feedback = |j: usize| {
            2.0 * damping_ratio * bandwidth * (reference.rate(k)[j] - dq[j])
                + bandwidth * bandwidth * (reference.position(k)[j] - q[j])
        };
        match law {
            Law::ComputedTorque => {
                for j in 0..n {
                    self.wanted[j] = reference.acceleration(k, j) + feedback(j);
                }
                inverse_dynamics(self.tree, &mut self.data, q, dq, &self.wanted, torque);
            }
            Law::PdFeedForward => {
                let (at, rate) = self.halfway.split_at_mut(n);
                for j in 0..n {
                    self.wanted[j] = reference.acceleration(k, j);
                    let middle = |row: fn(&Reference, usize) -> &[f64]| {
                        0.5 * (row(reference, k)[j] + row(reference, k + 1)[j])
                    };
                    at[j] = middle(Reference::position);
                    rate[j] = middle(Reference::rate);
                }
                inverse_dynamics(self.tree, &mut self.data, at, rate, &self.wanted, torque);
                for (j, torque) in torque.iter_mut().enumerate() {
                    *torque += self.scale[j] * feedback(j);
                }
            }
        }
    }
}

/// τ = H(θ)a + Cθ̇, eq. (6).
fn inverse_dynamics(
    tree: &Tree<Planar>,
    data: &mut Data<Planar, f64>,
    q: &[f64],
    dq: &[f64],
    a: &[f64],
    torque: &mut [f64],
) {
    let n = q.len();
    tree.kinematics(q, data);
    tree.momentum(data);
    tree.base_rate(dq, data);
    tree.mass_matrix(data);
    tree.bias(dq, data);
    torque.copy_from_slice(&data.bias);
    for (i, torque) in torque.iter_mut().enumerate() {
        for (j, a) in a.iter().enumerate() {
            let (row, column) = (i.max(j), i.min(j));
            *torque += data.mass_matrix[row * n + column] * a;
        }
    }
}
