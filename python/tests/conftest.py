"""What the tests share."""

import os
import pathlib
import subprocess

import pytest

import ffsm_ipopt as ffsm

ROOT = pathlib.Path(__file__).parents[2]
CONFIG = ROOT / "config"


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


def pytest_collection_modifyitems(items):
    """The trial of the wheel has neither the program nor what is optional."""
    if os.environ.get("FFSM_WHEEL_TRIAL"):
        absent = {"command", "pandas", "pyplot"}
        items[:] = [item for item in items if not absent & set(item.fixturenames)]
