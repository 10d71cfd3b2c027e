"""The program itself, run as a user would, with its time and memory."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path


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
            "iterations": self.iterations,
            "solves": len(solution["iterations"]),
            "points": solution["points"],
        }


def plan(program: Path, problem: Path, **settings: object) -> Run:
    """Plans a problem with keys of its file set, dots written as double underscores."""
    sets = [f"--set={key.replace('__', '.')}={value}" for key, value in settings.items()]
    with tempfile.TemporaryDirectory() as out:
        # One mesh is seldom within the tolerance: status 4 is no failure here.
        run = _run([program, "plan", problem, *sets, "--json", "--quiet", "--out", out], (0, 4))
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


def in_process(program: Path, problem: Path, segments: int, points: int) -> dict:
    """One programme solved over and over in one process, as a library: the median's figures."""
    example = program.parent / "examples" / "time_in_process"
    sets = ["mesh.max_iterations=1", f"mesh.segments={segments}", f"mesh.points={points}"]
    command = [example, problem, "11", *sets]
    return json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)


def check(program: Path, problem: Path) -> float:
    """Wall time of a process that reads the problem and solves nothing, s."""
    return _run([program, "check", problem], (0,)).wall


def _run(command: list, good: tuple[int, ...]) -> Run:
    with tempfile.TemporaryFile() as output:
        began = time.perf_counter()
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - began
        code = process.returncode = os.waitstatus_to_exitcode(status)
        if code not in good:
            raise RuntimeError(f"{' '.join(map(str, command))}: exit status {code}")
        output.seek(0)
        text = output.read()
    solution = json.loads(text) if command[1] == "plan" else {}
    return Run(wall, usage.ru_maxrss / 1024, solution)
