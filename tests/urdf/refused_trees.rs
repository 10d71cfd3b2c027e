//! Trees that are refused.

use crate::robots::*;

#[test]
fn joints_and_links_that_make_no_tree() {
    for (old, new, expected) in [
        (
            "<child link=\"lower\"/>",
            "<child link=\"lowr\"/>",
            "arm.urdf:27: joint 'boom' <child> link: \"lowr\"; expected the name of a link of this file",
        ),
        (
            "<parent link=\"upper\"/>",
            "<parent link=\"uper\"/>",
            "arm.urdf:26: joint 'boom' <parent> link: \"uper\"; expected the name of a link of this file",
        ),
        (
            "<child link=\"lower\"/>",
            "",
            "arm.urdf:25: joint 'boom' <child>: missing; expected the name of a link",
        ),
        (
            "<child link=\"tool0\"/>",
            "<child link=\"lower\"/>",
            "arm.urdf:52: joint 'tip': its child 'lower' is the child of joint 'boom' already; expected one parent a link: a tree",
        ),
        (
            "<link name=\"tool0\"/>",
            "<link name=\"tool0\"/>\n  <link name=\"spare\"/>",
            "arm.urdf:58: link 'spare': a second root beside link 'hull' (no joint has it as its child); expected one root: a tree",
        ),
        (
            "<parent link=\"hull\"/>",
            "<parent link=\"tool0\"/>",
            "arm.urdf:17: link 'upper': on a loop of joints; expected a tree: joints that lead from one root link outwards",
        ),
        (
            "<link name=\"tool0\"/>",
            "<link name=\"tool0\"/>\n  <joint name=\"back\" type=\"fixed\"><parent link=\"tool0\"/><child link=\"hull\"/></joint>",
            "arm.urdf:3: link 'hull': on a loop of joints; expected a tree: joints that lead from one root link outwards",
        ),
        (
            "<link name=\"tool0\"/>",
            "<link name=\"adapter\"/>",
            "arm.urdf: 2 faults: (1) arm.urdf:54: joint 'tip' <child> link: \"tool0\"; expected the name of a link of this file; (2) arm.urdf:57: link 'adapter': given twice; expected a name of its own",
        ),
        (
            "<joint name=\"tip\"",
            "<joint name=\"boom\"",
            "arm.urdf:52: joint 'boom': given twice; expected a name of its own",
        ),
        (
            "<link name=\"tool0\"/>",
            "<link/>",
            "arm.urdf:57: <link> name: missing; expected a name that is not empty",
        ),
    ] {
        assert_eq!(edit(old, new), expected);
    }
}
