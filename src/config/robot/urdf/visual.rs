//! `<visual>` and `<collision>` as they are drawn. Nothing depends on them, and what cannot be
//! understood is left out.

use super::element::Element;
use super::material::Materials;
use super::origin;
use crate::config::appearance::Form;
use crate::config::robot::look::Look;
use crate::dynamics::MOST_LENGTH;

/// All parts of a link.
pub(super) fn read(link: &Element<'_, '_>, materials: &Materials<'_>) -> Vec<Look> {
    let of = |tag: &str, is_collision| {
        let looks = link.children(tag).into_iter();
        let look = move |element: Element<'_, '_>| {
            Some(Look {
                placement: origin(&element).ok()?,
                form: form(&element)?,
                colour: materials.colour(&element),
                is_collision,
            })
        };
        looks.filter_map(look).collect::<Vec<_>>()
    };
    [of("visual", false), of("collision", true)].concat()
}

fn form(element: &Element<'_, '_>) -> Option<Form> {
    let geometry = element.child("geometry").ok()??;
    let shape = |tag| geometry.child(tag).ok().flatten();
    if let Some(cuboid) = shape("box") {
        let size = cuboid.get("size")?.triple("").ok()?;
        let good = size.iter().all(|edge| is_length(*edge));
        return good.then(|| Form::Box(size.map(|edge| 0.5 * edge)));
    }
    let length = |element: &Element<'_, '_>, name| {
        let value = element.get(name)?.finite("").ok()?;
        is_length(value).then_some(value)
    };
    if let Some(sphere) = shape("sphere") {
        return Some(Form::Sphere(length(&sphere, "radius")?));
    }
    if let Some(cylinder) = shape("cylinder") {
        return Some(Form::Cylinder {
            radius: length(&cylinder, "radius")?,
            half_length: 0.5 * length(&cylinder, "length")?,
        });
    }
    let mesh = shape("mesh")?;
    let scale = match mesh.get("scale") {
        Some(scale) => scale.triple("").ok()?,
        None => [1.0; 3],
    };
    Some(Form::File {
        name: mesh.get("filename")?.text.into(),
        scale,
    })
}

fn is_length(value: f64) -> bool {
    value > 0.0 && value <= MOST_LENGTH
}
