//! The robot as a model of MuJoCo, with the motion as keyframes.
//!
//! [`PLAYER`] plays the motion in it: joints are driven, the base is free.

use super::Samples;
use crate::dynamics::{Body, Inertia, JointKind, Model};
use crate::text::printable::xml_text;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use std::fmt::Write;

/// A program in Python that plays `motion.csv` in `model.xml`, both beside it, and says how far the base ends
/// from the plan.
pub const PLAYER: &str = include_str!("play.py");

/// Keyframes, from the start to the end.
const KEYS: usize = 11;

/// Part of the robot's largest moment of inertia that is added to all moments, and the same of its mass to
/// bodies without: MuJoCo takes no body of no mass, and no moments that are, by a rounding, none of a body.
const ADDED: f64 = 1e-11;

/// A model in MJCF: no gravity, no contacts, no friction; angles in rad, everything else in SI units. The
/// base is a free body, named as the robot's root link; joints have motors that bear the joints' names.
///
/// Joint limits are in it as data, but do not act: a plan may lie on them.
pub fn mjcf(robot: &Model, samples: &Samples) -> String {
    let mut text = Text {
        text: String::new(),
        least: Least::of(robot),
    };
    text.line(0, &format!("<mujoco model=\"{}\">", xml_text(robot.name())));
    text.line(1, "<compiler angle=\"radian\"/>");
    text.line(
        1,
        "<option gravity=\"0 0 0\" integrator=\"RK4\" timestep=\"0.002\"/>",
    );
    text.line(
        1,
        "<visual><global offwidth=\"1280\" offheight=\"960\"/></visual>",
    );
    text.line(1, "<worldbody>");
    text.line(
        2,
        "<light pos=\"0 0 10\" dir=\"0 0 -1\" directional=\"true\"/>",
    );
    text.line(
        2,
        &format!("<body name=\"{}\">", xml_text(&robot.base().name)),
    );
    text.line(3, "<freejoint/>");
    text.body(3, robot.base());
    text.block(3, &robot.base().inertia);
    text.children(3, robot, None);
    text.line(2, "</body>");
    text.line(1, "</worldbody>");
    text.line(1, "<actuator>");
    for joint in robot.joints() {
        let name = xml_text(&joint.name);
        text.line(2, &format!("<motor name=\"{name}\" joint=\"{name}\"/>"));
    }
    text.line(1, "</actuator>");
    text.line(1, "<keyframe>");
    text.keys(samples);
    text.line(1, "</keyframe>");
    text.line(0, "</mujoco>");
    text.text
}

/// The least that a body needs.
struct Least {
    mass: f64,
    moment: f64,
}

impl Least {
    fn of(robot: &Model) -> Self {
        let joints = robot.joints().iter().map(|joint| &joint.body);
        let bodies = joints.chain([robot.base()]);
        let moments = bodies.map(|body| body.inertia.rotational().diagonal().max());
        Self {
            mass: ADDED * robot.total_mass(),
            moment: ADDED * moments.fold(0.0, f64::max),
        }
    }
}

struct Text {
    text: String,
    least: Least,
}

impl Text {
    fn line(&mut self, depth: usize, line: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.text, "{:1$}{line}", "", 2 * depth);
    }

    /// The bodies that the joints on the body of `parent` carry, and all that those carry.
    fn children(&mut self, depth: usize, robot: &Model, parent: Option<usize>) {
        for (j, joint) in robot.joints().iter().enumerate() {
            if joint.parent != parent {
                continue;
            }
            let place = &joint.placement;
            self.line(
                depth,
                &format!(
                    "<body name=\"{}\" pos=\"{}\" quat=\"{}\">",
                    xml_text(&joint.body.name),
                    list(place.translation.as_slice()),
                    list(&quaternion(&place.rotation))
                ),
            );
            let kind = match joint.kind {
                JointKind::Revolute => "hinge",
                JointKind::Prismatic => "slide",
            };
            let [lower, upper] = joint.limits.position;
            let range = match lower.is_finite() && upper.is_finite() && lower < upper {
                true => format!(" range=\"{}\"", list(&[lower, upper])),
                false => String::new(),
            };
            self.line(
                depth + 1,
                &format!(
                    "<joint name=\"{}\" type=\"{kind}\" axis=\"{}\"{range} limited=\"false\"/>",
                    xml_text(&joint.name),
                    list(joint.axis.as_slice())
                ),
            );
            self.body(depth + 1, &joint.body);
            let next = robot.joints().iter().filter(|next| next.parent == Some(j));
            let mut ends: Vec<Vector3<f64>> = next.map(|next| next.placement.translation).collect();
            if let Some(effector) = robot.end_effector().filter(|at| at.joint == Some(j)) {
                ends.push(effector.placement.translation);
            }
            if ends.is_empty() {
                // As far beyond the mass centre as the joint is before it.
                ends.push(2.0 * joint.body.inertia.center());
            }
            self.links(depth + 1, robot, &ends);
            self.children(depth + 1, robot, Some(j));
            self.line(depth, "</body>");
        }
    }

    /// Mass properties.
    fn body(&mut self, depth: usize, body: &Body) {
        let (inertia, least) = (&body.inertia, &self.least);
        let mass = inertia.mass().max(least.mass);
        let moments = within_triangle(inertia) + Matrix3::identity() * least.moment;
        let full = [
            moments[(0, 0)],
            moments[(1, 1)],
            moments[(2, 2)],
            moments[(0, 1)],
            moments[(0, 2)],
            moments[(1, 2)],
        ];
        self.line(
            depth,
            &format!(
                "<inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"/>",
                list(inertia.center().as_slice()),
                number(mass),
                list(&full)
            ),
        );
    }

    /// The block of even density with these mass properties, to be seen alone.
    fn block(&mut self, depth: usize, inertia: &Inertia) {
        let (half, mut axes) = inertia.even_block();
        // MuJoCo takes no shape without size.
        let half = half.map(|side| side.max(1e-3));
        if axes.determinant() < 0.0 {
            axes.column_mut(2).neg_mut();
        }
        self.line(
            depth,
            &format!(
                "<geom type=\"box\" size=\"{}\" pos=\"{}\" quat=\"{}\" {SEEN} rgba=\"0.6 0.65 0.7 0.6\"/>",
                list(&half),
                list(inertia.center().as_slice()),
                list(&quaternion(&axes))
            ),
        );
    }

    /// Capsules from the joint to what it carries, to be seen alone.
    fn links(&mut self, depth: usize, robot: &Model, ends: &[Vector3<f64>]) {
        let reach: f64 = robot
            .joints()
            .iter()
            .map(|joint| joint.placement.translation.norm())
            .sum();
        let radius = (0.03 * reach / robot.joint_count() as f64).max(1e-3);
        for end in ends.iter().filter(|end| end.norm() > radius) {
            self.line(
                depth,
                &format!(
                    "<geom type=\"capsule\" fromto=\"0 0 0 {}\" size=\"{}\" {SEEN} rgba=\"0 0.45 0.7 1\"/>",
                    list(end.as_slice()),
                    number(radius)
                ),
            );
        }
    }

    fn keys(&mut self, samples: &Samples) {
        let last = samples.t.len().saturating_sub(1);
        let mut before = None;
        for k in (0..KEYS).map(|key| key * last / (KEYS - 1)) {
            if before == Some(k) {
                continue;
            }
            before = Some(k);
            let base = &samples.base[k];
            let qpos = [
                &base.position[..],
                &base.quaternion,
                &samples.joint_position[k],
            ];
            let qvel = [
                &base.velocity[..],
                &base.angular_velocity,
                &samples.joint_velocity[k],
            ];
            self.line(
                2,
                &format!(
                    "<key name=\"t={}\" time=\"{}\" qpos=\"{}\" qvel=\"{}\" ctrl=\"{}\"/>",
                    number(samples.t[k]),
                    number(samples.t[k]),
                    list(&qpos.concat()),
                    list(&qvel.concat()),
                    list(&samples.joint_torque[k])
                ),
            );
        }
    }
}

/// The rotational inertia, or where a moment exceeds the sum of the others the nearest of which none does:
/// published figures are rounded, and MuJoCo takes none of these.
fn within_triangle(inertia: &Inertia) -> Matrix3<f64> {
    let moments = inertia.rotational().symmetric_eigenvalues();
    if 2.0 * moments.max() <= moments.sum() {
        return *inertia.rotational();
    }
    *Inertia::nearest(inertia.mass(), inertia.rotational()).rotational()
}

/// A shape that is seen and does nothing else.
const SEEN: &str = "contype=\"0\" conaffinity=\"0\" mass=\"0\"";

/// w, x, y, z of a rotation matrix.
fn quaternion(rotation: &Matrix3<f64>) -> [f64; 4] {
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation));
    [turn.w, turn.i, turn.j, turn.k]
}

fn list(values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| number(*value)).collect();
    values.join(" ")
}

/// All digits.
fn number(value: f64) -> String {
    format!("{value:?}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounded_moments_become_those_of_a_body() {
        let moments = |c: f64| Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, c));
        let inertia = |c| Inertia::new(1.0, Vector3::zeros(), moments(c)).unwrap();
        assert_eq!(within_triangle(&inertia(1.9)), moments(1.9));
        // A thousandth too much is taken for rounding.
        let found = within_triangle(&inertia(2.001));
        assert!(
            found[(2, 2)] <= (found[(0, 0)] + found[(1, 1)]) * (1.0 + 1e-12),
            "{found}"
        );
        assert!((found - moments(2.001)).amax() < 1e-3, "{found}");
    }
}
