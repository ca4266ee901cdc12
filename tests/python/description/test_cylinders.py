"""A cylinder in one word is its two links and their slide."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

import assur
from models.errors.refusals import refused


def boom(lift: Any) -> assur.Mechanism:
    joints = {"foot": (0, 0), "eye": (2, 1), "base": (1, -1)}
    return assur.Mechanism(
        joints, {"ground": ["foot", "base"], "boom": ["foot", "eye"]}, "lift", slides={"lift": lift}
    )


def test_it_is_two_links_and_a_slide() -> None:
    by_hand = assur.Mechanism(
        {"foot": (0, 0), "eye": (2, 1), "base": (1, -1)},
        {"ground": ["foot", "base"], "boom": ["foot", "eye"], "tube": ["base"], "ram": ["eye"]},
        "lift",
        slides={
            "lift": assur.Slide(
                "ram", "tube", angle=np.arctan2(2.0, 1.0), origin="base", length=True
            )
        },
    )
    assert boom(assur.Cylinder("base", "eye", barrel="tube", rod="ram")) == by_hand
    assert list(boom(assur.Cylinder("base", "eye")).links)[2:] == ["lift_barrel", "lift_rod"]


def test_its_value_is_the_distance() -> None:
    m = boom(assur.Cylinder("base", "eye"))
    q = np.linspace(1.4, 3.0, 5)
    eye = m.solve(q).joint("eye").value
    np.testing.assert_allclose(np.hypot(eye[:, 0] - 1.0, eye[:, 1] + 1.0), q, rtol=1e-14)


def test_refusals() -> None:
    refused(assur.InputError, "lift eyes joint", partial(boom, assur.Cylinder("base", "eyes")))
    refused(assur.InputError, "one place", partial(boom, assur.Cylinder("eye", "eye")))
    refused(assur.InputError, "base", partial(boom, assur.Cylinder("a base", "eye")))
    refused(assur.InputError, "assur.Slide", partial(boom, 1.0))
    taken = assur.Cylinder("base", "eye", barrel="boom")
    refused(assur.StructureError, "boom twice", partial(boom, taken))
