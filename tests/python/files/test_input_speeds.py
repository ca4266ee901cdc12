"""The driver's speed in a file: read, refused, and saved with the same bits."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

import jsonschema
import pytest

import assur
from assur.files import Contents, FileError
from assur.files.parser import loads
from assur.files.write import text_of
from models.machines.machines import five_bar, four_bar

if TYPE_CHECKING:
    from pathlib import Path

ODD = (math.pi / 30.0, -0.0, 5e-324, 1e22, 0.1 + 0.2, -3.5)


@pytest.mark.parametrize("speed", ODD)
def test_it_comes_back_with_the_same_bits(speed: float, tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    contents = Contents(four_bar(), input_speed=speed)
    assur.files.save(contents, path)
    read = assur.files.read(path)
    assert isinstance(read.input_speed, float)
    assert read.input_speed.hex() == speed.hex()
    assert read == contents
    assert text_of(read) == path.read_text("utf-8")
    jsonschema.validate(loads(text_of(read)), json.loads(assur.files.SCHEMA.read_text("utf-8")))
    # What has no place for it does without.
    assert assur.load(path) == contents.mechanism


def test_of_several_drivers_one_each(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    assur.files.save(Contents(five_bar(), input_speed=(1, 0.1 + 0.2)), path)
    assert assur.files.read(path).input_speed == (1.0, 0.1 + 0.2)


def test_a_file_without_one() -> None:
    assert Contents(four_bar()).input_speed is None
    assert "input_speed" not in text_of(four_bar())


@pytest.mark.parametrize(
    ("make", "text", "key", "said"),
    [
        (four_bar, "[1.0, 2.0]", "input_speed", "is a list of 2: a number is needed"),
        (four_bar, '"30 rpm"', "input_speed", "a number is needed"),
        (four_bar, "nan", "input_speed", "is NaN: a finite number is needed"),
        (four_bar, "true", "input_speed", "is true: a number is needed"),
        (five_bar, "1.0", "input_speed", "a list of 2 numbers is needed"),
        (five_bar, "[1.0]", "input_speed", "has 1 entries: a number for each of the 2 drivers"),
        (five_bar, "[1.0, inf]", "input_speed[1]", "is infinite: a finite number is needed"),
    ],
)
def test_refused(make: Any, text: str, key: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    lines = text_of(make()).splitlines()
    path.write_text("\n".join([lines[0], f"input_speed = {text}", *lines[1:]]), "utf-8")
    with pytest.raises(FileError, match=r"m\.toml:2:\d+: ") as caught:
        assur.load(path)
    assert said in str(caught.value)
    assert caught.value.key == key


@pytest.mark.parametrize(
    ("make", "speed", "said"),
    [
        (four_bar, (1.0, 2.0), "a finite number is needed"),
        (four_bar, math.inf, "a finite number is needed"),
        (five_bar, 1.0, "a number for each of the 2 drivers is needed"),
        (five_bar, (1.0, math.nan), "a finite number is needed"),
    ],
)
def test_refused_in_python(make: Any, speed: Any, said: str) -> None:
    with pytest.raises(assur.InputError, match=said):
        Contents(make(), input_speed=speed)
