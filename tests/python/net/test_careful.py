"""Kernels and shortcuts against the careful path, to the bit."""

from __future__ import annotations

import json
import os

from net import bits, design_spaces
from support.samples import sample

# Random mechanisms, each with a space of 24 designs at 40 coordinates.
COUNT = sample(6, 200)


def test_careful_path_gives_the_same_bits() -> None:
    """Angles too; but traced knot by knot, an island may be missed, and whole turns with it."""
    assert "ASSUR_CARE" not in os.environ, "there would be nothing to compare with"
    program = design_spaces.__file__
    with (
        bits.elsewhere(program, COUNT, ASSUR_CARE="always") as always,
        bits.elsewhere(program, COUNT, ASSUR_CARE="knots") as knots,
    ):
        own = dict(design_spaces.digests(COUNT))
        one_by_one, knot_by_knot = (json.loads(p.communicate()[0]) for p in (always, knots))
    assert own.keys() == one_by_one.keys() == knot_by_knot.keys()
    assert [name for name in own if list(own[name]) != one_by_one[name]] == []
    assert [name for name in own if own[name][1] != knot_by_knot[name][1]] == []
