"""Random mechanisms of class III to V, each with the misfit that `scan.count` needs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import assur
from oracles.kinematics.scan import Complex, Float, Misfit, carried, circles, line

if TYPE_CHECKING:
    from collections.abc import Callable


@dataclass(frozen=True)
class Case:
    """A mechanism in its drawing; how to count its assemblies there without it."""

    mechanism: assur.Mechanism
    misfit: Misfit
    dyads: int
    complex_count: int


def points(rng: np.random.Generator, names: str) -> dict[str, complex]:
    """Joints anywhere in a square, no two of them close together."""
    found: dict[str, complex] = {}
    for name in names:
        while True:
            one = complex(*rng.uniform(0.0, 3.0, 2))
            if all(abs(one - other) > 0.15 for other in found.values()):
                found[name] = one
                break
    return found


def joints(at: dict[str, complex]) -> dict[str, tuple[float, float]]:
    return {name: (one.real, one.imag) for name, one in at.items()}


def length(a: complex, b: complex) -> float:
    return abs(b - a)


def from_line(at: Complex, point: complex, way: complex) -> Float:
    """Distance from a line, with sign."""
    return np.asarray(((at - point) * np.conj(way)).imag)


def triad(rng: np.random.Generator) -> Case:
    """A plate on three legs, one of them on the crank."""
    p = points(rng, "OAPQRUV")
    mechanism = assur.Mechanism(
        joints(p),
        {
            "ground": "OUV",
            "crank": "OA",
            "plate": "PQR",
            "l1": "AP",
            "l2": "UQ",
            "l3": "VR",
        },
        "crank",
    )
    a, b, r = length(p["A"], p["P"]), length(p["P"], p["Q"]), length(p["U"], p["Q"])

    def misfit(turns: Float, signs: tuple[int, ...]) -> Float:
        at_p = p["A"] + a * np.exp(1j * turns)
        at_q = circles(at_p, b, p["U"], r, signs[0])
        at_r = carried(p["R"], p["P"], p["Q"], at_p, at_q)
        return np.asarray(np.abs(at_r - p["V"]) - length(p["V"], p["R"]))

    return Case(mechanism, misfit, 1, 6)


def triad_block_on_ground(rng: np.random.Generator) -> Case:
    """The third corner of the plate in a straight guide of the ground."""
    p = points(rng, "OAPQRU")
    angle = float(rng.uniform(-math.pi, math.pi))
    mechanism = assur.Mechanism(
        joints(p),
        {
            "ground": "OU",
            "crank": "OA",
            "plate": "PQR",
            "l1": "AP",
            "l2": "UQ",
            "block": "R",
        },
        "crank",
        slides={"guide": assur.Slide("block", on="ground", angle=angle, origin="O")},
    )
    a, b, r = length(p["A"], p["P"]), length(p["P"], p["Q"]), length(p["U"], p["Q"])
    way = complex(math.cos(angle), math.sin(angle))

    def misfit(turns: Float, signs: tuple[int, ...]) -> Float:
        at_p = p["A"] + a * np.exp(1j * turns)
        at_q = circles(at_p, b, p["U"], r, signs[0])
        return from_line(carried(p["R"], p["P"], p["Q"], at_p, at_q), p["R"], way)

    return Case(mechanism, misfit, 1, 6)


def triad_block_on_plate(rng: np.random.Generator) -> Case:
    """A block that turns about a pin of the ground slides along the plate."""
    p = points(rng, "OAPQUV")
    angle = float(rng.uniform(-math.pi, math.pi))
    mechanism = assur.Mechanism(
        joints(p),
        {
            "ground": "OUV",
            "crank": "OA",
            "plate": "PQ",
            "l1": "AP",
            "l2": "UQ",
            "block": "V",
        },
        "crank",
        slides={"slot": assur.Slide("block", on="plate", angle=angle, origin="P")},
    )
    a, b, r = length(p["A"], p["P"]), length(p["P"], p["Q"]), length(p["U"], p["Q"])
    way = complex(math.cos(angle), math.sin(angle))
    offset = float(((p["V"] - p["P"]) * np.conj(way)).imag)

    def misfit(turns: Float, signs: tuple[int, ...]) -> Float:
        at_p = p["A"] + a * np.exp(1j * turns)
        at_q = circles(at_p, b, p["U"], r, signs[0])
        turned = way * (at_q - at_p) / (p["Q"] - p["P"])
        return np.asarray(((p["V"] - at_p) * np.conj(turned)).imag - offset)

    return Case(mechanism, misfit, 1, 6)


def triad_two_blocks(rng: np.random.Generator) -> Case:
    """Two corners of the plate in guides of the ground, which both pairs have in common."""
    p = points(rng, "OAPQR")
    angles = rng.uniform(-math.pi, math.pi, 2).tolist()
    mechanism = assur.Mechanism(
        joints(p),
        {
            "ground": "O",
            "crank": "OA",
            "plate": "PQR",
            "l1": "AP",
            "first": "Q",
            "second": "R",
        },
        "crank",
        slides={
            "one": assur.Slide("first", on="ground", angle=angles[0], origin="O"),
            "other": assur.Slide("second", on="ground", angle=angles[1], origin="O"),
        },
    )
    a, b = length(p["A"], p["P"]), length(p["P"], p["Q"])
    one, other = (complex(math.cos(angle), math.sin(angle)) for angle in angles)

    def misfit(turns: Float, signs: tuple[int, ...]) -> Float:
        at_p = p["A"] + a * np.exp(1j * turns)
        at_q = line(at_p, b, p["Q"], one, signs[0])
        return from_line(carried(p["R"], p["P"], p["Q"], at_p, at_q), p["R"], other)

    return Case(mechanism, misfit, 1, 4)


def triad_inner_and_outer_block(rng: np.random.Generator) -> Case:
    """One corner in a guide of the ground, and a block along the plate."""
    p = points(rng, "OAPQV")
    angles = rng.uniform(-math.pi, math.pi, 2).tolist()
    mechanism = assur.Mechanism(
        joints(p),
        {
            "ground": "OV",
            "crank": "OA",
            "plate": "PQ",
            "l1": "AP",
            "piston": "Q",
            "block": "V",
        },
        "crank",
        slides={
            "bore": assur.Slide("piston", on="ground", angle=angles[0], origin="O"),
            "slot": assur.Slide("block", on="plate", angle=angles[1], origin="P"),
        },
    )
    a, b = length(p["A"], p["P"]), length(p["P"], p["Q"])
    one, other = (complex(math.cos(angle), math.sin(angle)) for angle in angles)
    offset = float(((p["V"] - p["P"]) * np.conj(other)).imag)

    def misfit(turns: Float, signs: tuple[int, ...]) -> Float:
        at_p = p["A"] + a * np.exp(1j * turns)
        at_q = line(at_p, b, p["Q"], one, signs[0])
        turned = other * (at_q - at_p) / (p["Q"] - p["P"])
        return np.asarray(((p["V"] - at_p) * np.conj(turned)).imag - offset)

    return Case(mechanism, misfit, 1, 6)


def two_plates(rng: np.random.Generator) -> Case:
    """Class IV, order 2: two plates tied by two bars, one on the crank, one on the ground."""
    p = points(rng, "OABCDEF")
    mechanism = assur.Mechanism(
        joints(p),
        {
            "ground": "OD",
            "crank": "OA",
            "p1": "ABC",
            "p2": "DEF",
            "b1": "BE",
            "b2": "CF",
        },
        "crank",
    )

    def misfit(turns: Float, signs: tuple[int, ...]) -> Float:
        turn = np.exp(1j * turns)
        at_b, at_c = (p["A"] + (p[name] - p["A"]) * turn for name in "BC")
        bar, arm = length(p["B"], p["E"]), length(p["D"], p["E"])
        at_e = circles(at_b, bar, p["D"], arm, signs[0])
        at_f = carried(p["F"], p["D"], p["E"], np.full_like(at_e, p["D"]), at_e)
        return np.asarray(np.abs(at_f - at_c) - length(p["C"], p["F"]))

    return Case(mechanism, misfit, 1, 6)


def loom(rng: np.random.Generator, block: bool = False) -> Case:
    """The loom's class IV group; with `block`, a block on the first plate in place of its bar."""
    p = points(rng, "012345678")
    names = {"1": "0", "2": "1", "3": "2", "4": "3", "5": "4", "6": "5", "7": "6", "8": "7"}
    at = {name: p[own] for name, own in names.items()}
    more = points(rng, "9x")
    at |= {"9": more["9"], "10": more["x"]}
    links: dict[str, list[str]] = {
        "ground": ["1", "9", "10"],
        "crank": ["1", "2"],
        "l234": ["2", "3", "4"],
        "l365": ["3", "6", "5"],
        "l48": ["4", "8"],
        "l876": ["8", "7", "6"],
        "l95": ["9", "5"],
        "l107": ["10", "7"],
    }
    slides = {}
    angle = float(rng.uniform(-math.pi, math.pi))
    if block:
        links["l48"] = ["8"]
        links["l234"] = ["2", "3"]
        del at["4"]
        slides["slot"] = assur.Slide("l48", on="l234", angle=angle, origin="2")
    mechanism = assur.Mechanism(joints(at), links, "crank", slides=slides)
    way = complex(math.cos(angle), math.sin(angle))

    def misfit(turns: Float, signs: tuple[int, ...]) -> Float:
        turn = np.exp(1j * turns)
        at_3 = at["2"] + (at["3"] - at["2"]) * turn
        at_5 = circles(at_3, length(at["3"], at["5"]), at["9"], length(at["9"], at["5"]), signs[0])
        at_6 = carried(at["6"], at["3"], at["5"], at_3, at_5)
        at_7 = circles(
            at_6, length(at["6"], at["7"]), at["10"], length(at["10"], at["7"]), signs[1]
        )
        at_8 = carried(at["8"], at["6"], at["7"], at_6, at_7)
        if block:
            offset = ((at["8"] - at["2"]) * np.conj(way)).imag
            return np.asarray(((at_8 - at["2"]) * np.conj(way * turn)).imag - offset)
        at_4 = at["2"] + (at["4"] - at["2"]) * turn
        return np.asarray(np.abs(at_8 - at_4) - length(at["4"], at["8"]))

    return Case(mechanism, misfit, 2, 16)


def class_v(rng: np.random.Generator, block: bool = False) -> Case:
    """Class V: three plates and three bars; with `block`, a block in place of one bar."""
    p = points(rng, "OXYZMaKL")
    p |= points(rng, "NQ")
    links = {
        "ground": "OYZ",
        "crank": "OX",
        "t1": "MaK",
        "t2": "XML",
        "b": "LN",
        "t3": "YNQ",
        "c": "QK",
        "pend": "Za",
    }
    slides = {}
    angle = float(rng.uniform(-math.pi, math.pi))
    if block:
        links |= {"t1": "MK", "pend": "Z"}
        del p["a"]
        slides["slot"] = assur.Slide("pend", on="t1", angle=angle, origin="M")
    mechanism = assur.Mechanism(joints(p), links, "crank", slides=slides)
    way = complex(math.cos(angle), math.sin(angle))

    def misfit(turns: Float, signs: tuple[int, ...]) -> Float:
        turn = np.exp(1j * turns)
        at_m, at_l = (p["X"] + (p[name] - p["X"]) * turn for name in "ML")
        at_n = circles(at_l, length(p["L"], p["N"]), p["Y"], length(p["Y"], p["N"]), signs[0])
        at_q = carried(p["Q"], p["Y"], p["N"], np.full_like(at_n, p["Y"]), at_n)
        at_k = circles(at_m, length(p["M"], p["K"]), at_q, length(p["Q"], p["K"]), signs[1])
        if block:
            offset = ((p["Z"] - p["M"]) * np.conj(way)).imag
            turned = way * (at_k - at_m) / (p["K"] - p["M"])
            return np.asarray(((p["Z"] - at_m) * np.conj(turned)).imag - offset)
        at_a = carried(p["a"], p["M"], p["K"], at_m, at_k)
        return np.asarray(np.abs(at_a - p["Z"]) - length(p["Z"], p["a"]))

    return Case(mechanism, misfit, 2, 16)


# Each with the number that the campaign counts.
CASES: dict[str, tuple[Callable[[np.random.Generator], Case], int]] = {
    "triad": (triad, 1000),
    "triad, block on the ground": (triad_block_on_ground, 50),
    "triad, block on the plate": (triad_block_on_plate, 50),
    "triad, two blocks": (triad_two_blocks, 50),
    "triad, blocks inside and outside": (triad_inner_and_outer_block, 50),
    "IV, order 2": (two_plates, 50),
    "IV": (loom, 200),
    "IV, a block": (lambda rng: loom(rng, block=True), 50),
    "V": (class_v, 50),
    "V, a block": (lambda rng: class_v(rng, block=True), 50),
}
