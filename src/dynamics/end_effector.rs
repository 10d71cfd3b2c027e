//! Pose of the end-effector frame in the base frame.

use super::space::{Planar, Space, Spatial, Vector};
use super::{Data, Model, Tree};
use crate::autodiff::Scalar;
use nalgebra::{Matrix3, Vector2, Vector3};

/// Where the end-effector frame sits: in the body of a joint, or in the base.
#[derive(Debug, Clone)]
pub(super) struct Mount<Sp: Space> {
    pub link: Option<usize>,
    pub orientation: Sp::Orientation<f64>,
    pub offset: Sp::Linear<f64>,
}

impl<Sp: Space> Tree<Sp> {
    /// Whether the robot has an end-effector frame.
    pub fn has_end_effector(&self) -> bool {
        self.mount.is_some()
    }

    /// Orientation and position (m) of the end-effector frame in the base frame; `None` where the
    /// robot has none. Needs [`Tree::kinematics`].
    pub fn end_effector<S: Scalar>(
        &self,
        data: &Data<Sp, S>,
    ) -> Option<(Sp::Orientation<S>, Sp::Linear<S>)> {
        let mount = self.mount.as_ref()?;
        let (body, origin) = match mount.link {
            Some(j) => (data.orientation[j], data.origin[j]),
            None => (Sp::aligned(), Sp::Linear::zero()),
        };
        let position = origin + Sp::rotated(&body, &mount.offset);
        Some((Sp::attached(&body, &mount.orientation), position))
    }
}

impl Mount<Planar> {
    /// In the plane with the given basis; `rotations` are those of the bodies at position zero.
    ///
    /// The heading of the frame is that of its x axis, or of its y axis where x stands on the
    /// plane.
    pub fn planar(model: &Model, basis: &Matrix3<f64>, rotations: &[Matrix3<f64>]) -> Option<Self> {
        let (link, placement) = model.end_effector()?;
        let body = link.map_or(Matrix3::identity(), |j| rotations[j]);
        let flat = |v: Vector3<f64>| -> Vector2<f64> { (basis.transpose() * v).xy() };
        let frame = body * placement.rotation;
        let [x, y] = [0, 1].map(|i| flat(frame.column(i).into_owned()));
        let heading = if x.norm() > 0.5 { x } else { y };
        Some(Self {
            link: *link,
            orientation: heading.normalize(),
            offset: flat(body * placement.translation),
        })
    }
}

impl Mount<Spatial> {
    /// In space; `alignment` turns each body's frame to the one it is compiled in.
    pub fn spatial(model: &Model, alignment: &[Matrix3<f64>]) -> Option<Self> {
        let (link, placement) = model.end_effector()?;
        let body = link.map_or(Matrix3::identity(), |j| alignment[j].transpose());
        let frame = body * placement.rotation;
        Some(Self {
            link: *link,
            orientation: [0, 1, 2].map(|i| frame.column(i).into_owned()),
            offset: body * placement.translation,
        })
    }
}
