"""Values of Python as TOML."""

from typing import Any, List, Mapping

import numpy as np

#: Values by their keys in the problem file.
Values = Mapping[str, Any]


def document(tables: Values) -> str:
    """A TOML document, a key of the top level a line."""
    return "".join(f"{_key(name)} = {value(entry)}\n" for name, entry in tables.items())


def assignments(values: "Values | None") -> List[str]:
    """``key.path=value`` for each of ``values``."""
    if values is not None and not isinstance(values, Mapping):
        raise TypeError(f"values: {values!r}; expected a mapping from keys to values")
    return [f"{_path(path)}={value(entry)}" for path, entry in (values or {}).items()]


def value(entry: Any) -> str:
    """A value in one line."""
    if isinstance(entry, np.ndarray) or isinstance(entry, np.generic):
        entry = entry.tolist()
    if isinstance(entry, bool):
        return "true" if entry else "false"
    if isinstance(entry, int):
        # What is too long for a whole number of TOML is a number all the same.
        return str(entry) if -(2**63) <= entry < 2**63 else repr(float(entry))
    if isinstance(entry, float):
        return repr(entry)
    if isinstance(entry, str):
        return _string(entry)
    if isinstance(entry, Mapping):
        pairs = (f"{_key(name)} = {value(of)}" for name, of in entry.items())
        return "{" + ", ".join(pairs) + "}"
    if isinstance(entry, (list, tuple)):
        return "[" + ", ".join(map(value, entry)) + "]"
    if hasattr(entry, "__fspath__"):
        return _string(str(entry))
    raise TypeError(
        f"{entry!r}: expected a number, a string, a path, a bool, or lists, arrays and mappings of them"
    )


def _path(path: Any) -> str:
    if not isinstance(path, str):
        raise TypeError(f"{path!r}: expected a string as a key")
    if "=" in path:
        raise ValueError(f"{path!r}: expected a key of the problem file, which has no '='")
    return path


def _key(name: Any) -> str:
    if not isinstance(name, str):
        raise TypeError(f"{name!r}: expected a string as a key")
    return _string(name)


def _string(text: str) -> str:
    def escaped(character: str) -> str:
        if character in '"\\':
            return "\\" + character
        if ord(character) < 0x20 or ord(character) == 0x7F:
            return f"\\u{ord(character):04X}"
        return character

    return '"' + "".join(map(escaped, text)) + '"'
