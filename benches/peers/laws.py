"""Points, solves and time of refinement: by the law of structure, by the paper's, by the peers."""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import ours
from known import PROBLEMS
from process import timed

PEERS = Path(__file__).parent
RELAXED = PEERS.parents[1] / "config" / "table1-relaxed.toml"
# Of table1-relaxed, by the law of structure at 1e-8.
RELAXED_OPTIMUM = 0.43424344
# A peer that takes longer has no row of figures, s.
LIMIT = 180.0


@dataclass(frozen=True)
class Result:
    """The table, and its figures."""

    markdown: str
    figures: list[dict[str, Any]]


def laws(program: Path, quick: bool) -> Result:
    """Every problem by both laws and both peers."""
    repeat = 1 if quick else 5
    rows = []
    for tolerance in (1e-5, 1e-7):

        def planned(law: str, tolerance: float = tolerance) -> dict[str, Any]:
            return _plan(program, law, tolerance)

        rows += _problem(
            "table1-relaxed", str(RELAXED), tolerance, RELAXED_OPTIMUM, planned, repeat, quick
        )
    example = program.parent / "examples" / "known_optima_bench"
    if not example.exists():
        print("examples/known_optima_bench is not built: no rows of known optima", flush=True)
        return Result(_markdown(rows), rows)
    for name, known in PROBLEMS.items():

        def solved(law: str, name: str = name, tolerance: float = known.tolerance) -> dict:
            return json.loads(timed([example, name, law, str(tolerance)]).output)

        rows += _problem(name, name, known.tolerance, known.optimum, solved, repeat, quick)
    return Result(_markdown(rows), rows)


def _problem(
    name: str,
    for_peers: str,
    tolerance: float,
    optimum: float,
    run: Callable[[str], dict[str, Any]],
    repeat: int,
    quick: bool,
) -> list[dict[str, Any]]:
    found = []
    for law in ("structure", "paper"):
        runs = [run(law) for _ in range(repeat)]
        seconds = statistics.median(one["seconds"] for one in runs)
        found.append({"by": f"ours, {law}"} | runs[-1] | {"seconds": seconds})
    for peer in ("mpopt",) if quick else ("maptor", "mpopt"):
        found.append({"by": peer} | _peer(peer, for_peers, tolerance))
    for row in found:
        row |= {"problem": name, "tolerance": tolerance, "optimum": optimum}
        print(f"{name} to {tolerance:g} by {row['by']}: {row.get('seconds', 'no end')}", flush=True)
    return found


def _plan(program: Path, law: str, tolerance: float) -> dict[str, Any]:
    settings = {"law": law, "tolerance": tolerance, "max_iterations": 20}
    run = ours.plan(program, RELAXED, **{f"mesh__{key}": value for key, value in settings.items()})
    return run.figures() | {
        "error": run.solution["max_error"],
        "solved": run.solution["status"] == "solved",
    }


def _peer(peer: str, problem: str, tolerance: float) -> dict[str, Any]:
    command = [sys.executable, "-W", "ignore", PEERS / "adaptive_peer.py"]
    command += [peer, problem, str(tolerance)]
    try:
        done = subprocess.run(
            command,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            timeout=LIMIT,
        )
    except subprocess.TimeoutExpired as late:
        return {"failed": f"no end within {late.timeout:g} s"}
    if done.returncode:
        return {"failed": "error"}
    return json.loads(done.stdout.splitlines()[-1])


def _markdown(rows: list[dict[str, Any]]) -> str:
    lines = [
        "| refined | tolerance | by | points | solves | time / ms | error | J less its optimum |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for row in rows:
        start = f"| {row['problem']} | {row['tolerance']:g} | {row['by']} "
        if "failed" in row:
            lines.append(f"{start}| {row['failed']} | | | | |")
            continue
        error = f"{row['error']:.1e}" if "error" in row else ""
        unsolved = "" if row["solved"] else " (not solved)"
        lines.append(
            f"{start}| {row['points']}{unsolved} | {row['solves']} | {1e3 * row['seconds']:.1f} "
            f"| {error} | {row['objective'] - row['optimum']:.1e} |"
        )
    lines.append(
        "\nErrors are ours, by (28). maptor refines to its own estimate, and its solves are those "
        "after the first; mpopt has one solve on 10×5 with the widths of the segments free, "
        "whatever the tolerance. All begin from 10×5."
    )
    return "\n".join(lines)
