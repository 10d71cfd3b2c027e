//! A robot as described, before it becomes a model: bodies can be welded together, joints locked.

use super::bodies::Bodies;
use super::look::Look;
use crate::config::faults::Faults;
use crate::config::figures::Unusable;
use crate::config::{ConfigError, Place};
use crate::dynamics::{Body, Inertia, Joint, JointKind, Model, ModelError, Placement};
use crate::problem::Shape;
use nalgebra::Rotation3;

/// A joint as its file describes it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub joint: Joint,
    /// Where it is described.
    pub place: Place,
    /// What its file should say on its limits and does not.
    pub unlimited: Unlimited,
    /// Why it cannot move by itself, unless it is locked.
    pub refusal: Option<ConfigError>,
}

impl Entry {
    /// A joint of which all is known.
    pub(super) fn new(joint: Joint, place: Place) -> Self {
        Self {
            joint,
            place,
            unlimited: Unlimited::default(),
            refusal: None,
        }
    }
}

/// Limits that are taken as infinite because the file leaves them out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Unlimited {
    pub position: bool,
    pub velocity: bool,
    pub effort: bool,
}

/// A named frame that is no body of its own.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Frame {
    pub name: String,
    /// The joint whose body carries it; `None` for the base.
    pub carrier: Option<usize>,
    /// Its pose in that body's frame.
    pub placement: Placement,
}

/// Joints in any order in which parents come first.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Description {
    pub name: String,
    pub base: Body,
    pub joints: Vec<Entry>,
    /// Bodies that have become part of others.
    pub frames: Vec<Frame>,
    pub end_effector: Option<(Option<usize>, Placement)>,
    /// What bodies fill by their names, in their own frames; an error for a part that is no shape
    /// that is known.
    pub collisions: Vec<(String, Vec<Result<Shape, ConfigError>>)>,
    /// What is drawn of bodies by their names, in their own frames.
    pub looks: Vec<(String, Vec<Look>)>,
    /// What is wrong with the file, though the rest of it could be read.
    pub faults: Faults,
    /// Mass properties that cannot be used, by their bodies; these are massless until
    /// [`Description::settle`].
    pub unusable: Vec<(String, Unusable)>,
    /// Mass properties of the bodies that `robot.bodies` changes, in their own frames.
    pub changed: Vec<(String, Inertia)>,
    /// Whether the root link is but a frame: what is fixed to it is the base then.
    pub root_is_frame: bool,
    /// Where a robot none of whose links says its mass is described.
    pub kinematic: Option<Place>,
}

impl Description {
    /// A robot without joints.
    pub(super) fn new(name: &str, base: Body) -> Self {
        Self {
            name: name.into(),
            base,
            joints: Vec::new(),
            frames: Vec::new(),
            end_effector: None,
            collisions: Vec::new(),
            looks: Vec::new(),
            faults: Faults::default(),
            unusable: Vec::new(),
            changed: Vec::new(),
            root_is_frame: false,
            kinematic: None,
        }
    }

    /// Keeps the mass properties that a body went in with where `bodies` change it.
    pub(super) fn change(
        &mut self,
        name: &str,
        bodies: &Bodies,
        inertia: &Result<Inertia, Unusable>,
    ) {
        if let (true, Ok(inertia)) = (bodies.has(name), inertia) {
            self.changed.push((name.into(), inertia.clone()));
        }
    }

    /// The shapes of the body `name` in its own frame; none where its file gives none.
    pub(super) fn collisions(&self, name: &str) -> &[Result<Shape, ConfigError>] {
        let of_that_name = self.collisions.iter().find(|(body, _)| body == name);
        of_that_name.map_or(&[], |(_, shapes)| shapes)
    }

    /// Names of the joints that can move.
    pub(super) fn joint_names(&self) -> Vec<&str> {
        self.joints
            .iter()
            .map(|entry| entry.joint.name.as_str())
            .collect()
    }

    /// Where the body `name` is, or the body moved by the joint of that name: the joint that
    /// carries it (`None` for the base) and the pose in that joint's body.
    pub(super) fn find(&self, name: &str) -> Option<(Option<usize>, Placement)> {
        let moved = || {
            let joint = self.joints.iter().position(|e| e.joint.name == name)?;
            Some((Some(joint), Placement::identity()))
        };
        self.body(name).or_else(moved)
    }

    /// Where the body `name` is, as in [`Description::find`].
    pub(super) fn body(&self, name: &str) -> Option<(Option<usize>, Placement)> {
        if self.base.name == name {
            return Some((None, Placement::identity()));
        }
        let of_that_name = |entry: &Entry| entry.joint.body.name == name;
        if let Some(joint) = self.joints.iter().position(of_that_name) {
            return Some((Some(joint), Placement::identity()));
        }
        let frame = self.frames.iter().find(|frame| frame.name == name)?;
        Some((frame.carrier, frame.placement.clone()))
    }

    /// Names of the base, of the bodies that move and of those that have become part of others.
    pub(super) fn body_names(&self) -> impl Iterator<Item = &str> {
        let bodies = self.joints.iter().map(|entry| &entry.joint.body.name);
        let frames = self.frames.iter().map(|frame| &frame.name);
        std::iter::once(&self.base.name)
            .chain(bodies)
            .chain(frames)
            .map(String::as_str)
    }

    /// The body in whose frame the end effector stands; the one that carries it, and where, if it
    /// is at no body's frame.
    pub(super) fn end_effector_name(&self) -> Option<String> {
        let (carrier, placement) = self.end_effector.as_ref()?;
        let apart = |other: &Placement| {
            (other.translation - placement.translation).norm()
                + (other.rotation - placement.rotation).norm()
        };
        let still = Placement::identity();
        let base = std::iter::once((&self.base.name, None, &still));
        let moving = self.joints.iter().enumerate();
        let moving = moving.map(|(j, entry)| (&entry.joint.body.name, Some(j), &still));
        let frames = self.frames.iter();
        let frames = frames.map(|frame| (&frame.name, frame.carrier, &frame.placement));
        let mut names = base
            .chain(moving)
            .chain(frames)
            .filter(|(_, joint, at)| joint == carrier && apart(at) < 1e-9)
            .map(|(name, ..)| name.to_owned());
        // The last is the one nearest to the tip.
        names.next_back().or_else(|| {
            let body = match carrier {
                Some(joint) => &self.joints[*joint].joint.body.name,
                None => &self.base.name,
            };
            let shown = |v: f64| (v * 1e6).round() / 1e6 + 0.0;
            let [x, y, z] = <[f64; 3]>::from(placement.translation).map(shown);
            Some(format!("on {body}, at ({x}, {y}, {z}) m in its frame"))
        })
    }

    /// The names [`Description::find`] knows, for a message.
    pub(super) fn expected_names(&self) -> String {
        let names: Vec<&str> = self.body_names().collect();
        format!("a body or joint of the robot: {}", names.join(", "))
    }

    /// Puts the end effector at the frame of a body; false where there is no such body.
    pub(super) fn set_end_effector(&mut self, name: &str) -> bool {
        let found = self.find(name);
        let known = found.is_some();
        self.end_effector = found.or(self.end_effector.take());
        known
    }

    /// Makes `part` one with the body of the joint `carrier` (or the base), in whose frame it has
    /// the given placement. Its frame is still known by its name.
    pub(super) fn weld(&mut self, part: Body, carrier: Option<usize>, placement: Placement) {
        let moved = part
            .inertia
            .placed(&placement.rotation, &placement.translation);
        self.add(&moved, carrier);
        self.frames.push(Frame {
            name: part.name,
            carrier,
            placement,
        });
    }

    /// Adds mass to a body, given in its frame.
    pub(super) fn add(&mut self, inertia: &Inertia, carrier: Option<usize>) {
        let body = match carrier {
            Some(joint) => &mut self.joints[joint].joint.body,
            None => &mut self.base,
        };
        body.inertia = body.inertia.lumped(inertia);
    }

    /// Welds the joint `name` at `position` (rad or m): its body becomes part of the one that
    /// carries it. False where there is no such joint.
    pub(super) fn lock(&mut self, name: &str, position: f64) -> bool {
        let Some(locked) = self.joints.iter().position(|e| e.joint.name == name) else {
            return false;
        };
        let joint = self.joints.remove(locked).joint;
        let weld = joint.placement.then(&motion(&joint, position));
        let moved = |parent: Option<usize>, placement: &mut Placement| match parent {
            Some(p) if p == locked => {
                *placement = weld.then(placement);
                joint.parent
            }
            Some(p) if p > locked => Some(p - 1),
            other => other,
        };
        for Entry { joint: child, .. } in &mut self.joints {
            child.parent = moved(child.parent, &mut child.placement);
        }
        for frame in &mut self.frames {
            frame.carrier = moved(frame.carrier, &mut frame.placement);
        }
        if let Some((parent, placement)) = &mut self.end_effector {
            *parent = moved(*parent, placement);
        }
        self.weld(joint.body, joint.parent, weld);
        true
    }

    /// Orders the joints depth-first, those of one body in the order of the description.
    pub(super) fn sort(&mut self) {
        let order = depth_first(&self.joints);
        let mut renumbered = vec![0; order.len()];
        for (new, &old) in order.iter().enumerate() {
            renumbered[old] = new;
        }
        let renumber = |joint: &mut Option<usize>| *joint = joint.map(|old| renumbered[old]);
        self.joints = order.iter().map(|&old| self.joints[old].clone()).collect();
        for entry in &mut self.joints {
            renumber(&mut entry.joint.parent);
        }
        for frame in &mut self.frames {
            renumber(&mut frame.carrier);
        }
        if let Some((parent, _)) = &mut self.end_effector {
            renumber(parent);
        }
    }

    /// The model, its joints in the order they have here.
    pub(super) fn model(&self) -> Result<Model, ModelError> {
        let joints = self.joints.iter().map(|entry| entry.joint.clone());
        let model = Model::new(&self.name, self.base.clone(), joints.collect())?;
        Ok(match &self.end_effector {
            Some((joint, placement)) => model.with_end_effector(*joint, placement.clone()),
            None => model,
        })
    }
}

fn depth_first(joints: &[Entry]) -> Vec<usize> {
    let mut children = vec![Vec::new(); joints.len()];
    let mut next = Vec::new();
    for (child, entry) in joints.iter().enumerate().rev() {
        match entry.joint.parent {
            Some(parent) => children[parent].push(child),
            None => next.push(child),
        }
    }
    let mut order = Vec::with_capacity(joints.len());
    while let Some(joint) = next.pop() {
        order.push(joint);
        next.append(&mut children[joint]);
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::JointLimits;
    use nalgebra::{Matrix3, Vector3};
    use std::f64::consts::FRAC_PI_2;

    fn body(name: &str) -> Body {
        let inertia = Inertia::new(1.0, Vector3::new(0.5, 0.0, 0.0), Matrix3::identity()).unwrap();
        Body {
            name: name.into(),
            inertia,
        }
    }

    fn joint(name: &str, parent: Option<usize>) -> Entry {
        let place = Place {
            source: "r.toml".into(),
            line: None,
        };
        let joint = Joint {
            name: name.into(),
            kind: JointKind::Revolute,
            parent,
            placement: Placement::from_xyz_rpy([1.0, 0.0, 0.0], [0.0; 3]),
            axis: Vector3::z_axis(),
            limits: JointLimits::NONE,
            body: body(&format!("{name}_link")),
        };
        Entry::new(joint, place)
    }

    fn description(joints: Vec<Entry>) -> Description {
        Description {
            end_effector: Some((Some(joints.len() - 1), Placement::identity())),
            joints,
            ..Description::new("r", body("base"))
        }
    }

    fn model(mut robot: Description) -> Model {
        robot.sort();
        robot.model().unwrap()
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
        let model = model(robot);
        let carrier = &model.joints()[0].body.inertia;
        assert_eq!(carrier.mass(), 2.0);
        // One mass centre at 0.5, the other half a metre to the side of joint b at 1.
        assert!((carrier.center() - Vector3::new(0.75, 0.25, 0.0)).norm() < 1e-15);
        let c = &model.joints()[1];
        assert_eq!((c.name.as_str(), c.parent), ("c", Some(0)));
        assert!((c.placement.translation - Vector3::new(1.0, 1.0, 0.0)).norm() < 1e-15);
        assert_eq!(model.end_effector().unwrap().joint, Some(1));
        assert!((model.total_mass() - 4.0).abs() < 1e-15);
    }

    #[test]
    fn a_locked_body_keeps_its_name_as_a_frame() {
        let mut robot = description(vec![
            joint("a", None),
            joint("b", Some(0)),
            joint("c", Some(1)),
        ]);
        assert!(robot.lock("b", FRAC_PI_2));
        assert!(robot.lock("a", 0.0));
        let (carrier, placement) = robot.find("b_link").unwrap();
        assert_eq!(carrier, None);
        assert!((placement.translation - Vector3::new(2.0, 0.0, 0.0)).norm() < 1e-15);
        assert!((placement.rotation * Vector3::x() - Vector3::y()).norm() < 1e-15);
        assert!(robot.set_end_effector("a_link") && !robot.set_end_effector("d_link"));
        assert_eq!(
            model(robot).end_effector().unwrap().placement.translation.x,
            1.0
        );
    }

    #[test]
    fn joints_come_depth_first() {
        let robot = description(vec![
            joint("left", None),
            joint("right", None),
            joint("left2", Some(0)),
            joint("right2", Some(1)),
        ]);
        let model = model(robot);
        let names: Vec<&str> = model.joints().iter().map(|j| j.name.as_str()).collect();
        assert_eq!(names, ["left", "left2", "right", "right2"]);
        assert_eq!(model.joints()[3].parent, Some(2));
        assert_eq!(model.end_effector().unwrap().joint, Some(3));
    }
}
