"""An optimal control problem as the adaptive peers take it, whatever it is about."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from model import Array, Model


@dataclass(frozen=True)
class Ocp:
    """ẋ = f(x, u) with rows r(x, u) between bounds, J = ends(x₀, x_f, t_f) + ∫ running(x, u)."""

    name: str
    node: ca.Function  # (x, u) to f, r and the running cost
    ends: ca.Function
    lower: Array  # of the states, infinite where there is none
    upper: Array
    control_lower: Array
    control_upper: Array
    row_lower: Array
    row_upper: Array
    start: Array
    goal: Array  # nan where free
    duration: tuple[float, float]

    @property
    def states(self) -> int:
        """Number of states."""
        return len(self.start)

    @property
    def controls(self) -> int:
        """Number of controls."""
        return len(self.control_lower)

    @property
    def end_guess(self) -> Array:
        """The goal, and where it is free the start."""
        return np.where(np.isnan(self.goal), self.start, self.goal)

    @property
    def duration_guess(self) -> float:
        """The middle of its bounds."""
        return 0.5 * sum(self.duration)


def of_model(model: Model) -> Ocp:
    """The problem of a robot."""
    x, u = ca.SX.sym("x", model.states), ca.SX.sym("u", model.joints)
    rates, base, running = model.node(x, u, [])
    rows = base if model.limited else ca.SX(0, 1)
    last, duration = ca.SX.sym("last", model.states), ca.SX.sym("duration")
    limit = np.full(model.limited, model.base_rate_limit)
    return Ocp(
        model.name,
        ca.Function("node", [x, u], [rates, rows, running]),
        ca.Function("ends", [x, last, duration], [model.ends(x, last, [])]),
        model.lower,
        model.upper,
        -model.control,
        model.control,
        -limit,
        limit,
        model.start,
        model.goal,
        (model.duration, model.duration),
    )


def of_expressions(
    name: str,
    x: ca.SX,
    u: ca.SX,
    rates: list[Any],
    running: Any,
    *,
    start: list[float],
    goal: list[float],
    control: tuple[float, float],
    duration: tuple[float, float],
    upper: list[float] | None = None,
    rows: list[Any] | None = None,
    row_upper: float = np.inf,
    time_weight: float = 0.0,
) -> Ocp:
    """A problem from expressions; rows have upper bounds only, and the cost may count the time."""
    n, m, r = x.numel(), u.numel(), len(rows or [])
    first, last, end = ca.SX.sym("first", n), ca.SX.sym("last", n), ca.SX.sym("end")
    column = ca.vertcat(*(rows or []))
    return Ocp(
        name,
        ca.Function("node", [x, u], [ca.vertcat(*rates), column, ca.SX(running)]),
        ca.Function("ends", [first, last, end], [time_weight * end]),
        np.full(n, -np.inf),
        np.array(upper) if upper else np.full(n, np.inf),
        np.full(m, control[0]),
        np.full(m, control[1]),
        np.full(r, -np.inf),
        np.full(r, row_upper),
        np.array(start, float),
        np.array(goal, float),
        duration,
    )
