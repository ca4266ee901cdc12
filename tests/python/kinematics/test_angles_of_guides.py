"""The angle of a guide on its link is an angle wherever dimensions are named, never a length."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assur
from assur.cli.main import main
from assur.kinematics.configuration import size_of

YOKE = assur.examples.scotch_yoke()
Q = np.linspace(0.0, 6.0, 7)
UPRIGHT = -math.pi / 2


def test_its_unit_is_the_radian() -> None:
    pytest.importorskip("xarray")
    grid = {"bed.link_angle": [UPRIGHT, UPRIGHT + 0.1]}
    measured = assur.sweep(YOKE, grid, Q, metrics={"stroke": assur.metric.span("bed")})
    assert measured.to_xarray()["bed.link_angle"].units == "rad"
    assert YOKE.dimensions.to_dataframe().attrs["units"]["bed.link_angle"] == "rad"


def test_it_is_no_measure_of_the_size() -> None:
    assert size_of(YOKE) == pytest.approx(0.05)
    assert size_of(assur.examples.oldham()) == pytest.approx(0.02)


def test_a_map_shows_degrees() -> None:
    pytest.importorskip("matplotlib")
    grid = assur.Grid({"bed.link_angle": np.linspace(UPRIGHT, UPRIGHT + 0.2, 3)})
    measured = assur.sweep(YOKE, grid, Q, metrics={"stroke": assur.metric.span("bed")})
    labels = [label.get_text() for label in measured.plot("stroke").get_xticklabels()]
    assert any("°" in label for label in labels)


def test_the_command_line_takes_degrees(capsys: pytest.CaptureFixture[str]) -> None:
    ask = ["solve", "example:scotch_yoke", "--q", "30deg", "--set", "bed.link_angle=-90deg"]
    assert main(ask) == 0
    assert "bed" in capsys.readouterr().out
