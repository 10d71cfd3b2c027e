"""The program itself, run as a user would, with its time and memory."""

from __future__ import annotations

import json
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

from process import timed


@dataclass(frozen=True)
class Run:
    """One process: wall time (s), peak memory (MiB) and, of a plan, its solution file."""

    wall: float
    memory: float
    solution: dict

    @property
    def seconds(self) -> float:
        """From the problem to the trajectory, without start, parsing and writing."""
        return self.solution["timing"]["total"]

    @property
    def iterations(self) -> int:
        """Solver iterations on all meshes."""
        return sum(row["nlp_iterations"] for row in self.solution["iterations"])

    def figures(self) -> dict:
        """What the peers report of themselves, of this run."""
        solution = self.solution
        return {
            "objective": solution["objective"],
            "seconds": self.seconds,
            "process": self.wall,
            "iterations": self.iterations,
            "solves": len(solution["iterations"]),
            "points": solution["points"],
        }


def plan(program: Path, problem: Path, **settings: object) -> Run:
    """Plans a problem with keys of its file set, dots written as double underscores."""
    sets = [f"--set={key.replace('__', '.')}={value}" for key, value in settings.items()]
    with tempfile.TemporaryDirectory() as out:
        # One mesh is seldom within the tolerance: status 4 is no failure here.
        command = [program, "plan", problem, *sets, "--json", "--quiet", "--out", out]
        process = timed(command, (0, 4))
    run = Run(process.wall, process.memory, json.loads(process.output))
    if {row["nlp_status"] for row in run.solution["iterations"]} != {"solved"}:
        raise RuntimeError(f"{problem}: {run.solution['status']}")
    return run


def one_mesh(program: Path, problem: Path, segments: int, points: int) -> Run:
    """One programme on equal segments."""
    return plan(
        program,
        problem,
        mesh__segments=segments,
        mesh__points=points,
        mesh__max_iterations=1,
    )


def in_process(program: Path, problem: Path, segments: int, points: int, runs: int) -> dict:
    """One programme solved over and over in one process, as a library: the median's figures."""
    sets = ["mesh.max_iterations=1", f"mesh.segments={segments}", f"mesh.points={points}"]
    command = [_in_process(program), problem, str(runs), *sets]
    return json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)


def can_run_in_process(program: Path) -> bool:
    """Whether the example that does is built."""
    return _in_process(program).exists()


def _in_process(program: Path) -> Path:
    return program.parent / "examples" / "time_in_process"


def check(program: Path, problem: Path) -> float:
    """Wall time of a process that reads the problem and solves nothing, s."""
    return timed([program, "check", problem]).wall
