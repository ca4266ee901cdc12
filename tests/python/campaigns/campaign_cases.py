"""Input of a campaign: mechanisms by seed, and the user's steps."""

from __future__ import annotations

import math
import random
from typing import TYPE_CHECKING

import numpy as np

from models.mechanisms import dyad_models, higher_models
from models.mechanisms.mechanism_data import GROUND, SlideSpec

if TYPE_CHECKING:
    from numpy.typing import NDArray

    import assur

# A user's steps, rad and m (drawn anew for every mechanism), and how much finer the other track is.
TURN_STEPS = (math.radians(3.0), math.radians(6.0))
SLIDE_STEPS = (0.03, 0.06)
FINER = 8
TURNS = 3
SLIDE_RANGE = 3.0  # to either side of the drawing, whose links are 0.3 to 3 long
CHANGING = ("parallelogram", "antiparallelogram", "kite", "even", "isosceles", "shaper")


def random_case(seed: int) -> dyad_models.Case:
    """`dyad_models.random_case` with up to four dyads; with two drivers nothing is traced."""
    rng = random.Random(seed)
    kinds = [rng.choice(dyad_models.KINDS) for _ in range(rng.randint(1, 4))]
    driver = rng.choice(dyad_models.DRIVERS)
    return dyad_models.build(seed, "crank" if driver == "two_cranks" else driver, kinds)


def changing_case(seed: int) -> dyad_models.Case:
    """A crank, a dyad with change points (but for rounding), then up to two dyads."""
    rng = random.Random(f"changing {seed}")
    builder = dyad_models._Builder(rng)
    builder.driver("crank")
    kind = CHANGING[seed % len(CHANGING)]
    _change(builder, kind)
    for _ in range(rng.randint(0, 2)):
        builder.dyad(rng.choice(dyad_models.KINDS))
    return dyad_models.Case(builder.finish(), kind, tuple(builder.dyads), seed)


def _change(builder: dyad_models._Builder, kind: str) -> None:
    """Hang it between the crank's pin B and the ground."""
    a, b = (complex(*builder.joints[n]) for n in ("J0", "J1"))
    crank = abs(b - a)
    if kind == "isosceles":
        # The block on a guide through the pivot, as far from the pin as the pivot is.
        angle = math.atan2((b - a).imag, (b - a).real) + builder.corner()
        ray = complex(math.cos(angle), math.sin(angle))
        place = a + 2.0 * ((b - a) * ray.conjugate()).real * ray
        pin = builder.joint((place.real, place.imag))
        builder.link("J1", pin)
        builder.slides["s0"] = SlideSpec(builder.link(pin), GROUND, angle, "J0")
        return
    if kind == "shaper":
        # A guide through its pivot, which the pin passes once a turn.
        place = a + (b - a) * _unit(builder.corner())
        pivot = builder.joint((place.real, place.imag), GROUND)
        along = math.atan2((b - place).imag, (b - place).real)
        guide, block = builder.link(pivot), builder.link("J1")
        builder.slides["s0"] = SlideSpec(block, guide, along, pivot)
        return
    far, rod, rocker = crank, crank, crank
    turned = 0j
    while True:  # the first that closes in the drawing and is not flat there
        leg = builder.leg()
        if kind == "kite":
            far, rod, rocker = crank, leg, leg
        elif kind == "even":  # the longest and the shortest as long as the others
            far, rod = leg, builder.leg()
            rocker = builder.rng.choice((far + rod - crank, abs(far - rod) + crank))
        else:
            far, rod, rocker = leg, leg, crank
        foot = a + far * _unit(builder.angle())
        if kind == "parallelogram":
            turned = foot - a
        else:
            across = abs(foot - b)
            if rocker <= 0.1 or not abs(rod - rocker) < across < rod + rocker:
                continue
            cosine = (rod**2 + across**2 - rocker**2) / (2 * rod * across)
            turn = math.acos(cosine) * builder.rng.choice((-1, 1))
            if kind == "antiparallelogram":  # not the parallelogram again
                options = [(foot - b) / across * rod * _unit(s * turn) for s in (-1, 1)]
                turned = max(options, key=lambda v: abs(v - (foot - a)))
            else:
                turned = (foot - b) / across * rod * _unit(turn)
        sine = abs((turned.conjugate() * (foot - b - turned)).imag) / (rod * rocker)
        if sine > dyad_models.LEAST_SINE:
            break
    pivot = builder.joint((foot.real, foot.imag), GROUND)
    pin = builder.joint(((b + turned).real, (b + turned).imag))
    builder.link("J1", pin)
    builder.link(pin, pivot)


def _unit(angle: float) -> complex:
    return complex(math.cos(angle), math.sin(angle))


def grid_of(m: assur.Mechanism, rng: np.random.Generator) -> tuple[NDArray[np.float64], int]:
    """The fine grid, and how many of the user's steps make a turn (0 for slides)."""
    if isinstance(m.driver, str) and m.driver in m.slides:
        step, first, span, turn = rng.uniform(*SLIDE_STEPS), -SLIDE_RANGE, 2 * SLIDE_RANGE, 0
    else:
        step, first, span = rng.uniform(*TURN_STEPS), -math.tau * rng.random(), TURNS * math.tau
        turn = math.ceil(math.tau / step) + 1
    steps = np.arange(FINER * math.ceil(span / step) + 1)
    return np.asarray(float(m.q0) + first + step / FINER * steps, np.float64), turn


MAKE = {"random": random_case, "changing": changing_case, "higher": higher_models.higher_case}
