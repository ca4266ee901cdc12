"""What the rounding of a second drawing does to results.

Its coordinates are computed from the first's and rounded, so its lengths are not quite those of the
first. How far that moves a result, its own slopes say: each coordinate and guide is moved by a step
that is seen above rounding, and the change is scaled down to what rounding may have moved it by.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from models.mechanisms.variants import Variant

# Half units in the last place, one for each rounded operation. A drawing at another position rounds
# what was solved; a guide's angle there is a difference of two, added. Another frame takes two
# products and two sums of a coordinate, and one sum of an angle.
COORDINATE = {"redrawn": 1, "framed": 4}
ANGLE = {"redrawn": 3, "framed": 1}
# The root of u: the change is then known to as many digits as the slope is constant.
STEP = 2.0**-26


def moved_drawings(v: Variant) -> Iterator[tuple[Variant, float]]:
    """The drawing with one number moved, and the part of the change that rounding may have made."""
    d = v.description
    coordinate, angle = (
        sum(table.get(step, 0) for step in v.steps) for table in (COORDINATE, ANGLE)
    )
    size = max((max(map(abs, place)) for place in d.joints.values()), default=1.0)
    if coordinate:
        for name, (x, y) in d.joints.items():
            part = coordinate * 0.5 * math.ulp(max(abs(x), abs(y))) / (STEP * size)
            for place in ((x + STEP * size, y), (x, y + STEP * size)):
                moved = replace(d, joints={**d.joints, name: place})
                yield replace(v, description=moved), part
    if angle:
        for name, slide in d.slides.items():
            part = angle * 0.5 * math.ulp(max(abs(slide.angle), 1.0)) / STEP
            turned = replace(slide, angle=slide.angle + STEP)
            moved = replace(d, slides={**d.slides, name: turned})
            yield replace(v, description=moved), part
