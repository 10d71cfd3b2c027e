"""A chain of turning joints on a free base in space, as one would write it by hand for CasADi.

Everything is in axes of the base, and sums are taken about its origin, so that composite bodies are
plain sums. Links that do not move against each other are one body. An inertia is a·1 plus what its
axes differ from that, which for a link that is round about its axis is one dyad.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np
from numpy.typing import NDArray

import robot_file as robots

Array = NDArray[np.float64]


@dataclass
class Link:
    """Rigid body behind one joint, in the frame of that joint."""

    mass: float
    moment: Array  # mass times mass centre
    inertia: Array  # about the origin of the frame


@dataclass(frozen=True)
class Joint:
    """A turning joint: its frame in that of the link before, its axis there at zero."""

    offset: Array
    turn: Array
    axis: Array


def fits(robot: robots.Robot) -> bool:
    """Whether the robot is a chain of turning joints, rigid links aside."""
    kinds = all(joint.kind in ("revolute", "fixed") for joint in robot.joints)
    parents = [joint.parent for joint in robot.joints]
    return kinds and parents == [None, *range(len(robot.joints) - 1)]


def dynamics(robot: robots.Robot, theta: ca.SX, rate: ca.SX) -> tuple[ca.SX, ca.SX, ca.SX]:
    """Mass centre, base rate ω₀ and H⁻¹Cθ̇ of the free-floating system."""
    joints, links = _rigid(robot)
    n = len(joints)

    # Kinematics, and each link as mass, mass centre and inertia about it.
    turn, origin = ca.SX.eye(3), ca.SX(3, 1)
    axes, pivots, bodies = [], [], []
    for i, (joint, link) in enumerate(zip(joints, links[1:], strict=True)):
        origin = origin + ca.mtimes(turn, _sparse(joint.offset))
        turn = ca.mtimes(turn, _sparse(joint.turn))
        axis = ca.mtimes(turn, _sparse(joint.axis))
        turn = ca.mtimes(turn, _about(joint.axis, theta[i]))
        axes.append(axis)
        pivots.append(origin)
        center = link.moment / link.mass
        about = link.inertia - _point(link.mass, center)
        round_part, dyads = _dyads(about)
        arm = ca.mtimes(turn, _sparse(center))
        vectors = [(size, ca.mtimes(turn, _sparse(axis_))) for size, axis_ in dyads]
        bodies.append((link.mass, arm, round_part, vectors))

    # Composite bodies about the origin of the base.
    mass, moment, inertia = [0.0] * n, [ca.SX(3, 1)] * n, [ca.SX(3, 3)] * n
    for i in range(n - 1, -1, -1):
        m, arm, round_part, vectors = bodies[i]
        center = pivots[i] + arm
        first = m * center
        second = (round_part + ca.dot(first, center)) * ca.SX.eye(3) - _dyad(first, center)
        for size, v in vectors:
            second += _dyad(size * v, v)
        above = i + 1
        mass[i] = m + (mass[above] if above < n else 0.0)
        moment[i] = first + moment[above] if above < n else first
        inertia[i] = second + inertia[above] if above < n else second
    base = links[0]
    total = base.mass + mass[0]
    center = (_sparse(base.moment) + moment[0]) / total
    whole = _sparse(base.inertia) + inertia[0]
    whole = whole - total * (ca.dot(center, center) * ca.SX.eye(3) - _dyad(center, center))
    inverse = _inverse(whole)

    # Momenta for a unit rate of each joint: linear, angular about the origin and about the centre.
    levers = [ca.cross(pivot, a) for pivot, a in zip(pivots, axes, strict=True)]
    linear = [ca.cross(a, moment[i]) + mass[i] * levers[i] for i, a in enumerate(axes)]
    angular = [
        ca.mtimes(inertia[i], a) + ca.cross(moment[i], levers[i]) for i, a in enumerate(axes)
    ]
    coupling = [angular[i] - ca.cross(center, linear[i]) for i in range(n)]
    carried = [ca.mtimes(inverse, column) for column in coupling]
    omega = -ca.mtimes(inverse, sum((coupling[i] * rate[i] for i in range(n)), ca.SX(3, 1)))

    h = [[ca.SX(0)] * n for _ in range(n)]
    for i in range(n):
        for j in range(i + 1):
            free = ca.dot(axes[j], angular[i]) + ca.dot(levers[j], linear[i])
            h[i][j] = free - ca.dot(linear[i], linear[j]) / total - ca.dot(coupling[i], carried[j])

    # Newton-Euler with ω₀ and θ̇, no accelerations.
    w, dw, a, before = omega, ca.SX(3, 1), ca.SX(3, 1), ca.SX(3, 1)
    forces, moments = [], []
    for i, (m, arm, _, vectors) in enumerate(bodies):
        a = a + _moved(w, dw, pivots[i] - before)
        spin = axes[i] * rate[i]
        dw = dw + ca.cross(w, spin)
        w = w + spin
        before = pivots[i]
        force = m * (a + _moved(w, dw, arm))
        # The round part needs no rotation: a·dω; the dyads add d·v(v·dω) + d·(v·ω)(ω×v).
        turned = bodies[i][2] * dw
        for size, v in vectors:
            turned += size * (v * ca.dot(v, dw) + ca.cross(w, v) * ca.dot(v, w))
        forces.append(force)
        moments.append(turned + ca.cross(pivots[i] + arm, force))
    for i in range(n - 2, -1, -1):
        forces[i] = forces[i] + forces[i + 1]
        moments[i] = moments[i] + moments[i + 1]
    # The base itself only turns, about a point that does not accelerate.
    still = _sparse(base.moment)
    force0 = forces[0] + ca.cross(omega, ca.cross(omega, still))
    moment0 = moments[0] + ca.cross(omega, ca.mtimes(_sparse(base.inertia), omega))
    net = ca.mtimes(inverse, moment0 - ca.cross(center, force0))
    push = force0 / total
    bias = [
        ca.dot(axes[i], moments[i])
        + ca.dot(levers[i], forces[i])
        - ca.dot(linear[i], push)
        - ca.dot(coupling[i], net)
        for i in range(n)
    ]
    return center, omega, _solve(h, bias)


def _moved(w: ca.SX, dw: ca.SX, arm: ca.SX) -> ca.SX:
    """Acceleration that turning gives the end of `arm`: dω×r + ω(ω·r) − r(ω·ω)."""
    return ca.cross(dw, arm) + w * ca.dot(w, arm) - arm * ca.dot(w, w)


def _rigid(robot: robots.Robot) -> tuple[list[Joint], list[Link]]:
    """The chain with rigid links put together; the base's link first."""
    links = [_link(robot.base, np.zeros(3), np.eye(3))]
    joints: list[Joint] = []
    offset, turn = np.zeros(3), np.eye(3)
    for joint in robot.joints:
        offset = offset + turn @ np.array(joint.xyz)
        turn = turn @ _rotation(joint.rpy)
        if joint.kind == "revolute":
            axis = np.array(joint.axis, float)
            joints.append(Joint(offset, turn, axis / np.linalg.norm(axis)))
            links.append(Link(0.0, np.zeros(3), np.zeros((3, 3))))
            offset, turn = np.zeros(3), np.eye(3)
        more = _link(joint.body, offset, turn)
        links[-1].mass += more.mass
        links[-1].moment = links[-1].moment + more.moment
        links[-1].inertia = links[-1].inertia + more.inertia
    return joints, links


def _link(body: robots.Body, offset: Array, turn: Array) -> Link:
    center = offset + turn @ np.array(body.com)
    axes = turn @ _rotation(body.rpy)
    inertia = axes @ np.array(body.inertia) @ axes.T + _point(body.mass, center)
    return Link(body.mass, body.mass * center, inertia)


def _point(mass: float, at: Array) -> Array:
    return mass * (at @ at * np.eye(3) - np.outer(at, at))


def _dyads(inertia: Array) -> tuple[float, list[tuple[float, Array]]]:
    """a and the fewest (d, v) with inertia = a·1 + Σ d v vᵀ."""
    if np.count_nonzero(inertia - np.diag(np.diag(inertia))):
        sizes, axes = np.linalg.eigh(inertia)
    else:
        sizes, axes = np.diag(inertia), np.eye(3)
    middle = min(sizes, key=lambda s: np.count_nonzero(np.abs(sizes - s) > 1e-14 * max(sizes)))
    apart = [i for i in range(3) if abs(sizes[i] - middle) > 1e-14 * max(sizes)]
    return float(middle), [(float(sizes[i] - middle), axes[:, i]) for i in apart]


def _rotation(rpy: robots.Triple) -> Array:
    """Rz·Ry·Rx."""
    (sr, cr), (sp, cp), (sy, cy) = ((np.sin(v), np.cos(v)) for v in rpy)
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def _sparse(values: Array) -> ca.SX:
    return ca.SX(ca.sparsify(ca.DM(values), 1e-16))


def _about(axis: Array, angle: ca.SX) -> ca.SX:
    """Rotation about a constant axis; its zeros stay zeros."""
    k = _sparse(np.array(ca.skew(ca.DM(axis))))
    square = _sparse(np.outer(axis, axis))
    cos = ca.cos(angle)
    return square + cos * (ca.SX.eye(3) - square) + ca.sin(angle) * k


def _dyad(a: ca.SX, b: ca.SX) -> ca.SX:
    return ca.mtimes(a, b.T)


def _inverse(a: ca.SX) -> ca.SX:
    """Of a symmetric 3×3 matrix, by its six cofactors."""
    c00 = a[1, 1] * a[2, 2] - a[1, 2] * a[1, 2]
    c01 = a[0, 2] * a[1, 2] - a[0, 1] * a[2, 2]
    c02 = a[0, 1] * a[1, 2] - a[0, 2] * a[1, 1]
    c11 = a[0, 0] * a[2, 2] - a[0, 2] * a[0, 2]
    c12 = a[0, 1] * a[0, 2] - a[0, 0] * a[1, 2]
    c22 = a[0, 0] * a[1, 1] - a[0, 1] * a[0, 1]
    rows = [[c00, c01, c02], [c01, c11, c12], [c02, c12, c22]]
    scale = 1.0 / (a[0, 0] * c00 + a[0, 1] * c01 + a[0, 2] * c02)
    return ca.vertcat(*(ca.horzcat(*row) for row in rows)) * scale


def _solve(h: list[list[ca.SX]], b: list[ca.SX]) -> ca.SX:
    """H⁻¹b by LDLᵀ without pivoting; H, of which the lower half is given, is positive definite."""
    n = len(b)
    lower = [[ca.SX(0)] * n for _ in range(n)]
    scale: list[ca.SX] = []
    for i in range(n):
        scaled = [ca.SX(0)] * i
        pivot = h[i][i]
        for j in range(i):
            scaled[j] = h[i][j] - sum((scaled[k] * lower[j][k] for k in range(j)), ca.SX(0))
            lower[i][j] = scaled[j] * scale[j]
            pivot -= scaled[j] * lower[i][j]
        scale.append(1.0 / pivot)
    x = list(b)
    for i in range(n):
        x[i] = x[i] - sum((lower[i][k] * x[k] for k in range(i)), ca.SX(0))
    for i in range(n - 1, -1, -1):
        tail = sum((lower[k][i] * x[k] for k in range(i + 1, n)), ca.SX(0))
        x[i] = x[i] * scale[i] - tail
    return ca.vertcat(*x)
