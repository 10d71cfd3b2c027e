"""A problem file as CasADi expressions, for every peer to be given the same problem.

Frames and signs are those of docs/robot-file.md; all vectors in axes of the base. Only what the
benchmarks need is read: robots without tools, goals in joint space, a fixed duration.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

import generic
import robot_file as robots
import spatial_arm
import two_link

Array = NDArray[np.float64]
Dynamics = Callable[[robots.Robot, ca.SX, ca.SX], tuple[ca.SX, ca.SX, ca.SX]]


@dataclass(frozen=True)
class Model:
    """States x = [η, θ, θ̇], controls u: ẋ = f(x, u), J = ends(x₀, x_f) + ∫ running(x, u).

    `parameters` are figures of the robot that are given at each solve; mostly there are none.
    """

    name: str
    duration: float
    angles: int
    joints: int
    parameters: int
    node: ca.Function  # (x, u, p) to the rates f, the base's rate and the running cost
    ends: ca.Function  # (x₀, x_f, p)
    base_rate_limit: float  # infinite where there is none
    lower: Array
    upper: Array
    control: Array
    start: Array
    goal: Array  # nan where free

    @property
    def states(self) -> int:
        """Number of states."""
        return self.angles + 2 * self.joints

    @property
    def limited(self) -> int:
        """Rows of the base's rate that have limits."""
        return self.angles if np.isfinite(self.base_rate_limit) else 0

    def towards(self, joints: Array) -> Model:
        """The same with another goal."""
        goal = self.goal.copy()
        goal[self.angles : self.angles + self.joints] = joints
        return replace(self, goal=goal)

    def guess(self, fractions: Array, parameters: Any = ()) -> tuple[Array, Array]:
        """Joints along a quintic, the base following: states and controls by rows."""
        a, n, total = self.angles, self.joints, self.duration
        move = self.goal[a : a + n] - self.start[a : a + n]

        def at(p: Array) -> tuple[Array, Array, Array]:
            blend = p**3 * (10 + p * (6 * p - 15))
            slope, bend = 30 * p**2 * (1 - p) ** 2, 60 * p * (1 - p) * (1 - 2 * p)
            q = self.start[a : a + n] + np.outer(blend, move)
            return q, np.outer(slope, move) / total, np.outer(bend, move) / total**2

        # The base by the midpoint rule. In the plane its rate does not depend on it: all at once.
        grid = np.linspace(0.0, 1.0, 401)
        middle = 0.5 * (grid[:-1] + grid[1:])
        q, rate, control = at(middle)
        step = total / (len(grid) - 1)
        eta = np.tile(self.start[:a], (len(grid), 1))
        if a == 1:
            x = np.hstack([np.zeros((len(middle), 1)), q, rate])
            turning = np.array(self.node(x.T, control.T, parameters)[1])
            eta[1:] += step * np.cumsum(turning, axis=1).T
        else:
            for k in range(len(middle)):
                x = np.concatenate([eta[k], q[k], rate[k]])
                eta[k + 1] = (
                    eta[k] + step * np.array(self.node(x, control[k], parameters)[1]).ravel()
                )
        etas = np.column_stack([np.interp(fractions, grid, eta[:, i]) for i in range(a)])
        q, rate, control = at(np.asarray(fractions))
        return np.hstack([etas, q, rate]), control


def load(path: Path, dynamics: Dynamics | None = None, varied: Varied | None = None) -> Model:
    """The model of the problem in a file, its dynamics written by hand unless others are given."""
    table = tomllib.loads(path.read_text())
    problem = robots.load(path)
    arm, parameters = (problem.robot, ca.SX(0, 1)) if varied is None else varied(problem.robot)
    n = arm.moving
    planar = all(j.axis == (0.0, 0.0, 1.0) and j.rpy == robots.ZERO for j in arm.joints)
    a = 1 if planar else 3
    limits, weights = table["limits"], table["cost"]

    x, u = ca.SX.sym("x", a + 2 * n), ca.SX.sym("u", n)
    eta, theta, rate = x[:a], x[a : a + n], x[a + n :]
    center, omega, bias = (dynamics or by_hand(arm))(arm, theta, rate)
    attitude_rate = omega if planar else _rates(eta, omega)
    running = (
        _weight(weights, "base_rate") * ca.sumsqr(attitude_rate)
        + _weight(weights, "joint_rate") * ca.sumsqr(rate)
        + _weight(weights, "control") * ca.sumsqr(u)
    )
    outputs = ca.cse([ca.vertcat(attitude_rate, rate, u - bias), attitude_rate, running])
    place = ca.Function("place", [x, parameters], [-ca.mtimes(_rotation(eta, planar), center)])
    first, last = ca.SX.sym("first", a + 2 * n), ca.SX.sym("last", a + 2 * n)
    moved = place(last, parameters) - place(first, parameters)
    ends = _weight(weights, "final_base_attitude") * ca.sumsqr(last[:a]) + _weight(
        weights, "final_base_position"
    ) * ca.sumsqr(moved)

    bound = np.full(a + 2 * n, np.inf)
    bound[:a] = limits.get("base_attitude", np.inf)
    bound[a : a + n] = limits.get("joint_position", np.inf)
    bound[a + n :] = limits.get("joint_velocity", np.inf)
    start = np.concatenate([np.zeros(a), problem.initial, np.zeros(n)])
    goal = np.concatenate([np.full(a, np.nan), problem.final, np.zeros(n)])
    return Model(
        table["name"],
        float(table["task"]["duration"]),
        a,
        n,
        parameters.numel(),
        ca.Function("node", [x, u, parameters], outputs),
        ca.Function("ends", [first, last, parameters], [ca.cse(ends)]),
        float(limits.get("base_rate", np.inf)),
        -bound,
        bound,
        np.broadcast_to(np.asarray(limits.get("control", np.inf), float), (n,)).copy(),
        start,
        goal,
    )


Varied = Callable[[robots.Robot], tuple[robots.Robot, ca.SX]]
"""Makes figures of a robot symbols: the robot with them, and the column of them."""


def by_hand(robot: robots.Robot) -> Dynamics:
    """The model written by hand for a robot of this kind."""
    for written in (two_link, spatial_arm):
        if written.fits(robot):
            return written.dynamics
    raise ValueError(f"no model of {robot.name} is written by hand")


def in_the_plane(robot: robots.Robot, theta: ca.SX, rate: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX]:
    """The generic dynamics of a planar robot, vectors of the plane only."""
    center, omega, bias = generic.dynamics(robot, theta, rate)
    return center[:2], omega[2], bias


def _weight(weights: dict[str, Any], key: str) -> float:
    return float(weights.get(key, 0.0))


def _rotation(eta: ca.SX, planar: bool) -> ca.SX:
    """Of the base: R(η) in the plane, Rz Ry Rx in space."""
    if planar:
        c, s = ca.cos(eta), ca.sin(eta)
        return ca.vertcat(ca.horzcat(c, -s), ca.horzcat(s, c))
    (sr, cr), (sp, cp), (sy, cy) = ((ca.sin(v), ca.cos(v)) for v in ca.vertsplit(eta))
    rows = [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
    return ca.vertcat(*(ca.horzcat(*row) for row in rows))


def _rates(eta: ca.SX, omega: ca.SX) -> ca.SX:
    """Rates of roll, pitch and yaw at the angular velocity `omega` in axes of the base."""
    s, c = ca.sin(eta[0]), ca.cos(eta[0])
    turning = (s * omega[1] + c * omega[2]) / ca.cos(eta[1])
    return ca.vertcat(omega[0] + ca.sin(eta[1]) * turning, c * omega[1] - s * omega[2], turning)
