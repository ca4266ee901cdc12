"""Invalid descriptions: the change, words of the message, fields of the error."""

from __future__ import annotations

import math
from typing import Any

import assur
from models.errors.refusals import (
    FIVE,
    FIVE_LINKS,
    FOUR,
    LINKS,
    LOCOMOTIVE,
    RODS,
    engine,
    joint,
    link,
    oldham,
    slide,
    twice,
)

nan, inf = math.nan, math.inf
Refusal = tuple[dict[str, Any], tuple[str, ...], dict[str, Any]]
REFUSED: dict[str, Refusal] = {
    # names
    "unknown joint": (link(coupler="BCZ"), ('"coupler"', '"Z"', "does not exist"), {"joint": "Z"}),
    "joint for link": (
        joint(crank=(1, 2)) | link(rocker=["D", "C", "crank"]),
        ("crank", "twice"),
        {},
    ),
    "slide for joint": (
        {"slides": {"C": slide("rocker", "ground", 0)}},
        ("C", "joint"),
        {"slide": "C"},
    ),
    # joints and links
    "NaN": (joint(P=(nan, 0)), ("P", "x", "NaN"), {"joint": "P"}),
    "infinite": (joint(P=(0, -inf)), ("P", "y", "-inf"), {"joint": "P", "value": -inf}),
    "loose joint": (joint(Q=(9, 9)), ("Q", "no link", "leave it out"), {"joint": "Q"}),
    "listed twice": (link(coupler="BCB"), ("coupler", "B"), {"link": "coupler", "joint": "B"}),
    "zero length": (joint(B=(0, 0)), ("crank", "A", "B"), {"link": "crank", "value": 0.0}),
    "rounded to zero": (
        joint(A=(0.1 + 0.2, 1 / 3), B=(0.3, 1 / 3)),
        ("crank", "length zero"),
        {"link": "crank"},
    ),
    "jointless": (link(x=[]), ("x", "no joint", "two slides"), {"link": "x"}),
    "no ground": (
        {"links": {k: LINKS[k] for k in ("crank", "coupler", "rocker")}},
        ("ground",),
        {},
    ),
    "ground empty": (link(ground=[]), ("connected", "crank", "rocker"), {"link": "crank"}),
    "apart": (joint(Q=(9, 9), R=(1, 9)) | link(x="QR"), ("connected", "x"), {"link": "x"}),
    "two apart": (
        twice() | {"links": {**twice()["links"], "ground": "AD"}},
        ("crank2", "rocker2"),
        {},
    ),
    # slides
    "slide link": (engine(bore=slide("pistn", "ground", 0)), ("bore", "pistn", "piston"), {}),
    "slide on": (engine(bore=slide("piston", "grund", 0)), ("bore", "grund", '"ground"'), {}),
    "slide origin": (engine(bore=slide("piston", "ground", 0, "Q")), ("bore", "Q"), {"joint": "Q"}),
    "origin elsewhere": (
        engine(bore=slide("piston", "ground", 0, "A")),
        ("bore", "A", "ground"),
        {"slide": "bore", "joint": "A"},
    ),
    "on itself": (
        engine(bore=slide("piston", "piston", 0)),
        ("bore", "piston"),
        {"link": "piston"},
    ),
    "slide NaN": (engine(bore=slide("piston", "ground", nan)), ("bore", "NaN"), {"slide": "bore"}),
    "guides cross": (engine(bore2=slide("piston", "ground", 0.3, "O")), ("piston",), {}),
    "wedge": (
        {
            "joints": {"O": (0, 0), "X": (1, 0), "Y": (2, 2)},
            "links": {"ground": "O", "a": "X", "b": "Y"},
            "slides": {
                "s1": slide("a", "ground", 0),
                "s2": slide("b", "ground", 1.5),
                "s3": slide("a", "b", 0.7),
            },
            "driver": "s1",
        },
        ("s1", "s2", "s3", "PPP"),
        {"slide": "s1"},
    ),
    "parallel tongues": (
        oldham(tongue2=slide("disc", "shaft2", 0.4, "O2")),
        ("disc",),
        {"link": "disc"},
    ),
    "opposite tongues": (
        oldham(tongue2=slide("disc", "shaft2", 0.4 + math.pi, "O2")),
        ("disc",),
        {},
    ),
    "tongue nowhere": (
        oldham(tongue2=slide("disc", "shaft2", 2)),
        ("tongue2", "disc", "shaft2"),
        {},
    ),
    # drivers
    "no driver": ({"driver": []}, ("driver",), {}),
    "ground driven": ({"driver": "ground"}, ("ground",), {}),
    "unknown driver": ({"driver": "cranck"}, ("cranck", '"crank"'), {}),
    "unknown Drive": (
        {"driver": assur.Drive("crank", relative_to="rockr")},
        ("rockr", '"rocker"'),
        {},
    ),
    "Drive itself": (
        {"driver": assur.Drive("crank", relative_to="crank")},
        ("crank",),
        {"link": "crank"},
    ),
    "driven twice": (
        {"driver": ["crank", assur.Drive("crank")]},
        ("crank", "twice"),
        {"driver": "crank"},
    ),
    "angle of a piston": (engine("piston"), ("piston", "cannot"), {"driver": "piston"}),
    # mobility
    "two for one": ({"driver": ["crank", "rocker"]}, ("1", "2 drivers"), {"value": 1.0}),
    "one for two": (
        {"joints": FIVE, "links": FIVE_LINKS, "driver": "left"},
        ("mobility is 2", "l2", "l3", "right"),
        {"link": "l2", "value": 2.0},
    ),
    "five-bar doubled": (
        {"joints": FIVE, "links": {**FIVE_LINKS, "again": "BC"}, "driver": "left"},
        ("mobility is 2", "counted 1", "l3", "right", "over-constrained by 1", '"again"'),
        {"value": 2.0},
    ),
    "dangling": (joint(Q=(9, 9)) | link(tail="PQ"), ("mobility is 2", "tail"), {"link": "tail"}),
    "pinned at one joint": (link(tail="C"), ("mobility is 2", "tail"), {"link": "tail"}),
    "one driver, two four-bars": (
        twice(),
        ("mobility is 2", "crank2", "rocker2"),
        {"link": "crank2"},
    ),
    "both in one": (twice(driver=["crank", "rocker"]), ("cannot", "coupler2"), {"driver": "crank"}),
    "rigid part driven": (
        joint(Q=(9, 9)) | link(diagonal="AC", tail="PQ"),
        ("crank", "cannot", "tail"),
        {"driver": "crank"},
    ),
    # structures: what is too much must be named
    "triangle": (
        {
            "joints": {"A": (0, 0), "B": (1, 2), "C": (3, 0)},
            "links": {"ground": "AC", "crank": "AB", "other": "CB"},
        },
        ("mobility 0", '"crank"', '"other"'),
        {"value": 0.0},
    ),
    "diagonal": (link(diagonal="AC"), ("mobility 0", '"diagonal"'), {"value": 0.0}),
    "third rod 1e-3 too long": (
        {"joints": {**LOCOMOTIVE, "E": (1.49925, -0.001)}, "links": RODS},
        ("lengths agree", "0.00022 m off", '"third"'),
        {},
    ),
    "third rod 1e-2 too long": (
        {"joints": {**LOCOMOTIVE, "E": (1.4925, -0.01)}, "links": RODS},
        ("mobility 0", '"third"'),
        {"value": 0.0},
    ),
    # flat drawings
    "in line": (
        {"joints": {"A": (0, 0), "B": (1, 0), "C": (4, 0), "D": (2, 0)}, "links": FOUR},
        ("collinear", "C", "assembly"),
        {"joint": "C", "value": 0.0},
    ),
    "engine at its dead point": (
        engine("bore") | {"joints": {"O": (0, 0), "A": (0.05, 0), "B": (0.25, 0)}},
        ("collinear", "A", "assembly"),
        {"joint": "A"},
    ),
    "no such dyad": ({"assembly": {"X": 1}}, ("X", "C"), {"joint": "X"}),
    "sign": ({"assembly": {"C": 2}}, ("C", "2", "+1", "-1"), {"joint": "C", "value": 2}),
}
