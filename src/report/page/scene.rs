//! What the playback shows: points and lines of the robot at even times.

use super::marks::{Mark, marks};
use super::pose::{base_pose, from_picture};
use super::solids::{Faceted, Solids};
use crate::dynamics::{Body, Model};
use crate::problem::{KeepOut, Problem, Solid};
use crate::system::{Trajectory, base_angles};
use crate::text::digits;
use crate::transcription::Discretization;
use crate::verify::bodies::{BaseMotion, Bodies};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use serde::Serialize;

/// Part of the picture's size to which points are rounded.
const ROUNDING: f64 = 1e-4;

/// Motions that are played beside each other.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Scene {
    /// s
    duration: f64,
    /// Whether the motion stays in the plane of the first two axes.
    planar: bool,
    /// Edges of the base between the first points of a frame.
    box_edges: Vec<[usize; 2]>,
    /// Links between points of a frame.
    links: Vec<[usize; 2]>,
    /// Whether each of the links is drawn as a capsule: it has no solids.
    bare: Vec<bool>,
    /// Radius of these capsules, m.
    radius: f64,
    /// Whether the base's block is filled; else it only says where the base's solids reach.
    has_block: bool,
    solids: Vec<Faceted>,
    /// Points of a frame that are joints.
    joints: Vec<usize>,
    /// Points of a frame at the ends of arms.
    tips: Vec<usize>,
    /// Spheres and capsules that are kept apart: points of a frame at the ends of the axis, radius
    /// in m.
    swept_spheres: Vec<([usize; 2], f64)>,
    /// Edges of boxes that are kept apart.
    boxes: Vec<[usize; 2]>,
    /// Motions that have a picture of their own.
    motions: Vec<Playback>,
    /// Others, to be drawn into the first picture.
    ghosts: Vec<Playback>,
    /// Goals and way-points.
    marks: Vec<Mark>,
}

/// One motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Playback {
    title: String,
    /// Points of every frame, three coordinates each, m.
    frames: Vec<Vec<f64>>,
    /// Poses of the bodies that have solids in every frame: position in m, quaternion x, y, z, w.
    poses: Vec<Vec<f64>>,
    /// The base angle, deg; signed in the plane.
    turned: Vec<f64>,
    /// Distance of the base from its start, cm.
    shifted: Vec<f64>,
}

impl Scene {
    /// A scene with these motions of `problem`'s robot, at even times, under their titles; `ghosts`
    /// are others at any times, and `plan` has the goals.
    pub fn new(
        (problem, solids): (&Problem, &Solids),
        plan: &Discretization,
        motions: &[(&str, &Trajectory)],
        ghosts: &[(&str, &Trajectory)],
    ) -> Self {
        let robot = &problem.robot;
        let skeleton = Skeleton::new((robot, solids), &problem.limits.keep_out);
        let duration = motions.iter().filter_map(|(_, rows)| rows.t.last()).next();
        let duration = duration.copied().unwrap_or(0.0);
        let mut motions: Vec<Playback> = motions
            .iter()
            .map(|(title, rows)| skeleton.motion(title, rows))
            .collect();
        let steps = motions.first().map_or(1, |motion| motion.frames.len() - 1);
        let mut ghosts: Vec<Playback> = ghosts
            .iter()
            .map(|(title, rows)| skeleton.motion(title, rows).at_even_times(&rows.t, steps))
            .collect();
        let all = || motions.iter().flat_map(|motion| &motion.frames).flatten();
        let step = ROUNDING * all().fold(0.0, |most: f64, value| most.max(value.abs()));
        let decimals = (-step.log10()).ceil().clamp(0.0, 12.0) as i32;
        let scale = 10f64.powi(decimals);
        for motion in motions.iter_mut().chain(&mut ghosts) {
            for value in motion.frames.iter_mut().flatten() {
                // Adding zero takes the sign off a zero.
                *value = (*value * scale).round() / scale + 0.0;
            }
        }
        Self {
            duration,
            planar: robot.plane().is_some(),
            box_edges: edges(skeleton.corners.len()),
            links: skeleton.links.clone(),
            bare: skeleton.bare.clone(),
            radius: rounded(skeleton.radius()),
            has_block: solids.has_block(),
            solids: solids.all.clone(),
            joints: (0..robot.joint_count())
                .map(|j| skeleton.joint(j))
                .collect(),
            tips: skeleton.tips.clone(),
            swept_spheres: skeleton.swept_spheres.clone(),
            boxes: skeleton.boxes.clone(),
            marks: marks(problem, plan),
            motions,
            ghosts,
        }
    }

    /// Whether way-points are drawn beside the goal.
    pub fn has_way_points(&self) -> bool {
        self.marks.len() > 1
    }

    /// Whether anything is kept apart.
    pub fn keeps_apart(&self) -> bool {
        !(self.swept_spheres.is_empty() && self.boxes.is_empty())
    }

    /// As JSON that may stand in a script element.
    ///
    /// # Errors
    /// None that is expected: all numbers are finite.
    pub fn json(&self) -> serde_json::Result<String> {
        Ok(serde_json::to_string(self)?.replace('<', "\\u003c"))
    }
}

impl Playback {
    /// The same at so many even steps, the points between two times on the line between theirs.
    fn at_even_times(mut self, times: &[f64], steps: usize) -> Self {
        let last = times.last().copied().unwrap_or(0.0);
        let at = |k: usize| {
            let t = last * k as f64 / steps as f64;
            let next = times.partition_point(|time| *time < t);
            let next = next.clamp(1, times.len() - 1);
            let [a, b] = [times[next - 1], times[next]];
            (next - 1, if b > a { (t - a) / (b - a) } else { 0.0 })
        };
        let mix = |a: f64, b: f64, part: f64| a + part * (b - a);
        let rows = |values: &[f64]| -> Vec<f64> {
            let value = |(k, part): (usize, f64)| mix(values[k], values[k + 1], part);
            (0..=steps).map(|k| value(at(k))).collect()
        };
        self.turned = rows(&self.turned);
        self.shifted = rows(&self.shifted);
        let frame = |(k, part): (usize, f64)| {
            let pair = self.frames[k].iter().zip(&self.frames[k + 1]);
            pair.map(|(a, b)| mix(*a, *b, part)).collect()
        };
        self.frames = (0..=steps).map(|k| frame(at(k))).collect();
        // Drawn as lines alone.
        self.poses.clear();
        self
    }
}

/// Corners of the base, the base's origin, every joint, then what is attached to bodies: the ends of
/// arms, spheres, capsules and boxes.
struct Skeleton<'a> {
    robot: &'a Model,
    /// From inertial axes to those of the picture.
    to_picture: Matrix3<f64>,
    /// In base axes, m.
    corners: Vec<Vector3<f64>>,
    links: Vec<[usize; 2]>,
    bare: Vec<bool>,
    /// Bodies whose poses are wanted: the base, then those of the joints.
    posed: &'a [usize],
    tips: Vec<usize>,
    swept_spheres: Vec<([usize; 2], f64)>,
    boxes: Vec<[usize; 2]>,
    attached: Vec<Attached>,
}

/// The joint whose body carries a point, `None` for the base, and the point in that body's axes, m.
type Attached = (Option<usize>, Vector3<f64>);

impl<'a> Skeleton<'a> {
    fn new((robot, solids): (&'a Model, &'a Solids), apart: &[KeepOut]) -> Self {
        let to_picture = from_picture(robot).transpose();
        let mut corners = match solids.base_bounds() {
            Some([low, high]) => {
                let half = (0.5 * (high - low)).into();
                cuboid(0.5 * (low + high), &Matrix3::identity(), half)
            }
            None => block(robot.base()),
        };
        if robot.plane().is_some() {
            corners = outline(&corners, &to_picture);
        }
        let mut found = Self {
            robot,
            to_picture,
            corners,
            links: Vec::new(),
            bare: Vec::new(),
            posed: &solids.bodies,
            tips: Vec::new(),
            swept_spheres: Vec::new(),
            boxes: Vec::new(),
            attached: Vec::new(),
        };
        let origin = found.corners.len();
        for (j, joint) in robot.joints().iter().enumerate() {
            let from = joint.parent.map_or(origin, |parent| found.joint(parent));
            found.links.push([from, found.joint(j)]);
            let is_bare = |parent: usize| !solids.bodies.contains(&(parent + 1));
            found.bare.push(joint.parent.is_some_and(is_bare));
        }
        for (joint, end) in ends(robot) {
            let tip = found.attach((Some(joint), end));
            found.links.push([found.joint(joint), tip]);
            found.bare.push(!solids.bodies.contains(&(joint + 1)));
            found.tips.push(tip);
        }
        for pair in apart {
            found.solid(&pair.first);
            found.solid(&pair.second);
        }
        found
    }

    /// Adds a point; its number in a frame is returned.
    fn attach(&mut self, point: Attached) -> usize {
        self.attached.push(point);
        self.corners.len() + self.robot.joint_count() + self.attached.len()
    }

    fn solid(&mut self, solid: &Solid) {
        let corners = solid.shape.corners().into_iter().map(Vector3::from);
        self.cuboid(solid.joint, corners.collect());
        if let Some((centers, radius)) = solid.shape.swept_sphere() {
            let centers = centers.map(|center| self.attach((solid.joint, center.into())));
            self.swept_spheres.push((centers, radius));
        }
    }

    /// The edges between the eight corners, or the outline in the plane of motion.
    fn cuboid(&mut self, joint: Option<usize>, mut corners: Vec<Vector3<f64>>) {
        if corners.is_empty() {
            return;
        }
        if self.robot.plane().is_some() {
            corners = outline(&corners, &(self.to_picture * at_zero(self.robot, joint)));
        }
        let first = corners
            .iter()
            .map(|corner| self.attach((joint, *corner)))
            .min();
        let first = first.unwrap_or(0);
        let edges = edges(corners.len()).into_iter();
        self.boxes
            .extend(edges.map(|[a, b]| [first + a, first + b]));
    }

    /// Radius of capsules: slim beside the links, whose widths are not known, m.
    fn radius(&self) -> f64 {
        let joints = self.robot.joints();
        let lengths = joints.iter().filter(|joint| joint.parent.is_some());
        let lengths: Vec<f64> = lengths
            .map(|joint| joint.placement.translation.norm())
            .filter(|length| *length > 0.0)
            .collect();
        let sum: f64 = lengths.iter().sum();
        0.06 * sum / lengths.len().max(1) as f64
    }

    /// Number of the point at joint `j`.
    fn joint(&self, j: usize) -> usize {
        self.corners.len() + 1 + j
    }

    fn motion(&self, title: &str, rows: &Trajectory) -> Playback {
        let start = base_pose(self.robot, rows, 0);
        let mut bodies = Bodies::new(self.robot);
        let mut motion = Playback {
            title: title.into(),
            frames: Vec::with_capacity(rows.t.len()),
            poses: Vec::with_capacity(rows.t.len()),
            turned: Vec::with_capacity(rows.t.len()),
            shifted: Vec::with_capacity(rows.t.len()),
        };
        for (k, angle) in base_angles(rows).into_iter().enumerate() {
            let base = base_pose(self.robot, rows, k);
            let q = &rows.joint_position[k];
            bodies.update(self.robot, &base, q, &vec![0.0; q.len()]);
            motion.frames.push(self.points(&base, &bodies));
            if !self.posed.is_empty() {
                let pose = self.poses(&bodies, motion.poses.last());
                motion.poses.push(pose);
            }
            let turn = match self.robot.plane() {
                Some(_) => rows.base_attitude[k][0],
                None => angle,
            };
            let shift = (base.position - start.position).norm();
            motion.turned.push(rounded(turn.to_degrees()));
            motion.shifted.push(rounded(100.0 * shift));
        }
        motion
    }

    /// Poses of the bodies that have solids; each quaternion is the one of two that is nearer to that in
    /// the frame `before`.
    fn poses(&self, bodies: &Bodies, before: Option<&Vec<f64>>) -> Vec<f64> {
        let mut poses = Vec::with_capacity(7 * self.posed.len());
        for (k, &body) in self.posed.iter().enumerate() {
            let body = &bodies.motions()[body];
            let rotation = Rotation3::from_matrix_unchecked(self.to_picture * body.rotation);
            let turn = UnitQuaternion::from_rotation_matrix(&rotation);
            let turn = <[f64; 4]>::from(turn.coords);
            let last = before.map(|pose| &pose[7 * k + 3..7 * k + 7]);
            let along = last.map_or(1.0, |last| last.iter().zip(turn).map(|(a, b)| a * b).sum());
            let sign = if along < 0.0 { -1.0 } else { 1.0 };
            let origin = <[f64; 3]>::from(self.to_picture * body.origin);
            poses.extend(origin.map(rounded));
            poses.extend(turn.map(|value| rounded(sign * value)));
        }
        poses
    }

    fn points(&self, base: &BaseMotion, bodies: &Bodies) -> Vec<f64> {
        let corners = self.corners.iter();
        let corners = corners.map(|corner| base.position + base.rotation * corner);
        let origins = bodies.motions().iter().map(|body| body.origin);
        let attached = self.attached.iter().map(|(joint, point)| {
            let body = &bodies.motions()[joint.map_or(0, |joint| joint + 1)];
            body.origin + body.rotation * point
        });
        let points = corners.chain(origins).chain(attached);
        points
            .flat_map(|point| <[f64; 3]>::from(self.to_picture * point))
            .collect()
    }
}

/// Six digits, more than are shown.
fn rounded(value: f64) -> f64 {
    digits::rounded(value, 6)
}

/// The eight corners, in base axes, of the block of even density with the base's mass, mass centre
/// and inertia.
fn block(base: &Body) -> Vec<Vector3<f64>> {
    let (half, axes) = base.inertia.even_block();
    cuboid(*base.inertia.center(), &axes, half)
}

/// The eight corners of a block with these half edges along these axes.
fn cuboid(center: Vector3<f64>, axes: &Matrix3<f64>, half: [f64; 3]) -> Vec<Vector3<f64>> {
    let corner = |bits: usize| {
        let sign = |bit: usize| if bits & bit == 0 { -1.0 } else { 1.0 };
        let inside = Vector3::new(sign(1) * half[0], sign(2) * half[1], sign(4) * half[2]);
        center + axes * inside
    };
    (0..8).map(corner).collect()
}

/// Edges between the eight corners of a block, or those of an outline in order.
fn edges(corners: usize) -> Vec<[usize; 2]> {
    if corners == 8 {
        // Corners whose numbers differ in one bit.
        let pairs = (0..8).flat_map(|a| [1, 2, 4].map(|bit| [a, a ^ bit]));
        pairs.filter(|[a, b]| a < b).collect()
    } else {
        (0..corners).map(|k| [k, (k + 1) % corners]).collect()
    }
}

/// Rotation from the frame of a joint's body (`None`: the base) to base axes, all joints at zero.
fn at_zero(robot: &Model, mut joint: Option<usize>) -> Matrix3<f64> {
    let mut rotation = Matrix3::identity();
    while let Some(joint_at) = joint.map(|j| &robot.joints()[j]) {
        rotation = joint_at.placement.rotation * rotation;
        joint = joint_at.parent;
    }
    rotation
}

/// The four of the corners of a block that are its outline in the plane of motion, in order.
fn outline(corners: &[Vector3<f64>], to_picture: &Matrix3<f64>) -> Vec<Vector3<f64>> {
    let centre = corners.iter().sum::<Vector3<f64>>() / corners.len() as f64;
    let angle = |corner: &Vector3<f64>| {
        let seen = to_picture * (corner - centre);
        seen.y.atan2(seen.x)
    };
    let height = |corner: &Vector3<f64>| (to_picture * (corner - centre)).z;
    let mut upper: Vec<_> = corners.to_vec();
    upper.sort_by(|a, b| height(b).total_cmp(&height(a)));
    upper.truncate(4);
    upper.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    upper
}

/// The end effector, and the ends of arms without one: as far beyond the mass centre of the last
/// body as its joint is before it.
fn ends(robot: &Model) -> Vec<(usize, Vector3<f64>)> {
    let effector = robot.end_effector();
    let effector = effector.and_then(|end| Some((end.joint?, end.placement.translation)));
    let carries = |j: usize| robot.joints().iter().any(|joint| joint.parent == Some(j));
    let last = (0..robot.joint_count())
        .filter(|&j| !carries(j) && effector.is_none_or(|(joint, _)| joint != j));
    let beyond = |j: usize| (j, 2.0 * robot.joints()[j].body.inertia.center());
    effector.into_iter().chain(last.map(beyond)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Inertia;
    use nalgebra::Rotation3;

    #[test]
    fn the_block_has_the_inertia_of_the_base() {
        let turned = Rotation3::from_euler_angles(0.3, -0.5, 1.1).into_inner();
        let sides = Vector3::new(0.8, 1.2, 2.0);
        let mass = 60.0;
        let squares = sides.component_mul(&sides);
        let moments = Vector3::repeat(squares.sum()) - squares;
        let inertia =
            turned * Matrix3::from_diagonal(&(moments * mass / 12.0)) * turned.transpose();
        let center = Vector3::new(0.1, -0.2, 0.3);
        let base = Body {
            name: "base".into(),
            inertia: Inertia::new(mass, center, inertia).unwrap(),
        };
        let corners = block(&base);
        assert_eq!(corners.len(), 8);
        for corner in corners {
            let inside = turned.transpose() * (corner - center);
            let gap = (inside.abs() - sides / 2.0).amax();
            assert!(gap < 1e-12, "{inside}");
        }
    }
}
