"""How far a machine's reactions are from balance and from the oracle, in u κ of the largest force.

Moments count by the mechanism's size.  What is compared, of every position:

- each link: what pairs and drivers do to it, its loads and its inertia are in balance;
- the ground: what pairs and drivers do to it is the shaking force and the loads on moving links;
- each driver's effort by Newton and Euler against its effort by power;
- all forces and moments against the oracle's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from oracles.dynamics.body_places import GROUND, cross
from oracles.dynamics.multipliers import Reactions, unit_roundoff

if TYPE_CHECKING:
    from models.machines.reaction_machines import Case

# Beyond this share the float64 oracle's own error counts: the one of 50 digits is asked.
OWN = 4.0


@dataclass
class Worst:
    """The greatest share of each kind and whose it is."""

    shares: dict[str, tuple[float, str]] = field(default_factory=dict)

    def note(self, kind: str, error: float, unit: float, whose: str) -> None:
        share = error / unit if error == error else math.inf  # NaN is worse than all
        if share > self.shares.get(kind, (0.0, ""))[0]:
            self.shares[kind] = (share, whose)

    def __str__(self) -> str:
        return "; ".join(f"{k} {v:.2f} u κ ({whose})" for k, (v, whose) in self.shares.items())

    def add(self, other: Worst) -> None:
        for kind, (share, whose) in other.shares.items():
            self.note(kind, share, 1.0, whose)

    @property
    def greatest(self) -> float:
        return max((v for v, _ in self.shares.values()), default=0.0)


class Compared:
    """One machine's reactions at all positions of its case, beside the oracle."""

    def __init__(self, case: Case, worst: Worst, found: Any, effort: Any) -> None:
        self.case, self.found, self.effort = case, found, np.asarray(effort)
        condition = case.mechanism.solve(case.q).condition
        for k in range(len(case.q)):
            for exact in (False, True):
                self.known = Reactions(case.machine, *case.position(k), exact=exact)
                self.force = unit_roundoff() * float(condition[k]) * self.known.largest()
                self.torque = self.force * self.known.places.size
                self.worst = Worst()
                self.position(k)
                if self.worst.greatest < OWN:
                    break
            worst.add(self.worst)

    def note(self, kind: str, error: Any, whose: str, turns: bool = False) -> None:
        unit = self.torque if turns else self.force
        self.worst.note(kind, abs(complex(error)), unit, f"{whose}, seed {self.case.seed}")

    def position(self, k: int) -> None:
        known, found, m = self.known, self.found, self.case.mechanism
        places = known.places
        zero = dict.fromkeys(m.links, 0.0)
        force: dict[str, Any] = dict(zero)
        couple: dict[str, Any] = dict(zero)  # about the origin

        def act(link: str, place: Any, f: Any, c: Any = 0.0) -> None:
            force[link] += f
            couple[link] += c + cross(complex(place), complex(f))

        for joint, links in known.links_at.items():
            for link in links:
                one = complex(*found.joint(joint, on=link)[k])
                self.note("joint", one - known.joint(joint, link), f"{joint} on {link}")
                act(link, places.joints[joint], one)
        for name, slide in m.slides.items():
            own = found.slide(name)
            normal, moment = float(own.normal[k]), float(own.moment[k])
            self.note("normal", normal - known.normal(name), name)
            self.note("moment", moment - known.moment(name), name, True)
            push = normal * 1j * complex(places.guide[name])
            act(slide.link, places.sliding[name], push, moment)
            act(slide.on, places.sliding[name], -push, -moment)
        driver = np.reshape(found.driver, self.effort.shape).reshape(len(self.case.q), -1)[k]
        effort = self.effort.reshape(len(self.case.q), -1)[k]
        for i, (kind, a, b) in enumerate(places.drivers):
            turns, value = kind == "angle", float(driver[i])
            self.note("driver", value - known.driver(i), f"driver {i}", turns)
            self.note("power", value - effort[i], f"driver {i}", turns)
            if turns:
                act(a, 0.0, 0.0, value)
                act(b, 0.0, 0.0, -value)
            else:
                along = value * complex(places.guide[kind])
                act(a, places.sliding[kind], along)
                act(b, places.sliding[kind], -along)
        self.balance(k, force, couple)

    def balance(self, k: int, force: dict[str, Any], couple: dict[str, Any]) -> None:
        known, found = self.known, self.found
        loads, moments = known.reduced(known.loads)
        inertia, twist = known.reduced(known.inertia)
        ground, moment = force[GROUND], couple[GROUND]
        for link in known.moving:
            at = complex(known.places.reference[link])
            left = force[link] + complex(loads[link] + inertia[link])
            # the reference point's own moment: forces act there, of the origin's nothing is left
            turn = couple[link] - cross(at, force[link]) + float(moments[link] + twist[link])
            self.note("balance", left, link)
            self.note("balance of moments", turn, link, True)
            ground -= complex(loads[link])
            moment -= float(moments[link]) + cross(at, complex(loads[link]))
        shaking, twisting = known.shaking
        own = complex(*found.shaking_force[k])
        self.note("shaking force", own - shaking, "frame")
        self.note("frame", ground - own, "frame")
        reach = max(
            1.0, max(abs(complex(p)) for p in known.places.joints.values()) / known.places.size
        )
        self.note("shaking moment", (found.shaking_moment[k] - twisting) / reach, "frame", True)
        self.note("frame's moment", (moment - found.shaking_moment[k]) / reach, "frame", True)
