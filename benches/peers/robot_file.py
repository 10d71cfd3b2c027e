"""The reader of problem and robot files that the oracle's checks use, found from here."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "oracle"))
from robot import ZERO, Body, Problem, Robot, Triple, load, read  # noqa: E402

__all__ = ["ZERO", "Body", "Problem", "Robot", "Triple", "load", "read"]
