"""maptor: hp-adaptive LGR collocation, refined until its own error estimate is small enough."""

from __future__ import annotations

import logging
import time

import casadi as ca
import maptor
import numpy as np

from model import Model


def solve(model: Model, tolerance: float, segments: int, points: int) -> dict:
    """Objective, seconds, all in, and what the refinement took."""
    logging.getLogger("maptor").setLevel(logging.ERROR)
    began = time.perf_counter()
    problem = maptor.Problem(model.name)
    phase = problem.set_phase(1)
    phase.time(initial=0.0, final=model.duration)
    states = []
    for i in range(model.states):
        bound = (model.lower[i], model.upper[i]) if np.isfinite(model.upper[i]) else None
        goal = None if np.isnan(model.goal[i]) else float(model.goal[i])
        states.append(
            phase.state(f"x{i}", initial=float(model.start[i]), final=goal, boundary=bound)
        )
    controls = [
        phase.control(f"u{j}", boundary=(-float(limit), float(limit)))
        for j, limit in enumerate(model.control)
    ]
    x, u = ca.vertcat(*states), ca.vertcat(*controls)
    rates, base, cost = model.node(x, u, [])
    phase.dynamics({state: rates[i] for i, state in enumerate(states)})
    running = phase.add_integral(cost)
    for i in range(model.limited):
        phase.path_constraints(base[i] <= model.base_rate_limit)
        phase.path_constraints(base[i] >= -model.base_rate_limit)
    first = ca.vertcat(*(state.initial for state in states))
    last = ca.vertcat(*(state.final for state in states))
    problem.minimize(model.ends(first, last, []) + running)
    phase.mesh([points] * segments, np.linspace(-1.0, 1.0, segments + 1))
    solution = maptor.solve_adaptive(
        problem,
        error_tolerance=tolerance,
        nlp_options={"ipopt.print_level": 0, "ipopt.sb": "yes", "print_time": 0, "ipopt.tol": 1e-9},
        show_summary=False,
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
