"""Times the program against its peers on the same problems, side by side, and writes one table.

    bench.py PROGRAM OUT [--quick]

Runs of the two sides of a ratio take turns; figures are medians. Objectives have to agree, or the
two did not solve the same problem and the run fails.
"""

from __future__ import annotations

import argparse
import json
import math
import statistics
from collections.abc import Callable
from pathlib import Path

import ours

# Peers are imported where they are run: the memory of a process counts that of the one that
# started it, and the program's own is measured before they are loaded.
CONFIG = Path(__file__).parents[2] / "config"


def in_turn(repeat: int, **sides: Callable[[], dict]) -> dict[str, dict]:
    """Runs the sides in turn; each one's last figures with its median seconds."""
    found: dict[str, list[dict]] = {name: [] for name in sides}
    for _ in range(repeat):
        for name, run in sides.items():
            found[name].append(run())
    return {
        name: runs[-1] | {"seconds": statistics.median(run["seconds"] for run in runs)}
        for name, runs in found.items()
    }


def agree(what: str, figures: dict[str, dict], tolerance: float) -> None:
    """Fails where two sides end at different objectives."""
    values = [side["objective"] for side in figures.values()]
    if max(values) - min(values) > tolerance * abs(values[0]):
        raise SystemExit(f"{what}: the objectives differ: {figures}")


class Table:
    """Rows of a ratio each."""

    def __init__(self) -> None:
        self.rows: list[dict] = []

    def add(self, what: str, peer: str, mine: dict, theirs: dict, wanted: float | None) -> None:
        """The peer's time over the program's, beside the ratio it is meant to reach."""
        row = {
            "case": what,
            "peer": peer,
            "ours": mine["seconds"],
            "theirs": theirs["seconds"],
            "ratio": theirs["seconds"] / mine["seconds"],
            "wanted": wanted,
            "objective": mine["objective"],
            "peer_objective": theirs["objective"],
        }
        self.rows.append(row)
        print(f"{what}: {peer} takes {row['ratio']:.1f} times as long", flush=True)

    def markdown(self) -> str:
        """As a table."""
        lines = [
            "| case | peer | ours / ms | peer / ms | ratio | aim | J ours | J peer |",
            "| --- | --- | --- | --- | --- | --- | --- | --- |",
        ]
        for row in self.rows:
            aim = "" if row["wanted"] is None else f"{row['wanted']:g}"
            lines.append(
                f"| {row['case']} | {row['peer']} | {1e3 * row['ours']:.1f} "
                f"| {1e3 * row['theirs']:.0f} | {row['ratio']:.1f} | {aim} "
                f"| {row['objective']:.9f} | {row['peer_objective']:.9f} |"
            )
        return "\n".join(lines)


def one_programme(table: Table, program: Path, repeat: int) -> None:
    """One programme of table1-relaxed to 1e-9 on two meshes, against CasADi and yapss."""
    from model import load
    from with_casadi import Programme
    from with_yapss import solve as yapss

    path = CONFIG / "table1-relaxed.toml"
    model = load(path)
    for segments, points, alone, built in ((10, 5, 4.0, 30.0), (100, 4, 5.0, None)):
        programme = Programme(model, segments, points, whole=True)
        sides = in_turn(
            repeat,
            ours=lambda s=segments, n=points: ours.one_mesh(program, path, s, n).figures(),
            library=lambda s=segments, n=points: ours.in_process(program, path, s, n),
            casadi=programme.solve,
            yapss=lambda s=segments, n=points: yapss(model, s, n),
        )
        what = f"one programme, {segments}×{points}"
        agree(what, sides, 1e-7)
        table.add(what, "CasADi, solve alone", sides["ours"], sides["casadi"], None)
        # CasADi's process is loaded and warm; so is a process that plans one problem after another.
        warm = f"{what}, as a library"
        table.add(warm, "CasADi, solve alone", sides["library"], sides["casadi"], alone)
        whole = sides["casadi"] | {"seconds": programme.build + sides["casadi"]["seconds"]}
        table.add(what, "CasADi, build and solve", sides["ours"], whole, built)
        table.add(what, "yapss, all in", sides["ours"], sides["yapss"], None)


def seven_joints(table: Table, program: Path, repeat: int) -> None:
    """chaser-7dof on 10×5, all in, against CasADi without code generation."""
    from model import load
    from with_casadi import Programme

    path = CONFIG / "chaser-7dof.toml"

    def casadi() -> dict:
        # Nodes as calls of one function: the faster of the two once the build counts.
        programme = Programme(load(path), 10, 5, whole=False)
        result = programme.solve()
        return result | {"seconds": programme.build + result["seconds"]}

    sides = in_turn(
        repeat, ours=lambda: ours.one_mesh(program, path, 10, 5).figures(), casadi=casadi
    )
    agree("chaser-7dof", sides, 1e-7)
    table.add("chaser-7dof, 10×5", "CasADi, all in", sides["ours"], sides["casadi"], 60.0)


def adaptive(table: Table, program: Path, repeat: int, quick: bool) -> None:
    """table1-relaxed to 1e-5, against maptor to 1e-4 and mpopt's segment widths."""
    from model import load
    from with_mpopt import solve as mpopt

    path = CONFIG / "table1-relaxed.toml"
    model = load(path)
    sides = in_turn(
        repeat,
        ours=lambda: ours.plan(program, path).figures(),
        mpopt=lambda: mpopt(model, 10, 5),
    )
    mine = sides["ours"]
    table.add("adaptive to 1e-5", "mpopt, segment widths free", mine, sides["mpopt"], 50.0)
    if not quick:
        from with_maptor import solve as maptor

        theirs = maptor(model, 1e-4, 10, 5)
        table.add("adaptive to 1e-5", "maptor to 1e-4", mine, theirs, 50.0)


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


def main() -> None:
    """Runs all, writes `bench.md` and `bench.json`."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--quick", action="store_true", help="fewer runs, no maptor")
    arguments = parser.parse_args()
    program, quick = arguments.program.resolve(), arguments.quick
    repeat = 3 if quick else 11

    points = scaling(program, quick)
    table = Table()
    one_programme(table, program, repeat)
    seven_joints(table, program, 1 if quick else 3)
    adaptive(table, program, 1 if quick else 3, quick)
    fitted = {key: exponent(points, key) for key in ("milliseconds", "memory")}
    start = statistics.median(
        ours.check(program, CONFIG / "table1-relaxed.toml") for _ in range(5 * repeat)
    )

    text = [
        table.markdown(),
        "\nTime is from the problem to the trajectory; ratios are the peer's time over ours.\n",
        "| points | ms an iteration | peak memory / MiB |\n| --- | --- | --- |",
        *(f"| {r['points']} | {r['milliseconds']:.2f} | {r['memory']:.0f} |" for r in points),
        f"| exponent | {fitted['milliseconds']:.2f} | {fitted['memory']:.2f} |\n",
        split(program),
        f"\nA process that starts, reads `table1-relaxed` and checks it: {1e3 * start:.1f} ms.",
    ]
    arguments.out.mkdir(parents=True, exist_ok=True)
    (arguments.out / "bench.md").write_text("\n".join(text) + "\n")
    figures = {"ratios": table.rows, "points": points, "exponents": fitted, "check": start}
    (arguments.out / "bench.json").write_text(json.dumps(figures, indent=2) + "\n")
    print("\n".join(text))


if __name__ == "__main__":
    main()
