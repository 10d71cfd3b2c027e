"""Rows of data sets, held against each other: all columns but those that say how long it took.

As a program it ends with status 1 unless the folders of its arguments have the same rows.
"""

import sys

import pyarrow.dataset


def rows(folder):
    """The rows of a folder by their positions; no position is there twice."""
    table = pyarrow.dataset.dataset(folder).to_table()
    names = [name for name in table.column_names if not name.startswith("seconds")]
    found = {}
    for row in table.select(names).to_pylist():
        assert found.setdefault(row["row"], row) is row, f"row {row['row']} twice"
    return found


def main(first, *others):
    expected = rows(first)
    for other in others:
        if rows(other) != expected:
            sys.exit(f"{other}: has other rows than {first}")
    print(f"{len(expected)} rows, the same in all")


if __name__ == "__main__":
    main(*sys.argv[1:])
