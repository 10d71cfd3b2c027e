"""The free-floating dynamics of any tree of turning joints, in three dimensions.

Written for generality, from the figures of a robot file alone. The models that are timed are
written by hand, and have to agree with this one.
"""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

import robot_file as robots

Array = NDArray[np.float64]


def dynamics(robot: robots.Robot, theta: ca.SX, rate: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Mass centre, base rate ω₀ and H⁻¹Cθ̇ of the free-floating system.

    Composite bodies give the mass matrix, one Newton-Euler pass without accelerations the bias;
    the base takes the net force and moment back.
    """
    n = robot.moving
    vector = lambda v: ca.SX(ca.sparsify(ca.DM([float(c) for c in v])))  # noqa: E731
    tensor = lambda b: ca.SX(  # noqa: E731
        ca.sparsify(ca.mtimes([_fixed(b.rpy), ca.DM(np.array(b.inertia)), _fixed(b.rpy).T]))
    )
    turn, origin, moving = [], [], []
    axes, pivots = [], []
    parts = [(robot.base.mass, vector(robot.base.com), tensor(robot.base))]
    count = 0
    for joint in robot.joints:
        frame = (
            (ca.SX.eye(3), ca.SX(3, 1))
            if joint.parent is None
            else (
                turn[joint.parent],
                origin[joint.parent],
            )
        )
        at = frame[1] + ca.mtimes(frame[0], vector(joint.xyz))
        axes_here = ca.mtimes(frame[0], ca.SX(_fixed(joint.rpy)))
        before = -1 if joint.parent is None else moving[joint.parent]
        if joint.kind == "revolute":
            axis = np.array(joint.axis) / np.linalg.norm(joint.axis)
            axes.append((ca.mtimes(axes_here, vector(axis)), before))
            pivots.append(at)
            axes_here = ca.mtimes(axes_here, _turn(axis, theta[count]))
            before = count
            count += 1
        elif joint.kind != "fixed":
            raise ValueError(f"joint {joint.name}: joints of type {joint.kind} are not read here")
        turn.append(axes_here)
        origin.append(at)
        moving.append(before)
        com = at + ca.mtimes(axes_here, vector(joint.body.com))
        inertia = ca.mtimes([axes_here, tensor(joint.body), axes_here.T])
        parts.append((joint.body.mass, com, inertia))
    of_joint = [-1, *moving]

    composite = [
        _composite([p for p, j in zip(parts, of_joint, strict=True) if _carries(axes, i, j)])
        for i in range(n)
    ]
    mass, center, inertia = _composite(parts)
    momenta, angular = [], []
    for (axis, _), pivot, (m, c, tens) in zip(axes, pivots, composite, strict=True):
        momenta.append(m * ca.cross(axis, c - pivot))
        angular.append(ca.mtimes(tens, axis) + ca.cross(c - center, momenta[-1]))
    coupling = ca.horzcat(*angular)
    inverse = _inverse(inertia)
    carried = ca.mtimes(inverse, coupling)
    omega = -ca.mtimes(carried, rate)

    h = ca.SX(n, n)
    for i in range(n):
        m, c, tens = composite[i]
        j = i
        while j >= 0:
            about = ca.mtimes(tens, axes[i][0]) + ca.cross(c - pivots[j], momenta[i])
            h[i, j] = h[j, i] = ca.dot(axes[j][0], about)
            j = axes[j][1]
    linear = ca.horzcat(*momenta)
    h = h - ca.mtimes(linear.T, linear) / mass - ca.mtimes(coupling.T, carried)

    # Newton-Euler with ω₀ and θ̇, no accelerations.
    spin, swing, pull = [], [], []
    for i, (axis, parent) in enumerate(axes):
        w, dw, a, p = (
            (omega, ca.SX(3, 1), ca.SX(3, 1), ca.SX(3, 1))
            if parent < 0
            else (spin[parent], swing[parent], pull[parent], pivots[parent])
        )
        arm = pivots[i] - p
        spin.append(w + axis * rate[i])
        swing.append(dw + ca.cross(w, axis * rate[i]))
        pull.append(a + ca.cross(dw, arm) + ca.cross(w, ca.cross(w, arm)))
    forces, moments = [ca.SX(3, 1) for _ in range(n + 1)], [ca.SX(3, 1) for _ in range(n + 1)]
    for (m, c, tens), j in zip(parts, of_joint, strict=True):
        w, dw, a, p = (
            (omega, ca.SX(3, 1), ca.SX(3, 1), ca.SX(3, 1))
            if j < 0
            else (spin[j], swing[j], pull[j], pivots[j])
        )
        arm = c - p
        force = m * (a + ca.cross(dw, arm) + ca.cross(w, ca.cross(w, arm)))
        moment = ca.mtimes(tens, dw) + ca.cross(w, ca.mtimes(tens, w)) + ca.cross(c, force)
        forces[j + 1] += force
        moments[j + 1] += moment
    for i in range(n - 1, -1, -1):
        forces[axes[i][1] + 1] += forces[i + 1]
        moments[axes[i][1] + 1] += moments[i + 1]
    net, moment = forces[0], moments[0]
    alpha = -ca.mtimes(inverse, moment - ca.cross(center, net))
    accel = -net / mass - ca.cross(alpha, center)
    bias = []
    for i, (axis, _) in enumerate(axes):
        m, c, tens = composite[i]
        push = forces[i + 1] + m * (accel + ca.cross(alpha, c))
        about = moments[i + 1] + ca.mtimes(tens, alpha) + ca.cross(c, push - forces[i + 1])
        bias.append(ca.dot(axis, about - ca.cross(pivots[i], push)))
    return center, omega, _solve(h, ca.vertcat(*bias))


def _about(axis: str, angle: float) -> ca.DM:
    c, s = np.cos(angle), np.sin(angle)
    rows = {
        "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
        "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
        "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    }[axis]
    return ca.DM(rows)


def _turn(axis: Array, angle: ca.SX) -> ca.SX:
    """Rotation about a constant axis; its zeros stay zeros."""
    k = ca.SX(ca.sparsify(ca.skew(ca.DM(axis))))
    return ca.SX.eye(3) + ca.sin(angle) * k + (1 - ca.cos(angle)) * ca.mtimes(k, k)


def _fixed(rpy: robots.Triple) -> ca.DM:
    roll, pitch, yaw = (float(v) for v in rpy)
    turns = [_about(a, v) for a, v in (("z", yaw), ("y", pitch), ("x", roll))]
    return ca.sparsify(ca.mtimes(turns), 1e-16)


def _carries(axes: list, ancestor: int, joint: int) -> bool:
    while joint > ancestor:
        joint = axes[joint][1]
    return joint == ancestor


def _composite(parts: list) -> tuple[float, ca.SX, ca.SX]:
    mass = sum(m for m, _, _ in parts)
    center = sum(m * c for m, c, _ in parts) / mass
    inertia = ca.SX(3, 3)
    for m, c, tensor in parts:
        d = c - center
        inertia += tensor + m * (ca.dot(d, d) * ca.SX.eye(3) - ca.mtimes(d, d.T))
    return mass, center, inertia


def _inverse(a: ca.SX) -> ca.SX:
    columns = [a[:, i] for i in range(3)]
    rows = [ca.cross(columns[(i + 1) % 3], columns[(i + 2) % 3]) for i in range(3)]
    return ca.horzcat(*rows).T / ca.dot(columns[0], rows[0])


def _solve(h: ca.SX, b: ca.SX) -> ca.SX:
    """H⁻¹b by LDLᵀ without pivoting; H is positive definite."""
    n = h.shape[0]
    lower, diagonal = [[ca.SX(0)] * n for _ in range(n)], []
    for i in range(n):
        for j in range(i):
            inner = sum((lower[i][k] * diagonal[k] * lower[j][k] for k in range(j)), ca.SX(0))
            lower[i][j] = (h[i, j] - inner) / diagonal[j]
        inner = sum((lower[i][k] ** 2 * diagonal[k] for k in range(i)), ca.SX(0))
        diagonal.append(h[i, i] - inner)
    y = [b[i] for i in range(n)]
    for i in range(n):
        for k in range(i):
            y[i] -= lower[i][k] * y[k]
    y = [value / d for value, d in zip(y, diagonal, strict=True)]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            y[i] -= lower[k][i] * y[k]
    return ca.vertcat(*y)
