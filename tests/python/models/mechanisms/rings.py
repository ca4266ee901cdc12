"""Groups of any size."""

from __future__ import annotations

import math

import assur


def ring(plates: int) -> assur.Mechanism:
    """Plates tied by bars around a circle, the first pinned to the crank, others to the ground."""
    turns = [2.0 * math.pi * i / plates for i in range(plates)]
    at = {"O": (2.5, 0.3)}
    links = {"ground": ["O"], "crank": ["O", "D0"]}
    for i, turn in enumerate(turns):
        for name, radius, ahead in (("D", 2.0, 0.0), ("E", 3.0, -0.1), ("F", 3.1, 0.15)):
            angle = turn + ahead + 0.03 * i
            at[f"{name}{i}"] = (radius * math.cos(angle), radius * math.sin(angle))
        links[f"plate{i}"] = [f"D{i}", f"E{i}", f"F{i}"]
        links[f"bar{i}"] = [f"F{i}", f"E{(i + 1) % plates}"]
        if i:
            links["ground"].append(f"D{i}")
    return assur.Mechanism(at, links, "crank")
