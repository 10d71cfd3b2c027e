"""Runs of several sides that take turns, and the table of their ratios."""

from __future__ import annotations

import statistics
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any


@dataclass
class Side:
    """What each run of one side reported, and which of its times counts."""

    runs: list[dict[str, Any]] = field(default_factory=list)
    time: str = "seconds"

    @property
    def seconds(self) -> list[float]:
        """Of each run."""
        return [run[self.time] for run in self.runs]

    @property
    def figures(self) -> dict[str, Any]:
        """Of the last run."""
        return self.runs[-1]

    def by(self, time: str) -> Side:
        """The same runs by another of their times."""
        return Side(self.runs, time)


def in_turn(repeat: int, **sides: Callable[[], dict[str, Any]]) -> dict[str, Side]:
    """Runs the sides in turn, so that what disturbs the machine disturbs all."""
    found = {name: Side() for name in sides}
    for _ in range(repeat):
        for name, run in sides.items():
            found[name].runs.append(run())
    return found


def agree(what: str, sides: dict[str, Side], tolerance: float) -> None:
    """Fails where two sides end at different objectives."""
    values = {name: side.figures["objective"] for name, side in sides.items()}
    if max(values.values()) - min(values.values()) > tolerance * abs(max(values.values())):
        raise SystemExit(f"{what}: the objectives differ: {values}")


def quartiles(values: list[float]) -> tuple[float, float, float]:
    """Lower quartile, median and upper quartile."""
    if len(values) == 1:
        return values[0], values[0], values[0]
    low, middle, high = statistics.quantiles(values, n=4, method="inclusive")
    return low, middle, high


class Table:
    """Rows of a ratio each."""

    def __init__(self) -> None:
        self.rows: list[dict[str, Any]] = []

    def add(self, what: str, peer: str, mine: Side, theirs: Side, aim: float | None) -> None:
        """The peer's time over the program's, by pairs of runs, beside what it is meant to be."""
        pairs = zip(theirs.seconds, mine.seconds, strict=True)
        low, middle, high = quartiles([one / other for one, other in pairs])
        row = {
            "case": what,
            "peer": peer,
            "ours": statistics.median(mine.seconds),
            "theirs": statistics.median(theirs.seconds),
            "ratio": middle,
            "quartiles": [low, high],
            "aim": aim,
            "objective": mine.figures.get("objective"),
            "peer_objective": theirs.figures.get("objective"),
        }
        self.rows.append(row)
        print(f"{what}: {peer} takes {middle:.1f} times as long", flush=True)

    def markdown(self) -> str:
        """As a table."""
        lines = [
            "| case | peer | ours / ms | peer / ms | ratio | quartiles | aim | J ours | J peer |",
            "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
        ]
        for row in self.rows:
            low, high = row["quartiles"]
            aim = "" if row["aim"] is None else f"{row['aim']:g}"
            lines.append(
                f"| {row['case']} | {row['peer']} | {1e3 * row['ours']:.1f} "
                f"| {1e3 * row['theirs']:.1f} | {row['ratio']:.2f} | {low:.2f} to {high:.2f} "
                f"| {aim} | {row['objective']:.9f} | {row['peer_objective']:.9f} |"
            )
        return "\n".join(lines)
