"""The robot of a problem as plain figures, for every tool to build its own model from.

Frames and angles are those of docs/robot-file.md, which are URDF's. Nothing is computed here, so
that a mistake in one tool's reading of the figures shows as a gap between the tools.
"""

from __future__ import annotations

import tomllib
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path
from typing import Any

Triple = tuple[float, float, float]
ZERO: Triple = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Body:
    """Mass (kg), mass centre (m), inertia (kg m²) by rows about it, in axes turned by `rpy`."""

    mass: float
    com: Triple
    inertia: tuple[Triple, Triple, Triple]
    rpy: Triple = ZERO


@dataclass(frozen=True)
class Joint:
    """A joint and the body it carries; `kind` is revolute, prismatic or fixed."""

    name: str
    kind: str
    parent: int | None  # index of the joint that carries this one; None: the base
    xyz: Triple
    rpy: Triple
    axis: Triple
    body: Body


@dataclass(frozen=True)
class Robot:
    """A tree of bodies, its joints depth-first: the moving ones as the planner counts them."""

    name: str
    base: Body
    joints: tuple[Joint, ...]

    @property
    def moving(self) -> int:
        """Number of joints that move."""
        return sum(joint.kind != "fixed" for joint in self.joints)


@dataclass(frozen=True)
class Problem:
    """A robot with the ends of its task: joint positions by the planner's order."""

    robot: Robot
    initial: list[float]
    final: list[float]


def load(path: Path) -> Problem:
    """The problem in a file, with the robot file it names."""
    text = path.read_text()
    entry = tomllib.loads(text)["robot"]
    file = path.parent / (entry["file"] if isinstance(entry, dict) else entry)
    robot = read(text, file.suffix, file.read_text())
    names = [joint.name for joint in robot.joints if joint.kind != "fixed"]
    task = tomllib.loads(text)["task"]
    return Problem(robot, *(_by_joint(task[end]["joints"], names) for end in ("initial", "final")))


def read(problem_text: str, robot_suffix: str, robot_text: str) -> Robot:
    """The robot of a problem's text; its own text is TOML or URDF by its file's suffix."""
    problem = tomllib.loads(problem_text)
    entry = problem["robot"] if isinstance(problem["robot"], dict) else {}
    reader = _from_toml if robot_suffix == ".toml" else _from_urdf
    name, base, joints = reader(robot_text)
    joints = [_locked(joint, entry.get("lock", {})) for joint in joints]
    if "base" in problem:
        spacecraft = Joint(
            "spacecraft", "fixed", None, ZERO, ZERO, (0, 0, 1), _body(problem["base"])
        )
        joints.append(spacecraft)
    return Robot(name, base, _depth_first(joints))


def _locked(joint: Joint, locks: dict[str, float]) -> Joint:
    if joint.name not in locks:
        return joint
    if locks[joint.name] != 0.0:
        raise ValueError(f"joint {joint.name} is locked away from zero, which is not read here")
    return Joint(joint.name, "fixed", joint.parent, joint.xyz, joint.rpy, joint.axis, joint.body)


def _depth_first(joints: list[Joint]) -> tuple[Joint, ...]:
    order: list[int] = []

    def visit(parent: int | None) -> None:
        for index, joint in enumerate(joints):
            if joint.parent == parent:
                order.append(index)
                visit(index)

    visit(None)
    new = {old: index for index, old in enumerate(order)} | {None: None}
    ordered = (joints[old] for old in order)
    return tuple(
        Joint(j.name, j.kind, new[j.parent], j.xyz, j.rpy, j.axis, j.body) for j in ordered
    )


def _by_joint(values: Any, names: list[str]) -> list[float]:
    return [float(v) for v in (values if isinstance(values, list) else map(values.get, names))]


def _triple(values: Any) -> Triple:
    x, y, z = (float(value) for value in values)
    return (x, y, z)


def _body(table: dict[str, Any]) -> Body:
    inertia = table["inertia"]
    if isinstance(inertia, (int, float)):
        inertia = [inertia] * 3
    if not isinstance(inertia[0], list):
        inertia = [[inertia[i] if i == j else 0.0 for j in range(3)] for i in range(3)]
    rows = tuple(_triple(row) for row in inertia)
    return Body(float(table["mass"]), _triple(table.get("com", ZERO)), rows)


def _from_toml(text: str) -> tuple[str, Body, list[Joint]]:
    table = tomllib.loads(text)
    index: dict[str, int | None] = {table["base"].get("name", "base"): None}
    joints: list[Joint] = []
    for row in table["joints"]:
        origin = row.get("origin", {})
        joints.append(
            Joint(
                row["name"],
                "revolute" if row["type"] == "continuous" else row["type"],
                index[row["parent"]] if "parent" in row else (len(joints) - 1 if joints else None),
                _triple(origin.get("xyz", ZERO)),
                _triple(origin.get("rpy", ZERO)),
                _triple(row.get("axis", (0, 0, 1))),
                _body(row["body"]),
            )
        )
        index[row["name"]] = len(joints) - 1
        index[row["body"].get("name", f"{row['name']}_link")] = len(joints) - 1
    return table["name"], _body(table["base"]), joints


def _from_urdf(text: str) -> tuple[str, Body, list[Joint]]:
    root = ET.fromstring(text)
    bodies = {link.attrib["name"]: _urdf_body(link) for link in root.iterfind("link")}
    rows = list(root.iterfind("joint"))
    child = {row.find("child").attrib["link"]: index for index, row in enumerate(rows)}
    (base,) = bodies.keys() - child.keys()
    joints = []
    for row in rows:
        kind = {"continuous": "revolute"}.get(row.attrib["type"], row.attrib["type"])
        if kind not in ("revolute", "prismatic", "fixed"):
            raise ValueError(f"joints of type {kind} are not read here")
        axis = row.find("axis")
        joints.append(
            Joint(
                row.attrib["name"],
                kind,
                child.get(row.find("parent").attrib["link"]),
                *_urdf_origin(row),
                (1.0, 0.0, 0.0) if axis is None else _triple(axis.attrib["xyz"].split()),
                bodies[row.find("child").attrib["link"]],
            )
        )
    return root.attrib["name"], bodies[base], joints


def _urdf_origin(element: ET.Element) -> tuple[Triple, Triple]:
    origin = element.find("origin")
    found = {} if origin is None else origin.attrib
    return _triple(found.get("xyz", "0 0 0").split()), _triple(found.get("rpy", "0 0 0").split())


def _urdf_body(link: ET.Element) -> Body:
    inertial = link.find("inertial")
    if inertial is None:
        return Body(0.0, ZERO, (ZERO, ZERO, ZERO))
    xyz, rpy = _urdf_origin(inertial)
    i = {key: float(value) for key, value in inertial.find("inertia").attrib.items()}
    xy, xz, yz = (i.get(key, 0.0) for key in ("ixy", "ixz", "iyz"))
    rows = ((i["ixx"], xy, xz), (xy, i["iyy"], yz), (xz, yz, i["izz"]))
    return Body(float(inertial.find("mass").attrib["value"]), xyz, rows, rpy)
