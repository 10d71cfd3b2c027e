"""Whole solves of one problem: this program against CasADi, yapss, maptor and mpopt."""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import ours
import with_casadi
from forms import FORMS
from model import load
from ocp import of_model
from process import timed
from table import Table, agree, in_turn
from with_maptor import solve as maptor
from with_mpopt import solve as mpopt
from with_yapss import solve as yapss

PEERS = Path(__file__).parent
CONFIG = PEERS.parents[1] / "config"
# Where generated code is kept; compiling that of the arm in space takes minutes.
COMPILED = PEERS.parents[1] / "target" / "bench" / "compiled"


def one_programme(table: Table, program: Path, repeat: int) -> list[str]:
    """table1-relaxed to 1e-9 on two meshes and chaser-7dof on one; what compiling took."""
    relaxed, chaser = CONFIG / "table1-relaxed.toml", CONFIG / "chaser-7dof.toml"
    few = max(repeat // 3, 1)
    # Aims: CasADi's solve alone, interpreted and compiled, and its build and solve.
    return [
        _one(table, program, relaxed, (10, 5), repeat, 11, (5.0, None, 20.0)),
        _one(table, program, relaxed, (100, 4), repeat, 5, (6.0, None, 40.0)),
        _one(table, program, chaser, (10, 5), few, 3, (None, 3.0, 100.0)),
    ]


def _one(
    table: Table,
    program: Path,
    path: Path,
    mesh: tuple[int, int],
    repeat: int,
    solves: int,
    aims: tuple[float | None, float | None, float],
) -> str:
    what = f"{path.stem}, {mesh[0]}×{mesh[1]}"
    model = load(path)
    # One expression of an arm in space is millions of operations, and no expert writes that.
    forms = ["mapped", "by_node", "whole"] if model.angles == 1 else ["mapped", "by_node"]
    built = {form: with_casadi.build(model, *mesh, FORMS[form]) for form in forms}
    fastest = min(forms, key=lambda form: built[form].warm(3)["seconds"])
    generated, spent = with_casadi.compiled(built["by_node"], COMPILED)
    quickest = min(forms, key=lambda form: _anew(path, mesh, form)["seconds"])
    alone, whole, code = f"CasADi ({fastest})", f"CasADi ({quickest})", "CasADi, compiled C"
    if ours.can_run_in_process(program):
        sides = in_turn(
            repeat,
            ours=lambda: ours.in_process(program, path, *mesh, solves),
            alone=lambda: built[fastest].warm(solves),
            compiled=lambda: generated.warm(solves),
            anew=lambda: _anew(path, mesh, quickest),
        )
        agree(what, sides, 1e-7)
        warm, mine = f"{what}, both warm", sides["ours"]
        solve = mine.by("solve")
        table.add(warm, f"{alone}, solve alone", solve, sides["alone"], aims[0])
        table.add(warm, f"{code}, solve alone", solve, sides["compiled"], aims[1])
        table.add(warm, f"{whole}, build and solve", mine, sides["anew"], None)
    else:
        print(f"{what}: examples/time_in_process is not built, no warm times", flush=True)

    sides = in_turn(
        repeat,
        ours=lambda: ours.one_mesh(program, path, *mesh).figures(),
        casadi=lambda: _cold(path, mesh, quickest),
    )
    agree(what, sides, 1e-7)
    process, casadi = sides["ours"].by("process"), sides["casadi"]
    cold = f"{what}, cold, our process"
    table.add(cold, f"{whole}, build and solve", process, casadi, aims[2])
    table.add(cold, f"{whole}, process", process, casadi.by("process"), None)
    within = f"{what}, cold, within our process"
    table.add(within, f"{whole}, build and solve", sides["ours"], casadi, None)
    if model.angles == 1:
        _yapss(table, program, path, mesh, repeat)
    return f"| {what} | {fastest} | {quickest} | {spent:.1f} |"


def _anew(path: Path, mesh: tuple[int, int], form: str) -> dict:
    """Model and programme made and solved in this process, from the problem's file on."""
    began = time.perf_counter()
    programme = with_casadi.build(load(path), *mesh, FORMS[form])
    return programme.solve() | {"seconds": time.perf_counter() - began}


def _cold(path: Path, mesh: tuple[int, int], form: str) -> dict:
    """CasADi in a process of its own."""
    command = [sys.executable, "-W", "ignore", PEERS / "cold.py", path, *map(str, mesh), form]
    run = timed(command)
    figures = json.loads(run.output)
    return figures | {"seconds": figures["build"] + figures["solve"], "process": run.wall}


def _yapss(table: Table, program: Path, path: Path, mesh: tuple[int, int], repeat: int) -> None:
    model = load(path)
    sides = in_turn(
        max(repeat // 2, 1),
        ours=lambda: ours.one_mesh(program, path, *mesh).figures(),
        yapss=lambda: yapss(model, *mesh),
    )
    what = f"{path.stem}, {mesh[0]}×{mesh[1]}"
    agree(what, sides, 1e-7)
    table.add(f"{what}, cold, within our process", "yapss", sides["ours"], sides["yapss"], None)


def adaptive(table: Table, program: Path, repeat: int, quick: bool) -> None:
    """table1-relaxed to 1e-5 as shipped, against mpopt's segment widths and maptor to 1e-4."""
    path = CONFIG / "table1-relaxed.toml"
    problem = of_model(load(path))
    what = "table1-relaxed, refined to 1e-5"

    def plan(law: str = "paper") -> dict:
        return ours.plan(program, path, mesh__law=law).figures()

    sides = in_turn(
        repeat,
        ours=plan,
        structure=lambda: plan("structure"),
        mpopt=lambda: mpopt(problem, 10, 5),
    )
    peer = "mpopt, segment widths free, all in"
    by_structure = sides["structure"].by("process")
    table.add(f"{what}, by structure, our process", peer, by_structure, sides["mpopt"], 100.0)
    table.add(f"{what}, our process", peer, sides["ours"].by("process"), sides["mpopt"], 100.0)
    table.add(f"{what}, within our process", peer, sides["ours"], sides["mpopt"], None)
    if quick:
        return
    # Once: it takes long enough for that.
    sides = in_turn(1, ours=plan, maptor=lambda: maptor(problem, 1e-4, 10, 5))
    peer = "maptor to 1e-4, all in"
    table.add(f"{what}, our process", peer, sides["ours"].by("process"), sides["maptor"], 100.0)
    table.add(f"{what}, within our process", peer, sides["ours"], sides["maptor"], None)
