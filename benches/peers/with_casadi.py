"""CasADi with Ipopt, the transcription the planner uses written out by hand.

There are several ways to write a programme, and which is fastest depends on the problem and on
whether its building counts.
"""

from __future__ import annotations

import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np

from model import Array, Model
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
}
COMPILER = ["gcc", "-O3", "-march=native", "-fPIC", "-shared"]

Form = Callable[[Model, Mesh], tuple[dict[str, Any], dict[str, Any]]]


def whole(model: Model, mesh: Mesh) -> tuple[dict[str, Any], dict[str, Any]]:
    """All nodes written out as one scalar expression; CasADi's derivatives."""
    x, p = ca.SX.sym("x", mesh.size), ca.SX.sym("p", model.parameters)
    states, controls = mesh.split(x)
    rates, base, running = model.node.map(mesh.points)(states[:, :-1], controls, p)
    rows = mesh.rows(states, rates, base)
    cost = mesh.integral(running) + model.ends(model.start, states[:, -1], p)
    cost, rows = ca.cse([cost, rows])
    return {"x": x, "p": p, "f": cost, "g": rows}, {}


def mapped(model: Model, mesh: Mesh) -> tuple[dict[str, Any], dict[str, Any]]:
    """Nodes as calls of one function; CasADi's derivatives."""
    x, p = ca.MX.sym("x", mesh.size), ca.MX.sym("p", model.parameters)
    states, controls = mesh.split(x)
    nodes = model.node.map("nodes", "serial", mesh.points, [2], [])
    rates, base, running = nodes(states[:, :-1], controls, p)
    rows = mesh.rows(states, rates, base)
    cost = mesh.integral(running) + model.ends(model.start, states[:, -1], p)
    return {"x": x, "p": p, "f": cost, "g": rows}, {}


def by_node(model: Model, mesh: Mesh) -> tuple[dict[str, Any], dict[str, Any]]:
    """Derivatives of one node as functions, put together by hand.

    The Lagrangian's Hessian is a block a node and one of the last state, and the Jacobian is that of
    the differentiation plus a block a node: the nodes' values, one after another, are the values of
    a block-diagonal matrix.
    """
    nlp, _ = mapped(model, mesh)
    n, m, points = model.states, model.joints, mesh.points
    z, p = ca.SX.sym("z", n + m), ca.SX.sym("p", model.parameters)
    rates, base, running = model.node(z[:n], z[n:], p)
    limited = [base] if model.limited else []
    rows = ca.vertcat(-mesh.half * rates, *limited)
    last = ca.SX.sym("last", n)
    ends = model.ends(model.start, last, p)

    weights, weight = ca.SX.sym("weights", rows.numel()), ca.SX.sym("weight")
    slope = ca.densify(ca.cse(ca.gradient(weight * running, z)))
    jacobian = ca.cse(ca.jacobian(rows, z))
    lagrangian = weight * running + ca.dot(weights, rows)
    hessian = ca.triu(ca.cse(ca.hessian(lagrangian, z)[0]))
    last_hessian = ca.triu(ca.cse(ca.hessian(ends, last)[0]))

    def each(name: str, inputs: list[ca.SX], output: ca.SX) -> ca.Function:
        one = ca.Function(name, [*inputs, p], [output])
        return one.map(f"{name}s", "serial", points, [len(inputs)], [])

    def blocks(pattern: ca.Sparsity, end: ca.Sparsity, values: ca.MX) -> ca.MX:
        return ca.MX(ca.diagcat(*[pattern] * points, end), values)

    x, q, factor = nlp["x"], nlp["p"], ca.MX.sym("lam_f")
    nodes, final = ca.reshape(x[: points * (n + m)], n + m, points), x[points * (n + m) :]
    lam_g = ca.MX.sym("lam_g", mesh.row_count)
    quadrature = ca.DM(mesh.weights).T
    lams = ca.reshape(lam_g, rows.numel(), points)
    ends_slope = ca.Function("ends_slope", [last, p], [ca.cse(ca.gradient(ends, last))])
    ends_values = ca.Function("ends_hessian", [last, p], [ca.vertcat(*last_hessian.nonzeros())])

    gradient = ca.vertcat(
        ca.vec(each("slope", [z, weight], slope)(nodes, quadrature, q)),
        ends_slope(final, q),
    )
    values = each("jacobian", [z], ca.vertcat(*jacobian.nonzeros()))(nodes, q)
    slope_of_rows = mesh.differentiation() + blocks(
        jacobian.sparsity(), ca.Sparsity(0, n), ca.vec(values)
    )
    values = each("hessian", [z, weights, weight], ca.vertcat(*hessian.nonzeros()))(
        nodes, lams, factor * quadrature, q
    )
    curvature = blocks(
        hessian.sparsity(),
        last_hessian.sparsity(),
        ca.vertcat(ca.vec(values), factor * ends_values(final, q)),
    )
    given = {
        "grad_f": ca.Function(
            "nlp_grad_f", [x, q], [nlp["f"], gradient], ["x", "p"], ["f", "grad_f_x"]
        ),
        "jac_g": ca.Function(
            "nlp_jac_g", [x, q], [nlp["g"], slope_of_rows], ["x", "p"], ["g", "jac_g_x"]
        ),
        "hess_lag": ca.Function(
            "nlp_hess_l",
            [x, q, factor, lam_g],
            [curvature],
            ["x", "p", "lam_f", "lam_g"],
            ["triu_hess_gamma_x_x"],
        ),
    }
    return nlp, given


@dataclass
class Programme:
    """A programme of a model on equal segments, built once and solved many times."""

    model: Model
    mesh: Mesh
    solver: ca.Function
    build: float  # seconds

    def solve(self, model: Model | None = None, parameters: Any = ()) -> dict:
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


def build(model: Model, segments: int, points: int, form: Form) -> Programme:
    """The programme in one of the forms above."""
    began = time.perf_counter()
    mesh = Mesh(model, segments, points)
    nlp, given = form(model, mesh)
    solver = ca.nlpsol("solver", "ipopt", nlp, OPTIONS | given)
    return Programme(model, mesh, solver, time.perf_counter() - began)


def compiled(programme: Programme, folder: Path) -> tuple[Programme, float]:
    """The same with its functions generated as C and compiled; the seconds that took."""
    began = time.perf_counter()
    folder.mkdir(parents=True, exist_ok=True)
    source, library = folder / "nlp.c", folder / "nlp.so"
    # It is written to the current folder, whatever the name.
    code = programme.solver.generate_dependencies(source.name)
    Path(code).rename(source)
    subprocess.run([*COMPILER, "-w", source, "-lm", "-o", library], check=True)
    solver = ca.nlpsol("solver", "ipopt", str(library), OPTIONS)
    seconds = time.perf_counter() - began
    return Programme(programme.model, programme.mesh, solver, programme.build), seconds


def objective_and_rows(programme: Programme, x: Array) -> tuple[float, Array]:
    """For comparing forms."""
    f, g = programme.solver.get_function("nlp_fg")(x, [])
    return float(f), np.array(g).ravel()
