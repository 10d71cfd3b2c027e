"""CasADi with Ipopt, the transcription the planner uses written out by hand."""

from __future__ import annotations

import hashlib
import statistics
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import casadi as ca

from forms import Form
from model import Model
from process import timed
from transcription import Mesh

OPTIONS = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.tol": 1e-9,
    # MUMPS's own choice of ordering misleads Ipopt on finer meshes.
    "ipopt.mumps_pivot_order": 0,
    # Multipliers of parameters are nobody's wish here.
    "calc_lam_p": False,
    "no_nlp_grad": True,
}
COMPILER = ["gcc", "-O3", "-march=native", "-fPIC", "-shared", "-w"]


@dataclass
class Programme:
    """A programme of a model on equal segments, built once and solved many times."""

    model: Model
    mesh: Mesh
    solver: ca.Function
    build: float  # seconds

    def solve(self, model: Model | None = None, parameters: Any = ()) -> dict[str, Any]:
        """Objective, seconds and iterations of one solve, of another goal or robot if given."""
        arguments = self.mesh.arguments(model or self.model, parameters)
        began = time.perf_counter()
        result = self.solver(**arguments, p=parameters)
        seconds = time.perf_counter() - began
        stats = self.solver.stats()
        if not stats["success"]:
            raise RuntimeError(f"CasADi: {stats['return_status']}")
        return {
            "objective": float(result["f"]),
            "seconds": seconds,
            "iterations": int(stats["iter_count"]),
        }

    def warm(self, solves: int) -> dict[str, Any]:
        """Several solves in a row after one that warms up: figures with the median of the times."""
        self.solve()
        runs = [self.solve() for _ in range(solves)]
        return runs[-1] | {"seconds": statistics.median(run["seconds"] for run in runs)}


def build(model: Model, segments: int, points: int, form: Form) -> Programme:
    """The programme in one of the forms above."""
    began = time.perf_counter()
    mesh = Mesh(model, segments, points)
    nlp, derivatives = form(model, mesh)
    solver = ca.nlpsol("solver", "ipopt", nlp, OPTIONS | derivatives)
    return Programme(model, mesh, solver, time.perf_counter() - began)


def compiled(programme: Programme, folder: Path) -> tuple[Programme, float]:
    """The same with its functions generated as C and compiled; processor time of the compiler, s.

    What was compiled before is taken again, with the time it took then.
    """
    folder.mkdir(parents=True, exist_ok=True)
    # Not generate_dependencies, which leaves out derivatives that were given.
    generator = ca.CodeGenerator("nlp.c")
    generator.add(programme.solver.oracle())
    for name in programme.solver.get_function():
        generator.add(programme.solver.get_function(name))
    code = generator.dump()
    name = hashlib.sha256(" ".join([*COMPILER, code]).encode()).hexdigest()[:16]
    library, spent = folder / f"{name}.so", folder / f"{name}.seconds"
    if not spent.exists():
        source = folder / f"{name}.c"
        source.write_text(code)
        process = timed([*COMPILER, source, "-lm", "-o", library])
        spent.write_text(str(process.processor))
    solver = ca.nlpsol("solver", "ipopt", str(library), OPTIONS)
    return Programme(programme.model, programme.mesh, solver, programme.build), float(
        spent.read_text()
    )
