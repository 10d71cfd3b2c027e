//! How far a frame can be: bounds on its distance from the base and from the system's mass centre,
//! whatever the joints' angles.
//!
//! Derived in docs/algorithms.md#reach.

use super::algebra::{Algebra, Vector};
use super::{JointKind, Mount, Tree};

/// A ball that a point never leaves.
#[derive(Debug, Clone, Copy)]
pub struct Ball<Sp: Algebra> {
    /// Its centre, m.
    pub center: Sp::Linear<f64>,
    /// Its radius, m; infinite where a joint slides without end.
    pub radius: f64,
}

impl<Sp: Algebra> Tree<Sp> {
    /// The ball, in base axes, in which a mounted frame's origin stays. `travel` is how far each
    /// joint slides at most, m.
    pub fn reach_from_base(&self, mount: &Mount<Sp>, travel: &[f64]) -> Ball<Sp> {
        let mut ball = Ball {
            center: mount.offset,
            radius: 0.0,
        };
        let mut body = mount.link;
        while let Some(k) = body {
            ball.radius += norm::<Sp>(&ball.center) + self.slides(k, travel);
            ball.center = self.links[k].offset;
            body = self.links[k].parent;
        }
        ball
    }

    /// The largest distance of a mounted frame's origin from the system's mass centre, m.
    ///
    /// That distance is a sum of one vector a body, fixed in it: the way through this body from
    /// each body's mass to the frame, weighed with the masses.
    pub fn reach_from_center(&self, mount: &Mount<Sp>, travel: &[f64]) -> f64 {
        let bodies = (0..self.links.len()).map(Some).chain([None]);
        let turned: f64 = bodies
            .map(|body| norm::<Sp>(&self.way_through(body, mount)))
            .sum();
        let slid = (0..self.links.len()).map(|k| {
            let beyond = self.links[k].carried / self.total_mass;
            let share = match self.carries(k, mount.link) {
                true => 1.0 - beyond,
                false => beyond,
            };
            // Nothing is carried where a massless body slides without end.
            if share > 0.0 {
                share * self.slides(k, travel)
            } else {
                0.0
            }
        });
        turned + slid.sum::<f64>()
    }

    /// The ways through `body` of all masses whose way to the frame leads through it, weighed with
    /// their shares of the total mass.
    fn way_through(&self, body: Option<usize>, mount: &Mount<Sp>) -> Sp::Linear<f64> {
        let children = || (0..self.links.len()).filter(|&c| self.links[c].parent == body);
        let exit_joint = children().find(|&c| self.carries(c, mount.link));
        let towards_base = body.is_some_and(|k| !self.carries(k, mount.link));
        let exit = match exit_joint {
            Some(child) => self.links[child].offset,
            None if towards_base => Sp::Linear::zero(),
            None => mount.offset,
        };
        let (mass, center) = match body {
            Some(k) => (self.links[k].mass, self.links[k].center),
            None => (self.base_mass, self.base_center),
        };
        let mut way = (exit - center).times(mass / self.total_mass);
        for child in children().filter(|child| Some(*child) != exit_joint) {
            let link = &self.links[child];
            way += (exit - link.offset).times(link.carried / self.total_mass);
        }
        match body.filter(|_| !towards_base) {
            Some(k) => way + exit.times(1.0 - self.links[k].carried / self.total_mass),
            None => way,
        }
    }

    /// How far joint `k` slides at most, m; 0 where it turns.
    fn slides(&self, k: usize, travel: &[f64]) -> f64 {
        match self.links[k].kind {
            JointKind::Revolute => 0.0,
            JointKind::Prismatic => travel[k],
        }
    }
}

/// Length of a vector.
pub(super) fn norm<Sp: Algebra>(vector: &Sp::Linear<f64>) -> f64 {
    let squares: f64 = vector.components().iter().map(|c| c * c).sum();
    squares.sqrt()
}
