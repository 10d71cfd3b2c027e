"""Holds the models written by hand against the generic one, so that all time the same problem."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import generic
from model import Model, in_the_plane, load

POINTS = 50
# Of the largest value. The inertias of a wrist and of the arm that carries it are 1e5 apart, which
# leaves eleven of sixteen digits of the accelerations.
PLANAR, SPATIAL = 1e-12, 1e-11


def check(path: Path) -> None:
    """Fails where values at random points differ by more than rounding."""
    written = load(path)
    planar = written.angles == 1
    reference = load(path, in_the_plane if planar else generic.dynamics)
    tolerance = PLANAR if planar else SPATIAL
    random = np.random.default_rng(1)
    for _ in range(POINTS):
        x, last = (_state(random, written) for _ in range(2))
        u = random.uniform(-1.0, 1.0, written.joints)
        pairs = [
            *zip(written.node(x, u, []), reference.node(x, u, []), strict=True),
            (written.ends(x, last, []), reference.ends(x, last, [])),
        ]
        for found, expected in pairs:
            a, b = np.array(found), np.array(expected)
            if not np.abs(a - b).max() <= tolerance * max(np.abs(b).max(), 1.0):
                raise SystemExit(f"{path.name}: the hand-written model differs: {a} and {b}")


def _state(random: np.random.Generator, model: Model) -> np.ndarray:
    """Any joint angles, rates as planned; pitch away from where its rate is not defined."""
    a, n = model.angles, model.joints
    x = random.uniform(-1.0, 1.0, model.states)
    x[a : a + n] *= np.pi
    return x


if __name__ == "__main__":
    config = Path(__file__).parents[2] / "config"
    for name in ("table1-relaxed", "table1-smooth", "chaser-7dof"):
        check(config / f"{name}.toml")
