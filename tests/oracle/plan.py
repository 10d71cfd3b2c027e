"""A planned motion, read from solution.json and interpolated exactly as it was planned."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.polynomial import Legendre
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from robot import Robot, read

Array = NDArray[np.float64]


def radau_points(n: int) -> Array:
    """The n Legendre-Gauss-Radau points in [-1, 1): roots of P_{n-1} + P_n."""
    return np.sort((Legendre.basis(n - 1) + Legendre.basis(n)).roots().real)


class Polynomial:
    """The polynomial through rows of values at nodes on [-1, 1], in barycentric form."""

    def __init__(self, nodes: Array, rows: Array) -> None:
        gaps = 2.0 * (nodes[:, None] - nodes[None, :])
        np.fill_diagonal(gaps, 1.0)
        self.nodes, self.rows, self.weights = nodes, rows, 1.0 / gaps.prod(axis=1)

    def __call__(self, tau: float) -> Array:
        gap = tau - self.nodes
        if (hit := np.flatnonzero(gap == 0.0)).size:
            return self.rows[hit[0]]
        terms = self.weights / gap
        return terms @ self.rows / terms.sum()

    def derivative(self) -> Polynomial:
        """Of one degree less, through the slopes at the same nodes."""
        gaps = self.nodes[:, None] - self.nodes[None, :]
        np.fill_diagonal(gaps, 1.0)
        matrix = self.weights[None, :] / self.weights[:, None] / gaps
        np.fill_diagonal(matrix, 0.0)
        np.fill_diagonal(matrix, -matrix.sum(axis=1))
        return Polynomial(self.nodes, matrix @ self.rows)


@dataclass(frozen=True)
class Segment:
    """One segment of the mesh: times `start` to `end` (s), rows `first` to `last` of the plan."""

    start: float
    end: float
    first: int
    last: int
    joints: Polynomial
    slopes: Polynomial
    torque: Polynomial

    def tau(self, t: float) -> float:
        """Time on the segment's own scale from -1 to 1."""
        return 2.0 * (t - self.start) / (self.end - self.start) - 1.0

    def position(self, t: float) -> Array:
        """Joint positions, rad or m."""
        return self.joints(self.tau(t))

    def rate(self, t: float) -> Array:
        """Joint rates of the position polynomial, rad/s or m/s."""
        return self.slopes(self.tau(t)) * (2.0 / (self.end - self.start))

    def effort(self, t: float) -> Array:
        """Planned joint torques, N·m or N, through the collocation points."""
        return self.torque(self.tau(t))


@dataclass(frozen=True)
class Plan:
    """A solved problem: times (s), base poses and joint motion at the nodes."""

    name: str
    robot: Robot
    t: Array
    rotation: list[Array]
    position: Array  # of the base frame's origin from the system's mass centre, m
    control: Array
    segments: list[Segment]
    tolerance: float
    points: int


def load(path: Path) -> Plan:
    """The plan in a solution.json; its robot from the texts that it carries."""
    solution = json.loads(path.read_text())
    if solution["status"] != "solved":
        raise ValueError(f"{path}: the plan is {solution['status']}")
    source = solution["provenance"]
    if any(text.partition("=")[0].split(".")[0] in ("robot", "base") for text in _settings(source)):
        raise ValueError(f"{path}: the robot was changed on the command line")
    if "momentum" in source["problem"]["text"] or "momentum" in str(_settings(source)):
        raise ValueError(f"{path}: only systems without momentum are replayed here")
    robot_file = source["robot"]
    suffix = Path(robot_file["path"]).suffix
    robot = read(source["problem"]["text"], suffix, robot_file["text"])

    rows = {key: np.array(values) for key, values in solution["trajectory"].items()}
    attitude, position = rows["base_attitude"], rows["base_position"]
    planar = attitude.shape[1] == 1
    if planar:
        _check_plane(robot)
        position = np.column_stack([position, np.zeros(len(position))])
    angles = Rotation.from_euler("z" if planar else "xyz", attitude)  # fixed axes: Rz·Ry·Rx
    mesh = solution["mesh"]
    return Plan(
        solution["name"],
        robot,
        rows["t"],
        list(angles.as_matrix()),
        position,
        rows["control"],
        _segments(rows, np.array(mesh["breakpoints"]), mesh["points_per_segment"]),
        solution["tolerance"],
        solution["points"],
    )


def _settings(source: dict) -> list[str]:
    return [text.removeprefix("--set").strip() for text in source["problem"]["overrides"]]


def _check_plane(robot: Robot) -> None:
    """The angle and the two lengths of a planar plan are taken about and across z."""
    for joint in robot.joints:
        turned = any(angle != 0.0 for angle in joint.rpy[:2])
        if turned or (joint.kind == "revolute" and joint.axis[:2] != (0.0, 0.0)):
            raise ValueError(f"joint {joint.name}: only planar robots about z are read here")


def _segments(rows: dict[str, Array], breakpoints: Array, points: list[int]) -> list[Segment]:
    times = rows["t"][0] + breakpoints * (rows["t"][-1] - rows["t"][0])
    segments, first = [], 0
    for s, n in enumerate(points):
        nodes = radau_points(n)
        expected = times[s] + 0.5 * (nodes + 1.0) * (times[s + 1] - times[s])
        if np.abs(rows["t"][first : first + n] - expected).max() > 1e-9 * times[-1]:
            raise ValueError(f"segment {s}: the rows are not at Radau points")
        joints = Polynomial(np.append(nodes, 1.0), rows["joint_position"][first : first + n + 1])
        torque = Polynomial(nodes, rows["joint_torque"][first : first + n])
        segments.append(
            Segment(times[s], times[s + 1], first, first + n, joints, joints.derivative(), torque)
        )
        first += n
    return segments
