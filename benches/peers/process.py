"""Processes with what they took."""

from __future__ import annotations

import os
import subprocess
import tempfile
import time
from dataclasses import dataclass


@dataclass(frozen=True)
class Process:
    """A process that has ended: wall and processor time (s), peak memory (MiB), what it printed."""

    wall: float
    processor: float
    memory: float
    output: str


def timed(command: list, good: tuple[int, ...] = (0,)) -> Process:
    """Runs a command; fails where its exit status is another than these."""
    with tempfile.TemporaryFile() as output:
        began = time.perf_counter()
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - began
        code = process.returncode = os.waitstatus_to_exitcode(status)
        if code not in good:
            raise RuntimeError(f"{' '.join(map(str, command))}: exit status {code}")
        output.seek(0)
        text = output.read().decode()
    return Process(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, text)
