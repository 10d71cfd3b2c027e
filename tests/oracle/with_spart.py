"""SPART: the base's motion from its generalised inertia matrix.

SPART's base frame is at the base's mass centre; its base velocity is the angular velocity in base
axes followed by that of the mass centre in inertial axes. Its Python port has no function for the
inertia matrix, whose columns are the forces of inverse dynamics for unit accelerations.

Two faults of SPARTpy 1.1.3 are gone around:
- Inverse dynamics (ID_C.c) sums over as many bodies as joints move: with fixed joints the last
  bodies have no inertia. Fixed joints are given as ones that stay at zero.
- Velocities (Velocities_C.c) takes the body before for the parent, which is wrong where an
  arm branches. Accelerations from rest map alike and know the parent; they are used in its place.
"""

from __future__ import annotations

import dataclasses
import tempfile
from importlib.metadata import version
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from SPARTpy import SPART

import urdf
from robot import ZERO, Robot

Array = NDArray[np.float64]
VERSION = f"SPARTpy {version('SPARTpy')}"


class Spart:
    """A model read by SPART's own URDF reader."""

    def __init__(self, robot: Robot) -> None:
        if robot.base.rpy != ZERO:
            raise ValueError("SPART's base axes are those of the base's inertia")
        kinds = [joint.kind for joint in robot.joints]
        loose = [
            dataclasses.replace(joint, kind="revolute" if joint.kind == "fixed" else joint.kind)
            for joint in robot.joints
        ]
        robot = dataclasses.replace(robot, joints=tuple(loose))
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "robot.urdf"
            file.write_text(urdf.write(robot))
            self.spart = SPART(str(file))
        self.center = np.array(robot.base.com)
        self.moving = np.array([kind != "fixed" for kind in kinds])
        self.bodies = len(kinds)

    def _all(self, values: Array) -> Array:
        """Values of the moving joints, with zeros for those that stay."""
        full = np.zeros(self.bodies)
        full[self.moving] = values
        return full

    def system_center(self, rotation: Array, position: Array, q: Array) -> Array:
        """See `replay.Tool`."""
        base = position + rotation @ self.center
        *_, links, _, _ = self.spart.kinematics(rotation, base, self._all(q))
        model = self.spart.robot
        masses = np.array([link.mass for link in model.links])
        moment = model.base_link_mass * base + np.reshape(links, (3, -1)) @ masses
        return moment / (model.base_link_mass + masses.sum())

    def _forces(
        self, rotation: Array, base: Array, q: Array, velocity: Array, accelerations: Array
    ) -> Array:
        """Inverse dynamics, one column of forces for each of accelerations."""
        spart = self.spart
        _, turns, _, links, axes, arms = spart.kinematics(rotation, base, self._all(q))
        geometry = spart.diff_kinematics(rotation, base, links, axes, arms)
        bij, bi0, p0, pm = geometry
        i0, im = spart.i_i(rotation, turns)
        rest = np.zeros(6), np.zeros((6, self.bodies)), p0, pm, bi0, bij
        motion = velocity[:6].copy(), velocity[6:].copy()
        t0, tl = spart.accelerations(*rest, np.zeros(6), np.zeros(self.bodies), *motion)
        none = np.zeros(6), np.zeros((6, self.bodies))
        columns = []
        for column in accelerations.T:
            d0, dl = spart.accelerations(
                t0, tl, p0, pm, bi0, bij, *motion, column[:6].copy(), column[6:].copy()
            )
            forces = spart.inverse_dynamics(*none, t0, tl, d0, dl, p0, pm, i0, im, bij, bi0)
            columns.append(np.concatenate([np.ravel(force) for force in forces]))
        return np.array(columns).T

    def _base_velocity(self, rotation: Array, base: Array, q: Array, rate: Array) -> Array:
        """The first six rows of H·[u0, rate] are the momentum's, and zero."""
        size = 6 + self.bodies
        columns = np.zeros((size, 7))
        columns[:6, :6] = np.eye(6)
        columns[6:, 6] = self._all(rate)
        forces = self._forces(rotation, base, q, np.zeros(size), columns)[:6]
        return -np.linalg.solve(forces[:, :6], forces[:, 6])

    def base_twist(
        self, rotation: Array, position: Array, q: Array, rate: Array
    ) -> tuple[Array, Array]:
        """See `replay.Tool`."""
        base = position + rotation @ self.center
        velocity = self._base_velocity(rotation, base, q, rate)
        omega = velocity[:3]
        return velocity[3:] - rotation @ np.cross(omega, self.center), omega

    def reduced(self, q: Array, rate: Array) -> tuple[Array, Array]:
        """Mass matrix H and Coriolis force of the joints with the base eliminated."""
        size = 6 + self.bodies
        free = np.append(np.full(6, True), self.moving)
        pose = np.eye(3), self.center
        velocity = np.append(self._base_velocity(*pose, q, rate), self._all(rate))
        matrix = self._forces(*pose, q, np.zeros(size), np.eye(size))[free][:, free]
        force = self._forces(*pose, q, velocity, np.zeros((size, 1)))[free]
        carry = np.linalg.solve(matrix[:6, :6], np.column_stack([matrix[:6, 6:], force[:6]]))
        return (
            matrix[6:, 6:] - matrix[6:, :6] @ carry[:, :-1],
            force[6:, 0] - matrix[6:, :6] @ carry[:, -1],
        )
