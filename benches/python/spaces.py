"""The mechanisms of the benches and their designs, as `assur` and as others take them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import assur

if TYPE_CHECKING:
    from collections.abc import Sequence

    from subject import Float


@dataclass(frozen=True)
class Space:
    """A mechanism, and values of dimensions for many designs: rows in the order of names."""

    mechanism: assur.Mechanism
    names: Sequence[str]
    values: Float

    @property
    def columns(self) -> dict[str, Float]:
        return dict(zip(self.names, self.values, strict=True))

    def batch(self) -> assur.Mechanism:
        return self.mechanism.with_dimensions(self.columns)


def near(mechanism: assur.Mechanism, designs: int, names: Sequence[str] = ()) -> Space:
    """Designs with dimensions up to 1 % above the mechanism's own."""
    names = names or list(mechanism.dimensions)
    nominal = np.array([mechanism.dimensions[name] for name in names])
    stretch = np.random.default_rng(1).uniform(1.0, 1.01, (len(names), designs))
    return Space(mechanism, names, nominal[:, None] * stretch)


FOUR_BAR = ("crank.length", "coupler.length", "rocker.length", "ground.D.x")


def turning_four_bars(designs: int) -> Space:
    """Crank-rockers, all of which turn fully."""
    return near(assur.FourBar(1.0, 3.0, 2.5, 3.2), designs, FOUR_BAR)


def slider_cranks(designs: int) -> Space:
    """They turn fully."""
    names = ("crank.length", "rod.length", "bore.offset")
    return near(assur.SliderCrank(1.0, 3.0, 0.1), designs, names)


JOINTS = {"A": (0, 0), "B": (0, 1), "C": (2.5, 2.0), "D": (3.2, 0), "P": (1.0, 2.0)}
LINKS = {"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"}
POINT = ("coupler.P.x", "coupler.P.y")


def random_four_bars(designs: int) -> Space:
    """Any lengths from 0.5 to 4: most do not turn fully, a fifth cannot be assembled at q = 0."""
    random = np.random.default_rng(3)
    lengths = random.uniform(0.5, 4.0, (4, designs))
    point = random.uniform(-1.0, 2.0, (2, designs))
    mechanism = assur.Mechanism(JOINTS, {name: list(of) for name, of in LINKS.items()}, "crank")
    return Space(mechanism, (*FOUR_BAR, *POINT), np.concatenate([lengths, point]))


def random_six_bars(designs: int) -> Space:
    """Stephenson III on such four-bars: links 5 and 6, the pivot E, a point T of link 5."""
    four_bars = random_four_bars(designs)
    random = np.random.default_rng(4)
    low, high = [[2.0], [2.0], [3.0], [-1.0]], [[5.0], [5.0], [7.0], [2.0]]
    second = random.uniform(low, high, (4, designs))
    tip = random.uniform(-1.0, 2.0, (2, designs))
    joints = {**JOINTS, "E": (6.0, 0.5), "S": (4.0, 3.5), "T": (3.0, 4.5)}
    links = {**LINKS, "ground": "ADE", "fifth": "PST", "sixth": "ES"}
    mechanism = assur.Mechanism(joints, {name: list(of) for name, of in links.items()}, "crank")
    names = ("fifth.length", "sixth.length", "ground.E.x", "ground.E.y", "fifth.T.x", "fifth.T.y")
    values = np.concatenate([four_bars.values, second, tip])
    return Space(mechanism, (*four_bars.names, *names), values)


# Dyads of a chain after which its proportions begin again.
PERIOD = 50


def chain(dyads: int, designs: int) -> Space:
    """Rockers to the right and to the left in turns, each driven by the one before; none folds."""
    joints = {"O": (0.0, 0.0), "C0": (0.0, 0.5)}
    links = {"ground": ["O"], "crank": ["O", "C0"]}
    for k in range(1, dyads + 1):
        before, foot, tip = f"C{k - 1}", f"D{k}", f"C{k}"
        x, y = 3.0 if k % 2 else 0.02 * (k % PERIOD), joints[before][1]
        joints |= {foot: (x, y - 3.0 + 0.01 * (k % PERIOD)), tip: (x, y + 0.01)}
        links["ground"].append(foot)
        links |= {f"coupler{k}": [before, tip], f"rocker{k}": [foot, tip]}
    mechanism = assur.Mechanism(joints, links, "crank")
    return Space(
        mechanism, ["crank.length"], np.random.default_rng(4).uniform(0.5, 0.505, (1, designs))
    )


def chain_lengths(mechanism: assur.Mechanism, dyads: int) -> tuple[Float, Float]:
    """Pivots of the rockers; lengths of coupler and rocker, and the side that the tip is on."""
    joints = {name: np.array(place) for name, place in mechanism.joints.items()}
    feet, lengths = np.empty((dyads, 2)), np.empty((dyads, 3))
    for k in range(dyads):
        before, foot, tip = joints[f"C{k}"], joints[f"D{k + 1}"], joints[f"C{k + 1}"]
        chord, leg = foot - before, tip - before
        feet[k] = foot
        side = np.sign(chord[0] * leg[1] - chord[1] * leg[0])
        lengths[k] = np.hypot(*leg), np.hypot(*(tip - foot)), side
    return feet, lengths
