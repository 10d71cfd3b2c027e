//! The momentum connection η̇ = A(θ)·θ̇ of a planar arm with two joints, and its curvature.

use crate::autodiff::Dual;
use crate::dynamics::space::Planar;
use crate::dynamics::{Data, Model, Tree};

/// The momentum connection of a planar arm with two joints.
///
/// With zero momentum the base turns by the integral of A along the joint path (5). Two paths
/// between the same ends differ by the integral of the curvature ∂A₂/∂θ₁ − ∂A₁/∂θ₂ over the area
/// between them (Stokes), whatever the speed along them.
#[derive(Debug, Clone)]
pub struct Connection {
    tree: Tree<Planar>,
}

/// What the curvature says about a box of joint angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvatureBound {
    /// Largest magnitude of the curvature.
    pub largest: f64,
    /// Where that is, rad.
    pub at: [f64; 2],
    /// Turn of the base by one loop around the whole box, rad.
    pub box_loop: f64,
    /// Integrals of the positive and of the negative part over the box, rad: what one loop gains
    /// at most in either sense.
    pub parts: [f64; 2],
}

impl Connection {
    /// The connection of `robot`; `None` unless it is planar with two joints.
    pub fn new(robot: &Model) -> Option<Self> {
        let tree = Tree::planar(robot).filter(|tree| tree.joint_count() == 2)?;
        Some(Self { tree })
    }

    /// A with its derivatives by both joint angles.
    fn at(&self, theta: [f64; 2]) -> [Dual<2>; 2] {
        let mut data = Data::<Planar, Dual<2>>::new(&self.tree);
        let q = [Dual::seeded(theta[0], 0), Dual::seeded(theta[1], 1)];
        self.tree.kinematics(&q, &mut data);
        self.tree.momentum(&mut data);
        let constant = |value| Dual {
            value,
            gradient: [0.0; 2],
        };
        [[1.0, 0.0], [0.0, 1.0]].map(|rates| {
            self.tree.base_rate(&rates.map(constant), &mut data);
            data.base_rate.x
        })
    }

    /// A: turn of the base per unit of each joint's motion.
    pub fn coefficients(&self, theta: [f64; 2]) -> [f64; 2] {
        self.coefficients_in(&mut self.scratch(), theta)
    }

    /// Memory for [`coefficients_in`](Self::coefficients_in).
    pub(super) fn scratch(&self) -> Data<Planar, f64> {
        Data::new(&self.tree)
    }

    /// [`coefficients`](Self::coefficients), with memory to work in.
    pub(super) fn coefficients_in(
        &self,
        data: &mut Data<Planar, f64>,
        theta: [f64; 2],
    ) -> [f64; 2] {
        self.tree.kinematics(&theta, data);
        self.tree.momentum(data);
        [[1.0, 0.0], [0.0, 1.0]].map(|rates| {
            self.tree.base_rate(&rates, data);
            data.base_rate.x
        })
    }

    /// The curvature ∂A₂/∂θ₁ − ∂A₁/∂θ₂, exact by dual numbers.
    pub fn curvature(&self, theta: [f64; 2]) -> f64 {
        let [first, second] = self.at(theta);
        second.gradient[0] - first.gradient[1]
    }

    /// Its bound over the box [low, high] of both joints, on a grid of `cells` by `cells`
    /// midpoints, edges included for the largest value.
    pub fn over(&self, low: [f64; 2], high: [f64; 2], cells: usize) -> CurvatureBound {
        let size = [0, 1].map(|i| (high[i] - low[i]) / cells as f64);
        let area = size[0] * size[1];
        let mut bound = CurvatureBound {
            largest: 0.0,
            at: low,
            box_loop: 0.0,
            parts: [0.0; 2],
        };
        let mut see = |value: f64, theta: [f64; 2]| {
            if value.abs() > bound.largest {
                (bound.largest, bound.at) = (value.abs(), theta);
            }
        };
        for i in 0..=cells {
            for j in 0..=cells {
                let corner = [low[0] + i as f64 * size[0], low[1] + j as f64 * size[1]];
                see(self.curvature(corner), corner);
            }
        }
        for i in 0..cells {
            for j in 0..cells {
                let middle = [
                    low[0] + (i as f64 + 0.5) * size[0],
                    low[1] + (j as f64 + 0.5) * size[1],
                ];
                let turn = area * self.curvature(middle);
                bound.parts[usize::from(turn < 0.0)] += turn;
            }
        }
        bound.box_loop = bound.parts[0] + bound.parts[1];
        bound
    }
}
