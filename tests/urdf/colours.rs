//! The colours of what is drawn.

use crate::program::edited;
use crate::robots::*;

#[test]
fn a_part_has_the_colour_of_its_material() {
    let ball = "<geometry><sphere radius=\"0.1\"/></geometry>";
    let given = [
        // Its own; that of the whole file; that of another part.
        (
            "<material name=\"a\"><color rgba=\"1 0.5 0 1\"/></material>",
            Some([1.0, 0.5, 0.0]),
        ),
        ("<material name=\"grey\"/>", Some([0.5, 0.5, 0.5])),
        ("<material name=\"a\"/>", Some([1.0, 0.5, 0.0])),
        // Exporters give all of them the same name, which is none.
        (
            "<material name=\"\"><color rgba=\"0 0 1 1\"/></material>",
            Some([0.0, 0.0, 1.0]),
        ),
        ("<material name=\"\"/>", None),
        ("<material name=\"none\"/>", None),
        (
            "<material name=\"b\"><color rgba=\"1 2 0 1\"/></material>",
            None,
        ),
        (
            "<material name=\"c\"><color rgba=\"1 nan 0 1\"/></material>",
            None,
        ),
        (
            "<material name=\"d\"><color rgba=\"1 1 0\"/></material>",
            None,
        ),
        ("", None),
    ];
    let parts = given.map(|(material, _)| format!("<visual>{ball}{material}</visual>"));
    let hull = "<link name=\"hull\">";
    let arm = edited(ARM, hull, &format!("{hull}{}", parts.concat()));
    let grey = "<material name=\"grey\"><color rgba=\"0.5 0.5 0.5 1\"/></material>";
    let arm = arm.replace("</robot>", &format!("{grey}</robot>"));
    let file = load(&folder(&arm, FILE, 2, ""));
    let colours: Vec<_> = file
        .appearance
        .parts
        .iter()
        .map(|part| part.colour)
        .collect();
    assert_eq!(colours, given.map(|(_, colour)| colour));
}
