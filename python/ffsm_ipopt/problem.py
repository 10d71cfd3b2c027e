"""The problem: robot, task, limits, cost, mesh."""

import os
from typing import Any, List, Optional, Tuple, Union

from . import _native, _toml

Path = Union[str, "os.PathLike[str]"]


def _text(path: Path) -> str:
    """A path as a string; bytes are one as well."""
    return os.fsdecode(path)


class Problem:
    """A planning problem, validated; cannot be changed.

    ``values`` of every constructor are laid over the file before it is read, as ``--set`` of the command
    line: key paths of the problem file, such as ``{"task.duration": 30.0, "task.final.joints[1]": 0.9}``.

    Raises:
        ProblemError: what is wrong with it, or why no motion can carry it out, with key and place.
    """

    __slots__ = ("_inner",)
    _inner: _native.Problem

    def __init__(self) -> None:
        raise TypeError("use Problem.from_toml, from_dict or from_urdf")

    @classmethod
    def _of(cls, native: _native.Problem) -> "Problem":
        problem = cls.__new__(cls)
        problem._inner = native
        return problem

    @classmethod
    def from_toml(
        cls, source: Path, values: Optional[_toml.Values] = None, *, folder: Path = "."
    ) -> "Problem":
        """The problem in a file, or in a text, which is told by its line breaks.

        Args:
            source: path of a problem file, or the text of one.
            values: values laid over it.
            folder: of a text, the folder from which the path of its robot is counted.
        """
        over = _toml.assignments(values)
        if isinstance(source, str) and "\n" in source:
            path = os.path.join(_text(folder), "problem.toml")
            return cls._of(_native.Problem.of_text(path, source, over, True))
        return cls._of(_native.Problem.load(_text(source), over))

    @classmethod
    def from_dict(cls, tables: _toml.Values, *, folder: Path = ".") -> "Problem":
        """The problem of nested mappings with the keys of a problem file.

        Args:
            tables: ``{"schema": 1, "robot": "arm.urdf", "task": {...}, ...}``; arrays may be NumPy's.
            folder: the folder from which the path of its robot is counted.
        """
        path = os.path.join(_text(folder), "problem.toml")
        return cls._of(_native.Problem.of_text(path, _toml.document(tables), [], False))

    @classmethod
    def from_urdf(cls, path: Path, values: Optional[_toml.Values] = None) -> "Problem":
        """A first problem for the robot in a URDF file, as ``ffsm-ipopt init --urdf`` writes it.

        Base, end effector, ends of the motion and, where the file lacks them, masses are made up:
        :attr:`text` has them, ``values`` replace them, such as ``{"base.mass": 200.0,
        "task.final.joints": [...]}``.
        """
        return cls._of(_native.Problem.of_urdf(_text(path), _toml.assignments(values)))

    def with_values(self, values: _toml.Values) -> "Problem":
        """The problem again with more values laid over it; no file is read."""
        return type(self)._of(self._inner.edited(_toml.assignments(values)))

    @property
    def name(self) -> str:
        """Name of the problem."""
        return self._inner.name

    @property
    def robot(self) -> str:
        """Name of the robot."""
        return self._inner.robot

    @property
    def joint_names(self) -> Tuple[str, ...]:
        """Names of the n joints, in the order of every array of joints."""
        return tuple(self._inner.joint_names)

    @property
    def duration(self) -> Tuple[float, float]:
        """Least and largest duration t_f, s; equal where it is fixed."""
        return self._inner.duration

    @property
    def attitude(self) -> str:
        """How the base attitude is described: "angle" in the plane (1 value), else "roll-pitch-yaw" (3),
        "quaternion" (w, x, y, z) or "mrp" (3)."""
        return self._inner.attitude

    @property
    def end_effector(self) -> Optional[str]:
        """The body at whose frame the end effector is."""
        return self._inner.end_effector

    @property
    def notes(self) -> Tuple[str, ...]:
        """What a user should know of how the files were read, though nothing is wrong."""
        return tuple(self._inner.notes)

    @property
    def repairs(self) -> Tuple[str, ...]:
        """What was changed of the robot."""
        return tuple(self._inner.repairs)

    @property
    def text(self) -> str:
        """The problem file, without the values laid over it."""
        return self._inner.texts()[0][1]

    @property
    def values(self) -> Tuple[str, ...]:
        """The values laid over it, as options of the command line."""
        return tuple(self._inner.texts()[2])

    def __repr__(self) -> str:
        return f"<Problem {self.name!r}: {self.robot}, {len(self.joint_names)} joints>"

    def __reduce__(self) -> "Tuple[Any, Tuple[Any, ...]]":
        return _restored, self._inner.texts()


def _restored(problem: Tuple[str, str], robot: Tuple[str, str], options: List[str]) -> Problem:
    return Problem._of(_native.Problem.restore(problem, robot, options))
