//! Pairs kept apart by the shapes that a URDF gives for its links.

use crate::program::edited;
use crate::robots::*;
use ffsm_ipopt::nalgebra::Vector3;
use ffsm_ipopt::problem::Shape;

const UPPER: &str = "<collision><origin xyz=\"0.25 0 0\" rpy=\"0 1.5707963267948966 0\"/>\
                     <geometry><cylinder radius=\"0.05\" length=\"0.4\"/></geometry></collision>\
                     <collision><geometry><sphere radius=\"0.08\"/></geometry></collision>";
const HULL: &str = "<collision><origin xyz=\"0 0 0.1\"/>\
                    <geometry><box size=\"0.4 0.6 0.8\"/></geometry></collision>";
const PAIR: &str = "\n[[limits.keep_out]]\nname = \"arm off the hull\"\ncollision = \"upper\"\n\
                    from = { collision = \"hull\" }\n";

/// The arm with these elements in two of its links.
fn arm(hull: &str, upper: &str) -> String {
    let with_hull = edited(
        ARM,
        "<link name=\"hull\">",
        &format!("<link name=\"hull\">{hull}"),
    );
    let name = "<link name=\"upper\">";
    edited(&with_hull, name, &format!("{name}{upper}"))
}

#[test]
fn every_shape_of_one_link_is_kept_off_every_shape_of_the_other() {
    let file = load(&folder(&arm(HULL, UPPER), FILE, 2, PAIR));
    let pairs = &file.problem.limits.keep_out;
    let names: Vec<&str> = pairs.iter().map(|pair| pair.name.as_str()).collect();
    assert_eq!(names, ["arm off the hull, 1", "arm off the hull, 2"]);
    let Shape::Capsule { ends, radius } = pairs[0].first.shape else {
        panic!("{:?}", pairs[0].first);
    };
    assert_eq!((pairs[0].first.joint, radius), (Some(0), 0.05));
    assert_near(&Vector3::from(ends[0]), [0.05, 0.0, 0.0]);
    assert_near(&Vector3::from(ends[1]), [0.45, 0.0, 0.0]);
    let Shape::Sphere { center, radius } = pairs[1].first.shape else {
        panic!("{:?}", pairs[1].first);
    };
    assert_eq!((center, radius), ([0.0; 3], 0.08));
    for pair in pairs {
        let Shape::Box { center, half, .. } = pair.second.shape else {
            panic!("{:?}", pair.second);
        };
        assert_eq!((center, half), ([0.0, 0.0, 0.1], [0.2, 0.3, 0.4]));
    }
}

#[test]
fn shapes_that_cannot_be_used_are_refused_where_they_are_asked_for() {
    let mesh = "<collision><geometry><mesh filename=\"a.stl\"/></geometry></collision>";
    // Nobody asks for it.
    load(&folder(&arm(mesh, UPPER), FILE, 2, ""));
    let asked = complaint(&folder(&arm(mesh, UPPER), FILE, 2, PAIR));
    assert!(
        asked.ends_with("link 'hull' <collision>: a mesh; expected a box, a cylinder or a sphere"),
        "{asked}"
    );
    assert!(asked.contains("link 'hull' <collision>"), "{asked}");
    let none = complaint(&folder(&arm("", UPPER), FILE, 2, PAIR));
    assert!(none.contains("limits.keep_out[0].from.collision: \"hull\"; expected a body with"));
    let boxes = complaint(&folder(&arm(HULL, HULL), FILE, 2, PAIR));
    assert!(boxes.contains("a box against a box; expected one of both as spheres or capsules"));
}

#[test]
fn what_is_wrong_after_several_pairs_is_told_by_its_own_entry() {
    let wrong = format!(
        "{PAIR}\n[[limits.keep_out]]\nsphere = {{ body = \"lower\", radius = -1.0 }}\n\
         from = {{ collision = \"base\" }}\n"
    );
    let folder = folder(&arm(HULL, UPPER), FILE, 2, &wrong);
    let told = complaint(&folder);
    let lines = folder.read("case.toml");
    let line = 1 + lines
        .lines()
        .position(|line| line.contains("-1.0"))
        .unwrap();
    let expected =
        "limits.keep_out[1].sphere.radius: -1; expected a finite length, m, zero or above";
    assert_eq!(told, format!("case.toml:{line}: {expected}"));
    let same = "\n[[limits.keep_out]]\ncollision = \"upper\"\n\
                from = { body = \"upper\", radius = 0.1 }\n";
    let told = complaint(&self::folder(
        &arm(HULL, UPPER),
        FILE,
        2,
        &format!("{PAIR}{same}"),
    ));
    let expected = "limits.keep_out[1].from.body: the same body; expected two different bodies";
    assert!(told.ends_with(expected), "{told}");
}

#[test]
fn sizes_are_finite_and_above_zero() {
    for (old, new, expected) in [
        (
            "radius=\"0.05\"",
            "radius=\"-0.05\"",
            "<cylinder> radius: \"-0.05\"; expected a finite length above zero, m",
        ),
        (
            "length=\"0.4\"",
            "length=\"inf\"",
            "<cylinder> length: \"inf\"; expected a finite length above zero, m",
        ),
        (
            "size=\"0.4 0.6 0.8\"",
            "size=\"0.4 0 0.8\"",
            "<box> size: \"0.4 0 0.8\"; expected 3 finite lengths above zero, m",
        ),
    ] {
        let urdf = edited(&arm(HULL, UPPER), old, new);
        let told = complaint(&folder(&urdf, FILE, 2, PAIR));
        assert!(told.ends_with(expected), "{told}");
        assert!(told.contains("arm.urdf:"), "{told}");
    }
}

#[test]
fn a_link_that_is_part_of_another_keeps_its_shapes() {
    let tool = "<link name=\"tool0\"><collision><origin xyz=\"0 0 0.1\"/><geometry>\
                <sphere radius=\"0.03\"/></geometry></collision></link>";
    let urdf = edited(&arm(HULL, UPPER), "<link name=\"tool0\"/>", tool);
    let pair = "\n[[limits.keep_out]]\ncollision = \"tool0\"\n\
                from = { body = \"hull\", radius = 0.2 }\n";
    let file = load(&folder(&urdf, FILE, 2, pair));
    let [pair] = &file.problem.limits.keep_out[..] else {
        panic!("{:?}", file.problem.limits.keep_out);
    };
    assert_eq!(
        (pair.name.as_str(), pair.first.joint),
        ("clearance of tool0", Some(1))
    );
    let Shape::Sphere { center, .. } = pair.first.shape else {
        panic!("{pair:?}");
    };
    // The adapter's z axis is the lower link's x axis.
    assert_near(&Vector3::from(center), [0.4 + 0.1 + 0.1, 0.0, 0.0]);
}
