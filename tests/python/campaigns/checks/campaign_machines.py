"""All checks of one machine: reductions and the energy balance of a run.

Both sides of every comparison start from `Mechanism.solve`; energies, powers and generalised
forces are the ones of `machine_energy`, the work is a quadrature of its own.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import Status
from campaigns.campaign_report import Findings
from oracles.dynamics.machine_energy import Balance

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from assur.dynamics.motion.run import Run
    from models.machines.machine_models import Case

RTOL = 1e-9
BALANCE = 10.0  # times rtol of the greatest energy
# Gauss-Legendre nodes on the dense output between two steps. The work by half as many says what
# the quadrature itself is good for.
NODES, FEWER = 12, 6
QUADRATURE = 0.1  # of what is allowed, else the interval is halved
HALVINGS = 6
PLACES = 4  # where reductions are compared
REACH = 0.4  # to either side of the drawing, rad or m
# Of the sum of absolute values, besides 64 u κ² of analogues and 8 u κ of positions.
MOMENT = 1e-10
POTENTIAL = 1e-12
U = 2.220446049250313e-16
MAX_STEPS = 1000  # tried
COMPARED = 300  # steps of a run, the first ones
# The derivative of the energy by the coordinate, at so many places of each step.
SLOPE_STEP = 1e-7
LOOKS = 1000  # between two steps, for positions that are lost
SLOPES = 8


class Checked(Findings):
    """All checks of one machine."""

    def __init__(self, case: Case) -> None:
        super().__init__()
        self.case, self.machine = case, case.machine
        self.rng = np.random.default_rng(case.seed)
        mechanism = case.machine.mechanism
        assert mechanism is not None
        self.mechanism, self.drivers = mechanism, int(np.size(mechanism.q0))
        counts = self.report.counts
        counts["machines"] += 1
        counts["of class II"] += mechanism.structure.cls == 2
        counts["two drivers"] += self.drivers > 1
        counts["with motors"] += case.machine.motor is not None
        for load in case.machine.loads:
            counts[type(load).__name__] += 1
        self.guarded(self.reductions)
        self.guarded(self.run)

    # -- reductions ---------------------------------------------------------------------------

    def reductions(self) -> None:
        """Inertia, moments and potential at random positions and speeds."""
        machine, n = self.machine, self.drivers
        q = np.asarray(self.mechanism.q0) + self.rng.uniform(-REACH, REACH, (PLACES, n))
        speed = self.rng.uniform(-3.0, 3.0, (PLACES, n))
        own = Balance(machine, np.zeros(PLACES), q, speed)
        inertia = machine.reduced_inertia(self.plain(q), on_error="nan").value.reshape(PLACES, n, n)
        moment = machine.reduced_moment(self.plain(q), self.plain(speed), on_error="nan")
        potential = machine.potential(self.plain(q), on_error="nan")
        good = np.asarray(own.motion.status == Status.OK)
        self.report.counts["reductions"] += int(good.sum())
        condition = np.where(good, own.motion.condition, 1.0)
        with np.errstate(invalid="ignore"):
            forces = np.concatenate([own.conservative(), own.applied()])
            wanted, size = forces.sum(axis=0), np.abs(forces).sum(axis=(0, 2))
            allowed = (MOMENT + 64 * U * condition**2) * size
            # Where nothing moves under the loads their sums are the rounding of rates.
            allowed = np.maximum(allowed, 8 * U * condition * own.strength())
            apart = np.abs(moment.reshape(PLACES, n) - wanted).max(axis=1)
            self.compare("moment", apart, allowed, good, q)
            twice = 2.0 * own.kinetic()
            apart = np.abs(np.einsum("ij,ijk,ik->i", speed, inertia, speed) - twice)
            size = np.einsum("ij,ijk,ik->i", np.abs(speed), np.abs(inertia), np.abs(speed))
            self.compare("inertia", apart, (MOMENT + 64 * U * condition**2) * size, good, q)
            parts = own.potentials()
            apart, size = np.abs(potential - parts.sum(axis=0)), np.abs(parts).sum(axis=0)
            self.compare("potential", apart, (POTENTIAL + 8 * U * condition) * size, good, q)

    def plain(self, rows: NDArray[np.float64]) -> NDArray[np.float64]:
        """As the machine takes them."""
        return rows if self.drivers > 1 else rows[:, 0]

    def compare(self, kind: str, apart: Any, allowed: Any, good: Any, q: Any) -> None:
        part = np.where(good, apart / np.maximum(allowed, 1e-300), 0.0)
        self.report.note(kind, float(np.max(np.nan_to_num(part, nan=np.inf))))
        for k in np.flatnonzero(~(part <= 1.0))[:1]:
            self.fail(kind, f"q = {q[k]!r}: off by {apart[k]:.3g}, allowed {allowed[k]:.3g}")

    # -- a run --------------------------------------------------------------------------------

    def run(self) -> None:
        """Energy is conserved along the path, as far as positions are not near singular ones."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            run = self.machine.run(
                self.case.t_end, None, self.case.speed0, rtol=RTOL, max_steps=MAX_STEPS
            )
        for one in caught:
            if not issubclass(one.category, assur.AssurWarning):
                self.fail("warned", str(one.message))
        counts = self.report.counts
        counts[f"end {run.end}"] += 1
        counts["warned of energy"] += bool(caught)
        status = self.mechanism.solve(run.q, order=0, outputs=[], on_error="nan").status
        last = int(np.argmax(status != Status.OK) if (status != Status.OK).any() else len(status))
        last = min(last - 1, COMPARED)
        counts["cut"] += last < len(run.t) - 1
        counts["steps"] += len(run.t) - 1
        counts["compared"] += max(last, 0)
        if last < 1:
            counts["nothing compared"] += 1
            return
        own = Balance(self.machine, run.t[: last + 1], run.q[: last + 1], run.speed[: last + 1])
        kinetic, potentials = own.kinetic(), own.potentials()
        work, absolute = self.work(run, last, float(kinetic.max()))
        if np.isnan(work).any() and self.lost(run, int(np.isnan(work).argmax())):
            last = int(np.isnan(work).argmax()) - 1
            counts["cut"] += 1
            kinetic, work, absolute = (one[: last + 1] for one in (kinetic, work, absolute))
            potentials = potentials[:, : last + 1]
        stored = potentials - potentials[:, :1]
        imbalance = np.abs(kinetic - kinetic[0] + stored.sum(axis=0) - work)
        parts = kinetic, np.abs(stored).sum(axis=0), absolute
        size = max(float(part.max()) for part in parts)
        # Positions, and so potentials, are rounded to 8 u κ.
        heights = np.abs(potentials).sum(axis=0) * own.motion.condition[: last + 1]
        rounded = 8 * U * float(heights.max())
        strict = float(imbalance.max()) / (BALANCE * RTOL * size + rounded)
        counts["within the greatest energy"] += strict <= 1.0
        known = np.full(last + 1, size) if strict <= 1.0 else self.slopes(run, last)
        part = imbalance / (BALANCE * RTOL * np.maximum(known, size) + rounded)
        self.report.note("balance", float(part.max()))
        if not part.max() <= 1.0:
            k = int(np.argmax(part))
            text = f"{imbalance[k]:.3g} J of {size:.3g} J at t = {float(run.t[k])!r}"
            self.fail("balance", f"{text}, {part[k]:.3g} of what is allowed ({run.end})")

    def lost(self, run: Run, step: int) -> bool:
        """Whether `solve` loses the run there: with two drivers it takes a straight path."""
        t = np.linspace(run.t[step - 1], run.t[step], LOOKS)
        status = self.mechanism.solve(run.at(t).q, order=0, outputs=[], on_error="nan").status
        return self.drivers > 1 and bool((status == Status.LOST).any())

    def slopes(self, run: Run, last: int) -> NDArray[np.float64]:
        """Greatest derivative of the energy by the coordinate so far, J/rad, at every step.

        Of a driven slide by the mechanism's size.
        """
        ends = run.t[: last + 1]
        parts = np.arange(SLOPES) / SLOPES
        t = np.append((ends[:-1, np.newaxis] + np.outer(np.diff(ends), parts)).ravel(), ends[-1])
        state = run.at(t)
        q, speed = (np.reshape(one, (len(t), -1)) for one in (state.q, state.speed))
        total = np.zeros(len(t))
        for k, unit in enumerate(self.units()):
            step = SLOPE_STEP * unit * (np.arange(self.drivers) == k)
            energies = []
            for sign in (-1.0, 1.0):
                beside = Balance(self.machine, t, q + sign * step, speed)
                energies.append(beside.kinetic() + beside.potentials().sum(axis=0))
            total += np.abs(energies[1] - energies[0]) / (2.0 * SLOPE_STEP)
        greatest = np.maximum.accumulate(np.nan_to_num(total))
        return np.asarray(greatest[::SLOPES])

    def units(self) -> list[float]:
        """A radian, or of a driven slide the extent of the drawing."""
        places = np.array(list(self.mechanism.joints.values()))
        size = float(np.ptp(places, axis=0).max())
        drivers = self.mechanism.driver
        many = drivers if isinstance(drivers, tuple) else (drivers,)
        slides = self.mechanism.slides
        return [size if isinstance(one, str) and one in slides else 1.0 for one in many]

    def work(self, run: Run, last: int, size: float) -> tuple[Any, Any]:
        """Work since the beginning at every step, and that of absolute powers."""
        ends = run.t[: last + 1]
        starts, widths = ends[:-1].copy(), np.diff(ends)
        owner = np.arange(last)
        total, absolute = np.zeros(last), np.zeros(last)
        for halving in range(HALVINGS + 1):
            fine, both = self.quadrature(run, starts, widths, NODES)
            rough, _ = self.quadrature(run, starts, widths, FEWER)
            share = QUADRATURE * BALANCE * RTOL * max(size, float(absolute.sum() + both.sum()))
            good = np.abs(fine - rough) <= share * widths / widths.sum()
            good |= halving == HALVINGS
            np.add.at(total, owner[good], fine[good])
            np.add.at(absolute, owner[good], both[good])
            starts, widths, owner = starts[~good], 0.5 * widths[~good], owner[~good]
            if not len(starts):
                break
            self.report.counts["quadratures halved"] += len(starts)
            starts = np.concatenate([starts, starts + widths])
            widths, owner = np.tile(widths, 2), np.tile(owner, 2)
        return np.append(0.0, np.cumsum(total)), np.append(0.0, np.cumsum(absolute))

    def quadrature(
        self, run: Run, starts: Any, widths: Any, nodes: int
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Integrals of the power and of its absolute parts over intervals."""
        x, weight = np.polynomial.legendre.leggauss(nodes)
        t = (starts[:, np.newaxis] + 0.5 * widths[:, np.newaxis] * (x + 1.0)).ravel()
        state = run.at(t)
        powers = Balance(self.machine, t, state.q, state.speed).powers()
        signed = powers.sum(axis=0).reshape(-1, nodes) @ weight
        parts = np.abs(powers).sum(axis=0).reshape(-1, nodes) @ weight
        return 0.5 * widths * signed, 0.5 * widths * parts
