"""A robot written as URDF, the format SPART reads."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from robot import Body, Robot, Triple


def write(robot: Robot) -> str:
    """The whole file, every digit kept."""
    root = ET.Element("robot", name=robot.name)
    _link(root, "base", robot.base)
    for index, joint in enumerate(robot.joints):
        _link(root, f"body{index}", joint.body)
        parent = "base" if joint.parent is None else f"body{joint.parent}"
        element = ET.SubElement(root, "joint", name=joint.name, type=joint.kind)
        ET.SubElement(element, "parent", link=parent)
        ET.SubElement(element, "child", link=f"body{index}")
        ET.SubElement(element, "origin", xyz=text(joint.xyz), rpy=text(joint.rpy))
        length = sum(x * x for x in joint.axis) ** 0.5
        x, y, z = joint.axis
        ET.SubElement(element, "axis", xyz=text((x / length, y / length, z / length)))
    return ET.tostring(root, encoding="unicode")


def text(values: Triple) -> str:
    """Numbers with a space between, every digit kept."""
    return " ".join(repr(float(value)) for value in values)


def _link(root: ET.Element, name: str, body: Body) -> None:
    inertial = ET.SubElement(ET.SubElement(root, "link", name=name), "inertial")
    ET.SubElement(inertial, "origin", xyz=text(body.com), rpy=text(body.rpy))
    ET.SubElement(inertial, "mass", value=repr(body.mass))
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = body.inertia
    figures = {"ixx": xx, "ixy": xy, "ixz": xz, "iyy": yy, "iyz": yz, "izz": zz}
    ET.SubElement(inertial, "inertia", {key: repr(float(i)) for key, i in figures.items()})
