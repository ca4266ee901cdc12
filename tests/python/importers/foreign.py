"""Files of other programs, written for these tests, with the same linkages written for assur."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import assur
from importers.pmks_plus_writer import Block, Joint, Link, written

TURN = math.tau


@dataclass(frozen=True)
class Case:
    """A text, how to read it, and the mechanism that it is."""

    format: str
    text: str
    joints: dict[str, tuple[float, float]]
    links: dict[str, str | list[str]]
    driver: Any
    slides: dict[str, assur.Slide | assur.Cylinder] = field(default_factory=dict)
    mobility: int = 1
    # Of the drivers, over which positions are compared: how far from the drawing.
    span: float = TURN
    speed: Any = None
    omitted: tuple[str, ...] = ()
    drivers: Any = None

    def direct(self) -> assur.Mechanism:
        """The mechanism, written directly."""
        return assur.Mechanism(self.joints, self.links, self.driver, slides=self.slides)


FOUR_BAR = {
    "J1": (0.0, 0.0),
    "J2": (0.0, 1.0),
    "J3": (3.0, 2.5),
    "J4": (4.0, 0.0),
    "J5": (1.5, 3.0),
}

PMKS = {
    "four-bar, commas, tracer, rpm": Case(
        "pmks",
        "set=s30\n"
        "ground,crank,R,0,0,0,ffft\n"
        "crank,coupler,R,0,1,0,tfff\n"
        "coupler,rocker,R,3,2.5\n"
        "rocker,Ground,R,4,0,0.000,ffff\n"
        "coupler,R,1.5,3\n",
        FOUR_BAR,
        {
            "ground": ["J1", "J4"],
            "crank": ["J1", "J2"],
            "coupler": ["J2", "J3", "J5"],
            "rocker": ["J3", "J4"],
        },
        "crank",
        speed=math.pi,
    ),
    "slider-crank, joints at one place": Case(
        "pmks",
        "gnd crank R 0 0 0 ffft\ncrank rod R 0 1\nrod block R 3 0.25\n0 block P 3 0.25 185\n",
        {"J1": (0.0, 0.0), "J2": (0.0, 1.0), "J3": (3.0, 0.25)},
        {"ground": ["J1"], "crank": ["J1", "J2"], "rod": ["J2", "J3"], "block": ["J3"]},
        "crank",
        {"J4_slide": assur.Slide("block", on="ground", angle=math.radians(-175))},
        omitted=("Joints J3 and J4 are at one place of link block",),
    ),
    "quick return, no input marked": Case(
        "pmks",
        "ground,crank,R,0,0.00\nlever crank,RP,2,0.5,30\nlever,ground,R,0.5,-3\nlever,r,2.5,1.0\n",
        {"J1": (0.0, 0.0), "J2": (2.0, 0.5), "J3": (0.5, -3.0), "J4": (2.5, 1.0)},
        {"ground": ["J1", "J3"], "crank": ["J1", "J2"], "lever": ["J3", "J4"], "J2_block": ["J2"]},
        "crank",
        {"J2_slide": assur.Slide("J2_block", on="lever", angle=math.radians(30))},
        omitted=("No joint is marked as the input",),
    ),
    "address, joint of three links": Case(
        "pmks",
        "https://designengrlab.example/PMKS/pmks.html?set=s-12|f0.5&mech="
        "ground%20a%20R%200%200%200%20ffft|a%20b%20c%20R%201%201%200%20ffff|"
        "b%20d%20R%204%203%200%20ffff|d%20ground%20R%205%200%200%20ffff|"
        "c%20e%20R%20-3%202|e%20ground%20R%20-3.5%20-1|&x=1",
        {
            "J1": (0.0, 0.0),
            "J2": (1.0, 1.0),
            "J3": (4.0, 3.0),
            "J4": (5.0, 0.0),
            "J5": (-3.0, 2.0),
            "J6": (-3.5, -1.0),
        },
        {
            "ground": ["J1", "J4", "J6"],
            "a": ["J1", "J2"],
            "b": ["J2", "J3"],
            "c": ["J2", "J5"],
            "d": ["J3", "J4"],
            "e": ["J5", "J6"],
        },
        "a",
        speed=-12 * TURN / 60,
    ),
    "driven slide": Case(
        "pmks",
        "ground ram P 0 0 90 ffft\nram rod R 0 0\nrod arm R 2 1.5\narm ground R 3 -1\nset=s0.2\n",
        {"J1": (0.0, 0.0), "J3": (2.0, 1.5), "J4": (3.0, -1.0)},
        {"ground": ["J4"], "ram": ["J1"], "rod": ["J1", "J3"], "arm": ["J3", "J4"]},
        "J1_slide",
        {"J1_slide": assur.Slide("ram", on="ground", angle=math.pi / 2)},
        span=0.5,
        speed=0.2,
        omitted=("Joints J1 and J2",),
    ),
    "pin of three links in a slot, input between moving links": Case(
        "pmks",
        "ground1 arm R 0 0\narm hand R 2 1 0 ffft\nground2 hand rod RP 4 0 0 ffff\n"
        "rod rocker R 5 2\nrocker ground R 7 0\n",
        {"J1": (0.0, 0.0), "J2": (2.0, 1.0), "J3": (4.0, 0.0), "J4": (5.0, 2.0), "J5": (7.0, 0.0)},
        {
            "ground": ["J1", "J5"],
            "arm": ["J1", "J2"],
            "hand": ["J2", "J3"],
            "rod": ["J3", "J4"],
            "rocker": ["J4", "J5"],
            "J3_block": ["J3"],
        },
        assur.Drive("hand", relative_to="arm"),
        {"J3_slide": assur.Slide("J3_block", on="ground", angle=0.0)},
        span=0.4,
    ),
    "yoke": Case(
        "pmks",
        "ground crank R 0 0 0 ffft\nyoke crank RP 1 1 90\nground yoke P 1 3 0\n",
        {"J1": (0.0, 0.0), "J2": (1.0, 1.0), "J3": (1.0, 3.0)},
        {"ground": ["J1"], "crank": ["J1", "J2"], "yoke": ["J3"], "J2_block": ["J2"]},
        "crank",
        {
            "J2_slide": assur.Slide("J2_block", on="yoke", angle=math.pi / 2),
            "J3_slide": assur.Slide("yoke", on="ground", angle=0.0),
        },
    ),
    "JSON, three links in two records": Case(
        "pmks",
        """{"DrivingIndex": 3, "InputSpeed": -2.5, "Links": [{"Name": "a"}], "Joints": [
        {"X": 0, "Y": 0.0, "Angle": 0.0, "TypeOfJoint": "R", "Links": ["ground", "a"]},
        {"X": 0.0, "Y": 1.0, "Angle": 0.0, "TypeOfJoint": "R", "Links": ["a", "b"]},
        {"X": 3.0, "Y": 2.5, "Angle": 0.0, "TypeOfJoint": "R", "Links": ["b", "c"]},
        {"X": 4.0, "Y": 0.0, "Angle": 0.0, "TypeOfJoint": "R", "Links": ["c", "ground"]},
        {"X": 3.0, "Y": 2.5, "Angle": 0.0, "TypeOfJoint": "R", "Links": ["c", "d"]},
        {"X": 6.0, "Y": 2.0, "Angle": 7.0, "TypeOfJoint": "RP", "Links": ["ground", "d"]}]}""",
        {
            "J1": (0.0, 0.0),
            "J2": (0.0, 1.0),
            "J3": (3.0, 2.5),
            "J4": (4.0, 0.0),
            "J6": (6.0, 2.0),
        },
        {
            "ground": ["J1", "J4"],
            "a": ["J1", "J2"],
            "b": ["J2", "J3"],
            "c": ["J4", "J3"],
            "d": ["J3", "J6"],
            "J6_block": ["J6"],
        },
        "c",
        {"J6_slide": assur.Slide("J6_block", on="ground", angle=7.0 - TURN)},
        span=0.3,
        speed=-2.5,
        omitted=("Joints J3 and J5",),
    ),
}

PMKS_PLUS = {
    "four-bar, clockwise": Case(
        "pmks_plus",
        "https://pmks.example/?"
        + written(
            [
                Joint("A", (0, 0), "input frame"),
                Joint("B", (-0.5, 1)),
                Joint("C", (3, 2.125), "path"),
                Joint("D", (4, -0.25), "frame"),
            ],
            [Link("AB", "AB"), Link("BC", "BC"), Link("CD", "CD")],
            rpm=10,
            clockwise=True,
        ),
        {"A": (0.0, 0.0), "B": (-0.5, 1.0), "C": (3.0, 2.125), "D": (4.0, -0.25)},
        {"ground": "AD", "AB": "AB", "BC": "BC", "CD": "CD"},
        "AB",
        speed=-10 * TURN / 60,
        omitted=("Lengths are in cm", "Masses, inertias"),
    ),
    "slider-crank, block, as it was copied": Case(
        "pmks_plus",
        "0.Fe.A,0.2111.6A,,0,0,0.0B,,0,Fe,0.0C,,k_,VG,0.5E,,k_,VG,0W.."
        "YRAB,,0,0,0,0,,A,B,,.YRBC,,0,0,0,0,,B,C,,.YPCE,,0,0,0,0,,C,E,,..N_3",
        {"A": (0.0, 0.0), "B": (0.0, 1.0), "C": (3.006, 2.0)},
        {"ground": "A", "AB": "AB", "BC": "BC", "C_block": "C"},
        "AB",
        {"C_slide": assur.Slide("C_block", on="ground", angle=-0.032)},
        speed=10 * TURN / 60,
    ),
    "slot of a moving link, welded links, a force": Case(
        "pmks_plus",
        written(
            [
                Joint("A", (0, 0), "input frame", speed=6.0),
                Joint("B", (1, 0.5)),
                Joint("C", (3, -1), "frame"),
                Joint("D", (2, 3)),
                Joint("E", (4, 3), "weld"),
                Joint("P", (1, 0.5), "slides", slot=("CD", "C", "D")),
            ],
            [
                Link("AB", "AB"),
                Link("CDE", "CDE", parts=("CD", "DE")),
                Block("BP", "BP"),
                Link("CD", "CD", root=False),
                Link("DE", "DE", root=False),
            ],
            rpm=20,
            forces=("F1,CDE,F1,0,0,0,1,2",),
        ),
        {"A": (0.0, 0.0), "B": (1.0, 0.5), "C": (3.0, -1.0), "D": (2.0, 3.0), "E": (4.0, 3.0)},
        {"ground": "AC", "AB": "AB", "CDE": "CDE", "B_block": "B"},
        "AB",
        {"B_slide": assur.Slide("B_block", on="CDE", angle=math.atan2(4.0, -1.0))},
        speed=6 * TURN / 60,
        omitted=("Forces are left out: F1.",),
    ),
    "cylinder": Case(
        "pmks_plus",
        written(
            [
                Joint("O", (0, 0), "frame"),
                Joint("C", (0, 4)),
                Joint("G", (3, 0), "frame"),
                Joint("N", (1.5, 2)),
                Joint("P", (1.8, 1.6), "weld"),
                Joint("S", (1.8, 1.6), "slides input sealed", slot=("GN", "G", "N")),
            ],
            [Link("OC", "OC"), Link("GN", "GN"), Link("PC", "PC"), Block("PS", "PS")],
            linear=0.25,
            unit="2",
        ),
        {"O": (0.0, 0.0), "C": (0.0, 4.0), "G": (3.0, 0.0), "N": (1.5, 2.0), "P": (1.8, 1.6)},
        {"ground": "OG", "OC": "OC", "GN": "GN", "PC": "PC"},
        "P_slide",
        {"P_slide": assur.Slide("PC", on="GN", angle=math.atan2(2.0, -1.5))},
        span=0.2,
        speed=0.25,
    ),
    "sliders of one record": Case(
        "pmks_plus",
        written(
            [
                Joint("A", (0, 0), "input frame"),
                Joint("B", (1, 1)),
                Joint("C", (4, 0), "slides frame", angle=0.5),
                Joint("D", (1, 1), "slides", slot=("EF", "E", "F")),
                Joint("E", (-1, 4)),
                Joint("F", (-1, 2), "slides frame weld"),
            ],
            [Link("ABD", "ABD"), Link("BC", "BC"), Link("EF", "EF")],
        ),
        {"A": (0.0, 0.0), "B": (1.0, 1.0), "C": (4.0, 0.0), "E": (-1.0, 4.0), "F": (-1.0, 2.0)},
        {
            "ground": "A",
            "ABD": "AB",
            "BC": "BC",
            "EF": "EF",
            "C_block": "C",
            "B_block": "B",
        },
        "ABD",
        {
            "C_slide": assur.Slide("C_block", on="ground", angle=0.5),
            "D_slide": assur.Slide("B_block", on="EF", angle=-math.pi / 2),
            "F_slide": assur.Slide("EF", on="ground", angle=0.0),
        },
        speed=10 * TURN / 60,
        omitted=("Joints B and D are at one place",),
    ),
}
