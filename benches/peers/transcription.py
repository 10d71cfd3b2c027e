"""Radau collocation on equal segments, as the planner has it, for CasADi.

Variables are the states and controls of each point in turn, then the last state; rows are those of
each point in turn.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeVar

import casadi as ca
import numpy as np
from numpy.polynomial import Legendre

from model import Array, Model

Matrix = TypeVar("Matrix", ca.SX, ca.MX)


def radau(n: int) -> tuple[Array, Array, Array]:
    """Points in [-1, 1), weights, and differentiation through the points and 1."""
    points = np.sort((Legendre.basis(n - 1) + Legendre.basis(n)).roots().real)
    weights = np.linalg.solve(
        np.vander(points, increasing=True).T, [(1 + (-1) ** k) / (k + 1) for k in range(n)]
    )
    nodes = np.append(points, 1.0)
    gaps = nodes[:, None] - nodes[None, :]
    np.fill_diagonal(gaps, 1.0)
    scale = 1.0 / gaps.prod(axis=1)
    matrix = scale[None, :] / scale[:, None] / gaps
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    return points, weights, matrix[:n]


@dataclass
class Mesh:
    """The points of a model's programme."""

    model: Model
    segments: int
    degree: int

    def __post_init__(self) -> None:
        nodes, weights, self.derivative = radau(self.degree)
        self.points = self.segments * self.degree
        self.half = 0.5 * self.model.duration / self.segments
        self.weights = ca.DM(np.tile(self.half * weights, self.segments))
        starts = np.arange(self.segments)[:, None]
        self.fractions = np.append(((starts + 0.5 * (nodes + 1.0)) / self.segments).ravel(), 1.0)
        model = self.model
        self.size = self.points * (model.states + model.joints) + model.states
        self.row_count = self.points * (model.states + model.limited)

    def split(self, x: Matrix) -> tuple[Matrix, Matrix]:
        """States and controls, a column a point, and the last state."""
        width = self.model.states + self.model.joints
        inner = self.points * width
        return ca.reshape(x[:inner], width, self.points), x[inner:]

    def differentiation(self) -> ca.DM:
        """The constant part of the rows' Jacobian."""
        n, m, d = self.model.states, self.model.joints, self.degree
        height, width = n + self.model.limited, n + m
        row, column, value = [], [], []
        for k in range(self.points):
            first = k - k % d
            for j in range(d + 1):
                row += [k * height + i for i in range(n)]
                column += [(first + j) * width + i for i in range(n)]
                value += [self.derivative[k % d, j]] * n
        return ca.DM.triplet(row, column, ca.DM(value), self.row_count, self.size)

    def arguments(self, model: Model, parameters: Any = ()) -> dict[str, Array]:
        """Start and bounds for the solver; the ends are fixed by their bounds."""
        points, free = self.points, np.isnan(model.goal)
        low, high = np.tile(model.lower, (points + 1, 1)), np.tile(model.upper, (points + 1, 1))
        low[0] = high[0] = model.start
        low[-1, ~free] = high[-1, ~free] = model.goal[~free]
        control = np.tile(model.control, (points, 1))
        x, u = model.guess(self.fractions, parameters)
        rate = np.full((points, model.limited), model.base_rate_limit)
        zero = np.zeros((points, model.states))

        def column(states: Array, controls: Array) -> Array:
            return np.concatenate([np.hstack([states[:-1], controls]).ravel(), states[-1]])

        return {
            "x0": column(x, u[:-1]),
            "lbx": column(low, -control),
            "ubx": column(high, control),
            "lbg": np.hstack([zero, -rate]).ravel(),
            "ubg": np.hstack([zero, rate]).ravel(),
        }
