"""What must not depend on the description: the order of lists, names, the drawing, the frame."""

from __future__ import annotations

import math
import random
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import assur
from assur import Status
from campaigns.campaign_report import Findings
from models.mechanisms.frames import Frame
from models.mechanisms.mechanism_data import arguments
from models.mechanisms.variants import Variant, framed, redrawn, renamed, shuffled
from oracles.kinematics import variant_queries as queries
from oracles.kinematics.variant_results import Pairing

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from models.mechanisms import dyad_models
    from models.mechanisms.mechanism_data import Description
    from oracles.kinematics.variant_results import Array

POSITIONS = 24
REACH = math.pi  # to either side of the drawing, rad or m
# A second drawing is taken where the motion is well conditioned: it is rounded to κ.
REDRAWN = 20.0
# Curves and assemblies are asked of one mechanism in so many; limits and extremes of one in so many
# that a slide drives, whose limits take a second. Curves of so many groups at most.
CURVES = 5
SLIDING = 20
GROUPS = 2


def variant_of(d: Description, m: assur.Mechanism, rng: random.Random) -> Variant:
    """Shuffled, renamed, in another frame, and mostly drawn at another position."""
    v = Variant.same(d)
    if len(d.drivers) == 1 and rng.random() < 0.7:
        q = position(m, rng)
        v = redrawn(d, m, q) if q is not None else v
    v = shuffled(v, rng)
    if rng.random() < 0.5:
        v = renamed(v, rng)
    mirror = rng.random() < 0.5
    if mirror or rng.random() < 0.5:
        shift = rng.uniform(-2, 2), rng.uniform(-2, 2)
        v = framed(v, Frame(rng.uniform(-math.pi, math.pi), shift, mirror))
    return v


def position(m: assur.Mechanism, rng: random.Random) -> Array | None:
    """A coordinate of the same motion, which is not near a dead point."""
    q = float(m.q0) + np.array([rng.uniform(-REACH, REACH) for _ in range(POSITIONS)])
    if not (isinstance(m.driver, str) and m.driver in m.slides):
        q[::2] += math.tau * rng.randint(-1, 1)  # beyond a turn, too
    motion = m.solve(q, order=1, on_error="nan", threads=1)
    good = (np.asarray(motion.status) == Status.OK) & (np.asarray(motion.condition) < REDRAWN)
    return q[good][:1] if good.any() else None


class Variants(Findings):
    """One mechanism and another description of it: all results."""

    def __init__(self, case: dyad_models.Case) -> None:
        super().__init__()
        self.rng = random.Random(f"variants {case.seed}")
        d = case.description
        m = assur.Mechanism(**arguments(d))
        self.variant = variant_of(d, m, self.rng)
        self.report.counts["described again"] += 1
        for step in self.variant.steps:
            self.report.counts[f"described {step}"] += 1
        try:
            self.p = Pairing(d, m, self.variant)
        except assur.AssurError as error:
            self.fail("described refused", f"{self.variant.steps}: {error}")
            return
        self.guarded(self.structure)
        self.guarded(self.motion)
        if len(d.drivers) == 1 and (all(self.p.turning) or self.rng.randrange(SLIDING) == 0):
            self.guarded(self.queries)

    def check(self, what: str, *texts: str) -> None:
        self.fail(f"described {what}", *(f"{' '.join(self.variant.steps)}: {t}" for t in texts))

    def structure(self) -> None:
        """The same groups, in any order."""
        kinds = [
            sorted((g.cls, len(g.links), str(g.kind)) for g in m.structure.groups)
            for m in (self.p.one, self.p.two)
        ]
        if kinds[0] != kinds[1]:
            self.check("structure", f"{kinds[1]}, should be {kinds[0]}")

    def motion(self) -> None:
        start, drivers = np.atleast_1d(self.p.one.q0), len(self.p.d.drivers)
        q = start + np.array([[self.rng.uniform(-1, 1)] * drivers for _ in range(POSITIONS)]) * (
            REACH if drivers == 1 else 0.5
        )
        self.check("motion", *self.p.motions(q if drivers > 1 else q[:, 0]))

    def queries(self) -> None:
        """Limits, extremes, find; of one in some the curve and all assemblies."""
        p, rng = self.p, self.rng
        kind, name = rng.choice(
            [("link", n) for n in p.d.links if n != "ground"] + [("slide", n) for n in p.d.slides]
        )
        asked: list[tuple[str, Callable[[], Iterable[str]]]] = [
            ("limits", lambda: queries.same_limits(p)),
            *(("extremes", partial(queries.same_extremes, p, kind, name, k)) for k in range(4)),
        ]
        if rng.randrange(CURVES) == 0:
            q = np.atleast_1d(p.one.q0) + rng.uniform(-1, 1)
            value = float(getattr(p.at_first, kind)(name).value) + rng.uniform(-0.2, 0.2)
            asked += [
                ("assemblies", lambda: queries.same_assemblies(p, q)),
                ("find", lambda: queries.same_finds(p, kind, name, value)),
            ]
            # Above class II, and of long chains, curves take a minute.
            if p.one.structure.cls == 2 and len(p.one.structure.groups) <= GROUPS:
                asked.append(("curve", lambda: queries.same_curve(p)))
        for what, ask in asked:
            self.report.counts[f"described {what}"] += 1
            try:
                self.check(what, *ask())
            except assur.AssurError as error:
                if "more assemblies than can be found" in str(error):
                    self.report.counts["described too many assemblies"] += 1
                    continue
                self.check(what, f"{type(error).__name__}: {error}")
