"""Plans a second: 2,000 variations of table1-relaxed by `batch` and by CasADi.

CasADi has the model written by hand. Built once, the goal is in the bounds and the payload's mass a
parameter; built anew, both are numbers, as in a loop over a script. It takes the same rows, read
from the program's data set, to the same tolerance, and its optima are held against the program's.
"""

from __future__ import annotations

import multiprocessing
import re
import statistics
import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
import pyarrow.dataset

import robot_file as robots
import with_casadi
from forms import FORMS
from model import Array, Model, load
from process import timed

PEERS = Path(__file__).parent
CONFIG = PEERS.parents[1] / "config"
PROBLEM = CONFIG / "table1-relaxed.toml"
COMPILED = PEERS.parents[1] / "target" / "bench" / "compiled"
KEYS = ("task.final.joints[0]", "task.final.joints[1]", "robot.bodies.forearm.mass")
MESH = (10, 5)
SAMPLE = 20  # problems that are built anew
TOLERANCE = 1e-7  # of objectives; beyond a hundredth of them it is another optimum
OTHER_OPTIMUM = 1e-4


@dataclass(frozen=True)
class Result:
    """The table, and its figures."""

    markdown: str
    figures: dict[str, Any]


def batches(program: Path, quick: bool) -> Result:
    """Runs both sides, one process and two."""
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        fixed = _with_count(PEERS / "fixed-mesh.toml", home, 200 if quick else 2000)
        refined = _with_count(
            CONFIG / "batches" / "table1-relaxed.toml", home, 40 if quick else 400
        )
        rows = {
            "batch, fixed mesh": _batch(program, fixed, home / "one", 1),
            "batch, fixed mesh, two jobs": _batch(program, fixed, home / "two", 2),
            "batch, refined to 1e-5": _batch(program, refined, home / "refined", 1),
            "batch, refined to 1e-5 by structure": _batch(
                program, _by_structure(refined), home / "structure", 1
            ),
        }
        values, objectives = _read(home / "one")
    differ = 0
    for name, run in _peers(values, quick).items():
        gap = np.abs(run.pop("objectives") / objectives[: run["rows"]] - 1.0)
        if np.any((gap > TOLERANCE) & (gap < OTHER_OPTIMUM)):
            raise SystemExit(f"batches, {name}: the objectives differ by up to {gap.max():.1e}")
        run["other optima"] = int(np.sum(gap >= OTHER_OPTIMUM))
        differ = max(differ, run["other optima"])
        rows[name] = run
    return Result(_markdown(rows, differ), rows)


AIMS = {
    "batch, fixed mesh": "150 a second",
    "batch, refined to 1e-5": "20 a second",
    "CasADi, built once": "4",
    "CasADi, built once, two processes": "4",
    "CasADi, built anew": "40",
}


def _markdown(rows: dict[str, dict[str, Any]], differ: int) -> str:
    base = rows["batch, fixed mesh"]["processor"]
    lines = [
        "| variations of `table1-relaxed` | rows | rows a second of a core "
        "| of processor time | ours faster by | aim |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for name, row in rows.items():
        faster = "" if name.startswith("batch") else f"{base / row['processor']:.1f}"
        lines.append(
            f"| {name} | {row['rows']} | {row['wall']:.1f} | {row['processor']:.1f} "
            f"| {faster} | {AIMS.get(name, '')} |"
        )
    lines.append(
        "\nRows of `batch` are read, planned, integrated again and written; rows of CasADi are "
        "solved. Ratios are of processor time. "
        f"Objectives agree to {TOLERANCE:g}; {differ} rows ended at another optimum."
    )
    return "\n".join(lines)


def _with_count(batch: Path, folder: Path, count: int) -> Path:
    """The batch file with fewer rows, its problem found from another folder."""
    text = re.sub(r"(?m)^count = \d+", f"count = {count}", batch.read_text())
    file = folder / batch.name
    file.write_text(re.sub(r'(?m)^problem = ".*"', f'problem = "{PROBLEM}"', text))
    return file


def _by_structure(batch: Path) -> Path:
    file = batch.with_name("structure.toml")
    law = '\n[[vary]]\nkey = "mesh.law"\nvalues = ["structure"]\n'
    file.write_text(batch.read_text() + law)
    return file


def _batch(program: Path, batch: Path, out: Path, jobs: int) -> dict[str, Any]:
    command = [program, "batch", batch, "--out", out, "--jobs", str(jobs), "--quiet"]
    process = timed(command)
    rows = pyarrow.dataset.dataset(out).count_rows()
    return _rates(rows, process.wall * jobs, process.processor)


def _rates(rows: int, wall: float, processor: float) -> dict[str, Any]:
    return {"rows": rows, "wall": rows / wall, "processor": rows / processor}


def _read(folder: Path) -> tuple[Array, Array]:
    """What varies, and the objectives, in the order of the rows."""
    table = pyarrow.dataset.dataset(folder).to_table().sort_by("row")
    if table.num_rows == 0 or None in table["objective"].to_pylist():
        raise SystemExit("batches: not every row was planned")
    values = np.column_stack([table[key].to_numpy() for key in KEYS])
    return values, table["objective"].to_numpy()


def _peers(values: Array, quick: bool) -> dict[str, dict[str, Any]]:
    once = load(PROBLEM, varied=_payload)
    programmes = {
        form: with_casadi.build(once, *MESH, FORMS[form]) for form in ("by_node", "whole")
    }
    few = values[:SAMPLE]
    fastest = min(programmes, key=lambda form: _time(_loop, programmes[form], few))
    generated, _ = with_casadi.compiled(programmes["by_node"], COMPILED)
    found = {
        "CasADi, built once": _measured(_loop, programmes[fastest], values),
        "CasADi, built once, compiled C": _measured(_loop, generated, values),
        "CasADi, built once, two processes": _in_processes(2, fastest, values),
    }
    anew = {form: _time(_anew, form, few[:3]) for form in FORMS}
    quickest = min(anew, key=anew.__getitem__)
    found["CasADi, built anew"] = _measured(_anew, quickest, few)
    return found


def _payload(robot: robots.Robot) -> tuple[robots.Robot, ca.SX]:
    """The forearm's mass as a symbol; its mass centre and inertia about it stay."""
    mass = ca.SX.sym("mass")
    return _carrying(robot, mass), mass


def _carrying(robot: robots.Robot, mass: Any) -> robots.Robot:
    shoulder, elbow = robot.joints
    forearm = replace(elbow, body=replace(elbow.body, mass=mass))
    return replace(robot, joints=(shoulder, forearm))


def _loop(programme: with_casadi.Programme, values: Array) -> Array:
    """One programme, solved for each row."""
    model = programme.model
    return np.array(
        [programme.solve(model.towards(row[:2]), row[2:])["objective"] for row in values]
    )


def _anew(form: str, values: Array) -> Array:
    """Model and programme built for each row."""

    def model(row: Array) -> Model:
        varied = load(PROBLEM, varied=lambda robot: (_carrying(robot, row[2]), ca.SX(0, 1)))
        return varied.towards(row[:2])

    return np.array(
        [with_casadi.build(model(row), *MESH, FORMS[form]).solve()["objective"] for row in values]
    )


def _time(run: Any, what: Any, values: Array) -> float:
    return statistics.median(_seconds(run, what, values)[1] for _ in range(3))


def _seconds(run: Any, what: Any, values: Array) -> tuple[Array, float, float]:
    """Objectives, processor and wall time."""
    wall, processor = time.perf_counter(), time.process_time()
    objectives = run(what, values)
    return objectives, time.process_time() - processor, time.perf_counter() - wall


def _measured(run: Any, what: Any, values: Array) -> dict[str, Any]:
    run(what, values[:2])
    objectives, processor, wall = _seconds(run, what, values)
    return _rates(len(values), wall, processor) | {"objectives": objectives}


def _in_processes(count: int, form: str, values: Array) -> dict[str, Any]:
    """Each process builds the programme once, before the clock starts, and takes rows as it can."""
    # Not by fork, which copies the locks of libraries that have threads.
    context = multiprocessing.get_context("spawn")
    with context.Pool(count, _start, (form,)) as pool:
        pool.map(_one, values[: 4 * count], chunksize=1)
        wall = time.perf_counter()
        found = pool.map(_one, values, chunksize=20)
        wall = time.perf_counter() - wall
    objectives, processor = np.array(found).T
    return _rates(len(values), wall * count, processor.sum()) | {"objectives": objectives}


_programme: with_casadi.Programme


def _start(form: str) -> None:
    global _programme
    model = load(PROBLEM, varied=_payload)
    _programme = with_casadi.build(model, *MESH, FORMS[form])


def _one(row: Array) -> tuple[float, float]:
    """Objective and processor time of a row."""
    objectives, processor, _ = _seconds(_loop, _programme, row[None, :])
    return float(objectives[0]), processor
