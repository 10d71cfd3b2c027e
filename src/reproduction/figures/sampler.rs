//! The whole system's motion between the nodes of a plan.

use super::Case;
use crate::dynamics::attitude::Attitude;
use crate::dynamics::space::Planar;
use crate::dynamics::{Data, Mount, Placement};
use crate::system::FreeFloating;

/// One instant of a planar motion; angles in degrees, lengths in m.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Time, s.
    pub t: f64,
    /// Base attitude.
    pub attitude: f64,
    /// Its rate, deg/s.
    pub rate: f64,
    /// Base position relative to the system's mass centre, inertial axes.
    pub position: [f64; 2],
    /// Joint angles.
    pub joints: Vec<f64>,
    /// Joint rates, deg/s.
    pub joint_rates: Vec<f64>,
    /// The base's origin, every joint, and the end effector where there is one; inertial axes.
    pub skeleton: Vec<[f64; 2]>,
}

/// The motion of a planar plan at any time, from the polynomials of its segments.
#[derive(Debug)]
pub struct Sampler<'a> {
    case: &'a Case,
    system: FreeFloating<Planar>,
    joints: Vec<Mount<Planar>>,
    data: Data<Planar, f64>,
}

impl<'a> Sampler<'a> {
    /// The motion of `case`; `None` where it is not planar.
    pub fn new(case: &'a Case) -> Option<Self> {
        let system = FreeFloating::planar(&case.problem)?;
        let origin = Placement::identity();
        let tree = system.tree();
        let joints = (0..tree.joint_count())
            .map(|j| tree.mount(Some(j), &origin))
            .collect();
        let data = Data::new(tree);
        Some(Self {
            case,
            system,
            joints,
            data,
        })
    }

    /// The instant at a fraction of the duration.
    pub fn at(&mut self, fraction: f64) -> Sample {
        let plan = &self.case.trajectory;
        let n = self.system.joint_count();
        let (mut x, mut u) = (vec![0.0; plan.states], vec![0.0; plan.controls]);
        plan.at_fraction(fraction, &mut x, &mut u);
        let (eta, joints) = x.split_at(1);
        let (q, dq) = joints.split_at(n);
        let (tree, attitude) = (self.system.tree().clone(), self.system.attitude());
        tree.kinematics(q, &mut self.data);
        tree.momentum(&mut self.data);
        self.system.base_rate(eta, dq, &mut self.data);
        let base = attitude.base_position(eta, &self.data.system_center);
        let inertial = |v| {
            let turned = attitude.to_inertial(eta, &v);
            [base.x + turned.x, base.y + turned.y]
        };
        let mut skeleton = vec![[base.x, base.y]];
        let places = self
            .joints
            .iter()
            .map(|mount| tree.position(mount, &self.data));
        skeleton.extend(places.map(inertial));
        let hand = tree.end_effector(&self.data).map(|(_, position)| position);
        skeleton.extend(hand.map(inertial));
        Sample {
            t: fraction * plan.duration,
            attitude: eta[0].to_degrees(),
            rate: self.data.base_rate.x.to_degrees(),
            position: [base.x, base.y],
            joints: q.iter().map(|angle| angle.to_degrees()).collect(),
            joint_rates: dq.iter().map(|rate| rate.to_degrees()).collect(),
            skeleton,
        }
    }

    /// Every node and points between them, close enough for a smooth line.
    pub fn samples(&mut self) -> Vec<Sample> {
        let nodes = self.case.trajectory.mesh.node_fractions();
        let even = (0..=200).map(|k| f64::from(k) / 200.0);
        let mut fractions: Vec<f64> = nodes.into_iter().chain(even).collect();
        fractions.sort_by(f64::total_cmp);
        fractions.dedup();
        fractions
            .into_iter()
            .map(|fraction| self.at(fraction))
            .collect()
    }
}
