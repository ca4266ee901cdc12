"""Numbers with units, lists and ranges."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assur
from assur.cli.units import UNITS, evenly, numbers, ratio, split_number
from cli.command_line import same

# What one of each unit is, written independently (exact fractions of π or decimals).
ONE = {
    "m": 1.0,
    "cm": 0.01,
    "mm": 0.001,
    "in": 0.0254,
    "rad": 1.0,
    "deg": math.pi / 180,
    "m/s": 1.0,
    "mm/s": 0.001,
    "rad/s": 1.0,
    "deg/s": math.pi / 180,
    "rpm": 2 * math.pi / 60,
}


def test_units() -> None:
    assert set(ONE) == set(UNITS)
    for unit, value in ONE.items():
        assert float(numbers(f"1{unit}").values) == value
        assert float(numbers(f" -2.5e1 {unit} ").values) == pytest.approx(-25 * value, rel=1e-15)


def test_millimetres_are_the_decimal_to_the_last_bit() -> None:
    """Unlike 35 * 0.001."""
    for k in range(1, 2000):
        assert float(numbers(f"{k}mm").values) == float(f"{k}e-3")
        assert float(numbers(f"{k / 10}mm").values) == float(f"{k}e-4")
    assert any(k * 0.001 != float(f"{k}e-3") for k in range(1, 2000))


def test_degrees_are_those_of_solve() -> None:
    motion = assur.SliderCrank(0.1, 0.4).solve(deg=np.arange(361.0), order=0)
    assert same(numbers("0:360:1deg").values, motion.q)


def test_ranges_and_lists() -> None:
    assert numbers("0:1:0.25").values.tolist() == [0, 0.25, 0.5, 0.75, 1]
    assert numbers("1:-1:-1").values.tolist() == [1, 0, -1]
    assert numbers("0:100:30mm").values.tolist() == [0, 0.03, 0.06, 0.09]
    assert numbers("1mm,2mm").values.tolist() == [0.001, 0.002]
    assert numbers("0.1:0.3:0.1").values.size == 3  # though 3 · 0.1 > 0.3
    assert numbers("7").values.shape == ()
    assert evenly("1:2mm:3").values.tolist() == [0.001, 0.0015, 0.002]
    assert evenly("1:2:1").values.tolist() == [1]
    assert evenly("3deg").values.shape == (1,)
    assert evenly("3,4mm").values.tolist() == [0.003, 0.004]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is not a number"),
        ("nan", "is not a number"),
        ("inf", "is not a number"),
        ("1e999", "is not a number"),
        ("1_000", "unknown"),
        ("١", "is not a number"),
        ("1,,2", "is not a number"),
        ("0x10", "unknown"),
        ("1 2", "is not a number"),
        ("5furlong", "the unit 'furlong' is unknown; known: m, cm, mm"),
        ("1mm,2", "write one unit, after the last number"),
        ("1mm:2m:1m", "write one unit, after the last number"),
        ("0:1", "start:end:step is needed"),
        ("0:1:2:3", "start:end:step is needed"),
        ("0:1:0", "from 1 to 10000000 positions"),
        ("0:1:-1", "from 1 to 10000000 positions"),
        ("0:1:1e-9", "from 1 to 10000000 positions"),
        ("0:1:50", "the step is longer than the way"),
        ("-1e308:1e308:1", "a finite length"),
        ("9" * 200_000, "is not a number"),
    ],
)
def test_refused_numbers(text: str, said: str) -> None:
    with pytest.raises(assur.InputError) as caught:
        numbers(text)
    assert said in str(caught.value)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize("text", ["1:2", "1:2:0", "1:2:-1", "1:2:1.5", "1:2:3mm", "1:2:99999999"])
def test_refused_grids(text: str) -> None:
    with pytest.raises(assur.InputError):
        evenly(text)


def test_every_float_comes_back() -> None:
    """What Python prints is read as the same number."""
    rng = np.random.default_rng(4)
    for value in rng.integers(0, 2**64, 500, dtype=np.uint64).view(np.float64).tolist():
        if math.isfinite(value):
            assert split_number(repr(value)).si(None) == value


def test_ratios() -> None:
    assert ratio("1/25").one("", "x") == 1 / 25
    assert ratio("0.04").one("", "x") == 0.04
    for text in ("1/0", "1/", "/3", "1/2/3", "1mm/2"):
        with pytest.raises(assur.InputError):
            ratio(text)
