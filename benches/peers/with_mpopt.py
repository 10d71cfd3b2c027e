"""mpopt: collocation whose segment widths are variables of the programme."""

from __future__ import annotations

import contextlib
import io
import time

import casadi as ca
import numpy as np
from mpopt import mp

from model import Model


def solve(model: Model, segments: int, points: int) -> dict:
    """Objective and seconds, all in."""
    began = time.perf_counter()
    n, a = model.states, model.angles
    ocp = mp.OCP(n_states=n, n_controls=model.joints)
    ocp.dynamics[0] = lambda x, u, t: ca.vertsplit(model.node(x, u, [])[0])
    ocp.running_costs[0] = lambda x, u, t: model.node(x, u, [])[2]
    ocp.terminal_costs[0] = lambda xf, tf, x0, t0: model.ends(x0, xf, [])
    named = [i for i in range(n) if not np.isnan(model.goal[i])]
    ocp.terminal_constraints[0] = lambda xf, tf, x0, t0: [xf[i] - model.goal[i] for i in named]
    if model.limited:

        def path(x, u, t):
            rate = model.node(x, u, [])[1]
            ends = [rate[i] for i in range(a)] + [-rate[i] for i in range(a)]
            return [value - model.base_rate_limit for value in ends]

        ocp.path_constraints[0] = path
    x, _ = model.guess(np.array([0.0, 1.0]))
    ocp.x00[0], ocp.xf0[0] = x[0], x[1]
    ocp.lbx[0], ocp.ubx[0] = model.lower, model.upper
    ocp.lbu[0], ocp.ubu[0] = -model.control, model.control
    ocp.lbtf[0] = ocp.ubtf[0] = ocp.tf0[0] = model.duration
    ocp.validate()
    with contextlib.redirect_stdout(io.StringIO()):
        optimizer = mp.mpopt_adaptive(ocp, n_segments=segments, poly_orders=[points] * segments)
        # The layers are half a thousandth of the motion; the least width has to let them be.
        optimizer.lbh[0] = 1e-4
        solution = optimizer.solve(nlp_solver_options={"ipopt.tol": 1e-9, "ipopt.sb": "yes"})
    return {"objective": float(solution["f"]), "seconds": time.perf_counter() - began}
