"""What is raised where there is no plan at all.

An infeasible or unconverged problem raises nothing: its :class:`~ffsm_ipopt.Solution` says so.
"""

from typing import Dict, Optional, Sequence, Tuple


class Error(Exception):
    """Base of all errors of this package. The message is one line and says all.

    Attributes:
        key: key path that it is about, such as ``"task.duration"``; None where it is about none.
        file: the file, or the value laid over it as it was given; None where there is none.
        line: line in that file, counted from 1; None where there is none.
    """

    key: Optional[str]
    file: Optional[str]
    line: Optional[int]

    def __init__(
        self,
        message: str,
        key: Optional[str] = None,
        file: Optional[str] = None,
        line: Optional[int] = None,
    ) -> None:
        super().__init__(message)
        self.key = key
        self.file = file
        self.line = line


class ProblemError(Error, ValueError):
    """A problem, or the robot it names, cannot be used, or no motion can carry it out.

    Attributes:
        faults: all that is wrong where that is more than one thing, in the order of the message; else
            empty. Key and place are those of the first.
    """

    faults: Tuple["ProblemError", ...]

    def __init__(
        self,
        message: str,
        key: Optional[str] = None,
        file: Optional[str] = None,
        line: Optional[int] = None,
        faults: Sequence["ProblemError"] = (),
    ) -> None:
        super().__init__(message, key, file, line)
        self.faults = tuple(faults)


class SolutionError(Error, ValueError):
    """A ``solution.json`` cannot be used, or not for this problem."""


class PlanError(Error, RuntimeError):
    """The planner cannot begin: the solver refuses, or a start belongs to another robot."""


class DataSetError(Error, RuntimeError):
    """A data set cannot be written, read, or gone on with. The rows in it are kept.

    Attributes:
        file: the file or folder.
    """


class DataSetInUseError(DataSetError):
    """Another run writes to these rows of the folder; they are free once it has ended, however it ends."""


class ShardsFailedError(Error, RuntimeError):
    """Shards of a batch failed again and again without a row more; the others are done.

    Attributes:
        failures: what each of them failed with, by its number from 1.
    """

    failures: Dict[int, BaseException]

    def __init__(self, message: str, failures: Optional[Dict[int, BaseException]] = None) -> None:
        super().__init__(message)
        self.failures = failures or {}


class ShardCancelledError(Error, RuntimeError):
    """The cluster has no task any more for a shard that was not done: its scheduler ended, or somebody
    cancelled the task. What was written is kept."""
