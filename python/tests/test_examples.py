"""The examples run as they are printed."""

import re
import runpy

import pytest

from conftest import ROOT

PAGES = ["README.md", "docs/python.md"]


def blocks():
    for page in PAGES:
        text = (ROOT / page).read_text()
        for number, code in enumerate(re.findall(r"^```python\n(.*?)^```", text, re.M | re.S), 1):
            yield pytest.param(code, id=f"{page}-{number}")


@pytest.mark.parametrize("code", list(blocks()))
def test_a_printed_example_runs(code, monkeypatch, tmp_path):
    for folder in ("config", "docs"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "example", "exec"), {"__name__": "example"})


def test_the_batch_example_runs_and_is_short(monkeypatch):
    path = ROOT / "python" / "examples" / "batch.py"
    theirs = ROOT / "examples" / "batch_in_code.rs"
    for example in (path, theirs):
        lines = example.read_text().splitlines()
        assert len([line for line in lines if not line.startswith("//!")]) <= 25
    monkeypatch.chdir(ROOT)
    runpy.run_path(str(path), run_name="__main__")
