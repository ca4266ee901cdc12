"""How far from its path a linkage gets when its lengths are not quite right."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.description.dotted_names import split_name
from assur.fitting.distance import chamfer
from assur.fitting.proof import path_coordinates

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.fitting.target import PathTarget
    from assur.kinematics.mechanism import Mechanism

# Positions of a path, and samples of the target: changes of the error need no more.
PATH = 161
# By which part lengths are changed.
TOLERANCE = 1e-3


def perturbed_errors(
    mechanism: Mechanism, arc: float, target: PathTarget, tolerance: float
) -> dict[str, float]:
    """Return for every length the greater error after it grew or shrank by a part of itself.

    A coordinate of a joint changes by that part of the joint's distance from its link's first
    joint. Infinite if the crank then does not go round. The most sensitive come first.
    """
    names, designs = changed_lengths(mechanism, tolerance)
    turns = np.asarray(designs.limits().full_rotation)
    q = path_coordinates(mechanism, arc, PATH)
    motion = designs.solve(q, order=0, outputs=[target.joint], on_error="nan")
    curves = target.framed(motion.joint(target.joint).value)
    errors = [
        chamfer(curve, target.corners, PATH) if turned and np.isfinite(curve).all() else np.inf
        for curve, turned in zip(curves, turns, strict=True)
    ]
    worst = np.maximum(*np.reshape(errors, (2, -1)))
    order = np.argsort(-worst, kind="stable")
    return {names[index]: float(worst[index]) for index in order}


def changed_lengths(mechanism: Mechanism, tolerance: float) -> tuple[list[str], Mechanism]:
    """Return the lengths by name, and designs: each grown by a part of itself, then each shrunk."""
    sizes = _sizes(mechanism, list(mechanism.dimensions))
    # The first joint on the ground is where it is.
    names = [name for name, size in zip(mechanism.dimensions, sizes, strict=True) if size > 0.0]
    sizes = sizes[sizes > 0.0]
    values = np.array([mechanism.dimensions[name] for name in names])
    # Each length with either sign: a design for each.
    changes = tolerance * np.concatenate([np.diag(sizes), -np.diag(sizes)], axis=1)
    columns = dict(zip(names, values[:, np.newaxis] + changes, strict=True))
    return names, mechanism.with_dimensions(columns)


def _sizes(mechanism: Mechanism, names: list[str]) -> Float:
    """Return for every dimension the distance of which a part is its change."""
    # Places on the ground are the drawing's; on other links the first joint is the origin.
    foot = mechanism.joints[mechanism.links["ground"][0]] if mechanism.links["ground"] else (0, 0)
    sizes = []
    for name in names:
        item, component = split_name(name)
        if component == "length":
            sizes.append(float(mechanism.dimensions[name]))
            continue
        if component in ("angle", "link_angle", "offset"):
            # A part of a radian; of a distance from a line.
            sizes.append(1.0 if component != "offset" else abs(float(mechanism.dimensions[name])))
            continue
        x, y = (float(mechanism.dimensions[f"{item}.{axis}"]) for axis in "xy")
        if item.startswith("ground."):
            x, y = x - foot[0], y - foot[1]
        sizes.append(float(np.sqrt(x * x + y * y)))
    return np.array(sizes)
