//! No file of the ordered folders imports another one that imports it back.
//!
//! Every path that a file uses is followed through `use` and `pub use` to the file that defines
//! the item, so that a re-export in a `mod.rs` hides no circle. `scripts/import-circles.sh`
//! prints the circles of the whole crate.

mod circles;
mod imports;
mod made_up;
mod modules;
mod paths;
mod resolve;
mod tokens;

use std::path::Path;

use circles::Circle;
use modules::Sources;

/// Folders of `src` in which no file may be part of a circle. One that does not exist is skipped.
const WITHOUT_CIRCLES: [&str; 6] = [
    "problem", "system", "planner", "study", "solution", "dynamics",
];

#[test]
fn no_circles_in_the_ordered_folders() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let sources = Sources::read(&root);
    let found = imports::of(&sources, "ffsm_ipopt");
    assert_eq!(found.lost, [""; 0], "paths that could not be followed");
    let circles = circles::find(&found.imports);
    print(&circles);

    let forbidden: Vec<&Circle> = circles
        .iter()
        .filter(|circle| WITHOUT_CIRCLES.iter().any(|folder| circle.touches(folder)))
        .collect();
    assert!(
        forbidden.is_empty(),
        "{} circles in {WITHOUT_CIRCLES:?}, printed above",
        forbidden.len()
    );
}

fn print(circles: &[Circle]) {
    println!("{} circles of files", circles.len());
    for circle in circles {
        println!("\n{circle}");
    }
}
