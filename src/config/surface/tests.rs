//! Surfaces from files that are as they should be, and from others.

use super::*;
use std::fs;

const FACET: &str = "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  \
                     vertex 0 2.5e-1 0\n endloop\nendfacet\n";

/// A binary STL with this many triangles in it, which says it has `told`.
fn binary(triangles: usize, told: u32) -> Vec<u8> {
    let mut bytes = b"solid of a tool that begins binary files so".to_vec();
    bytes.resize(80, 0);
    bytes.extend(told.to_le_bytes());
    for k in 0..triangles {
        for number in [
            0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, k as f32,
        ] {
            bytes.extend(f32::to_le_bytes(number));
        }
        bytes.extend([0, 0]);
    }
    bytes
}

#[test]
fn stl_is_read_as_text_and_binary() {
    let text = stl::parse(format!("solid a\n{FACET}{FACET}endsolid a\n").as_bytes()).unwrap();
    assert_eq!((text.vertices.len(), text.triangles.len()), (6, 2));
    assert_eq!(text.vertices[5], [0.0, 0.25, 0.0]);
    let found = stl::parse(&binary(3, 3)).unwrap();
    assert_eq!(found.triangles, [[0, 1, 2], [3, 4, 5], [6, 7, 8]]);
    assert_eq!(found.vertices[8], [0.0, 1.0, 2.0]);
}

#[test]
fn obj_is_read_with_its_polygons() {
    let text = "# a square\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1/1/1 2//1 3 -1\n";
    let found = obj::parse(text.as_bytes()).unwrap();
    assert_eq!(found.vertices.len(), 4);
    assert_eq!(found.triangles, [[0, 1, 2], [0, 2, 3]]);
}

/// Two triangles and a square in centimetres, moved by 1 m and turned about z by a right angle.
const SCENE: &str = r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="cm" meter="0.01"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="plate"><mesh>
<source id="places"><float_array id="a" count="12">0 0 0 10 0 0 10 10 0 0 10 0</float_array></source>
<source id="normals"><float_array id="n" count="3">0 0 1</float_array></source>
<vertices id="vs"><input semantic="POSITION" source="#places"/></vertices>
<triangles count="2"><input semantic="VERTEX" source="#vs" offset="0"/>
<input semantic="NORMAL" source="#normals" offset="1"/><p>0 0 1 0 2 0 0 0 2 0 3 0</p></triangles>
<polylist count="1"><input semantic="VERTEX" source="#vs" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><translate>100 0 0</translate><node>
<rotate>0 0 1 90</rotate><instance_geometry url="#plate"/></node></node></visual_scene></library_visual_scenes>
</COLLADA>"##;

#[test]
fn dae_has_nodes_that_stand_for_others() {
    let place = "<instance_geometry url=\"#plate\"/>";
    let library = format!(
        "<library_nodes><node id=\"pair\"><node>{place}</node><node><translate>0 0 5</translate>{place}</node>\
         </node></library_nodes><library_visual_scenes>"
    );
    let instance = "<instance_node url=\"#pair\"/>";
    let text = SCENE.replace(place, instance);
    let whole = text.replace("<library_visual_scenes>", &library);
    let found = dae::parse(whole.as_bytes()).unwrap();
    assert_eq!(found.triangles.len(), 8);
    let heights = found
        .vertices
        .iter()
        .filter(|at| (at[2] - 0.05).abs() < 1e-12);
    assert_eq!(heights.count(), 12);
    // One that is not there, and one that holds itself.
    assert!(dae::parse(text.as_bytes()).unwrap().triangles.is_empty());
    let endless = whole.replace(&format!("<node>{place}</node>"), instance);
    let error = dae::parse(endless.as_bytes()).unwrap_err();
    assert!(error.contains("at most 100000 nodes"), "{error}");
}

#[test]
fn dae_is_read_with_its_units_and_nodes() {
    let found = dae::parse(SCENE.as_bytes()).unwrap();
    assert_eq!((found.vertices.len(), found.triangles.len()), (12, 4));
    for (k, expected) in [
        (0, [1.0, 0.0, 0.0]),
        (1, [1.0, 0.1, 0.0]),
        (2, [0.9, 0.1, 0.0]),
        (5, [0.9, 0.0, 0.0]),
    ] {
        let gap = (0..3).map(|i| (found.vertices[k][i] - expected[i]).abs());
        assert!(
            gap.fold(0.0, f64::max) < 1e-12,
            "{k}: {:?}",
            found.vertices[k]
        );
    }
    for (old, new, expected) in [
        ("0 0 2 0 3 0<", "0 0 2 0 4 0<", "vertices that are there"),
        ("100 0 0<", "100 0<", "<translate>: expected 3 numbers"),
        ("10 10 0 0", "10 ten 0 0", "<float_array>: expected numbers"),
        (
            "meter=\"0.01\"",
            "meter=\"1e300\"",
            "not finite, or far away",
        ),
        ("</COLLADA>", "", "not XML"),
        ("COLLADA", "KML", "not <COLLADA>"),
    ] {
        let error = dae::parse(SCENE.replace(old, new).as_bytes()).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn what_is_no_surface_is_refused() {
    for (bytes, expected) in [
        (binary(2, u32::MAX), "no triangle"),
        (b"".to_vec(), "too early"),
        (b"\0\0".to_vec(), "too early"),
        (
            format!("solid\n{}", FACET.replace("0 0 0", "0 0")).into_bytes(),
            "line 4: expected three numbers",
        ),
        (
            format!("solid\n{}", FACET.replace("0 0 0", "0 0 inf")).into_bytes(),
            "not finite",
        ),
    ] {
        let error = stl::parse(&bytes).and_then(Surface::if_any).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
    for text in [
        "v 0 0\n",
        "v 0 0 0\nf 1 1 2\n",
        "v 0 0 0\nf 1 1\n",
        "v 0 0 0\nf 1 1 0\n",
        "v 0 0 0\nf 1 1 -2\n",
        "f 1 1 -9223372036854775808\n",
    ] {
        let error = obj::parse(text.as_bytes()).unwrap_err();
        assert!(error.starts_with("line "), "{error}");
    }
}

/// A folder with a package in it, a URDF in that, and files.
fn package() -> (tempfile::TempDir, RobotFile) {
    let place = tempfile::tempdir().unwrap();
    let root = place.path().join("arm_description");
    fs::create_dir_all(root.join("urdf/arm_description/meshes")).unwrap();
    fs::create_dir_all(root.join("meshes")).unwrap();
    fs::write(root.join("package.xml"), "<package/>").unwrap();
    fs::write(root.join("meshes/a.stl"), binary(1, 1)).unwrap();
    fs::write(
        root.join("meshes/b.OBJ"),
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    )
    .unwrap();
    fs::write(root.join("meshes/c.dae"), "<COLLADA/>").unwrap();
    fs::write(root.join("meshes/d.ply"), "ply").unwrap();
    fs::write(place.path().join("secret.stl"), binary(1, 1)).unwrap();
    let path = root.join("urdf/arm.urdf");
    fs::write(&path, "<robot/>").unwrap();
    let path = path.to_str().unwrap().to_owned();
    let text = "<robot/>".into();
    (place, RobotFile { path, text })
}

#[test]
fn files_are_found_in_the_package_and_nowhere_else() {
    let (place, robot) = package();
    let shelf = Shelf::of(&robot);
    for name in [
        "package://arm_description/meshes/a.stl",
        "../meshes/a.stl",
        "../meshes/b.OBJ",
    ] {
        assert_eq!(shelf.surface(name).unwrap().triangles.len(), 1, "{name}");
    }
    let secret = place.path().join("secret.stl");
    std::os::unix::fs::symlink(
        &secret,
        place.path().join("arm_description/meshes/link.stl"),
    )
    .unwrap();
    let outside = format!(
        "expected a file below {}",
        place
            .path()
            .join("arm_description")
            .canonicalize()
            .unwrap()
            .display()
    );
    for (name, expected) in [
        ("../../secret.stl", outside.as_str()),
        ("../meshes/link.stl", &outside),
        (&format!("file://{}", secret.display()), &outside),
        (secret.to_str().unwrap(), &outside),
        ("package://arm_description/../secret.stl", &outside),
        ("package://other/meshes/a.stl", "not found in the folder"),
        ("package://other", "expected package://NAME/PATH"),
        ("../meshes/none.stl", "not found beside"),
        ("../meshes/c.dae", "no triangle is in it"),
        (
            "../meshes/d.ply",
            "expected a file that ends in .stl, .obj or .dae",
        ),
        ("../meshes", "expected a file that ends in"),
    ] {
        let error = shelf.surface(name).unwrap_err();
        assert!(error.contains(expected), "{name}: {error}");
    }
}

#[test]
fn without_a_package_files_stay_in_the_folder_of_the_urdf() {
    let (place, robot) = package();
    fs::remove_file(place.path().join("arm_description/package.xml")).unwrap();
    let beside = place
        .path()
        .join("arm_description/urdf/arm_description/meshes/a.stl");
    fs::write(beside, binary(2, 2)).unwrap();
    let shelf = Shelf::of(&robot);
    let error = shelf.surface("../meshes/a.stl").unwrap_err();
    assert!(error.ends_with("/urdf"), "{error}");
    let found = shelf
        .surface("package://arm_description/meshes/a.stl")
        .unwrap();
    assert_eq!(found.triangles.len(), 2);
}

#[test]
fn no_file_is_looked_for_where_the_urdf_is_another() {
    let (_place, mut robot) = package();
    robot.text.push(' ');
    let error = Shelf::of(&robot).surface("../meshes/a.stl").unwrap_err();
    assert!(
        error.starts_with("not looked for") && error.ends_with("has changed"),
        "{error}"
    );
    robot.path.push_str(".old");
    let error = Shelf::of(&robot).surface("../meshes/a.stl").unwrap_err();
    assert!(error.ends_with("is not there"), "{error}");
}

#[test]
fn damaged_files_do_no_harm() {
    let mut random = fastrand::Rng::with_seed(7);
    let text = format!("solid a\n{FACET}{FACET}endsolid a\n").into_bytes();
    let polygons = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf -1 -2 -3\n".to_vec();
    for whole in [text, binary(3, 3), polygons, SCENE.as_bytes().to_vec()] {
        for _ in 0..5_000 {
            let mut bytes = whole.clone();
            for _ in 0..1 + random.usize(..4) {
                let at = random.usize(..bytes.len());
                bytes[at] = random.u8(..);
            }
            bytes.truncate(random.usize(..2 * whole.len()));
            for parse in [stl::parse, obj::parse, dae::parse] {
                if let Ok(surface) = parse(&bytes) {
                    let known = surface.vertices.len() as u32;
                    assert!(
                        surface
                            .triangles
                            .iter()
                            .flatten()
                            .all(|corner| *corner < known)
                    );
                }
            }
        }
    }
}
