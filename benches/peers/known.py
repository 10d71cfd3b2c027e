"""Problems whose optima are known, those of examples/known_optima_bench.rs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, nan, pi, sqrt

import casadi as ca

from ocp import Ocp, of_expressions


@dataclass(frozen=True)
class Known:
    """A problem with its optimum and the tolerance it is solved to."""

    make: Callable[[], Ocp]
    tolerance: float
    optimum: float


def minimum_time() -> Ocp:
    """Rest to rest over a distance of one, −1 ≤ u ≤ 7/10."""
    x, u = ca.SX.sym("x", 2), ca.SX.sym("u")
    return of_expressions(
        "minimum-time",
        x,
        u,
        [x[1], u],
        0.0,
        start=[0.0, 0.0],
        goal=[1.0, 0.0],
        control=(-1.0, 0.7),
        duration=(0.5, 10.0),
        time_weight=1.0,
    )


def bryson_denham() -> Ocp:
    """½∫u² from rate 1 to rate −1 in one second, the position at most 1/9."""
    x, u = ca.SX.sym("x", 2), ca.SX.sym("u")
    return of_expressions(
        "bryson-denham",
        x,
        u,
        [x[1], u],
        0.5 * u**2,
        start=[0.0, 1.0],
        goal=[0.0, -1.0],
        control=(-inf, inf),
        duration=(1.0, 1.0),
        upper=[1.0 / 9.0, inf],
    )


def singular() -> Ocp:
    """½∫(x² + ẋ²) over five seconds with |u| ≤ 1: a bang arc, then a singular one."""
    x, u = ca.SX.sym("x", 2), ca.SX.sym("u")
    return of_expressions(
        "singular",
        x,
        u,
        [x[1], u],
        0.5 * (x[0] ** 2 + x[1] ** 2),
        start=[0.0, 1.0],
        goal=[nan, nan],
        control=(-1.0, 1.0),
        duration=(5.0, 5.0),
    )


def aly_chan() -> Ocp:
    """½∫(ẋ² − x²) over π/2 seconds with |u| ≤ 1, from (0, 1): singular throughout, u = −sin t."""
    x, u = ca.SX.sym("x", 2), ca.SX.sym("u")
    return of_expressions(
        "aly-chan",
        x,
        u,
        [x[1], u],
        0.5 * (x[1] ** 2 - x[0] ** 2),
        start=[0.0, 1.0],
        goal=[nan, nan],
        control=(-1.0, 1.0),
        duration=(0.5 * pi, 0.5 * pi),
    )


def free_flying_robot() -> Ocp:
    """Two pairs of jets on the least fuel, as in examples/free_flying_robot.rs."""
    x, u = ca.SX.sym("x", 6), ca.SX.sym("u", 4)
    first, second = u[0] - u[1], u[2] - u[3]
    both = first + second
    return of_expressions(
        "free-flying-robot",
        x,
        u,
        [x[3], x[4], x[5], both * ca.cos(x[2]), both * ca.sin(x[2]), 0.2 * (first - second)],
        ca.sum1(u),
        start=[-10.0, -10.0, 0.5 * pi, 0.0, 0.0, 0.0],
        goal=[0.0] * 6,
        control=(0.0, inf),
        duration=(12.0, 12.0),
        rows=[u[0] + u[1], u[2] + u[3]],
        row_upper=1.0,
    )


PROBLEMS = {
    "minimum-time": Known(minimum_time, 1e-8, sqrt(2.0 * (1.0 + 1.0 / 0.7))),
    "bryson-denham": Known(bryson_denham, 1e-6, 4.0),
    "singular": Known(singular, 1e-6, 0.37699193),
    "aly-chan": Known(aly_chan, 1e-6, 0.0),
    "free-flying-robot": Known(free_flying_robot, 1e-6, 7.910154),
}
