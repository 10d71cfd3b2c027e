"""Values from outside tools that the ordinary tests are held against.

    golden.py FILE          checks that the tools still give what FILE holds
    golden.py FILE --write  writes FILE anew

Paths of problems are relative to the working directory, the repository's root.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import with_pinocchio
import with_spart
from replay import Tool, replay, start
from robot import Problem, load

Array = NDArray[np.float64]

PROBLEMS = [
    "config/table1-smooth.toml",
    "config/planar-3link.toml",
    "config/chaser-7dof.toml",
    "config/dual-arm.toml",
    "tests/data/odd-tree.toml",
]
TOLERANCE = 1e-11  # relative to the largest number of a value


def straight_line(tool: Tool, problem: Problem) -> dict[str, list[float]]:
    """Base motion along the straight joint path, from attitude zero: roll, pitch, yaw (rad) and
    displacement (m)."""
    origin, span = np.array(problem.initial), np.subtract(problem.final, problem.initial)
    first = start(tool, np.eye(3), origin)
    path = lambda s: (origin + s * span, span)  # noqa: E731
    rotation, position = replay(tool, path, np.linspace(0.0, 1.0, 11), np.eye(3), first)[-1]
    attitude = Rotation.from_matrix(rotation).as_euler("xyz")  # fixed axes: Rz·Ry·Rx
    return {"attitude": attitude.tolist(), "displacement": (position - first).tolist()}


def values(tool: Any, problem: Problem, q: Array, rate: Array) -> dict[str, Any]:
    """All that is compared, of one problem by one tool."""
    _, omega = tool.base_twist(np.eye(3), np.zeros(3), q, rate)
    matrix, force = tool.reduced(q, rate)
    return {
        "straight_line": straight_line(tool, problem),
        "base_rate": omega.tolist(),
        "mass_matrix": matrix.tolist(),
        "bias": force.tolist(),
    }


def case(path: str, seed: int) -> dict[str, Any]:
    """One problem at a random configuration, by both tools."""
    problem = load(Path(path))
    random = np.random.default_rng(seed)
    q = random.uniform(-1.2, 1.2, problem.robot.moving).round(3)
    rate = random.uniform(-0.8, 0.8, problem.robot.moving).round(3)
    return {
        "problem": path,
        "joints": q.tolist(),
        "rates": rate.tolist(),
        "pinocchio": values(with_pinocchio.Pinocchio(problem.robot), problem, q, rate),
        "spart": values(with_spart.Spart(problem.robot), problem, q, rate),
    }


def differences(found: Any, kept: Any, where: str) -> list[str]:
    """Where two documents differ by more than the tolerance."""
    if isinstance(found, dict):
        if found.keys() != kept.keys():
            return [f"{where}: other keys"]
        return [line for key in found for line in differences(found[key], kept[key], where + key)]
    if isinstance(found, list) and not isinstance(found[0], dict):
        a, b = np.array(found), np.array(kept)
        if a.shape != b.shape or not np.abs(a - b).max() <= TOLERANCE * np.abs(b).max():
            return [f"{where}: {found} instead of {kept}"]
        return []
    if isinstance(found, list):
        if len(found) != len(kept):
            return [f"{where}: other length"]
        pairs = enumerate(zip(found, kept, strict=True))
        return [line for i, (a, b) in pairs for line in differences(a, b, f"{where}[{i}].")]
    return [] if found == kept else [f"{where}: {found} instead of {kept}"]


def main(arguments: list[str]) -> int:
    """Writes or checks the file."""
    file = Path(arguments[0])
    found = {
        "provenance": f"tests/oracle/golden.py: {with_pinocchio.VERSION}, {with_spart.VERSION}",
        "cases": [case(path, seed) for seed, path in enumerate(PROBLEMS)],
    }
    if "--write" in arguments:
        file.write_text(json.dumps(found, indent=1) + "\n")
        return 0
    lines = differences(found, json.loads(file.read_text()), "")
    print(
        "\n".join(lines) or f"{file}: as {with_pinocchio.VERSION} and {with_spart.VERSION} have it"
    )
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
