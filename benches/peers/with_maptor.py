"""maptor: hp-adaptive LGR collocation, refined until its own error estimate is small enough."""

from __future__ import annotations

import logging
import time
from typing import Any

import casadi as ca
import maptor
import numpy as np

from ocp import Ocp

# It prints a table of each refinement at length, and Ipopt's own output.
QUIET = {"ipopt.print_level": 0, "ipopt.sb": "yes", "print_time": 0}
# As in with_casadi.py: MUMPS's own choice of ordering misleads Ipopt on finer meshes.
SOLVER = {
    "ipopt.tol": 1e-9,
    "ipopt.mumps_pivot_order": 0,
    "ipopt.max_iter": 2000,
    # All nodes as one scalar expression: a tenth less time.
    "expand": True,
}


def solve(ocp: Ocp, tolerance: float, segments: int, points: int) -> dict[str, Any]:
    """Objective, seconds, all in, and what the refinement took."""
    logging.getLogger("maptor").setLevel(logging.ERROR)
    began = time.perf_counter()
    problem = maptor.Problem(ocp.name)
    phase = problem.set_phase(1)
    fixed = ocp.duration[0] == ocp.duration[1]
    clock = phase.time(initial=0.0, final=ocp.duration[0] if fixed else ocp.duration)
    states = [
        phase.state(
            f"x{i}",
            initial=float(ocp.start[i]),
            final=None if np.isnan(ocp.goal[i]) else float(ocp.goal[i]),
            boundary=_between(ocp.lower[i], ocp.upper[i]),
        )
        for i in range(ocp.states)
    ]
    controls = [
        phase.control(f"u{j}", boundary=_between(ocp.control_lower[j], ocp.control_upper[j]))
        for j in range(ocp.controls)
    ]
    rates, rows, cost = ocp.node(ca.vertcat(*states), ca.vertcat(*controls))
    phase.dynamics({state: rates[i] for i, state in enumerate(states)})
    running = phase.add_integral(cost)
    for i, (low, high) in enumerate(zip(ocp.row_lower, ocp.row_upper, strict=True)):
        if np.isfinite(high):
            phase.path_constraints(rows[i] <= float(high))
        if np.isfinite(low):
            phase.path_constraints(rows[i] >= float(low))
    first = ca.vertcat(*(state.initial for state in states))
    last = ca.vertcat(*(state.final for state in states))
    problem.minimize(ocp.ends(first, last, clock.final) + running)
    phase.mesh([points] * segments, np.linspace(-1.0, 1.0, segments + 1))
    if not fixed:
        phase.guess(terminal_time=ocp.duration_guess)
    solution = maptor.solve_adaptive(
        problem, error_tolerance=tolerance, nlp_options=QUIET | SOLVER, show_summary=False
    )
    seconds = time.perf_counter() - began
    status = solution.status
    return {
        "objective": float(status["objective"]),
        "seconds": seconds,
        "solved": bool(status["success"]),
        "solves": int(solution.adaptive["iterations"]),
        "points": int(sum(solution.phases[1]["mesh"]["polynomial_degrees"])),
    }


def _between(low: float, high: float) -> tuple[float | None, float | None] | None:
    """Bounds as maptor takes them."""
    ends = tuple(float(v) if np.isfinite(v) else None for v in (low, high))
    return None if ends == (None, None) else ends
