//! A robot as described, before it becomes a model: joints can be locked and renamed.

use crate::dynamics::{Body, Joint, JointKind, Model, ModelError, Placement};
use nalgebra::Rotation3;

/// Joints in any order in which parents come first.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Description {
    pub name: String,
    pub base: Body,
    pub joints: Vec<Joint>,
    pub end_effector: Option<(Option<usize>, Placement)>,
}

impl Description {
    /// Names of the joints that can move.
    pub(super) fn joint_names(&self) -> Vec<&str> {
        self.joints
            .iter()
            .map(|joint| joint.name.as_str())
            .collect()
    }

    /// Index of the joint that moves the body `name`, or of the joint of that name; the base
    /// is `Some(None)`.
    pub(super) fn carrier(&self, name: &str) -> Option<Option<usize>> {
        if self.base.name == name {
            return Some(None);
        }
        let position = |f: fn(&Joint) -> &str| self.joints.iter().position(|j| f(j) == name);
        position(|joint| &joint.body.name)
            .or_else(|| position(|joint| &joint.name))
            .map(Some)
    }

    /// The names [`Description::carrier`] knows, for a message.
    pub(super) fn expected_names(&self) -> String {
        let bodies = self.joints.iter().map(|joint| joint.body.name.as_str());
        let names: Vec<&str> = std::iter::once(self.base.name.as_str())
            .chain(bodies)
            .collect();
        format!("a body or joint of the robot: {}", names.join(", "))
    }

    /// Puts the end effector at the frame of a body; false where there is no such body.
    pub(super) fn set_end_effector(&mut self, name: &str) -> bool {
        let carrier = self.carrier(name);
        if let Some(carrier) = carrier {
            self.end_effector = Some((carrier, Placement::identity()));
        }
        carrier.is_some()
    }

    /// Welds the joint `name` at `position` (rad or m): its body becomes part of the one that
    /// carries it. False where there is no such joint.
    pub(super) fn lock(&mut self, name: &str, position: f64) -> bool {
        let Some(locked) = self.joints.iter().position(|joint| joint.name == name) else {
            return false;
        };
        let joint = self.joints.remove(locked);
        let weld = compose(&joint.placement, &motion(&joint, position));
        let part = joint.body.inertia.placed(&weld.rotation, &weld.translation);
        let carrier = match joint.parent {
            Some(parent) => &mut self.joints[parent].body,
            None => &mut self.base,
        };
        carrier.inertia = carrier.inertia.lumped(&part);
        let moved = |parent: Option<usize>, placement: &mut Placement| match parent {
            Some(p) if p == locked => {
                *placement = compose(&weld, placement);
                joint.parent
            }
            Some(p) if p > locked => Some(p - 1),
            other => other,
        };
        for child in &mut self.joints {
            child.parent = moved(child.parent, &mut child.placement);
        }
        if let Some((parent, placement)) = &mut self.end_effector {
            *parent = moved(*parent, placement);
        }
        true
    }

    /// The model, its joints depth-first in the order of the description.
    pub(super) fn into_model(self) -> Result<Model, ModelError> {
        let order = depth_first(&self.joints);
        let mut renumbered = vec![0; order.len()];
        for (new, &old) in order.iter().enumerate() {
            renumbered[old] = new;
        }
        let joints = order
            .iter()
            .map(|&old| {
                let mut joint = self.joints[old].clone();
                joint.parent = joint.parent.map(|parent| renumbered[parent]);
                joint
            })
            .collect();
        let model = Model::new(&self.name, self.base, joints)?;
        Ok(match self.end_effector {
            Some((joint, placement)) => {
                model.with_end_effector(joint.map(|joint| renumbered[joint]), placement)
            }
            None => model,
        })
    }
}

fn depth_first(joints: &[Joint]) -> Vec<usize> {
    fn visit(joints: &[Joint], parent: Option<usize>, order: &mut Vec<usize>) {
        for (child, joint) in joints.iter().enumerate() {
            if joint.parent == parent {
                order.push(child);
                visit(joints, Some(child), order);
            }
        }
    }
    let mut order = Vec::with_capacity(joints.len());
    visit(joints, None, &mut order);
    order
}

/// Where the joint has moved its body, in the joint frame.
fn motion(joint: &Joint, position: f64) -> Placement {
    let still = Placement::identity();
    match joint.kind {
        JointKind::Revolute => Placement {
            rotation: Rotation3::from_axis_angle(&joint.axis, position).into_inner(),
            ..still
        },
        JointKind::Prismatic => Placement {
            translation: joint.axis.into_inner() * position,
            ..still
        },
    }
}

/// The placement of a frame given in `inner`, itself placed by `outer`.
fn compose(outer: &Placement, inner: &Placement) -> Placement {
    Placement {
        rotation: outer.rotation * inner.rotation,
        translation: outer.translation + outer.rotation * inner.translation,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::{Inertia, JointLimits};
    use nalgebra::{Matrix3, Vector3};
    use std::f64::consts::FRAC_PI_2;

    fn body(name: &str) -> Body {
        let inertia = Inertia::new(1.0, Vector3::new(0.5, 0.0, 0.0), Matrix3::identity()).unwrap();
        Body {
            name: name.into(),
            inertia,
        }
    }

    fn joint(name: &str, parent: Option<usize>) -> Joint {
        Joint {
            name: name.into(),
            kind: JointKind::Revolute,
            parent,
            placement: Placement::from_xyz_rpy([1.0, 0.0, 0.0], [0.0; 3]),
            axis: Vector3::z_axis(),
            limits: JointLimits::NONE,
            body: body(&format!("{name}_link")),
        }
    }

    fn description(joints: Vec<Joint>) -> Description {
        let end_effector = Some((Some(joints.len() - 1), Placement::identity()));
        Description {
            name: "r".into(),
            base: body("base"),
            joints,
            end_effector,
        }
    }

    #[test]
    fn a_locked_joint_becomes_part_of_its_carrier() {
        let mut robot = description(vec![
            joint("a", None),
            joint("b", Some(0)),
            joint("c", Some(1)),
        ]);
        assert!(robot.lock("b", FRAC_PI_2));
        assert!(!robot.lock("b", 0.0));
        let model = robot.into_model().unwrap();
        let carrier = &model.joints()[0].body.inertia;
        assert_eq!(carrier.mass(), 2.0);
        // One mass centre at 0.5, the other half a metre to the side of joint b at 1.
        assert!((carrier.center() - Vector3::new(0.75, 0.25, 0.0)).norm() < 1e-15);
        let c = &model.joints()[1];
        assert_eq!((c.name.as_str(), c.parent), ("c", Some(0)));
        assert!((c.placement.translation - Vector3::new(1.0, 1.0, 0.0)).norm() < 1e-15);
        assert_eq!(model.end_effector().unwrap().0, Some(1));
        assert!((model.total_mass() - 4.0).abs() < 1e-15);
    }

    #[test]
    fn joints_come_depth_first() {
        let robot = description(vec![
            joint("left", None),
            joint("right", None),
            joint("left2", Some(0)),
            joint("right2", Some(1)),
        ]);
        let model = robot.into_model().unwrap();
        let names: Vec<&str> = model.joints().iter().map(|j| j.name.as_str()).collect();
        assert_eq!(names, ["left", "left2", "right", "right2"]);
        assert_eq!(model.joints()[3].parent, Some(2));
        assert_eq!(model.end_effector().unwrap().0, Some(3));
    }
}
