//! COLLADA: the triangles and polygons of the geometries that the scene holds, where its nodes put them.
//! Like others that read these files for URDF, this one takes lengths in the file's unit and axes as they
//! stand, whichever of them points up.

use super::Surface;
use crate::text::printable::message;
use nalgebra::{Matrix4, Rotation3, Unit, Vector3, Vector4};
use roxmltree::{Document, Node};
use std::collections::HashMap;

/// Most nodes of the scene.
const MOST_NODES: usize = 100_000;

/// Reads a surface, in metres.
pub(super) fn parse(bytes: &[u8]) -> Result<Surface, String> {
    let text = str::from_utf8(bytes).map_err(|_| "it is not UTF-8 text")?;
    let document = Document::parse(text).map_err(|error| format!("not XML: {}", message(error)))?;
    let root = document.root_element();
    if root.tag_name().name() != "COLLADA" {
        return Err("the outermost element is not <COLLADA>".into());
    }
    let unit = child(root, "asset").and_then(|asset| child(asset, "unit"));
    let unit = unit.and_then(|unit| unit.attribute("meter")?.trim().parse().ok());
    let unit = Matrix4::new_scaling(unit.unwrap_or(1.0));
    let mut geometries = HashMap::new();
    for geometry in descendants(root, "geometry") {
        if let (Some(id), Some(mesh)) = (geometry.attribute("id"), child(geometry, "mesh")) {
            geometries.insert(id, triangles(mesh)?);
        }
    }
    let named: HashMap<_, _> = descendants(root, "node")
        .filter_map(|node| Some((node.attribute("id")?, node)))
        .collect();
    let mut surface = Surface::default();
    let mut open: Vec<(Node<'_, '_>, Matrix4<f64>)> = descendants(root, "visual_scene")
        .take(1)
        .map(|scene| (scene, unit))
        .collect();
    let mut nodes = 0;
    while let Some((node, above)) = open.pop() {
        nodes += 1;
        if nodes > MOST_NODES {
            return Err(format!("expected at most {MOST_NODES} nodes"));
        }
        let pose = above * placement(node)?;
        for held in node.children() {
            match held.tag_name().name() {
                "node" => open.push((held, pose)),
                // One of the library, which may hold itself: the number of nodes ends that.
                "instance_node" => {
                    open.extend(target(held).and_then(|id| Some((*named.get(id)?, pose))))
                }
                "instance_geometry" => {
                    let corners = target(held).and_then(|id| geometries.get(id));
                    add(&mut surface, corners.map_or(&[], Vec::as_slice), &pose)?;
                }
                _ => {}
            }
        }
    }
    Ok(surface)
}

fn child<'a, 'input>(node: Node<'a, 'input>, name: &str) -> Option<Node<'a, 'input>> {
    node.children()
        .find(|child| child.tag_name().name() == name)
}

/// What an instance is one of, if it is in the same file.
fn target<'a>(instance: Node<'a, '_>) -> Option<&'a str> {
    instance.attribute("url")?.strip_prefix('#')
}

fn descendants<'a, 'input>(
    node: Node<'a, 'input>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'input>> {
    node.descendants()
        .filter(move |node| node.tag_name().name() == name)
}

fn numbers<T: std::str::FromStr>(node: Node<'_, '_>) -> Result<Vec<T>, String> {
    let words = node.text().unwrap_or_default().split_ascii_whitespace();
    let numbers: Option<Vec<T>> = words.map(|word| word.parse().ok()).collect();
    numbers.ok_or_else(|| format!("<{}>: expected numbers", node.tag_name().name()))
}

/// What a node does to what it holds.
fn placement(node: Node<'_, '_>) -> Result<Matrix4<f64>, String> {
    let mut pose = Matrix4::identity();
    for step in node.children() {
        let name = step.tag_name().name();
        let count = match name {
            "matrix" => 16,
            "rotate" => 4,
            "translate" | "scale" => 3,
            _ => continue,
        };
        let values: Vec<f64> = numbers(step)?;
        if values.len() != count {
            return Err(format!("<{name}>: expected {count} numbers"));
        }
        pose *= match name {
            "matrix" => Matrix4::from_row_slice(&values),
            "translate" => Matrix4::new_translation(&Vector3::from_column_slice(&values)),
            "scale" => Matrix4::new_nonuniform_scaling(&Vector3::from_column_slice(&values)),
            _ => match Unit::try_new(Vector3::from_column_slice(&values[..3]), 1e-12) {
                Some(axis) => {
                    Rotation3::from_axis_angle(&axis, values[3].to_radians()).to_homogeneous()
                }
                None => Matrix4::identity(),
            },
        };
    }
    Ok(pose)
}

fn add(
    surface: &mut Surface,
    corners: &[[[f64; 3]; 3]],
    pose: &Matrix4<f64>,
) -> Result<(), String> {
    for triangle in corners {
        let mut numbers = [0; 3];
        for (number, [x, y, z]) in numbers.iter_mut().zip(triangle) {
            let at = pose * Vector4::new(*x, *y, *z, 1.0);
            *number = surface.vertex([at.x, at.y, at.z])?;
        }
        surface.triangle(numbers)?;
    }
    Ok(())
}

/// The corners of all triangles of a `<mesh>`, polygons cut into some.
fn triangles(mesh: Node<'_, '_>) -> Result<Vec<[[f64; 3]; 3]>, String> {
    let mut sources = HashMap::new();
    for source in mesh
        .children()
        .filter(|node| node.tag_name().name() == "source")
    {
        if let (Some(id), Some(array)) = (source.attribute("id"), child(source, "float_array")) {
            sources.insert(id, array);
        }
    }
    let local = |url: &str| url.strip_prefix('#').map(str::to_owned);
    let input = |node: Node<'_, '_>, semantic: &str| {
        let mut inputs = node
            .children()
            .filter(|node| node.tag_name().name() == "input");
        let input = inputs.find(|input| input.attribute("semantic") == Some(semantic))?;
        let offset = input
            .attribute("offset")
            .unwrap_or("0")
            .trim()
            .parse::<usize>()
            .ok()?;
        Some((local(input.attribute("source")?)?, offset))
    };
    let vertices = child(mesh, "vertices").and_then(|node| input(node, "POSITION"));
    let array = vertices.and_then(|(source, _)| sources.get(source.as_str()).copied());
    let Some(array) = array else {
        return Ok(Vec::new());
    };
    let places: Vec<f64> = numbers(array)?;
    let place = |k: usize| -> Result<[f64; 3], String> {
        let at = k
            .checked_mul(3)
            .and_then(|first| places.get(first..)?.get(..3));
        let at = at.and_then(|at| <[f64; 3]>::try_from(at).ok());
        at.ok_or_else(|| "<p>: expected numbers of vertices that are there".into())
    };
    let mut found = Vec::new();
    for primitive in mesh.children() {
        let name = primitive.tag_name().name();
        if !matches!(name, "triangles" | "polylist" | "polygons") {
            continue;
        }
        let offsets = primitive
            .children()
            .filter_map(|node| node.attribute("offset"));
        let offsets = offsets.filter_map(|offset| offset.trim().parse::<usize>().ok());
        let stride = offsets.max().unwrap_or(0).min(63) + 1;
        let Some((_, offset)) = input(primitive, "VERTEX").filter(|(_, at)| *at < stride) else {
            continue;
        };
        let counts = match child(primitive, "vcount") {
            Some(node) if name == "polylist" => numbers::<usize>(node)?,
            _ => Vec::new(),
        };
        for list in primitive
            .children()
            .filter(|node| node.tag_name().name() == "p")
        {
            let indices: Vec<usize> = numbers(list)?;
            let mut corners = indices.chunks_exact(stride).map(|corner| corner[offset]);
            let total = corners.len();
            let sizes: Vec<usize> = match name {
                "triangles" => vec![3; total / 3],
                "polygons" => vec![total],
                _ => counts.clone(),
            };
            for size in sizes {
                let polygon: Vec<usize> = corners.by_ref().take(size).collect();
                for pair in polygon.get(1..).unwrap_or_default().windows(2) {
                    found.push([place(polygon[0])?, place(pair[0])?, place(pair[1])?]);
                    if found.len() > super::MOST_TRIANGLES {
                        return Err(super::too_many());
                    }
                }
            }
        }
    }
    Ok(found)
}
