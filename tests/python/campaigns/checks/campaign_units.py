"""Machines in other units of time and length, with friction, tables that end, saved and loaded.

In units of powers of two nothing may change but exponents: the same steps, the same bits. In other
units the same run to rtol, in about as many steps.
"""

from __future__ import annotations

import math
import random
import tempfile
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from campaigns.campaign_report import Findings
from campaigns.checks.everything_asked import asked
from models.machines.machine_units import Units, in_units, with_friction

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from assur.dynamics.forces.reactions import Reactions
    from models.machines.machine_models import Case

RTOL = 1e-8
MAX_STEPS = 300
# Beside a position locked by friction each evaluation may take 40 ms.
MAX_SECONDS = 1.0
RUBBING = 3  # one machine in so many has friction
# In other units than powers of two: results to rtol times this (rounding is multiplied by a run
# as its tolerance is), and steps.
CLOSE = 1e3
STEPS = 0.05
POSITIONS = 6
REACH = 0.3
# Even powers of two: the mass matrix of two drivers has a square root.
POWERS = (-10, 10)
FACTORS = (1e-4, 1e4)
# Reactions are solved with pivots, which depend on units: to this part of the largest, times κ².
FORCE = 1e-12
CONDITION = 1e4
# Effort that is missing at a row of a run, as a part of what it is a difference of, and the
# greatest condition κ at which that is asked: its rounding is 64 u κ²; and beside dead points the
# law of friction may have several solutions: the acceleration may be of one, the effort of another.
BALANCE = 1e-5
BALANCED_TO = 1e3
RUBBING_TO = 50.0
# A part of an acceleration, by which it is changed to see how the effort changes.
SHIFT = 1e-6
# Beyond this condition errors of steps are rounding, of several drivers u κ³: their number is luck.
STEPS_TO = 1e3
# Units that differ from the first ones by far less than the tolerance: what they change of the
# number of steps is luck.
NEARLY = tuple(1.0 + k * 2.0**-44 for k in range(-15, 16, 2))


class InUnits(Findings):
    """One machine, the same in other units, and the same from its file."""

    def __init__(self, case: Case) -> None:
        super().__init__()
        self.rng = random.Random(f"units {case.seed}")
        self.case, self.d, self.machine = case, case.description, case.machine
        self.drivers = len(self.d.drivers)
        counts = self.report.counts
        if self.rng.randrange(RUBBING) == 0:
            self.machine = with_friction(self.d, self.machine, self.rng)
            counts["with friction"] += bool(self.machine.friction)
        counts["in other units"] += 1
        self.two = Units(*(4.0 ** self.rng.randint(*POWERS) for _ in range(3)))
        self.other = Units(*(float(np.exp(self.rng.uniform(*np.log(FACTORS)))) for _ in range(3)))
        self.q = self.positions()
        self.guarded(self.reactions)
        self.guarded(self.runs)
        self.guarded(self.everything)
        self.guarded(self.files)

    def positions(self) -> Any:
        start = np.atleast_1d(self.mechanism.q0)
        q = start + np.array(
            [[self.rng.uniform(-REACH, REACH) for _ in start] for _ in range(POSITIONS)]
        )
        return q if self.drivers > 1 else q[:, 0]

    @property
    def mechanism(self) -> assur.Mechanism:
        assert self.machine.mechanism is not None
        return self.machine.mechanism

    def coordinate(self, u: Units) -> Any:
        unit = u.coordinate(self.d)
        return unit if self.drivers > 1 else unit[0]

    # -- at positions -------------------------------------------------------------------------

    def asked(self, machine: assur.Machine, u: Units) -> Reactions:
        per = self.coordinate(u)
        speed, acceleration = np.asarray(self.case.speed0), np.full(self.drivers, 2.0)
        acceleration = acceleration if self.drivers > 1 else acceleration[0]
        return machine.reactions(
            self.q * per,
            np.broadcast_to(speed * (per / u.time), self.q.shape),
            np.broadcast_to(acceleration * (per / u.time**2), self.q.shape),
            on_error="nan",
        )

    def forces(self, found: Any, u: Units) -> Iterator[tuple[str, Any]]:
        """All forces by name, in the first units."""
        per = self.coordinate(u)
        yield "driver", np.asarray(found.driver) / (u.torque / per)
        for name in self.d.joints:
            for link, own in self.d.links.items():
                if name in own and sum(name in other for other in self.d.links.values()) > 1:
                    yield f"joint {name} on {link}", found.joint(name, on=link) / u.force
                    if name in self.machine.friction:
                        moment = found.joint_moment(name, on=link)
                        yield f"moment {name} on {link}", np.asarray(moment) / u.torque
        for name in self.d.slides:
            guide = found.slide(name)
            yield f"normal {name}", np.asarray(guide.normal) / u.force
            yield f"friction {name}", np.asarray(guide.friction) / u.force
            yield f"moment of {name}", np.asarray(guide.moment) / u.torque

    def reactions(self) -> None:
        """The same forces but for rounding."""
        try:
            own = dict(self.forces(self.asked(self.machine, Units()), Units()))
        except assur.InputError:  # friction on redundant links
            self.report.counts["reactions refused"] += 1
            return
        other = in_units(self.d, self.machine, self.two)
        motion = self.mechanism.solve(self.q, order=0, on_error="nan")
        condition = np.asarray(motion.condition)
        rows = {name: np.reshape(f, (POSITIONS, -1)) for name, f in own.items()}
        size = np.max([np.abs(np.nan_to_num(f)).max(axis=1) for f in rows.values()], axis=0)
        allowed = FORCE * condition**2 * size
        for name, have in self.forces(self.asked(other, self.two), self.two):
            self.report.counts["forces in other units"] += 1
            self.report.counts["of these the same bits"] += np.array_equal(have, own[name], True)
            apart = np.abs(np.reshape(have, (POSITIONS, -1)) - rows[name]).max(axis=1)
            for i in np.flatnonzero((condition < CONDITION) & (apart > allowed))[:1]:
                text = f"{name} at q = {self.q[i]!r}: off by {apart[i]:.3g} of {size[i]:.3g}"
                self.fail("units reactions", f"{text}, {self.two}")

    # -- runs ---------------------------------------------------------------------------------

    def run_of(self, machine: assur.Machine, u: Units) -> assur.Run:
        per = self.coordinate(u)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", assur.AssurWarning)
            run: assur.Run = machine.run(
                self.case.t_end * u.time,
                None,
                np.asarray(self.case.speed0) * (per / u.time),
                rtol=RTOL,
                max_steps=MAX_STEPS,
                max_seconds=MAX_SECONDS,
            )
        return run

    def runs(self) -> None:
        """The same steps and bits in units of powers of two; about as many steps in others."""
        try:
            own = self.run_of(self.machine, Units())
        except assur.AssurError as error:
            self.report.counts[f"run refused: {str(error)[:30]}"] += 1
            return
        self.report.counts["runs in other units"] += 1
        self.balanced(own)
        two = self.run_of(in_units(self.d, self.machine, self.two), self.two)
        per = self.coordinate(self.two)
        texts = []
        if "time limit" in (own.end, two.end):
            self.report.counts["runs that took too long"] += 1
            return
        if (own.end, len(own.t)) != (two.end, len(two.t)):
            texts = [f"{two.end} in {len(two.t)} steps, was {own.end} in {len(own.t)}"]
        elif not (
            np.array_equal(own.t, two.t / self.two.time)
            and np.array_equal(own.q, two.q / per)
            and np.array_equal(own.speed, two.speed * (self.two.time / per))
            and np.array_equal(own.acceleration, two.acceleration * (self.two.time**2 / per))
        ):
            k = int(np.argmax(np.asarray(own.q != two.q / per).reshape(len(own.t), -1).any(1)))
            texts = [f"other bits from step {k} of {len(own.t)} on"]
        self.fail("units run", *(f"{text}, in {self.two}" for text in texts))
        self.similar(own)

    def balanced(self, own: assur.Run) -> None:
        """At the accelerations of a run no effort of the driver is missing."""
        machine = self.machine
        if self.drivers > 1 or machine.motor is not None or own.end == "time limit":
            return
        try:
            driver = machine.reactions(own, on_error="nan").driver
        except assur.InputError:  # friction on redundant links
            return
        # At rest friction needs a sense.
        moves = np.flatnonzero(own.speed)
        q, apart = own.q[moves], np.abs(driver[moves])
        own_part = np.abs(
            machine.reduced_inertia(q, on_error="nan").value * own.acceleration[moves]
        )
        size = own_part + np.abs(machine.reduced_moment(q, own.speed[moves], on_error="nan"))
        condition = self.mechanism.solve(q, order=0, on_error="nan").condition
        self.report.counts["rows of runs in balance"] += len(q)
        most = RUBBING_TO if machine.friction else BALANCED_TO
        for i in np.flatnonzero((condition < most) & (apart > BALANCE * size))[:1]:
            if not self.has_balance(own, int(moves[i]), BALANCE * size[i]):
                self.report.counts["rows with several solutions of friction"] += 1
                continue
            text = f"{apart[i]:.3g} of {size[i]:.3g} is missing at q = {q[i]!r}"
            self.fail("effort of a run", f"{text}, speed {own.speed[moves[i]]!r}, row {moves[i]}")

    def has_balance(self, own: assur.Run, row: int, near: float) -> bool:
        """Whether effort 0 is at another acceleration; elsewhere effort is linear in it."""
        q, speed, a = own.q[row], own.speed[row], own.acceleration[row]
        effort = [self.effort(q, speed, a), self.effort(q, speed, a + SHIFT * abs(a))]
        slope = (effort[1] - effort[0]) / (SHIFT * abs(a))
        return abs(self.effort(q, speed, a - effort[0] / slope)) <= near

    def effort(self, q: float, speed: float, acceleration: float) -> float:
        if not np.isfinite(acceleration):
            return math.nan
        return float(self.machine.reactions(q, speed, acceleration, on_error="nan").driver)

    def steps(self, run: assur.Run, per: Any) -> int:
        """How many steps a run takes until rounding decides their widths."""
        condition = self.mechanism.solve(run.q / per, order=0, on_error="nan").condition
        beyond = np.flatnonzero(~(condition < STEPS_TO))
        return int(beyond[0]) if len(beyond) else len(run.t)

    def by_rounding(self) -> int:
        """How far apart the numbers of steps are in units that hardly differ, these among them."""
        units = [
            Units(*(self.rng.choice(NEARLY) for _ in range(3))) for _ in range(2 * len(NEARLY))
        ]
        runs = ((self.run_of(in_units(self.d, self.machine, u), u), u) for u in (Units(), *units))
        return int(np.ptp([self.steps(run, self.coordinate(u)) for run, u in runs]))

    def similar(self, own: assur.Run) -> None:
        other = self.run_of(in_units(self.d, self.machine, self.other), self.other)
        per, u = self.coordinate(self.other), self.other
        steps = self.steps(own, 1.0), self.steps(other, per)
        if own.end == other.end == "step limit" or other.end == "time limit":
            return
        # Where a smooth interval ends it may take one step more, by rounding.
        apart = abs(steps[1] - steps[0])
        if apart > max(3.0, STEPS * steps[0], own.statistics.restarts):
            if apart > self.by_rounding():
                text = f"{steps[1]} ({other.end}), was {steps[0]} ({own.end}), in {u}"
                self.fail("units steps", text)
                return
            self.report.counts["numbers of steps as different in nearly the same units"] += 1
        if own.end != "reached" or other.end != "reached":
            return
        off = float(np.abs(own.q[-1] - other.q[-1] / per).max())
        if not off <= CLOSE * RTOL * max(1.0, float(np.abs(own.q).max())):
            self.fail("units end", f"q off by {off:.3g} at the end, in {u}")

    # -- all that results have, and files -----------------------------------------------------

    def everything(self) -> None:
        """No property and no method fails; a run's own reactions are given."""
        machine, q = self.machine, self.q
        calls: dict[str, Callable[[], Any]] = {
            "reactions": lambda: self.asked(machine, Units()),
            "motion": lambda: self.mechanism.solve(q, order=3, on_error="nan"),
            "run": lambda: self.run_of(machine, Units()),
            "reactions of the run": lambda: machine.reactions(
                self.run_of(machine, Units()), on_error="nan"
            ),
            "reactions from rest": lambda: machine.reactions(
                machine.run(0.05, rtol=1e-6, max_steps=200, max_seconds=MAX_SECONDS), on_error="nan"
            ),
            "machine": lambda: machine,
            "mechanism": lambda: self.mechanism,
            "structure": lambda: self.mechanism.structure,
        }
        if self.drivers == 1:
            calls["flywheel"] = lambda: machine.flywheel(0.05, mean_speed=10.0)
        for what, call in calls.items():
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore", assur.AssurWarning)
                    result = call()
            except assur.AssurError as error:
                self.report.counts[f"{what} refused"] += 1
                if "fault of assur" in str(error) or "friction needs sense" in str(error):
                    self.fail(f"asked {what}", str(error))
                continue
            self.report.counts["results asked for all"] += 1
            self.fail(f"asked {what}", *asked(result))

    def files(self) -> None:
        """From its file a machine is the same, to the bit."""
        machine = self.machine
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "machine.toml"
            try:
                machine.save(path)
            except assur.InputError as error:
                if "function" not in str(error):
                    self.fail("file refused", str(error))
                return
            again = assur.files.read(path).machine
        assert again is not None
        self.report.counts["loaded"] += 1
        if again.mechanism != machine.mechanism:
            self.fail("file mechanism", "is not equal")
        if again != machine:
            self.fail("file machine", f"is not equal: {machine!r}")
        speed = np.ones_like(self.q)
        one, two = (m.reduced_moment(self.q, speed, on_error="nan") for m in (machine, again))
        if not np.array_equal(one, two, equal_nan=True):
            self.fail("file moment", "other bits")
