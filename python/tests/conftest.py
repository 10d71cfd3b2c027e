"""What the tests share."""

import os
import pathlib
import subprocess
import sys

import pytest

import ffsm_ipopt as ffsm

ROOT = pathlib.Path(__file__).parents[2]
CONFIG = ROOT / "config"
BATCH = """schema = 1
problem = "{problem}"
seed = 3
count = {count}
[[vary]]
key = "task.final.joints[0]"
uniform = [0.3, 0.7]
"""


@pytest.fixture(scope="session")
def command():
    """Runs the command line."""

    def run(*arguments):
        program = os.environ["FFSM_IPOPT"]
        return subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, text=True)

    return run


@pytest.fixture(scope="session")
def smooth():
    return ffsm.Problem.from_toml(CONFIG / "table1-smooth.toml")


@pytest.fixture(scope="session")
def planned(smooth):
    return ffsm.plan(smooth)


@pytest.fixture(scope="session")
def pandas():
    import pandas

    return pandas


@pytest.fixture(scope="session")
def pyplot():
    from matplotlib import pyplot

    return pyplot


@pytest.fixture(scope="session")
def polars():
    import polars

    return polars


@pytest.fixture(scope="session")
def arrow():
    """Of pyarrow what opens data sets."""
    import pyarrow.dataset

    return pyarrow.dataset


@pytest.fixture(scope="session")
def rows():
    """Reads the rows of a data set by their positions, without the times."""
    import same_rows

    return same_rows.rows


@pytest.fixture(scope="session")
def write_batch():
    """Writes a batch file of so many rows to a folder. Some of its rows are not solved."""

    def write(folder, count):
        path = folder / f"batch-{count}.toml"
        path.write_text(BATCH.format(problem=CONFIG / "table1-relaxed.toml", count=count))
        return path

    return write


@pytest.fixture
def batch(write_batch, tmp_path):
    """The path of a batch file of so many rows."""
    return lambda count: write_batch(tmp_path, count)


def pytest_collection_modifyitems(items):
    absent = set()
    if os.environ.get("FFSM_WHEEL_TRIAL"):
        # The trial of the wheel has neither the program nor what is optional.
        absent |= {"arrow", "cluster", "command", "pandas", "polars", "pyplot", "rows"}
    if sys.flags.dev_mode:
        # What plans in Dask's workers is tested in this mode without Dask, in a tenth of the time.
        absent |= {"cluster"}
    items[:] = [item for item in items if not absent & set(item.fixturenames)]
