"""Machines described otherwise: reactions, efforts and runs are the same.

Pairs that do not move relative to each other have friction too: of their rates only rounding is
left, which is another in another frame.
"""

from __future__ import annotations

import math
import random
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import Status
from campaigns.campaign_report import Findings
from models.machines.machine_units import with_friction
from models.machines.turned_machines import forces, ordered, turned
from models.mechanisms.frames import Frame
from models.mechanisms.variants import Variant, framed, renamed, shuffled

if TYPE_CHECKING:
    from models.machines.machine_models import Case

POSITIONS = 12
REACH = 0.5
# Forces agree to this part of the largest, times the condition squared: analogues are good to that.
CLOSE = 1e-12
CONDITION = 1e4
RTOL = 1e-9
RUN = 1e-6  # of q at the end of a run, times its condition; both are good to rtol, and grow apart
T_END = 0.1
MAX_STEPS = 300
# Beside a position locked by friction each evaluation may take 40 ms.
MAX_SECONDS = 1.0


class Turned(Findings):
    """One machine, with friction more often than not, and another description of it."""

    def __init__(self, case: Case) -> None:
        super().__init__()
        self.rng = rng = random.Random(f"turned {case.seed}")
        self.case, self.d = case, case.description
        v = shuffled(Variant.same(self.d), rng, within=False)
        v = renamed(v, rng) if rng.random() < 0.5 else v
        shift = rng.uniform(-2, 2), rng.uniform(-2, 2)
        self.v = framed(v, Frame(rng.uniform(-math.pi, math.pi), shift))
        self.one = ordered(self.d, case.machine)
        if rng.random() < 0.7:
            self.one = with_friction(self.d, self.one, rng)
        counts = self.report.counts
        counts["turned"] += 1
        counts["turned with friction"] += bool(self.one.friction)
        self.two = turned(self.d, self.one, self.v)
        self.shift = self.q0(self.two) - self.q0(self.one)
        self.guarded(self.reactions)
        self.guarded(self.run)

    def q0(self, machine: assur.Machine) -> Any:
        assert machine.mechanism is not None
        return np.atleast_1d(machine.mechanism.q0)

    def plain(self, q: Any) -> Any:
        return q if q.shape[-1] > 1 else q[..., 0]

    def reactions(self) -> None:
        """All forces, where neither is near a dead point."""
        machine, rng = self.one, self.rng
        start = self.q0(machine)
        q = start + np.array(
            [[rng.uniform(-REACH, REACH) for _ in start] for _ in range(POSITIONS)]
        )
        speed = np.broadcast_to(np.atleast_1d(self.case.speed0), q.shape)
        zero = np.zeros_like(q)
        assert machine.mechanism is not None
        motion = machine.mechanism.solve(self.plain(q), order=1, on_error="nan")
        good = (np.asarray(motion.status) == Status.OK) & (np.asarray(motion.condition) < CONDITION)
        condition = np.asarray(motion.condition)
        try:
            a = machine.reactions(*map(self.plain, (q, speed, zero)), on_error="nan")
        except assur.InputError:  # friction on redundant links
            return
        b = self.two.reactions(*map(self.plain, (q + self.shift, speed, zero)), on_error="nan")
        own, other = (
            forces(self.d, found, v, machine.friction) for found, v in ((a, None), (b, self.v))
        )
        flat = {n: np.reshape(f, (POSITIONS, -1)) for n, f in own.items() if f.size}
        size = np.max([np.abs(np.nan_to_num(f)).max(axis=1) for f in flat.values()], axis=0)
        locked = [
            np.isnan(np.asarray(f["driver"]).reshape(POSITIONS, -1)).any(1) for f in (own, other)
        ]
        self.report.counts["positions turned"] += int(good.sum())
        self.report.counts["locked in one frame"] += int((good & (locked[0] != locked[1])).sum())
        good &= ~locked[0] & ~locked[1]
        allowed = CLOSE * condition**2 * size
        for name, have in own.items():
            apart = np.abs(np.reshape(other[name] - have, (POSITIONS, -1))).max(axis=1, initial=0.0)
            for i in np.flatnonzero(good & ~(apart <= allowed))[:1]:
                text = f"{name} at q = {q[i]!r}: off by {apart[i]:.3g}, largest {size[i]:.3g}"
                self.fail("turned reactions", f"{text}, κ {condition[i]:.3g}")
                return

    def run(self) -> None:
        """The same motion."""
        ends = []
        for machine, shift in ((self.one, 0.0), (self.two, self.shift)):
            q0 = self.q0(self.one) + shift
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", assur.AssurWarning)
                try:
                    run = machine.run(
                        T_END,
                        self.plain(q0),
                        self.case.speed0,
                        rtol=RTOL,
                        max_steps=MAX_STEPS,
                        max_seconds=MAX_SECONDS,
                    )
                except assur.AssurError:  # redundant links with friction; or friction locks it
                    return
            ends.append((run, np.atleast_1d(run.q[-1]) - shift))
        (a, here), (b, there) = ends
        if a.end == b.end == "reached":
            self.report.counts["runs turned"] += 1
            if not np.abs(here - there).max() <= RUN * max(1.0, float(np.abs(here).max())):
                self.fail("turned run", f"q at the end is {there!r}, was {here!r}")
        elif a.end != b.end and not {"step limit", "time limit"} & {a.end, b.end}:
            self.fail("turned run", f"{b.end} at t = {b.t[-1]!r}, was {a.end} at {a.t[-1]!r}")
