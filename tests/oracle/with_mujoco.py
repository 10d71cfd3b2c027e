"""MuJoCo: the joints driven by the planned torques in a simulation without gravity.

The torques are the planned ones and those of a stiff tracking law, which makes up for what the
plan leaves between its points; nothing acts on the base. How much the law adds is measured.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from plan import Plan, Segment
from robot import Body, Robot
from urdf import text

Array = NDArray[np.float64]
VERSION = f"MuJoCo {mujoco.__version__}"
STEP = 2e-3  # s, at most; classical Runge-Kutta
STIFFNESS = 40.0  # rad/s, of the critically damped tracking law


@dataclass(frozen=True)
class Simulation:
    """Base poses at the plan's rows; how far off the joints were and what feedback added."""

    poses: list[tuple[Array, Array]]
    joint_gap: float  # rad or m
    feedback: float  # rad/s² or m/s²
    steps: int


def simulate(plan: Plan, step: float = STEP) -> Simulation:
    """Plays the plan; steps of at most `step` seconds end at every row of the plan."""
    model = mujoco.MjModel.from_xml_string(mjcf(plan.robot))
    data = mujoco.MjData(model)
    segment = plan.segments[0]
    feedback = 0.0

    def reduced_mass() -> Array:
        full = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, full)
        return full[6:, 6:] - full[6:, :6] @ np.linalg.solve(full[:6, :6], full[:6, 6:])

    def law(segment: Segment, t: float) -> Array:
        rate_gap = segment.rate(t) - data.qvel[6:]
        return STIFFNESS**2 * (segment.position(t) - data.qpos[7:]) + 2 * STIFFNESS * rate_gap

    def control(_model: mujoco.MjModel, data: mujoco.MjData) -> None:
        nonlocal feedback
        t = min(max(data.time, segment.start), segment.end)
        correction = law(segment, t)
        feedback = max(feedback, np.abs(correction).max())
        data.qfrc_applied[6:] = segment.effort(t) + reduced_mass() @ correction

    data.qpos[3:7] = Rotation.from_matrix(plan.rotation[0]).as_quat(scalar_first=True)
    data.qpos[7:] = segment.position(segment.start)
    data.qvel[6:] = segment.rate(segment.start)
    mujoco.mj_forward(model, data)
    data.qpos[:3] = -data.subtree_com[1]
    mujoco.mj_forward(model, data)
    full = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    data.qvel[:6] = -np.linalg.solve(full[:6, :6], full[:6, 6:] @ data.qvel[6:])

    def pose() -> tuple[Array, Array]:
        turn = Rotation.from_quat(data.qpos[3:7], scalar_first=True)
        return turn.as_matrix(), data.qpos[:3].copy()

    poses, joint_gap, steps = [pose()], 0.0, 0
    mujoco.set_mjcb_control(control)
    try:
        for segment in plan.segments:
            for row in range(segment.first, segment.last):
                begin, end = plan.t[row], plan.t[row + 1]
                count = math.ceil((end - begin) / step)
                model.opt.timestep = (end - begin) / count
                data.time = begin
                for _ in range(count):
                    mujoco.mj_step(model, data)
                steps += count
                poses.append(pose())
                joint_gap = max(joint_gap, np.abs(segment.position(end) - data.qpos[7:]).max())
    finally:
        mujoco.set_mjcb_control(None)
    return Simulation(poses, joint_gap, feedback, steps)


def mjcf(robot: Robot) -> str:
    """The robot as MuJoCo's XML: no gravity, no shapes, no friction; `XYZ` are URDF's angles."""
    root = ET.Element("mujoco", model=robot.name)
    ET.SubElement(root, "compiler", angle="radian", eulerseq="XYZ")
    ET.SubElement(root, "option", gravity="0 0 0", integrator="RK4")
    base = ET.SubElement(ET.SubElement(root, "worldbody"), "body", name="base")
    ET.SubElement(base, "freejoint")
    _inertial(base, robot.base)
    bodies: list[ET.Element] = []
    for joint in robot.joints:
        parent = base if joint.parent is None else bodies[joint.parent]
        element = ET.SubElement(parent, "body", pos=text(joint.xyz), euler=text(joint.rpy))
        if joint.kind != "fixed":
            kind = {"revolute": "hinge", "prismatic": "slide"}[joint.kind]
            ET.SubElement(element, "joint", name=joint.name, type=kind, axis=text(joint.axis))
        _inertial(element, joint.body)
        bodies.append(element)
    return ET.tostring(root, encoding="unicode")


def _inertial(element: ET.Element, body: Body) -> None:
    if body.mass == 0.0:
        return
    turn = Rotation.from_euler("xyz", body.rpy).as_matrix()
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = turn @ np.array(body.inertia) @ turn.T
    full = " ".join(repr(float(i)) for i in (xx, yy, zz, xy, xz, yz))
    ET.SubElement(element, "inertial", pos=text(body.com), mass=repr(body.mass), fullinertia=full)
