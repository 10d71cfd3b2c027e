"""Holds a dispersion against brute-force replays by Pinocchio, with random numbers of its own.

    disperse.py SOLUTION.json DISPERSION.json [SAMPLES]

Mean and standard deviation of every figure have to agree within the errors of both samples. Exits
with 1 where one does not.
"""

from __future__ import annotations

import json
import re
import sys
import time
from pathlib import Path

import numpy as np
import pinocchio as pin
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import plan as plans
from plan import Plan
from with_pinocchio import VERSION, Pinocchio

Array = NDArray[np.float64]
STEPS = 4  # of the Runge-Kutta method of order 4, a segment
ERRORS = 4.0  # standard errors that chance is granted


def normal(text: str) -> tuple[float, float]:
    """Mean and standard deviation of a normal distribution far from its bounds."""
    found = re.match(r"normal\(([^,)]+), ([^,)]+)", text)
    if not found:
        raise ValueError(f"{text}: only normal distributions are replayed here")
    return float(found[1]), float(found[2])


class Disperser:
    """The robot, its perturbations and the times at which its momentum is needed."""

    def __init__(self, plan: Plan, dispersion: dict, seed: int) -> None:
        self.plan, self.random = plan, np.random.default_rng(seed)
        self.tool = Pinocchio(plan.robot)
        self.model = self.tool.model
        self.nominal = [self.model.inertias[i].copy() for i in range(1, self.model.njoints)]
        self.harmonics = dispersion["tracking_harmonics"]
        self.sizes: dict[str, list[tuple[float, float]]] = {}
        # Bodies, the base first, and joints stand in the model's order.
        for entry in dispersion["perturbations"]:
            kind = entry["key"].split(".")[-1] if "momentum" not in entry["key"] else entry["key"]
            self.sizes.setdefault(kind, []).append(normal(entry["distribution"]))
        # Momentum is needed at the beginning, the middle and the end of every step.
        self.steps: list[tuple[float, float]] = []
        self.at: list[tuple[float, Array, Array]] = []
        for segment in plan.segments:
            cuts = np.linspace(segment.start, segment.end, STEPS + 1)
            for begin, end in zip(cuts[:-1], cuts[1:], strict=True):
                self.steps.append((begin, end - begin))
                for t in (begin, 0.5 * (begin + end), end):
                    self.at.append((t, segment.position(t), segment.rate(t)))

    def draw(self, kind: str, which: int, count: int) -> Array:
        """Numbers of a quantity, each by itself."""
        mean, sd = self.sizes[kind][which]
        return mean + sd * self.random.standard_normal(count)

    def perturb(self) -> None:
        """Gives the model's bodies masses, mass centres and inertias of a new sample."""
        for i, body in enumerate(self.nominal):
            moments, axes = np.linalg.eigh(body.inertia)
            second = 0.5 * moments.sum() - moments
            second = second * self.draw("inertia", i, 3)
            inertia = axes @ np.diag(second.sum() - second) @ axes.T
            mass = self.draw("mass", i, 1)[0]
            self.model.inertias[i + 1] = pin.Inertia(
                mass, body.lever + self.draw("com", i, 3), inertia
            )

    def figures(self) -> tuple[Array, Array]:
        """Largest and final angle, final displacement of one sample; its last orientation."""
        self.perturb()
        n = len(self.at[0][1])
        offset = np.array([self.draw("offset", j, 1)[0] for j in range(n)])
        waves = np.array([self.draw("tracking", j, 2 * self.harmonics) for j in range(n)])
        waves /= np.sqrt(self.harmonics)
        linear = self.draw("momentum.linear", 0, 3)
        angular = self.draw("momentum.angular", 0, 3)
        return self.follow(offset, waves, np.concatenate([linear, angular]))

    def follow(self, offset: Array, waves: Array, momentum: Array) -> tuple[Array, Array]:
        """The base's motion by conservation of momentum."""
        duration = self.plan.t[-1]
        cycles = 2.0 * np.pi * np.arange(1, self.harmonics + 1) / duration
        maps = []
        for t, q, rate in self.at:
            cos, sin = np.cos(cycles * t), np.sin(cycles * t)
            even, odd = waves[:, 0::2], waves[:, 1::2]
            q = q + offset + even @ cos + odd @ sin
            rate = rate - even @ (cycles * sin) + odd @ (cycles * cos)
            configuration = np.concatenate([np.zeros(6), [1.0], q])
            momentum_map = pin.computeCentroidalMap(self.model, self.tool.data, configuration)
            inverse = np.linalg.inv(momentum_map[:, :6])
            maps.append((inverse, inverse @ (momentum_map[:, 6:] @ rate)))

        def slope(k: int, y: Array) -> Array:
            x, yy, z, w = y[3:] / np.linalg.norm(y[3:])
            turn = np.array(
                [
                    [1 - 2 * (yy * yy + z * z), 2 * (x * yy - w * z), 2 * (x * z + w * yy)],
                    [2 * (x * yy + w * z), 1 - 2 * (x * x + z * z), 2 * (yy * z - w * x)],
                    [2 * (x * z - w * yy), 2 * (yy * z + w * x), 1 - 2 * (x * x + yy * yy)],
                ]
            )
            inverse, driven = maps[k]
            seen = np.concatenate([turn.T @ momentum[:3], turn.T @ momentum[3:]])
            twist = inverse @ seen - driven
            a, b, c = twist[3:]
            spin = 0.5 * np.array(
                [
                    w * a + yy * c - z * b,
                    w * b + z * a - x * c,
                    w * c + x * b - yy * a,
                    -(x * a + yy * b + z * c),
                ]
            )
            return np.concatenate([turn @ twist[:3], spin])

        y = np.concatenate([np.zeros(3), Rotation.from_matrix(self.plan.rotation[0]).as_quat()])
        times, angles = [0.0], [angle(y[3:])]
        for k, (begin, h) in enumerate(self.steps):
            first, middle, last = 3 * k, 3 * k + 1, 3 * k + 2
            a = slope(first, y)
            b = slope(middle, y + 0.5 * h * a)
            c = slope(middle, y + 0.5 * h * b)
            d = slope(last, y + h * c)
            y = y + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
            y[3:] /= np.linalg.norm(y[3:])
            times.append(begin + h)
            angles.append(angle(y[3:]))
        figures = np.array([peak(times, angles), angles[-1], np.linalg.norm(y[:3])])
        return figures, Rotation.from_quat(y[3:]).as_matrix()


def angle(quaternion: Array) -> float:
    """Of the rotation, rad."""
    return 2.0 * np.arctan2(np.linalg.norm(quaternion[:3]), abs(quaternion[3]))


def peak(times: list[float], values: list[float]) -> float:
    """The largest value of the parabola through the largest one and its neighbours."""
    k = int(np.argmax(values))
    if k in (0, len(values) - 1):
        return values[k]
    t = np.array(times[k - 1 : k + 2]) - times[k]
    a, b, c = np.polyfit(t, values[k - 1 : k + 2], 2)
    return c - 0.25 * b * b / a if a < 0.0 else values[k]


def moments(values: Array) -> tuple[float, float, float, float]:
    """Mean, standard deviation and the standard errors of both."""
    n, sd = len(values), values.std(ddof=1)
    fourth = ((values - values.mean()) ** 4).mean()
    return (
        values.mean(),
        sd,
        sd / np.sqrt(n),
        0.5 * np.sqrt(max(fourth - values.var() ** 2, 0.0) / n) / sd,
    )


def main(solution: str, dispersion: str, samples: int = 2000) -> int:
    """Replays, compares, says how it went."""
    plan = plans.load(Path(solution))
    found = json.loads(Path(dispersion).read_text())
    disperser = Disperser(plan, found, seed=20)
    still = np.zeros((plan.robot.moving, 2 * disperser.harmonics))
    planned, last = disperser.follow(np.zeros(plan.robot.moving), still, np.zeros(6))
    began = time.monotonic()
    rows, departures = [], []
    for _ in range(samples):
        figures, end = disperser.figures()
        rows.append(figures)
        departures.append(Rotation.from_matrix(last.T @ end).magnitude())
    table = np.column_stack([np.array(rows), departures])
    names = ("max_base_attitude", "final_base_attitude", "final_base_displacement", "departure")
    by_name = {figure["name"]: figure for figure in found["figures"]}
    print(
        f"{plan.name} dispersed: {found['samples']} samples, {VERSION} {samples} in "
        f"{time.monotonic() - began:.1f} s"
    )
    print(f"{'figure':<24} {'':<5} {'ours':>12} {'theirs':>12} {'gap':>9} {'error':>9}")
    good = True
    for name, values, own in zip(names, table.T, (*planned, 0.0), strict=True):
        ours = by_name[name]
        mean, sd, mean_error, sd_error = moments(values)
        checks = [
            ("plan", ours["planned"], own, 1e-6 / ERRORS),
            ("mean", ours["mean"], mean, np.hypot(ours["mean_error"], mean_error)),
            ("sd", ours["sd"], sd, np.hypot(ours["sd_error"], sd_error)),
        ]
        for what, a, b, error in checks:
            passed = abs(a - b) <= ERRORS * error
            good &= bool(passed)
            print(
                f"{name:<24} {what:<5} {a:>12.8f} {b:>12.8f} {abs(a - b):>9.2e} {error:>9.2e}  "
                f"{'pass' if passed else 'FAIL'}"
            )
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3], *map(int, sys.argv[3:])))
