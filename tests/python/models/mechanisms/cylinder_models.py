"""Random mechanisms with cylinders: driven, or in a dyad, between the ground and moving links."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from typing import Any

import assur


@dataclass(frozen=True)
class Case:
    """A mechanism, and the cylinders in it by their joints."""

    mechanism: assur.Mechanism
    cylinders: dict[str, tuple[str, str]]
    seed: int


def cylinder_case(seed: int) -> Case:
    """Booms on one another, a cylinder each: the first drives, or the first boom does.

    A boom turns about a pivot on the one before; its cylinder goes from there to a joint of it.
    """
    rng = random.Random(f"cylinder {seed}")

    def near(x: float, y: float, far: float) -> tuple[float, float]:
        angle, length = rng.uniform(-math.pi, math.pi), rng.uniform(0.3, far)
        return x + length * math.cos(angle), y + length * math.sin(angle)

    joints: dict[str, tuple[float, float]] = {}
    links: dict[str, list[str]] = {"ground": []}
    slides: dict[str, Any] = {}
    before = "ground"
    count = rng.randint(1, 2)
    for k in range(count):
        pivot, base, eye, tip = (f"{n}{k}" for n in ("pivot", "base", "eye", "tip"))
        joints[pivot] = near(0.0, 0.0, 2.0)
        joints[base], joints[eye] = near(*joints[pivot], 1.5), near(*joints[pivot], 1.5)
        joints[tip] = near(*joints[pivot], 2.0)
        links[before] += [pivot, base]
        links[f"boom{k}"] = [pivot, eye, tip]
        slides[f"lift{k}"] = assur.Cylinder(base, eye)
        before = f"boom{k}"
    drives: list[Any] = [
        rng.choice(
            [
                f"lift{k}",
                f"boom{k}" if k == 0 else assur.Drive(f"boom{k}", relative_to=f"boom{k - 1}"),
            ]
        )
        for k in range(count)
    ]
    driver = drives[0] if count == 1 else drives
    m = assur.Mechanism(joints=joints, links=links, driver=driver, slides=slides)
    return Case(m, {f"lift{k}": (f"base{k}", f"eye{k}") for k in range(count)}, seed)
