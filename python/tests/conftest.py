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
