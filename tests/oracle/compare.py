"""Holds planned base motion against three outside tools and prints one table.

    compare.py SOLUTION.json...

Exits with 1 where a gap exceeds its tolerance.
"""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import plan as plans
import with_mujoco
import with_pinocchio
import with_spart
from plan import Plan
from replay import Tool, replay, start

Array = NDArray[np.float64]
Poses = list[tuple[Array, Array]]

TOLERANCE = 1e-6  # rad and m, for all: MuJoCo's own error at its step is far below


@dataclass(frozen=True)
class Row:
    """Largest gaps over all rows of a plan: attitude (rad), position (m)."""

    case: str
    tool: str
    attitude: float
    position: float
    note: str

    @property
    def passed(self) -> bool:
        """Whether both are within the tolerance; a NaN is not."""
        return self.attitude <= TOLERANCE and self.position <= TOLERANCE


def angle(a: Array, b: Array) -> float:
    """Angle between two orientations, exact for small ones, rad."""
    return 2.0 * np.arcsin(min(1.0, np.linalg.norm(a - b) / np.sqrt(8.0)))


def gaps(plan: Plan, poses: Poses) -> tuple[float, float]:
    """Largest attitude and position gaps between the plan and poses at its rows."""
    attitude = [angle(mine, theirs) for mine, (theirs, _) in zip(plan.rotation, poses, strict=True)]
    position = [np.linalg.norm(mine - p) for mine, (_, p) in zip(plan.position, poses, strict=True)]
    return float(np.max(attitude)), float(np.max(position))


def replayed(plan: Plan, tool: Tool) -> Poses:
    """Base poses at the plan's rows by momentum conservation in a tool's model."""
    rotation = plan.rotation[0]
    poses = [(rotation, start(tool, rotation, plan.segments[0].position(plan.t[0])))]
    for segment in plan.segments:
        times = list(plan.t[segment.first : segment.last + 1])
        path = lambda t, segment=segment: (segment.position(t), segment.rate(t))  # noqa: E731
        poses += replay(tool, path, times, *poses[-1])[1:]
    return poses


def compare(plan: Plan) -> list[Row]:
    """One row a tool."""
    rows = []
    for name, tool in (
        (with_pinocchio.VERSION, with_pinocchio.Pinocchio(plan.robot)),
        (with_spart.VERSION, with_spart.Spart(plan.robot)),
    ):
        began = time.monotonic()
        found = gaps(plan, replayed(plan, tool))
        rows.append(Row(plan.name, name, *found, f"{time.monotonic() - began:.1f} s"))
    began = time.monotonic()
    fine = with_mujoco.simulate(plan)
    coarse = with_mujoco.simulate(plan, 2.0 * with_mujoco.STEP)
    between = [
        max(angle(a, b), float(np.linalg.norm(p - q)))
        for (a, p), (b, q) in zip(fine.poses, coarse.poses, strict=True)
    ]
    note = (
        f"{time.monotonic() - began:.1f} s; joints within {fine.joint_gap:.1e}, "
        f"feedback at most {fine.feedback:.1e} beside u of {np.abs(plan.control).max():.1e}, "
        f"twice the step moves the base by {max(between):.1e}"
    )
    rows.append(Row(plan.name, with_mujoco.VERSION, *gaps(plan, fine.poses), note))
    return rows


def main(files: list[str]) -> int:
    """Compares every file and says how it went."""
    rows: list[Row] = []
    for file in files:
        plan = plans.load(Path(file))
        print(f"{plan.name}: {plan.points} points, tolerance {plan.tolerance:g}", file=sys.stderr)
        rows += compare(plan)
    print(f"{'case':<16} {'tool':<17} {'attitude / rad':>14} {'position / m':>14} {'limit':>7}")
    for row in rows:
        verdict = "pass" if row.passed else "FAIL"
        print(
            f"{row.case:<16} {row.tool:<17} {row.attitude:>14.2e} {row.position:>14.2e} "
            f"{TOLERANCE:>7.0e}  {verdict}  {row.note}"
        )
    return 0 if rows and all(row.passed for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
