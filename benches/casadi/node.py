"""One collocation node of the seven-joint chaser in CasADi: generated C against our own derivatives.

The model is written here from the robot's figures alone: kinematics in base axes, composite bodies
and one Newton-Euler pass, as someone would who writes it by hand for CasADi. Its values,
derivatives and times are printed beside ours.

    node.py PROBLEM FOLDER OURS...    FOLDER keeps the generated code; OURS is our timing command
"""

from __future__ import annotations

import json
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import casadi as ca
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "oracle"))
import robot as robots  # noqa: E402

OPTIMISED = {"-O3": ["-O3"], "-O3 -march=native": ["-O3", "-march=native"]}


def rotation_rpy(rpy):
    """Rz·Ry·Rx, as numbers."""
    (sr, cr), (sp, cp), (sy, cy) = ((np.sin(a), np.cos(a)) for a in rpy)
    rx = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    ry = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    rz = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return rz @ ry @ rx


def about_axis(axis, angle):
    """Rodrigues' formula; numbers for the axis, a symbol for the angle."""
    a = np.array(axis) / np.linalg.norm(axis)
    k = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    return ca.DM(np.eye(3)) + ca.sin(angle) * ca.DM(k) + (1 - ca.cos(angle)) * ca.DM(k @ k)


def point_inertia(mass, r):
    return mass * (ca.dot(r, r) * ca.DM.eye(3) - r @ r.T)


def solve_spd(matrix, rhs):
    """LDLᵀ without pivoting, written out."""
    n = matrix.shape[0]
    lower = [[None] * n for _ in range(n)]
    diagonal = [None] * n
    for i in range(n):
        for j in range(i):
            scaled = matrix[i, j] - sum(lower[i][k] * lower[j][k] * diagonal[k] for k in range(j))
            lower[i][j] = scaled / diagonal[j]
        diagonal[i] = matrix[i, i] - sum(lower[i][k] ** 2 * diagonal[k] for k in range(i))
    y = [None] * n
    for i in range(n):
        y[i] = rhs[i] - sum(lower[i][k] * y[k] for k in range(i))
    for i in reversed(range(n)):
        y[i] = y[i] / diagonal[i] - sum(lower[k][i] * y[k] for k in range(i + 1, n))
    return ca.vertcat(*y)


def node(problem: dict, robot: robots.Robot):
    """x, u and (f, C, ℒ) as symbols: x = [roll, pitch, yaw, θ, θ̇], u = H⁻¹τ."""
    n = robot.moving
    eta, q, dq, u = (ca.SX.sym(*s) for s in [("eta", 3), ("q", n), ("dq", n), ("u", n)])
    base_inertia = ca.DM(turned(robot.base))
    bodies = []  # mass, centre, inertia about it, parent, axis, origin
    pose = {None: (ca.SX.eye(3), ca.SX.zeros(3))}
    carrier = {None: None}  # moving joint that carries a joint's body
    masses = [(robot.base.mass, ca.SX(ca.DM(robot.base.com)), base_inertia, None)]
    joints = []
    for index, joint in enumerate(robot.joints):
        rotation, origin = pose[joint.parent]
        origin = origin + rotation @ ca.DM(joint.xyz)
        rotation = rotation @ ca.DM(rotation_rpy(joint.rpy))
        carrier[index] = carrier[joint.parent]
        if joint.kind == "revolute":
            moving = len(joints)
            axis = np.array(joint.axis) / np.linalg.norm(joint.axis)
            joints.append((carrier[joint.parent], rotation @ ca.DM(axis), origin))
            rotation = rotation @ about_axis(axis, q[moving])
            carrier[index] = moving
        elif joint.kind != "fixed":
            raise ValueError("only turning joints are written out here")
        pose[index] = (rotation, origin)
        inertia = rotation @ ca.DM(turned(joint.body)) @ rotation.T
        centre = origin + rotation @ ca.DM(joint.body.com)
        masses.append((joint.body.mass, centre, inertia, carrier[index]))
    # Composite bodies about the base origin.
    mass = [0.0] * (n + 1)
    moment = [ca.SX.zeros(3) for _ in range(n + 1)]
    inertia = [ca.SX.zeros(3, 3) for _ in range(n + 1)]
    slot = lambda j: n if j is None else j  # noqa: E731
    for m, c, i, j in masses:
        mass[slot(j)] += m
        moment[slot(j)] += m * c
        inertia[slot(j)] += i + point_inertia(m, c)
    for j in reversed(range(n)):
        p = slot(joints[j][0])
        mass[p], moment[p], inertia[p] = mass[p] + mass[j], moment[p] + moment[j], inertia[p] + inertia[j]
    total, centre = mass[n], moment[n] / mass[n]
    about_centre = inertia[n] - point_inertia(total, centre)
    inverse = ca.inv_minor(about_centre)
    linear, angular, per_rate = [], [], []
    for j, (_, axis, origin) in enumerate(joints):
        p = ca.cross(axis, moment[j] - mass[j] * origin)
        about = inertia[j] @ axis - ca.cross(moment[j], ca.cross(axis, origin))
        linear.append(p)
        angular.append(about)
        per_rate.append(inverse @ (about - ca.cross(centre, p)))
    omega0 = -sum(per_rate[j] * dq[j] for j in range(n))
    h = ca.SX.zeros(n, n)
    for j in range(n):
        ancestor = j
        for i in reversed(range(j + 1)):
            g = angular[i] - ca.cross(centre, linear[i])
            h[j, i] = -ca.dot(linear[i], linear[j]) / total - ca.dot(g, per_rate[j])
            if ancestor == i:
                h[j, i] += ca.dot(joints[i][1], angular[j] - ca.cross(joints[i][2], linear[j]))
                ancestor = joints[i][0]
            h[i, j] = h[j, i]
    # Newton-Euler with joint and base accelerations held at zero.
    force = [ca.SX.zeros(3) for _ in range(n + 1)]
    torque = [ca.SX.zeros(3) for _ in range(n + 1)]
    spin = {None: (omega0, ca.SX.zeros(3), ca.SX.zeros(3), ca.SX.zeros(3))}
    for j, (p, axis, origin) in enumerate(joints):
        w, dw, start, a = spin[p]
        r = origin - start
        a = a + ca.cross(dw, r) + ca.cross(w, ca.cross(w, r))
        s = axis * dq[j]
        spin[j] = (w + s, dw + ca.cross(w, s), origin, a)
    for m, c, i, j in masses:
        w, dw, start, a = spin[j]
        r = c - start
        f = m * (a + ca.cross(dw, r) + ca.cross(w, ca.cross(w, r)))
        force[slot(j)] += f
        torque[slot(j)] += ca.cross(c, f) + i @ dw + ca.cross(w, i @ w)
    for j in reversed(range(n)):
        p = slot(joints[j][0])
        force[p], torque[p] = force[p] + force[j], torque[p] + torque[j]
    net = torque[n] - ca.cross(centre, force[n])
    bias = ca.vertcat(*(
        ca.dot(axis, torque[j] - ca.cross(origin, force[j]))
        - ca.dot(linear[j], force[n]) / total
        - ca.dot(per_rate[j], net)
        for j, (_, axis, origin) in enumerate(joints)
    ))
    acceleration = u - solve_spd(h, bias)
    sr, cr, cp = ca.sin(eta[0]), ca.cos(eta[0]), ca.cos(eta[1])
    level = sr * omega0[1] + cr * omega0[2]
    rates = ca.vertcat(omega0[0] + ca.sin(eta[1]) * level / cp, cr * omega0[1] - sr * omega0[2], level / cp)
    weights = problem["cost"]
    cost = (
        weights["base_rate"] * ca.sumsqr(rates)
        + weights["joint_rate"] * ca.sumsqr(dq)
        + weights["control"] * ca.sumsqr(u)
    )
    return ca.vertcat(eta, q, dq), u, ca.vertcat(rates, dq, acceleration, rates, cost)


def turned(body: robots.Body):
    """Inertia about the mass centre in the axes of the body's frame."""
    r = rotation_rpy(body.rpy)
    return r @ np.array(body.inertia) @ r.T


def functions(problem, robot):
    x, u, out = node(problem, robot)
    z, out = ca.vertcat(x, u), ca.cse(out)
    weights = ca.SX.sym("weights", out.shape[0])
    hessian, _ = ca.hessian(ca.dot(weights, out), z)
    return [
        ca.Function("node_values", [z], [out], {"cse": True}),
        ca.Function("node_jacobian", [z], [ca.jacobian(out, z)], {"cse": True}),
        ca.Function("node_hessian", [z, weights], [ca.tril(hessian)], {"cse": True}),
    ]


def generate(problem, robot, folder: Path) -> dict[str, float]:
    """Writes and compiles the code, once; returns seconds of compilation by options."""
    done = folder / "compiled.json"
    if done.exists():
        return json.loads(done.read_text())
    folder.mkdir(parents=True, exist_ok=True)
    start = time.time()
    generator = ca.CodeGenerator("node.c", {"with_header": True})
    for function in functions(problem, robot):
        generator.add(function)
    generator.generate(f"{folder}/")
    seconds = {"generation": time.time() - start}
    harness = Path(__file__).with_name("harness.c")
    for name, flags in OPTIMISED.items():
        start = time.time()
        binary = folder / name.replace(" ", "")
        command = ["cc", *flags, f"-I{folder}", str(harness), str(folder / "node.c"), "-lm", "-o", str(binary)]
        subprocess.run(command, check=True)
        seconds[name] = time.time() - start
    done.write_text(json.dumps(seconds))
    return seconds


def point(sizes) -> tuple[np.ndarray, np.ndarray]:
    """A point with every angle and rate at work, and weights of the outputs."""
    k = np.arange(sizes[0])
    m = np.arange(sizes[1])
    return 0.4 * np.sin(1.0 + 0.7 * k), np.cos(0.3 + 1.1 * m)


def run(command: list[str], text: str) -> dict:
    """What a timing program prints for the point it is given."""
    return json.loads(subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout)


def main() -> None:
    problem_file, folder, ours = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3:]
    problem = tomllib.loads(problem_file.read_text())
    robot = robots.load(problem_file).robot
    seconds = generate(problem, robot, folder)
    n = robot.moving
    z, weights = point((3 + 3 * n, 3 + 2 * n + 4))
    text = " ".join(f"{v:.17g}" for v in [*z, *weights])
    results = {"ours": run(ours, text)}
    for name in OPTIMISED:
        results[f"CasADi {name}"] = run([str(folder / name.replace(" ", ""))], text)
    reference = results["CasADi -O3"]
    for what in ("values", "jacobian", "hessian"):
        a, b = (np.array(r[what]) for r in (results["ours"], reference))
        gap = np.abs(a - b).max() / np.abs(b).max()
        print(f"largest difference in {what}: {gap:.1e} of the largest entry")
        if not gap < 1e-11:
            sys.exit(f"{what} differ: the two do not compute the same thing")
    print(f"{'µs a node (median)':<26}" + "".join(f"{what:>12}" for what in ("values", "Jacobian", "Hessian")))
    for name, result in results.items():
        print(f"{name:<26}" + "".join(f"{result['time'][w]:12.3f}" for w in ("values", "jacobian", "hessian")))
    for name in list(results)[1:]:
        ratios = (results[name]["time"][w] / results["ours"]["time"][w] for w in ("values", "jacobian", "hessian"))
        print(f"{'ours faster than ' + name:<26}".ljust(26) + "".join(f"{ratio:11.1f}×" for ratio in ratios))
    for name, value in seconds.items():
        print(f"CasADi, {name}: {value:.1f} s")


if __name__ == "__main__":
    main()
