"""yapss: LGR collocation on a given mesh, derivatives by CasADi."""

from __future__ import annotations

import time

import casadi as ca
import numpy as np
import yapss
from yapss.math.wrapper import SXW

from model import Model


def solve(model: Model, segments: int, points: int) -> dict:
    """Objective and seconds, all in."""
    began = time.perf_counter()
    n, m = model.states, model.joints
    limited = model.limited
    ocp = yapss.Problem(name=model.name, nx=[n], nu=[m], nq=[1], nh=[limited])

    def objective(arg: yapss.ObjectiveArg) -> None:
        phase = arg.phase[0]
        ends = model.ends(_column(phase.initial_state), _column(phase.final_state), [])
        arg.objective = SXW(ends) + phase.integral[0]

    def continuous(arg: yapss.ContinuousArg) -> None:
        phase = arg.phase[0]
        x, u = _column(phase.state), _column(phase.control)
        rates, base, running = model.node(x, u, [])
        phase.dynamics[:] = _scalars(rates)
        phase.integrand[0] = SXW(running)
        if limited:
            phase.path[:] = _scalars(base)

    ocp.functions.objective = objective
    ocp.functions.continuous = continuous
    bounds = ocp.bounds.phase[0]
    bounds.initial_time.lower = bounds.initial_time.upper = 0.0
    bounds.final_time.lower = bounds.final_time.upper = model.duration
    bounds.initial_state.lower[:] = bounds.initial_state.upper[:] = model.start
    free = np.isnan(model.goal)
    bounds.final_state.lower[:] = np.where(free, model.lower, model.goal)
    bounds.final_state.upper[:] = np.where(free, model.upper, model.goal)
    bounds.state.lower[:], bounds.state.upper[:] = model.lower, model.upper
    bounds.control.lower[:], bounds.control.upper[:] = -model.control, model.control
    if limited:
        bounds.path.lower[:] = -model.base_rate_limit
        bounds.path.upper[:] = model.base_rate_limit
    grid = np.linspace(0.0, 1.0, 51)
    x, u = model.guess(grid)
    guess = ocp.guess.phase[0]
    guess.time, guess.state, guess.control = grid * model.duration, x.T, u.T
    ocp.mesh.phase[0].collocation_points = segments * [points]
    ocp.mesh.phase[0].fraction = segments * [1.0 / segments]
    ocp.spectral_method = "lgr"
    ocp.derivatives.method = "auto"
    ocp.derivatives.order = "second"
    ocp.ipopt_options.tol = 1e-9
    ocp.ipopt_options.print_level = 0
    ocp.ipopt_options.print_user_options = "no"
    ocp.ipopt_options.sb = "yes"
    solution = ocp.solve()
    return {"objective": float(solution.objective), "seconds": time.perf_counter() - began}


def _column(values: object) -> ca.SX:
    """Scalars of yapss's own kind as a column of CasADi's."""
    return ca.vertcat(*(SXW(value)._value for value in values))


def _scalars(column: ca.SX) -> list[SXW]:
    return [SXW(column[i]) for i in range(column.numel())]
