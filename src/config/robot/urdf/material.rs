//! `<material>`: the colour of a part.

use super::element::Element;
use roxmltree::Node;
use std::collections::HashMap;

/// Colours by the names of their materials, wherever in the file these are given one.
#[derive(Debug, Default)]
pub(super) struct Materials<'a>(HashMap<&'a str, [f64; 3]>);

impl<'a> Materials<'a> {
    /// All of a file. Of several colours for one name the first is taken.
    pub(super) fn of(root: Node<'a, '_>) -> Self {
        let mut found = HashMap::new();
        let is_material = |node: &Node<'_, '_>| node.tag_name().name() == "material";
        for node in root.descendants().filter(is_material) {
            let colour = node.children().find_map(|child| {
                let is_colour = child.tag_name().name() == "color";
                colour(child.attribute("rgba").filter(|_| is_colour)?)
            });
            let name = node.attribute("name").unwrap_or_default().trim();
            if let (Some(colour), false) = (colour, name.is_empty()) {
                found.entry(name).or_insert(colour);
            }
        }
        Self(found)
    }

    /// The colour of a `<visual>`: its own, or that of the material it names.
    pub(super) fn colour(&self, visual: &Element<'_, '_>) -> Option<[f64; 3]> {
        let material = visual.child("material").ok()??;
        let own = material.child("color").ok().flatten();
        let own = own.and_then(|element| colour(element.get("rgba")?.text));
        own.or_else(|| self.0.get(material.get("name")?.text).copied())
    }
}

/// Red, green and blue of `rgba`, each from 0 to 1.
fn colour(rgba: &str) -> Option<[f64; 3]> {
    let parts = rgba.split_whitespace().map(|part| part.parse().ok());
    let parts: Vec<f64> = parts.collect::<Option<_>>()?;
    let [red, green, blue, _] = parts[..] else {
        return None;
    };
    let colour = [red, green, blue];
    let is_part = |part: &f64| (0.0..=1.0).contains(part);
    colour.iter().all(is_part).then_some(colour)
}
