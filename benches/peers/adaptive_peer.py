"""One problem by a peer that refines, in a process of its own, so that it can be given a time.

adaptive_peer.py maptor|mpopt PROBLEM TOLERANCE    PROBLEM: a file, or a name of known.py
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import known
import model
import ocp

SEGMENTS, POINTS = 10, 5


def main() -> None:
    """Prints the peer's figures as JSON."""
    peer, name, tolerance = sys.argv[1:]
    problem = (
        known.PROBLEMS[name].make()
        if name in known.PROBLEMS
        else ocp.of_model(model.load(Path(name)))
    )
    if peer == "maptor":
        from with_maptor import solve

        found = solve(problem, float(tolerance), SEGMENTS, POINTS)
    else:
        # It has no tolerance: the widths of the segments are free, and there is one solve.
        from with_mpopt import solve

        found = solve(problem, SEGMENTS, POINTS)
    print(f"\n{json.dumps(found)}")


if __name__ == "__main__":
    main()
