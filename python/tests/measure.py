"""Measures what the package costs: its import, and a plan beside the time the library says it took.

    python python/tests/measure.py      from the top of the repository
"""

import statistics
import subprocess
import sys
import time

IMPORT = "import time; b = time.perf_counter(); import {}; print(time.perf_counter() - b)"


def imported(name):
    def once(_):
        child = [sys.executable, "-c", IMPORT.format(name)]
        return float(subprocess.run(child, check=True, capture_output=True, text=True).stdout)

    return 1e3 * statistics.median(map(once, range(11)))


def main():
    print(f"import numpy: {imported('numpy'):.1f} ms; import ffsm_ipopt: {imported('ffsm_ipopt'):.1f} ms")

    import ffsm_ipopt as ffsm

    for name in ("table1-smooth", "still-base"):
        problem = ffsm.Problem.from_toml(f"config/{name}.toml")
        more = []
        for _ in range(11):
            began = time.perf_counter()
            plan = ffsm.plan(problem, verify=False)
            more.append(time.perf_counter() - began - plan.timing.total)
        print(
            f"plan of {name}: {1e3 * plan.timing.total:.1f} ms in the library, "
            f"{1e3 * statistics.median(more):.3f} ms more in Python (first {1e3 * more[0]:.3f} ms)"
        )


if __name__ == "__main__":
    main()
