"""Ways to write a programme in CasADi.

Which is fastest depends on the problem and on whether the building counts.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi as ca

from model import Model
from transcription import Mesh

Expressions = dict[str, Any]
Form = Callable[[Model, Mesh], tuple[Expressions, dict[str, ca.Function]]]


def whole(model: Model, mesh: Mesh) -> tuple[Expressions, dict[str, ca.Function]]:
    """All nodes written out as one scalar expression; CasADi's derivatives."""
    x, p = ca.SX.sym("x", mesh.size), ca.SX.sym("p", model.parameters)
    nodes, last = mesh.split(x)
    rows, running = node(model, mesh).map(mesh.points)(nodes, p)
    cost = ca.mtimes(running, mesh.weights) + model.ends(model.start, last, p)
    # Subexpressions of a node are shared already, and nodes share none.
    defects = ca.mtimes(mesh.differentiation(), x) + ca.vec(rows)
    return {"x": x, "p": p, "f": cost, "g": defects}, {}


def mapped(model: Model, mesh: Mesh) -> tuple[Expressions, dict[str, ca.Function]]:
    """Nodes as calls of one function; CasADi's derivatives."""
    x, p = ca.MX.sym("x", mesh.size), ca.MX.sym("p", model.parameters)
    nodes, last = mesh.split(x)
    rows, running = _each(node(model, mesh), mesh)(nodes, p)
    cost = ca.mtimes(running, mesh.weights) + model.ends(model.start, last, p)
    defects = ca.mtimes(mesh.differentiation(), x) + ca.vec(rows)
    return {"x": x, "p": p, "f": cost, "g": defects}, {}


def by_node(model: Model, mesh: Mesh) -> tuple[Expressions, dict[str, ca.Function]]:
    """The same with derivatives put together from those of one node.

    The Lagrangian's Hessian is a block a node and one of the last state, and the Jacobian is the
    differentiation and a block a node: the nodes' values, one after another, are the values of a
    block-diagonal matrix.
    """
    nlp, _ = mapped(model, mesh)
    one = node(model, mesh)
    z, p, last = (
        ca.SX.sym("z", one.size1_in(0)),
        ca.SX.sym("p", model.parameters),
        ca.SX.sym("last", model.states),
    )
    rows, running = one(z, p)
    ends = model.ends(model.start, last, p)
    weight, multipliers = ca.SX.sym("weight"), ca.SX.sym("multipliers", rows.numel())
    slope = ca.densify(ca.gradient(weight * running, z))
    jacobian = ca.jacobian(rows, z)
    curvature = ca.triu(ca.hessian(weight * running + ca.dot(multipliers, rows), z)[0])
    last_slope = ca.densify(ca.gradient(ends, last))
    last_curvature = ca.triu(ca.hessian(ends, last)[0])

    def function(name: str, inputs: list[ca.SX], matrix: ca.SX) -> ca.Function:
        # Without `cse`, which finds next to nothing in expressions that are written with care, and
        # takes four times as long as all the rest of the build.
        return ca.Function(name, [*inputs, p], [ca.vertcat(*matrix.nonzeros())])

    def blocks(pattern: ca.Sparsity, end: ca.Sparsity, values: ca.MX) -> ca.MX:
        return ca.MX(ca.diagcat(*[pattern] * mesh.points, end), values)

    x, q, factor = nlp["x"], nlp["p"], ca.MX.sym("lam_f")
    all_multipliers = ca.MX.sym("lam_g", mesh.row_count)
    nodes, final = mesh.split(x)
    weights = mesh.weights.T
    slopes = _each(function("slope", [z, weight], slope), mesh)(nodes, weights, q)
    gradient = ca.vertcat(ca.vec(slopes), function("last_slope", [last], last_slope)(final, q))
    values = _each(function("jacobian", [z], jacobian), mesh)(nodes, q)
    all_slopes = mesh.differentiation() + blocks(
        jacobian.sparsity(), ca.Sparsity(0, model.states), ca.vec(values)
    )
    by_column = ca.reshape(all_multipliers, rows.numel(), mesh.points)
    values = _each(function("curvature", [z, weight, multipliers], curvature), mesh)(
        nodes, factor * weights, by_column, q
    )
    final_values = factor * function("last_curvature", [last], last_curvature)(final, q)
    hessian = blocks(
        curvature.sparsity(), last_curvature.sparsity(), ca.vertcat(ca.vec(values), final_values)
    )

    def derivative(name: str, inputs: dict[str, ca.MX], outputs: dict[str, ca.MX]) -> ca.Function:
        return ca.Function(name, [*inputs.values()], [*outputs.values()], [*inputs], [*outputs])

    at = {"x": x, "p": q}
    return nlp, {
        "grad_f": derivative("nlp_grad_f", at, {"f": nlp["f"], "grad_f_x": gradient}),
        "jac_g": derivative("nlp_jac_g", at, {"g": nlp["g"], "jac_g_x": all_slopes}),
        "hess_lag": derivative(
            "nlp_hess_l",
            at | {"lam_f": factor, "lam_g": all_multipliers},
            {"triu_hess_gamma_x_x": hessian},
        ),
    }


def node(model: Model, mesh: Mesh) -> ca.Function:
    """Of states and controls of one point: its rows without the differentiation, running cost."""
    z, p = ca.SX.sym("z", model.states + model.joints), ca.SX.sym("p", model.parameters)
    rates, base, running = model.node(z[: model.states], z[model.states :], p)
    rows = ca.vertcat(-mesh.half * rates, *([base] if model.limited else []))
    return ca.Function("node", [z, p], [rows, running])


def _each(function: ca.Function, mesh: Mesh) -> ca.Function:
    """The function at every point; its last input, the parameters, is the same for all."""
    return function.map(f"{function.name()}s", "serial", mesh.points, [function.n_in() - 1], [])


FORMS: dict[str, Form] = {"whole": whole, "mapped": mapped, "by_node": by_node}
