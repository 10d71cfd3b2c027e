"""Pinocchio: the base's motion from the centroidal momentum map."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray

from robot import Body, Robot

Array = NDArray[np.float64]
VERSION = f"Pinocchio {pin.__version__}"


class Pinocchio:
    """A model on a free-flyer, built from the figures."""

    def __init__(self, robot: Robot) -> None:
        model = pin.Model()
        base = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "base")
        model.appendBodyToJoint(base, _inertia(robot.base), pin.SE3.Identity())
        carriers: list[tuple[int, pin.SE3]] = []  # joint and pose of each body's frame in it
        for joint in robot.joints:
            origin = pin.SE3(pin.rpy.rpyToMatrix(*joint.rpy), np.array(joint.xyz))
            parent, at = (
                (base, pin.SE3.Identity()) if joint.parent is None else carriers[joint.parent]
            )
            placement = at * origin
            if joint.kind == "fixed":
                carriers.append((parent, placement))
            else:
                axis = np.array(joint.axis) / np.linalg.norm(joint.axis)
                kinds = {
                    "revolute": pin.JointModelRevoluteUnaligned,
                    "prismatic": pin.JointModelPrismaticUnaligned,
                }
                moved = model.addJoint(parent, kinds[joint.kind](axis), placement, joint.name)
                carriers.append((moved, pin.SE3.Identity()))
            model.appendBodyToJoint(carriers[-1][0], _inertia(joint.body), carriers[-1][1])
        self.model, self.data = model, model.createData()

    def _configuration(self, rotation: Array, position: Array, q: Array) -> Array:
        quaternion = pin.Quaternion(rotation)
        quaternion.normalize()
        return np.concatenate([position, quaternion.coeffs(), q])

    def system_center(self, rotation: Array, position: Array, q: Array) -> Array:
        """See `replay.Tool`."""
        configuration = self._configuration(rotation, position, q)
        return pin.centerOfMass(self.model, self.data, configuration).copy()

    def base_twist(
        self, rotation: Array, position: Array, q: Array, rate: Array
    ) -> tuple[Array, Array]:
        """See `replay.Tool`."""
        configuration = self._configuration(rotation, position, q)
        momentum = pin.computeCentroidalMap(self.model, self.data, configuration)
        twist = -np.linalg.solve(momentum[:, :6], momentum[:, 6:] @ rate)  # in base axes
        return rotation @ twist[:3], twist[3:]

    def reduced(self, q: Array, rate: Array) -> tuple[Array, Array]:
        """Mass matrix H and Coriolis force of the joints with the base eliminated."""
        still = np.eye(3), np.zeros(3)
        configuration = self._configuration(*still, q)
        velocity = np.concatenate([*self.base_twist(*still, q, rate), rate])
        matrix = pin.crba(self.model, self.data, configuration)
        matrix = np.triu(matrix) + np.triu(matrix, 1).T
        self.model.gravity.setZero()
        force = pin.nonLinearEffects(self.model, self.data, configuration, velocity)
        carry = np.linalg.solve(matrix[:6, :6], np.column_stack([matrix[:6, 6:], force[:6]]))
        return (
            matrix[6:, 6:] - matrix[6:, :6] @ carry[:, :-1],
            force[6:] - matrix[6:, :6] @ carry[:, -1],
        )


def _inertia(body: Body) -> pin.Inertia:
    turn = pin.rpy.rpyToMatrix(*body.rpy)
    return pin.Inertia(body.mass, np.array(body.com), turn @ np.array(body.inertia) @ turn.T)
