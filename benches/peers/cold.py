"""One plan by CasADi in a process of its own, as a user's script would be.

    cold.py PROBLEM SEGMENTS POINTS FORM    FORM as in forms.py

Prints JSON: seconds of the import, of building model and programme, and of the solve.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

began = time.perf_counter()
import with_casadi  # noqa: E402
from forms import FORMS  # noqa: E402
from model import load  # noqa: E402

imported = time.perf_counter()


def main() -> None:
    """Runs it."""
    problem, segments, points, form = sys.argv[1:]
    model = load(Path(problem))
    programme = with_casadi.build(model, int(segments), int(points), FORMS[form])
    built = time.perf_counter()
    figures = programme.solve()
    figures |= {"import": imported - began, "build": built - imported}
    # The start of the solver counts too: bounds and guess.
    figures["solve"] = time.perf_counter() - built
    print(json.dumps(figures))


if __name__ == "__main__":
    main()
