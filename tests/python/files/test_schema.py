"""The schema for editors: it accepts what loads, and has the words that the reader has."""

from __future__ import annotations

import copy
import inspect
import json
from typing import TYPE_CHECKING, Any

import jsonschema
import pytest

import assur
from assur.files import SCHEMA
from assur.files.contents import KEYS
from assur.files.parser import loads
from assur.files.parts import FRICTIONS, LOADS, MOTORS, PARTS, ROWS
from assur.files.wanted import RANGE, WANTED
from assur.flywheel import SPLINES
from files.sample_files import BY_HAND, saved
from files.sample_files import WANTED as ALL_WANTED
from models.machines.every_load import KINDS

if TYPE_CHECKING:
    from pathlib import Path

ALL: dict[str, Any] = json.loads(SCHEMA.read_text(encoding="utf-8"))
DEFINED = ALL["definitions"]
VALIDATOR = jsonschema.Draft7Validator(ALL)
GOOD = {**BY_HAND, **saved()}
GOOD["everything wanted"] = GOOD["everything"] + ALL_WANTED


def test_it_is_a_schema() -> None:
    jsonschema.Draft7Validator.check_schema(ALL)


@pytest.mark.parametrize("name", list(GOOD))
def test_it_accepts_what_loads(name: str) -> None:
    VALIDATOR.validate(loads(GOOD[name]))


def test_its_words_are_those_of_the_reader() -> None:
    assert tuple(LOADS) == KINDS
    assert tuple(ALL["properties"]) == KEYS
    for name, words in WANTED.items():
        assert tuple(ALL["properties"][name]["properties"]) == tuple(words)
    assert set(DEFINED["range"]["properties"]) == set(RANGE)
    assert set(DEFINED["table"]["properties"]) == set(ROWS)
    assert tuple(DEFINED["spline"]["enum"]) == SPLINES
    for cls, words in PARTS.items():
        own, parameters = DEFINED[cls.__name__], inspect.signature(cls).parameters
        assert [name for name in own["properties"] if name != "type"] == list(words)
        needed = [n for n in words if parameters[n].default is inspect.Parameter.empty]
        assert own.get("required", []) == needed
        assert own["additionalProperties"] is False
        assert ("type" in own["properties"]) == (cls in LOADS or cls in MOTORS)
    for kind, known in (("load", LOADS), ("motor", MOTORS)):
        names = [cls.__name__ for cls in known]
        assert DEFINED[kind]["properties"]["type"]["enum"] == names
        assert [one["then"]["$ref"].rpartition("/")[2] for one in DEFINED[kind]["allOf"]] == names
    assert set(FRICTIONS) <= set(PARTS)
    solve = inspect.signature(assur.Mechanism.solve).parameters
    assert set(ALL["properties"]["solve"]["properties"]) <= set(solve)
    for name in ("reactions", "run", "steady_state", "flywheel"):
        method = inspect.signature(getattr(assur.Machine, name)).parameters
        assert set(ALL["properties"][name]["properties"]) <= {*method, "deg"}


def changed(data: dict[str, Any], path: list[Any], value: Any) -> dict[str, Any]:
    """A copy in which a value is another, or is left out if that is None."""
    data = copy.deepcopy(data)
    at: Any = data
    for key in path[:-1]:
        at = at[key]
    if value is None:
        del at[path[-1]]
    else:
        at[path[-1]] = value
    return data


@pytest.mark.parametrize(
    ("name", "path", "value"),
    [
        ("press", ["format"], 2),
        ("press", ["format"], None),
        ("press", ["driver"], None),
        ("press", ["driver"], 1),
        ("press", ["input_speed"], "30 rpm"),
        ("press", ["input_speed"], [1.0]),
        ("press", ["joints", "A"], [0.0]),
        ("press", ["joints", "A"], [0.0, "x"]),
        ("press", ["links", "ground"], None),
        ("press", ["links", "crank"], "OA"),
        ("press", ["slides", "guide", "on"], None),
        ("press", ["slides", "guide", "orign"], "O"),
        ("press", ["dimensions", "rod", "length"], "0.4"),
        ("press", ["bodies", "ram", "mass"], -1),
        ("press", ["bodies", "ram", "weight"], 1),
        ("press", ["loads", 0, "type"], "gravity"),
        ("press", ["loads", 0, "type"], None),
        ("press", ["loads", 0, "force"], [1, 2]),
        ("press", ["loads", 1, "at"], None),
        ("press", ["loads", 1, "at"], ["rod", 1.0]),
        ("press", ["loads", 1, "force"], [1.0]),
        ("press", ["loads", 1, "force", 0, "spline"], "cubic"),
        ("press", ["motor", "type"], "LinearMotor"),
        ("press", ["motor", "slip"], 0),
        ("press", ["flywheel", "fluctuation"], None),
        ("press", ["flywheel", "mean"], "middle"),
        ("press", ["sovle"], {}),
        ("excavator", ["slides", "boom_cylinder", "end"], None),
        ("excavator", ["slides", "boom_cylinder", "angle"], 1),
        ("excavator", ["friction", "elbow", "radius"], None),
        ("excavator", ["reactions", "q", "step"], 1),
        ("excavator", ["reactions", "q"], None),
        ("excavator", ["reactions", "deg"], [1]),
        ("excavator", ["driver", 0], {"lnk": "boom"}),
        ("crank_rocker", ["solve", "order"], 4),
        ("crank_rocker", ["solve", "outputs"], "P"),
        ("crank_rocker", ["assembly"], {"C": 0}),
    ],
)
def test_it_refuses_what_does_not_load(
    name: str, path: list[Any], value: Any, tmp_path: Path
) -> None:
    from assur.files.toml import pair_text

    data = changed(loads(GOOD[name]), path, value)
    assert not VALIDATOR.is_valid(data)
    file = tmp_path / "m.toml"
    file.write_text("\n".join(pair_text(key, one) for key, one in data.items()), encoding="utf-8")
    with pytest.raises(assur.files.FileError):
        assur.load(file)
