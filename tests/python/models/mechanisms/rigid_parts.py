"""Random mechanisms whose groups hang on one link each, so that all of them move as one body.

A four-bar moves; dyads, triads and pairs of slides hang on its links and on one another. Computed
relative speeds within a body are rounding, the more the worse the groups are conditioned.
"""

from __future__ import annotations

from typing import Any

import numpy as np

import assur

KINDS = ("RRR", "RRR", "RRP", "PRP", "RPR", "RPP", "triad")
# Differences of the directions of two guides: of the first the condition is 500.
APART = (0.002, 0.01, 0.1, 1.0)


class RigidParts:
    """A mechanism under construction, and the links that move as one."""

    def __init__(self, seed: int, groups: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.joints: dict[str, Any] = {name: self.place() for name in "ABCD"}
        self.links: dict[str, list[str]] = {
            "ground": ["A", "D"],
            "crank": ["A", "B"],
            "coupler": ["B", "C"],
            "rocker": ["D", "C"],
        }
        self.slides: dict[str, assur.Slide] = {}
        self.bodies = [["crank"], ["coupler"], ["rocker"]]
        for index in range(groups):
            self.add(str(index))

    def place(self) -> tuple[float, float]:
        x, y = np.round(self.rng.uniform(-3.0, 3.0, 2), 2)
        return float(x), float(y)

    def angle(self) -> float:
        return float(np.round(self.rng.uniform(0.0, 3.1), 3))

    def two_angles(self) -> tuple[float, float]:
        angle = self.angle()
        return angle, round(angle + float(self.rng.choice(APART)), 4)

    def any_of(self, many: list[str]) -> str:
        return many[int(self.rng.integers(len(many)))]

    def anchor(self, body: list[str], name: str) -> str:
        """A joint of a body: one that it has, or a new one."""
        link = self.any_of(body)
        if self.links[link] and self.rng.random() < 0.3:
            return self.any_of(self.links[link])
        self.joints[name] = self.place()
        self.links[link].append(name)
        return name

    def add(self, index: str) -> None:
        body = self.bodies[int(self.rng.integers(3))]
        kind = KINDS[int(self.rng.integers(len(KINDS)))]
        u, w, pin = f"u{index}", f"w{index}", f"C{index}"
        if kind == "triad":
            anchors = [self.anchor(body, f"P{index}{k}") for k in range(3)]
            if len(set(anchors)) < 3:
                return
            corners = [f"{pin}{k}" for k in range(3)]
            self.joints |= {corner: self.place() for corner in corners}
            self.links[u] = corners
            legs = [f"{w}{k}" for k in range(3)]
            for leg, start, corner in zip(legs, anchors, corners, strict=True):
                self.links[leg] = [start, corner]
            body += [u, *legs]
            return
        first = self.anchor(body, f"P{index}")
        if kind in ("RRR", "RPR"):
            second = self.anchor(body, f"Q{index}")
            if first == second:
                return
        self.links[u], self.links[w] = [first], []
        if kind == "RRR":
            self.links[u], self.links[w] = [first, pin], [second, pin]
        elif kind == "RRP":
            self.links[u], self.links[w] = [first, pin], [pin]
            self.slides[f"s{index}"] = assur.Slide(w, on=self.any_of(body), angle=self.angle())
        elif kind == "RPR":
            self.links[w] = [second]
            self.slides[f"s{index}"] = assur.Slide(w, on=u, angle=self.angle())
        else:
            angles = self.two_angles()
            self.links[u], self.links[w] = [pin] if kind == "PRP" else [first], [pin]
            on = self.any_of(body) if kind == "PRP" else w
            self.slides[f"s{index}"] = assur.Slide(u, on=on, angle=angles[0])
            self.slides[f"t{index}"] = assur.Slide(w, on=self.any_of(body), angle=angles[1])
        if kind != "RRR" and pin not in self.links[u] + self.links[w]:
            body += [u, w]
            return
        self.joints[pin] = self.place()
        body += [u, w]

    def mechanism(self) -> assur.Mechanism:
        return assur.Mechanism(self.joints, self.links, driver="crank", slides=self.slides)

    def moves_with(self, link: str) -> list[str]:
        """The links that move as one with a link."""
        return next((body for body in self.bodies if link in body), [link])
