//! What the page says of how the robot is drawn.

use super::solids::Solids;

/// Sentences on base and links.
pub(super) fn of(solids: &Solids) -> String {
    let base = match (solids.has_block(), solids.bodies.contains(&0)) {
        (false, _) => "The base is drawn as the robot's file has it.",
        (true, false) => {
            "The base is drawn as the block of even density with its mass and inertia."
        }
        (true, true) => {
            "The base is drawn as the robot's file has it, inside the block of even density with the \
             mass and inertia of base and spacecraft together."
        }
    };
    let links = match solids.links() {
        [0, _] => "Links are drawn as capsules between their joints; their shape is not known.",
        [drawn, joints] if drawn == joints => "Links are drawn as the robot's file has them.",
        _ => {
            "Links are drawn as the robot's file has them, those without a shape as capsules between \
             their joints."
        }
    };
    let coarser = match solids.is_coarser {
        true => " Surfaces are drawn with fewer triangles than their files have.",
        false => "",
    };
    format!("{base} {links}{coarser}")
}
