"""The schema of the problem file, by a validator that nobody here wrote: it allows what the program takes."""

import json
import subprocess
import sys

import pytest

from conftest import CONFIG

# CPython 3.9 and 3.10 have none.
tomllib = pytest.importorskip("tomllib")

SMOOTH = CONFIG / "table1-smooth.toml"
SHIPPED = sorted({*CONFIG.glob("*.toml"), CONFIG / "starter" / "problem.toml"})


@pytest.fixture(scope="module")
def validator(command):
    import jsonschema

    schema = json.loads(command("schema").stdout)
    kind = jsonschema.validators.validator_for(schema)
    kind.check_schema(schema)
    return kind(schema)


def finite(value):
    """An infinite number as a large one: JSON has none."""
    if isinstance(value, dict):
        return {key: finite(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [finite(entry) for entry in value]
    if isinstance(value, float):
        return min(max(value, -sys.float_info.max), sys.float_info.max)
    return value


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_problems_that_are_shipped_are_allowed(validator, path):
    problem = finite(tomllib.loads(path.read_text()))
    assert [f"{error.json_path}: {error.message}" for error in validator.iter_errors(problem)] == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("schema = 1", "schema = 2"),
        ("schema = 1", ""),
        ('robot = "robots/planar-2link.toml"', ""),
        ("duration = 20.0", "duration = -1.0"),
        ("duration = 20.0", "duration = { min = 5.0 }"),
        ("joint_velocity = 0.9", "joint_velocity = -0.9"),
        ("joint_velocity = 0.9", "joint_velocity = [1.0, 2.0, 3.0, [1]]"),
        ("control = [5.0, 4.0]", "contrl = [5.0, 4.0]"),
        ("joint_rate = 0.2", 'joint_rate = "much"'),
        ("segments = 10", "segments = 0"),
        ("points = 5", "points = 2.5"),
        ("tolerance = 1e-5", "tolerance = 0.0"),
    ],
)
def test_what_the_program_refuses_is_not_allowed(validator, command, tmp_path, old, new):
    text = SMOOTH.read_text()
    assert text.count(f"\n{old} ") + text.count(f"\n{old}\n") == 1
    text = text.replace(f"\n{old}", f"\n{new}", 1)
    assert not validator.is_valid(finite(tomllib.loads(text)))

    problem = tmp_path / "case.toml"
    problem.write_text(text.replace('"robots/', f'"{CONFIG}/robots/'))
    with pytest.raises(subprocess.CalledProcessError) as refused:
        command("check", problem)
    assert refused.value.returncode == 2
    assert str(problem) in refused.value.stderr
