//! What the robot's file draws of its bodies, as faces.

use super::coarse::{SIDES, bounds, coarse};
use crate::config::{Drawing, Drawn, Form, Surface};
use crate::dynamics::MOST_LENGTH;
use nalgebra::Vector3;
use serde::Serialize;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::Arc;

/// Triangles of all surfaces from files together: more are slow to draw, and hardly seen.
const TRIANGLES: usize = 5000;
/// Triangles that a surface has at least, however many there are.
const LEAST: usize = 16;
/// Most parts.
const PARTS: usize = 300;
/// Part of its size to which a part's vertices are rounded.
const ROUNDING: f64 = 5e-4;
/// Complaints that are shown.
const COMPLAINTS: usize = 12;

/// All of them.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Solids {
    pub all: Vec<Faceted>,
    /// Bodies that have solids: 0 for the base, then those of the joints.
    pub bodies: Vec<usize>,
    /// Number of joints.
    joints: usize,
    has_spacecraft: bool,
    /// Whether surfaces have been made coarser.
    pub is_coarser: bool,
    /// Lines about what is not drawn.
    pub complaints: Vec<String>,
}

/// A part of a body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Faceted {
    /// Its place among the bodies that have solids.
    body: usize,
    of_base: bool,
    /// Whether its faces are flat with edges to be seen.
    has_edges: bool,
    /// Its own colour, `#rrggbb`; `None` for that of all bases or links.
    colour: Option<String>,
    /// Coordinates of its vertices in the axes of the body, m.
    points: Vec<f64>,
    /// Numbers of vertices, face by face.
    faces: Vec<Vec<u32>>,
}

impl Solids {
    /// Those of `drawing`, of a robot with so many joints.
    pub fn of(drawing: &Drawing, joints: usize) -> Self {
        let mut found = Self {
            joints,
            has_spacecraft: drawing.has_spacecraft,
            ..Self::default()
        };
        let mut complaints = drawing.complaints.clone();
        let surfaces = drawing.parts.iter().filter(|part| part.surface.is_some());
        let most = (TRIANGLES / surfaces.count().max(1)).max(LEAST);
        let mut known = HashMap::new();
        for drawn in drawing.parts.iter().take(PARTS) {
            let (vertices, faces) = found.faces(drawn, most, &mut known);
            if faces.is_empty() {
                let (link, form) = (&drawn.part.link, &drawn.part.form);
                let name = match form {
                    Form::File { name, .. } => name,
                    _ => "its shape",
                };
                complaints.push(format!(
                    "link '{link}': {name}: it has no size, or is far too large"
                ));
                continue;
            }
            let body = drawn.part.joint.map_or(0, |joint| joint + 1);
            if !found.bodies.contains(&body) {
                found.bodies.push(body);
            }
            let place = found.bodies.iter().position(|known| *known == body);
            found.all.push(Faceted {
                body: place.unwrap_or(0),
                of_base: body == 0,
                has_edges: matches!(drawn.part.form, Form::Box(_)),
                colour: drawn.part.colour.map(shown),
                points: rounded(&vertices),
                faces,
            });
        }
        if drawing.parts.len() > PARTS {
            let more = drawing.parts.len() - PARTS;
            complaints.push(format!("{more} more parts; {PARTS} at most are drawn"));
        }
        let more = complaints.len().saturating_sub(COMPLAINTS);
        complaints.truncate(COMPLAINTS);
        if more > 0 {
            complaints.push(format!("and {more} more"));
        }
        found.complaints = complaints;
        found
    }

    /// Whether the base is drawn as the block of its mass properties: its own shape is not known, or that
    /// of the spacecraft under it is not.
    pub fn has_block(&self) -> bool {
        self.has_spacecraft || !self.bodies.contains(&0)
    }

    /// How many of the joints move a body that has solids, and how many there are.
    pub fn links(&self) -> [usize; 2] {
        let drawn = self.bodies.iter().filter(|body| **body > 0);
        [drawn.count(), self.joints]
    }

    /// From where to where the base's own solids reach, where they stand for it, m.
    pub fn base_bounds(&self) -> Option<[Vector3<f64>; 2]> {
        if self.has_block() {
            return None;
        }
        let solids = self.all.iter().filter(|solid| solid.of_base);
        let points = solids.flat_map(|solid| solid.points.chunks_exact(3));
        let points: Vec<[f64; 3]> = points.map(|at| [at[0], at[1], at[2]]).collect();
        Some(bounds(&points).map(Vector3::from))
    }

    /// Vertices in the axes of the body, and faces; none where it has no size. `known` are surfaces made
    /// coarser before.
    fn faces(
        &mut self,
        drawn: &Drawn,
        most: usize,
        known: &mut HashMap<*const Surface, Faces>,
    ) -> (Vec<Vector3<f64>>, Vec<Vec<u32>>) {
        let (vertices, faces) = match (&drawn.surface, &drawn.part.form) {
            (Some(surface), Form::File { scale, .. }) => {
                self.is_coarser |= surface.triangles.len() > most;
                let coarser = known.entry(Arc::as_ptr(surface)).or_insert_with(|| {
                    let (vertices, triangles) = coarse(surface, most);
                    let faces = triangles.iter().map(|face| face.to_vec());
                    (vertices, faces.collect())
                });
                let (mut vertices, faces) = coarser.clone();
                for vertex in &mut vertices {
                    *vertex = std::array::from_fn(|i| scale[i] * vertex[i]);
                }
                (vertices, faces)
            }
            (_, Form::Box(half)) => cuboid(*half),
            (
                _,
                Form::Cylinder {
                    radius,
                    half_length,
                },
            ) => cylinder(*radius, *half_length),
            (_, Form::Sphere(radius)) => sphere(*radius),
            (None, Form::File { .. }) => (Vec::new(), Vec::new()),
        };
        let placement = &drawn.part.placement;
        let place = |vertex| placement.translation + placement.rotation * Vector3::from(vertex);
        let placed: Vec<Vector3<f64>> = vertices.into_iter().map(place).collect();
        let is_sane = |vertex: &Vector3<f64>| vertex.amax() <= MOST_LENGTH;
        match placed.iter().all(is_sane) && placed.iter().any(|vertex| *vertex != placed[0]) {
            true => (placed, faces),
            false => (Vec::new(), Vec::new()),
        }
    }
}

/// A colour that is seen on white and on black paper.
fn shown(colour: [f64; 3]) -> String {
    let channel = |part: f64| (255.0 * part.clamp(0.12, 0.8)).round() as u8;
    let [red, green, blue] = colour.map(channel);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn rounded(vertices: &[Vector3<f64>]) -> Vec<f64> {
    let all: Vec<[f64; 3]> = vertices.iter().map(|vertex| (*vertex).into()).collect();
    let [low, high] = bounds(&all);
    let size = (0..3)
        .map(|i| high[i] - low[i])
        .fold(f64::MIN_POSITIVE, f64::max);
    let decimals = (-(ROUNDING * size).log10()).ceil().clamp(0.0, 12.0) as i32;
    let scale = 10f64.powi(decimals);
    let round = |value: f64| (value * scale).round() / scale + 0.0;
    all.into_iter().flatten().map(round).collect()
}

type Faces = (Vec<[f64; 3]>, Vec<Vec<u32>>);

fn cuboid(half: [f64; 3]) -> Faces {
    let corner = |bits: u32| std::array::from_fn(|i| [-half[i], half[i]][(bits >> i & 1) as usize]);
    ((0..8).map(corner).collect(), SIDES.map(Vec::from).into())
}

/// As a prism.
fn cylinder(radius: f64, half_length: f64) -> Faces {
    const SIDES: u32 = 20;
    let rim = |z: f64| {
        (0..SIDES).map(move |k| {
            let angle = 2.0 * PI * f64::from(k) / f64::from(SIDES);
            [radius * angle.cos(), radius * angle.sin(), z]
        })
    };
    let side = |k: u32| {
        let next = (k + 1) % SIDES;
        vec![k, next, SIDES + next, SIDES + k]
    };
    let ends = [(0..SIDES).collect(), (SIDES..2 * SIDES).collect()];
    let vertices = rim(-half_length).chain(rim(half_length));
    (
        vertices.collect(),
        (0..SIDES).map(side).chain(ends).collect(),
    )
}

/// By meridians and parallels.
fn sphere(radius: f64) -> Faces {
    const AROUND: u32 = 16;
    const RINGS: u32 = 8;
    let vertices = (0..=RINGS).flat_map(|i| {
        (0..AROUND).map(move |k| {
            let down = PI * f64::from(i) / f64::from(RINGS);
            let angle = 2.0 * PI * f64::from(k) / f64::from(AROUND);
            [
                down.sin() * angle.cos(),
                down.sin() * angle.sin(),
                down.cos(),
            ]
            .map(|value| radius * value)
        })
    });
    let face = |i: u32, k: u32| {
        let next = (k + 1) % AROUND;
        vec![
            i * AROUND + k,
            i * AROUND + next,
            (i + 1) * AROUND + next,
            (i + 1) * AROUND + k,
        ]
    };
    let faces = (0..RINGS).flat_map(|i| (0..AROUND).map(move |k| face(i, k)));
    (vertices.collect(), faces.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Overrides, ProblemFile};
    use std::path::Path;

    fn drawing(path: &str) -> (Drawing, usize) {
        let file = ProblemFile::load(Path::new(path), &Overrides::default()).unwrap();
        (
            file.appearance.drawing(&file.robot),
            file.problem.robot.joint_count(),
        )
    }

    fn solids(path: &str) -> Solids {
        let (drawing, joints) = drawing(path);
        Solids::of(&drawing, joints)
    }

    /// Faces lie in planes, and their vertices are there.
    fn is_sound(points: &[f64], faces: &[Vec<u32>]) {
        let at = |k: u32| Vector3::from_column_slice(&points[3 * k as usize..3 * k as usize + 3]);
        for face in faces {
            let corners: Vec<_> = face.iter().map(|k| at(*k)).collect();
            let normal = (corners[2] - corners[0]).cross(&(corners[1] - corners[face.len() - 1]));
            for pair in corners.windows(2) {
                let off = (pair[1] - pair[0]).dot(&normal.normalize());
                assert!(off.abs() < 3e-3 || normal.norm() == 0.0, "{face:?}: {off}");
            }
        }
    }

    #[test]
    fn the_robot_of_a_file_is_drawn_as_it_says() {
        let found = solids("tests/page/shaped.toml");
        assert_eq!(found.bodies, [0, 1, 3]);
        assert_eq!(found.links(), [2, 3]);
        assert!(!found.has_block() && !found.is_coarser);
        // Bus, panels, engine; sleeve and ball of the upper arm; the hand as it collides.
        let faces: Vec<_> = found.all.iter().map(|solid| solid.faces.len()).collect();
        assert_eq!(faces, [6, 6, 6, 22, 60, 128, 12]);
        for solid in &found.all {
            is_sound(&solid.points, &solid.faces);
        }
        // In metres: the file of the sleeve is in millimetres.
        let reach = found.all[4]
            .points
            .chunks_exact(3)
            .map(|at| at[0])
            .fold(0.0, f64::max);
        assert!((reach - 0.6).abs() < 1e-3);
        let [low, high] = found.base_bounds().unwrap();
        assert!(
            (low - Vector3::new(-0.725, -1.7, -0.4)).amax() < 1e-3,
            "{low}"
        );
        assert!((high - Vector3::new(0.5, 1.7, 0.4)).amax() < 1e-3, "{high}");
        let [complaint] = &found.complaints[..] else {
            panic!("{:?}", found.complaints)
        };
        assert!(complaint.starts_with("link 'hand': package://shaped/missing.stl: not found"));
    }

    #[test]
    fn a_spacecraft_of_the_problem_has_a_block_and_a_robot_in_toml_no_solids() {
        let (mut drawing, joints) = drawing("config/chaser-7dof.toml");
        let found = Solids::of(&drawing, joints);
        assert!(!found.has_block() && found.links() == [0, 7]);
        drawing.has_spacecraft = true;
        let found = Solids::of(&drawing, joints);
        assert!(found.has_block() && found.base_bounds().is_none());
        let found = solids("config/table1-relaxed.toml");
        assert!(found.all.is_empty() && found.has_block());
    }
}
