"""Random mechanisms with a dyad that is nearly flat in the drawing, or guides nearly parallel."""

from __future__ import annotations

import math
import random

from models.mechanisms import dyad_models

# The sine of the least angle: the drawing's condition is about its inverse.
LEAST, MOST = 1e-6, 1e-2
DRIVERS = ("crank", "slide")


class Builder(dyad_models._Builder):
    """One of the dyads, drawn by lot, is nearly flat."""

    flat = False

    def corner(self) -> float:
        if not self.flat:
            return super().corner()
        sine = math.exp(self.rng.uniform(math.log(LEAST), math.log(MOST)))
        corner = math.asin(sine)
        corner = math.pi - corner if self.rng.random() < 0.5 else corner
        return corner * self.rng.choice((-1, 1))


def flat_case(seed: int) -> dyad_models.Case:
    """A crank or a slide, and one to three dyads, of which one is nearly flat."""
    rng = random.Random(f"flat {seed}")
    builder = Builder(rng)
    driver = rng.choice(DRIVERS)
    builder.driver(driver)
    kinds = [rng.choice(dyad_models.KINDS) for _ in range(rng.randint(1, 3))]
    flat = rng.randrange(len(kinds))
    for k, kind in enumerate(kinds):
        builder.flat = k == flat
        builder.dyad(kind)
    return dyad_models.Case(builder.finish(), driver, tuple(builder.dyads), seed)
