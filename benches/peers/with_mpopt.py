"""mpopt: collocation whose segment widths are variables of the programme."""

from __future__ import annotations

import contextlib
import io
import time
from typing import Any

import casadi as ca
import numpy as np
from mpopt import mp

from ocp import Ocp

# MUMPS's ordering as in with_casadi.py.
SOLVER = {"ipopt.tol": 1e-9, "ipopt.sb": "yes", "ipopt.mumps_pivot_order": 0}


def solve(ocp: Ocp, segments: int, points: int) -> dict[str, Any]:
    """Objective and seconds, all in."""
    began = time.perf_counter()
    problem = mp.OCP(n_states=ocp.states, n_controls=ocp.controls)
    problem.dynamics[0] = lambda x, u, t: ca.vertsplit(ocp.node(x, u)[0])
    problem.running_costs[0] = lambda x, u, t: ocp.node(x, u)[2]
    problem.terminal_costs[0] = lambda xf, tf, x0, t0: ocp.ends(x0, xf, tf)
    named = [i for i in range(ocp.states) if not np.isnan(ocp.goal[i])]
    if named:
        problem.terminal_constraints[0] = lambda xf, tf, x0, t0: [
            xf[i] - ocp.goal[i] for i in named
        ]
    if len(ocp.row_upper):

        def path(x: ca.SX, u: ca.SX, t: ca.SX) -> list[ca.SX]:
            rows = ca.vertsplit(ocp.node(x, u)[1])
            above = zip(rows, ocp.row_upper, strict=True)
            below = zip(rows, ocp.row_lower, strict=True)
            return [row - limit for row, limit in above if np.isfinite(limit)] + [
                limit - row for row, limit in below if np.isfinite(limit)
            ]

        problem.path_constraints[0] = path
    problem.x00[0], problem.xf0[0] = ocp.start, ocp.end_guess
    problem.lbx[0], problem.ubx[0] = ocp.lower, ocp.upper
    problem.lbu[0], problem.ubu[0] = ocp.control_lower, ocp.control_upper
    problem.lbtf[0], problem.ubtf[0] = ocp.duration
    problem.tf0[0] = ocp.duration_guess
    problem.validate()
    with contextlib.redirect_stdout(io.StringIO()):
        optimizer = mp.mpopt_adaptive(problem, n_segments=segments, poly_orders=[points] * segments)
        # The layers are half a thousandth of the motion; the least width has to let them be.
        optimizer.lbh[0] = 1e-4
        solution = optimizer.solve(nlp_solver_options=dict(SOLVER))
        solved = optimizer.nlp_solver.stats()["success"]
    return {
        "objective": float(solution["f"]),
        "seconds": time.perf_counter() - began,
        "solved": bool(solved),
        "solves": 1,
        "points": segments * points,
    }
