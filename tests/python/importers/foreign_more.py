"""Files of pylinkage, pyslvs and Linkage, written for these tests."""

from __future__ import annotations

import math

import assur
from importers.foreign import TURN, Case

PIN = {"O": (0.0, 0.0), "A": (0.0, 1.0), "B": (3.0, 2.5), "C": (4.0, 0.0)}
FOUR_BAR = {"ground": "OC", "crank": "OA", "rod": "AB", "arm": "BC"}

# Circles of radius 3 about (0, 1) and 2.5 about (3, 0): their difference is y = 3 x - 5.375, and
# then 10 x² - 38.25 x + 6.375² - 9 = 0.
CROSS = (38.25 + math.sqrt(38.25**2 - 40.0 * (6.375**2 - 9.0))) / 20.0

PYLINKAGE = {
    "four-bar, tracker, steps": Case(
        "pylinkage",
        """{"name": "four-bar", "ground": "frame", "joints": [
        {"id": "O", "type": "ground", "position": [0.0, 0.0]},
        {"id": "A", "type": "revolute", "position": [0.0, 1.0], "name": "pin"},
        {"id": "B", "type": "revolute", "position": [3.0, 2.5]},
        {"id": "C", "type": "ground", "position": [4, 0]},
        {"id": "T", "type": "tracker", "position": [9, 9], "ref_joint1_id": "A",
         "ref_joint2_id": "B", "distance": 2.0, "angle": 0.7}],
        "links": [
        {"id": "frame", "type": "ground", "joints": ["O", "C"]},
        {"id": "crank", "type": "driver", "joints": ["O", "A"], "motor_joint": "O",
         "angular_velocity": 0.1, "initial_angle": 1.5707963267948966},
        {"id": "rod", "type": "link", "joints": ["A", "B"]},
        {"id": "arm", "type": "link", "joints": ["B", "C"]}]}""",
        {
            **PIN,
            "T": (
                2.0 * math.cos(math.atan2(1.5, 3.0) + 0.7),
                1.0 + 2.0 * math.sin(math.atan2(1.5, 3.0) + 0.7),
            ),
        },
        {**FOUR_BAR, "rod": "ABT"},
        "crank",
        speed=0.1,
        omitted=("The speed is in rad a step",),
    ),
    "slider on an oblique line, to and fro": Case(
        "pylinkage",
        """{"joints": [
        {"id": "O", "type": "ground", "position": [0, 0]},
        {"id": "A", "position": [0.6, 0.8]},
        {"id": "S", "type": "prismatic", "position": [4.0, 1.5], "axis": [2.0, 1.0],
         "line_point": [1.0, 0.0], "slide_distance": 0}],
        "links": [
        {"id": "crank", "type": "arc_driver", "joints": ["O", "A"], "motor_joint": "O",
         "arc_start": 0.0, "arc_end": 1.0},
        {"id": "rod", "type": "link", "joints": ["A", "S"]}]}""",
        {"O": (0.0, 0.0), "A": (0.6, 0.8), "S": (4.0, 1.5)},
        {"ground": "O", "crank": "OA", "rod": "AS", "S_block": "S"},
        "crank",
        {"S_slide": assur.Slide("S_block", on="ground", angle=math.atan2(1.0, 2.0))},
        omitted=("Driver crank turns to and fro",),
    ),
    "five-bar, two drivers": Case(
        "pylinkage",
        """{"joints": [
        {"id": "A", "type": "ground", "position": [0, 0]},
        {"id": "B", "type": "revolute", "position": [0, 1]},
        {"id": "P", "type": "revolute", "position": [0.7, 1.2]},
        {"id": "D", "type": "revolute", "position": [1.4, 0.6]},
        {"id": "E", "type": "ground", "position": [1, 0]}],
        "links": [
        {"id": "left", "type": "driver", "joints": ["A", "B"], "motor_joint": "A",
         "angular_velocity": 0.25},
        {"id": "rod", "type": "link", "joints": ["B", "P"]},
        {"id": "arm", "type": "link", "joints": ["D", "P"]},
        {"id": "right", "type": "driver", "joints": ["D", "E"], "motor_joint": "E"}]}""",
        {"A": (0.0, 0.0), "B": (0.0, 1.0), "P": (0.7, 1.2), "D": (1.4, 0.6), "E": (1.0, 0.0)},
        {"ground": "AE", "left": "AB", "rod": "BP", "arm": "DP", "right": "ED"},
        ("left", "right"),
        mobility=2,
        span=0.2,
        speed=(0.25, None),
    ),
    "dyads, only roughly placed": Case(
        "pylinkage",
        """{"name": "old", "joints": [
        {"type": "Revolute", "name": "B", "x": 2.9, "y": 2.7, "joint0": {"ref": "A"},
         "joint1": {"ref": "C"}, "distance0": 3.0, "distance1": 2.5},
        {"type": "Fixed", "name": "T", "x": null, "y": null, "joint0": {"ref": "A"},
         "joint1": {"ref": "B"}, "distance": 1.5, "angle": -0.4},
        {"type": "Static", "name": "O", "x": 0, "y": 0},
        {"type": "Static", "name": "C", "x": 3.0, "y": 0},
        {"type": "Crank", "name": "A", "x": 0.0, "y": 7.0, "joint0": {"ref": "O"},
         "distance": 1.0, "angle": 0.31}], "solve_order": ["A", "B", "T"]}""",
        {
            "O": (0.0, 0.0),
            "A": (0.0, 1.0),
            "B": (CROSS, 3.0 * CROSS - 5.375),
            "C": (3.0, 0.0),
            "T": (
                1.5 * math.cos(math.atan2(3.0 * CROSS - 6.375, CROSS) - 0.4),
                1.0 + 1.5 * math.sin(math.atan2(3.0 * CROSS - 6.375, CROSS) - 0.4),
            ),
        },
        {"ground": "OC", "O_A": "OA", "A_B": "ABT", "C_B": "CB"},
        "O_A",
        speed=0.31,
    ),
    "dyads: a slider between inline points, a slot": Case(
        "pylinkage",
        """{"joints": [
        {"type": "Static", "name": "O", "x": 0, "y": 0},
        {"type": "Crank", "name": "A", "x": 0, "y": 1, "joint0": {"ref": "O"}, "distance": 1},
        {"type": "Prismatic", "name": "S", "x": 3, "y": -0.5, "joint0": {"ref": "A"},
         "joint1": {"inline": true, "type": "Static", "x": 0, "y": -0.5, "name": null},
         "joint2": {"inline": true, "type": "Static", "x": 1, "y": -0.5, "name": null},
         "revolute_radius": 2.5},
        {"type": "Fixed", "name": "T", "x": 0, "y": 0, "joint0": {"ref": "S"},
         "joint1": {"ref": "O"}, "distance": 1, "angle": 1.5707963267948966}]}""",
        {
            "O": (0.0, 0.0),
            "A": (0.0, 1.0),
            "S_joint1": (0.0, -0.5),
            "S_joint2": (1.0, -0.5),
            "S": (2.0, -0.5),
            # From S towards O is (-2, 0.5); a quarter turn on from there is (-0.5, -2).
            "T": (2.0 - 0.5 / math.sqrt(4.25), -0.5 - 2.0 / math.sqrt(4.25)),
        },
        {
            "ground": ["O", "S_joint1", "S_joint2"],
            "O_A": "OA",
            "A_S": "AS",
            "S_block": "S",
            "S_T": "ST",
            "O_block": "O",
        },
        "O_A",
        {
            "S_slide": assur.Slide("S_block", on="ground", angle=0.0),
            "O_slide": assur.Slide("O_block", on="S_T", angle=math.atan2(0.5, -2.0)),
        },
    ),
}

PYSLVS = {
    "four-bar, comments": Case(
        "pyslvs",
        """# a four-bar
        M[  #[ of several
        lines #]
            J[R, color[Green], P[0.0, 0.0], L[ground, crank]],
            J[R, color[(1, 2, 3)], P[0, 1], L[crank, rod]],
            J[R, P[+3.0, 25e-1], L[rod, arm]], # inner
            J[R, P[4, .0], L[arm, ground,]],
            J[R, P[-1.5, 3], L[rod]],
        ]""",
        {"P0": (0.0, 0.0), "P1": (0.0, 1.0), "P2": (3.0, 2.5), "P3": (4.0, 0.0), "P4": (-1.5, 3.0)},
        {
            "ground": ["P0", "P3"],
            "crank": ["P0", "P1"],
            "rod": ["P1", "P2", "P4"],
            "arm": ["P2", "P3"],
        },
        "crank",
        drivers=[(0, 1)],
    ),
    "pin of three links in a slot of a moving link": Case(
        "pyslvs",
        "M[J[R,P[0,0],L[ground,a]],J[R,P[1,1],L[a,b]],J[RP,A[-340],P[4,2],L[c,b,d]],"
        "J[R,P[3,-2],L[ground,c]],J[R,P[5,4],L[d,e]],J[R,P[7,1],L[e,ground]],J[R,P[6,2],L[c]]]",
        {
            "P0": (0.0, 0.0),
            "P1": (1.0, 1.0),
            "P2": (4.0, 2.0),
            "P3": (3.0, -2.0),
            "P4": (5.0, 4.0),
            "P5": (7.0, 1.0),
            "P6": (6.0, 2.0),
        },
        {
            "ground": ["P0", "P3", "P5"],
            "a": ["P0", "P1"],
            "b": ["P1", "P2"],
            "c": ["P3", "P6"],
            "d": ["P2", "P4"],
            "e": ["P4", "P5"],
            "P2_block": ["P2"],
        },
        ("a", "c"),
        {"P2_slide": assur.Slide("P2_block", on="c", angle=math.radians(20))},
        mobility=2,
        span=0.1,
        drivers=[(0, 1), (3, 6)],
    ),
    "sliding block on a moving link": Case(
        "pyslvs",
        "M[J[R, P[-1, 0], L[ground, a]], J[R, P[3, 0], L[ground, c]], J[R, P[-0.5, 2], L[a, b]], "
        "J[P, A[380], P[2, 3], L[c, b]]]",
        {"P0": (-1.0, 0.0), "P1": (3.0, 0.0), "P2": (-0.5, 2.0), "P3": (2.0, 3.0)},
        {"ground": ["P0", "P1"], "a": ["P0", "P2"], "b": ["P2", "P3"], "c": ["P1"]},
        "a",
        {"P3_slide": assur.Slide("b", on="c", angle=math.radians(20))},
        span=0.5,
        drivers=[(0, 2)],
    ),
    "driven slide": Case(
        "pyslvs",
        "M[J[RP, A[0], P[0, 0], L[ground, b]], J[R, P[5, 0], L[ground, a]], "
        "J[R, P[2.5, 2.7], L[a, b]], J[R, P[0, 5], L[a]]]",
        {"P0": (0.0, 0.0), "P1": (5.0, 0.0), "P2": (2.5, 2.7), "P3": (0.0, 5.0)},
        {"ground": ["P1"], "b": ["P0", "P2"], "a": ["P1", "P2", "P3"], "P0_block": ["P0"]},
        "P0_slide",
        {"P0_slide": assur.Slide("P0_block", on="ground", angle=0.0)},
        span=1.0,
        drivers=[(0, 0)],
    ),
}

LINKAGE = {
    "four-bar, names, a label, a frame": Case(
        "linkage2",
        """<?xml version="1.0"?>
        <linkage2>
        <program zoom="1"xoffset="10" scalefactor="1" units="Millimeters"/>
        <connector id="0" layer="16" name="left &amp; low" x="0" y="0" anchor="true" input="true"
          rpm="15" color="1"/>
        <connector id="1" layer="16" x="0" y="1"/>
        <connector id="2" layer="16" x="3" y="2.5" draw="true"/>
        <connector id="3" layer="16" x="4.0" y="0" anchor="true"/>
        <connector id="4" layer="16" x="9" y="9" anchor="true"/>
        <connector id="5" layer="1" x="2" y="8" name="Title & more"/>
        <connector id="6" layer="16" x="20" y="8"/><connector id="7" layer="16" x="21" y="8"/>
        <Link id="0" layer="16"><connector id="0"/><connector id="1"/></Link>
        <element id="1" name="rod (long)"><connector id="1"/><connector id="2"/></element>
        <Link id="2"><connector id="2"/><connector id="3"/></Link>
        <Link id="3"><connector id="0"/><connector id="3"/></Link>
        <Link id="4"><connector id="6"/><connector id="7"/></Link>
        <Link id="5" layer="1"><connector id="5"/></Link>
        <Link id="6"><connector id="4"/></Link>
        <selected><connector id="1"/><link id="0"/></selected>
        </linkage2>""",
        {
            "left_&_low": (0.0, 0.0),
            "c1": (0.0, 1.0),
            "c2": (3.0, 2.5),
            "c3": (4.0, 0.0),
            "c4": (9.0, 9.0),
        },
        {
            "ground": ["left_&_low", "c3", "c4"],
            "L0": ["left_&_low", "c1"],
            "rod__long_": ["c1", "c2"],
            "L2": ["c2", "c3"],
        },
        "L0",
        speed=-15 * TURN / 60,
        omitted=(
            "Drawing L5 is left out.",
            "Link L3 has two joints on the frame",
            "Link L4 is not connected with the frame",
            "Link L6 is held by a single joint",
            "Joints c6 and c7 are on no link",
            "Joint 'left & low' is called left_&_low.",
            "Link 'rod (long)' is called rod__long_.",
        ),
    ),
    "sliders on a moving link and between anchors": Case(
        "linkage2",
        """<linkage2>
        <connector id="0" x="0" y="0" anchor="true" input="true" rpm="-30"/>
        <connector id="1" x="1" y="0.5" slider="true"><slidelimit id="2"/><slidelimit id="3"/>
        </connector>
        <connector id="2" x="3" y="-1" anchor="true"/><connector id="3" x="2" y="3"/>
        <connector id="4" x="5" y="4" slider="true"><slidelimit id="5"/><slidelimit id="6"/>
        </connector>
        <connector id="5" x="4" y="4" anchor="true"/><connector id="6" x="8" y="4" anchor="true"/>
        <connector id="7" x="5" y="8"/>
        <Link id="0"><connector id="0"/><connector id="1"/></Link>
        <Link id="1"><connector id="2"/><connector id="3"/></Link>
        <Link id="0"><connector id="3"/><connector id="4"/></Link>
        <Link id="3"><connector id="7"/></Link>
        </linkage2>""",
        {
            "c0": (0.0, 0.0),
            "c1": (1.0, 0.5),
            "c2": (3.0, -1.0),
            "c3": (2.0, 3.0),
            "c4": (5.0, 4.0),
            "c5": (4.0, 4.0),
            "c6": (8.0, 4.0),
        },
        {
            "ground": ["c0", "c2", "c5", "c6"],
            "L0": ["c0", "c1"],
            "L1": ["c2", "c3"],
            "L0_2": ["c3", "c4"],
            "c1_block": ["c1"],
            "c4_block": ["c4"],
        },
        "L0",
        {
            "c1_slide": assur.Slide("c1_block", on="L1", angle=math.atan2(4.0, -1.0)),
            "c4_slide": assur.Slide("c4_block", on="ground", angle=0.0),
        },
        span=0.3,
        speed=math.pi,
    ),
    "actuator, fastened links": Case(
        "linkage2",
        """<linkage2>
        <connector id="0" x="0" y="0" anchor="true"/><connector id="1" x="2" y="1"/>
        <connector id="2" x="1" y="-1" anchor="true"/><connector id="3" x="4" y="4"/>
        <connector id="4" x="9" y="9" fastenlink="0"/>
        <Link id="0"><connector id="0"/><connector id="1"/></Link>
        <Link id="1" fastenlink="0"><connector id="1"/><connector id="3"/></Link>
        <Link id="2" name="lift" actuator="true" throw="0.75" cpm="12"><connector id="2"/>
        <connector id="1"/></Link>
        </linkage2>""",
        {
            "c0": (0.0, 0.0),
            "c1": (2.0, 1.0),
            "c2": (1.0, -1.0),
            "c3": (4.0, 4.0),
            "c4": (9.0, 9.0),
        },
        {"ground": ["c0", "c2"], "L0": ["c0", "c1", "c4", "c3"]},
        "lift",
        {"lift": assur.Cylinder("c2", "c1", barrel="lift_barrel", rod="lift_rod")},
        span=0.5,
        speed=0.3,
        omitted=("The throw 0.75 m of actuator lift", "Links L0 and L1 are welded"),
    ),
    "two inputs": Case(
        "linkage2",
        """<linkage2>
        <connector id="1" x="0" y="0" anchor="true" input="true" rpm="10"/>
        <connector id="2" x="0" y="1"/><connector id="3" x="0.7" y="1.2"/>
        <connector id="4" x="1.4" y="0.6"/>
        <connector id="5" x="1" y="0" anchor="true" input="true" rpm="20" limitangle="90"/>
        <Link id="1"><connector id="1"/><connector id="2"/></Link>
        <Link id="2"><connector id="2"/><connector id="3"/></Link>
        <Link id="3"><connector id="3"/><connector id="4"/></Link>
        <Link id="4"><connector id="4"/><connector id="5"/></Link>
        </linkage2>""",
        {
            "c1": (0.0, 0.0),
            "c2": (0.0, 1.0),
            "c3": (0.7, 1.2),
            "c4": (1.4, 0.6),
            "c5": (1.0, 0.0),
        },
        {
            "ground": ["c1", "c5"],
            "L1": ["c1", "c2"],
            "L2": ["c2", "c3"],
            "L3": ["c3", "c4"],
            "L4": ["c5", "c4"],
        },
        ("L1", "L4"),
        mobility=2,
        span=0.2,
        speed=(-TURN / 6, -TURN / 3),
        omitted=("Input c5 turns to and fro",),
    ),
}
