"""Time and memory of this program by the size of a problem, and where its time goes."""

from __future__ import annotations

import math
import statistics
from pathlib import Path

import ours

CONFIG = Path(__file__).parents[2] / "config"


def scaling(program: Path, quick: bool) -> list[dict]:
    """Time of an iteration and peak memory by points, on table1-smooth."""
    rows = []
    for points in (200, 1000, 4000) if quick else (200, 1000, 4000, 10000, 20000):
        run = ours.one_mesh(program, CONFIG / "table1-smooth.toml", points // 4, 4)
        spent = run.solution["timing"]
        rows.append(
            {
                "points": points,
                "iterations": run.iterations,
                "milliseconds": 1e3 * run.seconds / max(run.iterations, 1),
                "memory": run.memory,
                "timing": spent,
            }
        )
        print(f"{points} points: {rows[-1]['milliseconds']:.1f} ms an iteration", flush=True)
    return rows


def exponent(rows: list[dict], key: str) -> float:
    """Of the power law through the points, least squares of the logarithms."""
    x = [math.log(row["points"]) for row in rows]
    y = [math.log(row[key]) for row in rows]
    return statistics.linear_regression(x, y).slope


def split(program: Path) -> str:
    """Where the time of a plan goes, by problem."""
    keys = ("derivatives", "linear_solver", "ipopt_other", "setup", "total")
    lines = [
        "| problem | iterations | derivatives / ms | linear systems / ms | rest of Ipopt / ms "
        "| set-up / ms | total / ms | process / ms |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for name in ("table1-relaxed", "table1-smooth", "planar-3link", "chaser-7dof"):
        run = ours.plan(program, CONFIG / f"{name}.toml")
        times = " | ".join(f"{1e3 * run.solution['timing'][key]:.1f}" for key in keys)
        lines.append(f"| {name} | {run.iterations} | {times} | {1e3 * run.wall:.1f} |")
    return "\n".join(lines)
