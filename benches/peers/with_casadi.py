"""CasADi with Ipopt, the transcription the planner uses written out by hand."""

from __future__ import annotations

import time

import casadi as ca
import numpy as np
from numpy.polynomial import Legendre

from model import Array, Model

OPTIONS = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.tol": 1e-9,
    # MUMPS's own choice of ordering misleads Ipopt on finer meshes.
    "ipopt.mumps_pivot_order": 0,
}


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


class Programme:
    """The programme of a model on equal segments, built once and solved many times.

    `whole` writes all nodes out as one expression, which solves faster and takes longer to build;
    otherwise the nodes call one function.
    """

    def __init__(self, model: Model, segments: int, points: int, whole: bool) -> None:
        began = time.perf_counter()
        symbol = (ca.SX if whole else ca.MX).sym
        nodes, weights, derivative = radau(points)
        half = 0.5 * model.duration / segments
        n, m, total = model.states, model.joints, segments * points
        state = [symbol(f"x{k}", n) for k in range(total + 1)]
        control = [symbol(f"u{k}", m) for k in range(total)]
        variables, rows, cost = [], [], model.ends(state[0], state[-1])
        lower, upper, row_lower, row_upper = [], [], [], []
        for s in range(segments):
            first = s * points
            block = ca.horzcat(*state[first : first + points + 1])
            for i in range(points):
                k = first + i
                rows.append(
                    ca.mtimes(block, derivative[i]) - half * model.rates(state[k], control[k])
                )
                row_lower += [0.0] * n
                row_upper += [0.0] * n
                if np.isfinite(model.base_rate_limit):
                    rows.append(model.base_rate(state[k]))
                    row_lower += [-model.base_rate_limit] * model.angles
                    row_upper += [model.base_rate_limit] * model.angles
                cost += half * weights[i] * model.running(state[k], control[k])
        for k in range(total + 1):
            low, high = model.lower.copy(), model.upper.copy()
            if k == 0:
                low, high = model.start, model.start
            if k == total:
                free = np.isnan(model.goal)
                low, high = np.where(free, low, model.goal), np.where(free, high, model.goal)
            variables.append(state[k])
            lower.extend(low)
            upper.extend(high)
            if k < total:
                variables.append(control[k])
                lower.extend(-model.control)
                upper.extend(model.control)
        fractions = np.append(
            [(s + 0.5 * (tau + 1.0)) / segments for s in range(segments) for tau in nodes], 1.0
        )
        x, u = model.guess(fractions)
        guess = np.concatenate([np.hstack([x[:-1], u[:-1]]).ravel(), x[-1]])
        self.arguments = dict(x0=guess, lbx=lower, ubx=upper, lbg=row_lower, ubg=row_upper)
        nlp = {"x": ca.vertcat(*variables), "f": cost, "g": ca.vertcat(*rows)}
        self.solver = ca.nlpsol("solver", "ipopt", nlp, OPTIONS)
        self.build = time.perf_counter() - began

    def solve(self) -> dict:
        """Objective, seconds and iterations of one solve."""
        began = time.perf_counter()
        result = self.solver(**self.arguments)
        seconds = time.perf_counter() - began
        stats = self.solver.stats()
        if not stats["success"]:
            raise RuntimeError(f"CasADi: {stats['return_status']}")
        return {
            "objective": float(result["f"]),
            "seconds": seconds,
            "iterations": int(stats["iter_count"]),
        }
