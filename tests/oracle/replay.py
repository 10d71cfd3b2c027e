"""The base's motion by momentum conservation, along a joint path that is followed exactly."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]


class Tool(Protocol):
    """What is asked of a tool: where its mass centre is and how its base moves."""

    def system_center(self, rotation: Array, position: Array, q: Array) -> Array:
        """Mass centre of the system in inertial axes, m."""
        ...

    def base_twist(
        self, rotation: Array, position: Array, q: Array, rate: Array
    ) -> tuple[Array, Array]:
        """Without momentum: velocity of the base's origin in inertial axes (m/s), angular
        velocity in base axes (rad/s)."""
        ...


def start(tool: Tool, rotation: Array, q: Array) -> Array:
    """Base position that has the system's mass centre at the origin, m."""
    return -tool.system_center(rotation, np.zeros(3), q)


def replay(
    tool: Tool,
    path: Callable[[float], tuple[Array, Array]],
    times: Sequence[float],
    rotation: Array,
    position: Array,
) -> list[tuple[Array, Array]]:
    """Base orientations and positions at `times`, the first given; `path` yields positions and
    rates of the joints and is smooth between the times."""

    def derivative(t: float, y: Array) -> Array:
        turn = Rotation.from_quat(y[3:])  # normalises; x, y, z, w
        velocity, omega = tool.base_twist(turn.as_matrix(), y[:3], *path(t))
        x, w = y[3:6], y[6]
        spin = 0.5 * np.append(w * omega + np.cross(x, omega), -x @ omega)
        return np.append(velocity, spin)

    poses = [(rotation, position)]
    y = np.append(position, Rotation.from_matrix(rotation).as_quat())
    for begin, end in pairwise(times):
        result = solve_ivp(derivative, (begin, end), y, method="DOP853", rtol=1e-12, atol=1e-14)
        if not result.success:
            raise RuntimeError(result.message)
        y = result.y[:, -1]
        y[3:] /= np.linalg.norm(y[3:])
        poses.append((Rotation.from_quat(y[3:]).as_matrix(), y[:3]))
    return poses
