"""The examples run as they are printed."""

import re
import runpy
import shlex

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


def test_the_chapter_on_exports_writes_what_it_reads(command, monkeypatch, tmp_path, pyplot):
    (tmp_path / "config").symlink_to(ROOT / "config")
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "docs" / "exports.md").read_text()
    for line in re.findall(r"^ffsm-ipopt (.*)$", text, re.M):
        command(*shlex.split(line, comments=True))
    # ROS 2, MoveIt and Basilisk are not here, but the files they are given are.
    files = re.findall(r"(?:m\.parquet|\bout/[\w./-]+)", text)
    assert len(set(files)) > 5
    assert [name for name in files if not (tmp_path / name).is_file()] == []
    code = re.search(r"^```python\n(.*?)^```", text, re.M | re.S)[1]
    assert "read_parquet" in code
    found = {"__name__": "example"}
    exec(compile(code, "example", "exec"), found)
    assert len(found["motion"]) == 1501
    assert len(pyplot.gca().lines) == 7
    pyplot.close("all")


def test_the_batch_example_runs_and_is_short(monkeypatch):
    path = ROOT / "python" / "examples" / "batch.py"
    theirs = ROOT / "examples" / "batch_in_code.rs"
    for example in (path, theirs):
        lines = example.read_text().splitlines()
        assert len([line for line in lines if not line.startswith("//!")]) <= 25
    monkeypatch.chdir(ROOT)
    runpy.run_path(str(path), run_name="__main__")
