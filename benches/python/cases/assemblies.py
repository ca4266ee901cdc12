"""Ways to put a mechanism together, where they move, and curves over two coordinates."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from subject import OURS, Case, Contender, Subject

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from subject import Float

# Coordinates at which all assemblies are found, one call.
POSITIONS = 100


def case(quick: bool) -> Case:
    designs, grid = (1000, 8) if quick else (100_000, 48)
    subjects: dict[str | int, Callable[[], Subject]] = {
        "all assemblies of a class II six-bar": partial(assemblies, six_bar),
        "all assemblies of a triad": partial(assemblies, triad),
        "all assemblies of class IV": partial(assemblies, loom),
        f"{designs:,} four-bars, their limits".replace(",", " "): partial(limits, designs),
        "a configuration curve, Stephenson III": partial(curve, six_bar),
        "a configuration curve, class IV": partial(curve, loom),
        "a five-bar's workspace": partial(workspace, grid),
        f"full rotation over {grid} × {grid} dimensions": partial(rotation, grid),
    }
    return Case(
        "assemblies",
        "position, design or call",
        subjects,
        plotted=False,
        every_level=False,
        rounds=9,
    )


def six_bar() -> assur.Mechanism:
    joints = {"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0), "P": (3, 4), "E": (5.5, 5)}
    links = {"ground": "ADF", "crank": "AB", "coupler": "BCP", "rocker": "DC", "bar": "PE"}
    return assur.Mechanism({**joints, "F": (7, 2)}, {**links, "rocker2": "FE"}, "crank")


def triad() -> assur.Mechanism:
    joints = {"O": (0.45, 2.8), "A": (-0.34, 3.2), "P": (2.43, 0.41), "Q": (1.26, 2.45)}
    joints |= {"R": (0.04, 1.89), "U": (2.38, 1.54), "V": (2.18, 0.68)}
    links = {"ground": "OUV", "crank": "OA", "plate": "PQR", "l1": "AP", "l2": "UQ", "l3": "VR"}
    return assur.Mechanism(joints, links, "crank")


def loom() -> assur.Mechanism:
    at = [(0, 0), (0.35, 0), (1.24, 0.99), (0.75, 1.91), (3.02, -0.73), (2.45, 1.02)]
    at += [(3.2, 2.24), (1.85, 2.35), (1.62, -1.11), (4.28, 1.52)]
    return assur.ClassIV({str(i): place for i, place in enumerate(at, start=1)})


def five_bar() -> assur.Mechanism:
    joints = {"A": (0, 0), "B": (-0.33, 0.73), "P": (0.68, 1.16), "D": (1.38, 0.59), "E": (1, 0)}
    links = {"ground": "AE", "crank": "AB", "rod": "BP", "arm": "DP", "rocker": "ED"}
    return assur.Mechanism(joints, links, ("crank", "rocker"))


def alone(run: Callable[[], Any], designs: int = 1, units: int = 1) -> Subject:
    """Without anyone beside it: no other package answers this completely."""
    return Subject(designs, 1, {OURS: Contender(run, every_level=False)}, units)


def assemblies(make: Callable[[], assur.Mechanism]) -> Subject:
    mechanism = make()
    q = np.linspace(-3.0, 3.0, POSITIONS)
    return alone(lambda: mechanism.assemblies(q, threads=1), units=POSITIONS)


def limits(designs: int) -> Subject:
    lengths = np.random.default_rng(5).uniform(0.5, 4.0, (4, designs))
    names = ("crank.length", "coupler.length", "rocker.length", "ground.D.x")
    batch = assur.FourBar(1.0, 3.0, 2.5, 3.2).with_dimensions(
        dict(zip(names, lengths, strict=True))
    )

    def answer(limits: assur.Limits) -> Sequence[Any]:
        return [limits.full_rotation.astype(float)]

    contenders = {
        OURS: Contender(batch.limits, answer, every_level=False),
        "NumPy, four-bars only": Contender(
            lambda: closed_form(*lengths), lambda turns: [turns[0].astype(float)]
        ),
    }
    return Subject(designs, 1, contenders)


def closed_form(a: Float, b: Float, c: Float, d: Float) -> tuple[Any, Float, Float]:
    """Full rotation, and the angles beyond which the crank cannot turn, outward and inward."""
    away = (a**2 + d**2 - (b + c) ** 2) / (2.0 * a * d)
    near = (a**2 + d**2 - (b - c) ** 2) / (2.0 * a * d)
    with np.errstate(invalid="ignore"):
        return (away <= -1.0) & (near >= 1.0), np.arccos(away), np.arccos(near)


def curve(make: Callable[[], assur.Mechanism]) -> Subject:
    return alone(make().configuration_curve)


def workspace(grid: int) -> Subject:
    mechanism = five_bar()
    return alone(lambda: mechanism.workspace("P", positions=grid))


def rotation(grid: int) -> Subject:
    axis = np.linspace(0.6, 5.0, grid)
    mechanism = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    return alone(
        lambda: mechanism.map("full_rotation", {"rocker.length": axis, "ground.D.x": axis})
    )
