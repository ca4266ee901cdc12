"""Files of Linkage: lengths in 1/96 inch, speeds, and ends of strokes."""

from __future__ import annotations

import math

import pytest

import assur
from assur import importers

UNIT = 0.0254 / 96


def four_bar(rpm: str = "15", program: str = 'units="Millimeters" scalefactor="1.0"') -> str:
    return (
        f"<linkage2><program {program}/>"
        f'<connector id="0" x="0" y="0" anchor="true" input="true" rpm="{rpm}"/>'
        '<connector id="1" x="0" y="96"/><connector id="2" x="288" y="192"/>'
        '<connector id="3" x="384" y="0" anchor="true"/>'
        '<Link id="0"><connector id="0"/><connector id="1"/></Link>'
        '<Link id="1"><connector id="1"/><connector id="2"/></Link>'
        '<Link id="2"><connector id="2"/><connector id="3"/></Link></linkage2>'
    )


@pytest.mark.parametrize("units", ["Millimeters", "Inches", "Centimeters", ""])
def test_lengths_are_read_in_metres_whatever_unit_is_shown(units: str) -> None:
    program = f'units="{units}" scalefactor="1.0"'
    for text in (four_bar(program=program), four_bar(program="")):
        for found in (importers.read(text), importers.linkage2.read(text)):
            dimensions = found.mechanism.dimensions
            assert dimensions["L0.length"] == pytest.approx(0.0254, rel=1e-15)
            assert dimensions["ground.c3.x"] == pytest.approx(4 * 0.0254, rel=1e-15)
            assert found.omitted == ()


def test_another_unit_can_be_given() -> None:
    found = importers.read(four_bar(), scale=1.0)
    assert found.mechanism.dimensions["L0.length"] == 96.0
    assert found.omitted == ()
    for scale in (0.0, -1.0, math.nan, "mm"):
        with pytest.raises(assur.InputError, match="scale is"):
            importers.read(four_bar(), scale=scale)  # type: ignore[arg-type]


def test_a_scale_factor_is_said() -> None:
    found = importers.read(four_bar(program='units="Inches" scalefactor="2.5"'))
    assert found.mechanism.dimensions["L0.length"] == pytest.approx(0.0254)
    assert found.omitted == ("The scale factor 2.5 is left out.",)


def test_an_input_at_rest_has_a_speed_of_plus_zero() -> None:
    for rpm in ("0", "0.0", "-0"):
        speed = importers.read(four_bar(rpm)).input_speed
        assert speed == 0.0
        assert math.copysign(1.0, speed) == 1.0
    assert importers.read(four_bar("15")).input_speed == pytest.approx(-math.tau / 4)


def test_ends_of_slots_and_throws_are_said() -> None:
    text = (
        '<linkage2><connector id="0" x="0" y="0" anchor="true" input="true"/>'
        '<connector id="1" x="0" y="96"/><connector id="2" x="288" y="0" slider="true">'
        '<slidelimit id="3"/><slidelimit id="4"/></connector>'
        '<connector id="3" x="200" y="0" anchor="true"/>'
        '<connector id="4" x="400" y="0" anchor="true"/>'
        '<Link id="0"><connector id="0"/><connector id="1"/></Link>'
        '<Link id="1"><connector id="1"/><connector id="2"/></Link></linkage2>'
    )
    found = importers.read(text)
    assert found.omitted == ("The ends c3 and c4 of the slot of c2 are not limits here.",)
    boom = (
        '<linkage2><connector id="0" x="0" y="0" anchor="true"/><connector id="1" x="192" y="96"/>'
        '<connector id="2" x="96" y="-96" anchor="true"/>'
        '<Link id="0"><connector id="0"/><connector id="1"/></Link>'
        '<Link id="1" actuator="true" throw="96" cpm="12"><connector id="2"/><connector id="1"/>'
        "</Link></linkage2>"
    )
    lifted = importers.read(boom)
    assert lifted.omitted == ("The throw 0.0254 m of actuator L1 is not a limit here.",)
    assert lifted.mechanism.q0 == pytest.approx(math.sqrt(5) * 0.0254)
    # Forth and back in a cycle of 5 s.
    assert lifted.input_speed == pytest.approx(2 * 0.0254 / 5)
