//! Files that are refused.

use crate::robots::*;

#[test]
fn files_that_are_no_urdf() {
    for (text, expected) in [
        (
            "",
            "arm.urdf: the file is empty; expected a <robot>, as in URDF",
        ),
        (
            " \n\n",
            "arm.urdf: the file is empty; expected a <robot>, as in URDF",
        ),
        ("schema = 1\n", "arm.urdf:1: not XML: unknown token"),
        (
            "<robot>\n  <link name=\"a\">\n</robot>\n",
            "arm.urdf:3: not XML: expected 'link' tag, not 'robot'",
        ),
        (
            "<robot>\n  <link name=\"a\" name=\"b\"/>\n</robot>\n",
            "arm.urdf:2: not XML: attribute 'name' is already defined",
        ),
        (
            "<!DOCTYPE a>\n<robot/>",
            "arm.urdf:1: not XML: XML with DTD detected",
        ),
        (
            "<?xml version=\"1.0\"?>\n<mujoco model=\"arm\"/>\n",
            "arm.urdf:2: <mujoco>: the outermost element; expected <robot>, as in URDF",
        ),
        (
            "<robot name=\"arm\"/>",
            "arm.urdf:1: <robot>: no links; expected at least two links and a joint between them",
        ),
        (
            "<robot name=\"arm\"><link name=\"a\"/></robot>",
            "case.toml:3: robot: robot 'arm' has no joints; it needs at least one",
        ),
    ] {
        assert_eq!(refusal(text), expected);
    }
    let folder = folder("", FILE, 2, "");
    std::fs::write(folder.path().join("arm.urdf"), [0x3c, 0xff]).unwrap();
    assert_eq!(
        complaint(&folder),
        "case.toml:3: robot: arm.urdf: cannot be read: it is not UTF-8 text; expected a robot \
         file, by a path relative to the problem file"
    );
}

#[test]
fn xacro_is_pointed_out() {
    let run_it = "expected URDF: run xacro on the file first, xacro arm.urdf.xacro > arm.urdf";
    let included = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n\
                    <xacro:include filename=\"a\"/>\n</robot>";
    assert_eq!(
        refusal(included),
        format!("arm.urdf:2: <xacro:include>; {run_it}")
    );
    assert_eq!(
        refusal("<robot>\n<xacro:arm/>\n</robot>"),
        format!("arm.urdf:2: <xacro:arm>; {run_it}")
    );
    assert_eq!(
        edit("0.5 0 0\"/>\n    <limit", "${length} 0 0\"/>\n    <limit"),
        "arm.urdf:28: joint 'boom' <origin> xyz: \"${length} 0 0\"; expected 3 finite lengths, m \
         (an expression of xacro's; run xacro on the file first)"
    );
    assert_eq!(
        complaint(&folder("", "\"arm.urdf.xacro\"", 2, "")),
        format!("case.toml:3: robot: \"arm.urdf.xacro\"; {run_it}")
    );
}

#[test]
fn file_that_is_not_there() {
    assert_eq!(
        complaint(&folder("", "\"none.urdf\"", 2, "")),
        "case.toml:3: robot: none.urdf: cannot be read: No such file or directory (os error 2); \
         expected a robot file, by a path relative to the problem file"
    );
    assert_eq!(
        complaint(&folder("", "\"arm.sdf\"", 2, "")),
        "case.toml:3: robot: \"arm.sdf\"; expected a file that ends in .toml or .urdf"
    );
}
