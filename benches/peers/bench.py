"""Times the program against its peers on the same problems, side by side, and writes one table.

    bench.py PROGRAM OUT [--quick]

Runs of the two sides of a ratio take turns; times are medians, ratios medians of pairs of runs with
their quartiles. Objectives have to agree, or the two did not solve the same problem and the run
fails.
"""

from __future__ import annotations

import argparse
import datetime
import json
import os
import platform
import statistics
import subprocess
import sys
from pathlib import Path

import ours
from scaling import exponent, scaling, split
from table import Table

# Peers are imported where they are run: the memory of a process counts that of the one that
# started it, and the program's own is measured before they are loaded.
PEERS = Path(__file__).parent
CONFIG = PEERS.parents[1] / "config"


def machine() -> str:
    """Processor, cores, and the load of others when the run began."""
    model = platform.processor()
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
    flags = Path("/proc/cpuinfo").read_text()
    vectors = "AVX-512" if " avx512f " in flags else "AVX2" if " avx2 " in flags else "SSE"
    load = os.getloadavg()[0]
    return f"{model}, {vectors}, {os.cpu_count()} cores, load {load:.1f} at the start"


def main() -> None:
    """Runs all, writes `bench.md` and `bench.json`."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--quick", action="store_true", help="fewer runs, no maptor")
    arguments = parser.parse_args()
    program, quick = arguments.program.resolve(), arguments.quick
    repeat = 3 if quick else 11
    on = f"{datetime.date.today()}, {machine()}."
    print(on, flush=True)
    check_models()

    points = scaling(program, quick)
    from batches import batches
    from laws import laws
    from programmes import adaptive, one_programme

    table = Table()
    forms = one_programme(table, program, repeat)
    adaptive(table, program, 1 if quick else 3, quick)
    throughput = batches(program, quick)
    by_law = laws(program, quick)
    fitted = {key: exponent(points, key) for key in ("milliseconds", "memory")}
    start = statistics.median(
        ours.check(program, CONFIG / "table1-relaxed.toml") for _ in range(5 * repeat)
    )

    text = [
        on,
        "",
        table.markdown(),
        "\nRatios are the peer's time over ours, medians of pairs of runs that took turns; peers "
        "have one BLAS thread.",
        "Warm: the process is loaded. A solve alone leaves out the build of CasADi and all of ours that "
        "is outside the solver; else ours is a whole plan, set-up and error estimate included.",
        "Cold: each run is a new process. A process counts from start to end, ours with the files "
        "and the page it writes; within it, from the problem to the trajectory; CasADi's build "
        "and solve without its import, but with the loading of Ipopt.\n",
        "| problem | CasADi's fastest form to solve | to build and solve "
        "| compiling its C, processor time / s |",
        "| --- | --- | --- | --- |",
        *forms,
        "",
        throughput.markdown,
        "",
        by_law.markdown,
        "",
        "| points | ms an iteration | peak memory / MiB |\n| --- | --- | --- |",
        *(f"| {r['points']} | {r['milliseconds']:.2f} | {r['memory']:.0f} |" for r in points),
        f"| exponent | {fitted['milliseconds']:.2f} | {fitted['memory']:.2f} |\n",
        split(program),
        f"\nA process that starts, reads `table1-relaxed` and checks it: {1e3 * start:.1f} ms.",
    ]
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "bench.md").write_text("\n".join(text) + "\n")
    figures = {
        "on": on,
        "ratios": table.rows,
        "points": points,
        "exponents": fitted,
        "check": start,
        "batches": throughput.figures,
        "laws": by_law.figures,
    }
    (arguments.out / "bench.json").write_text(json.dumps(figures, indent=2) + "\n")
    print("\n".join(text))


def check_models() -> None:
    """In a process of its own: this one has not loaded the peers yet."""
    subprocess.run([sys.executable, "-W", "ignore", PEERS / "check_models.py"], check=True)


if __name__ == "__main__":
    main()
