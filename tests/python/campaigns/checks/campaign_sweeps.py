"""Sweeps: designs handed back are what was measured, and a number that is missing has a status."""

from __future__ import annotations

import math
import random
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import Status, metric
from campaigns.campaign_report import Findings
from models.machines.turned_machines import forces
from models.mechanisms.mechanism_data import arguments

if TYPE_CHECKING:
    from models.machines.machine_models import Case
    from models.mechanisms import dyad_models

DESIGNS = 3
SPREAD = 0.01  # of a dimension
POSITIONS = 16
REACH = 0.2
# The table covers a part of what its slide or link goes through.
COVERED = 0.5


class Swept(Findings):
    """One mechanism in another assembly, over one of its dimensions."""

    def __init__(self, case: dyad_models.Case) -> None:
        super().__init__()
        self.rng = random.Random(f"sweep {case.seed}")
        self.m = assur.Mechanism(**arguments(case.description))
        self.guarded(self.handed_back)

    def handed_back(self) -> None:
        """Each design reproduces its metrics, by itself."""
        m, rng = self.m, self.rng
        q0 = np.atleast_1d(m.q0)
        try:
            found = list(m.assemblies(m.q0))
        except assur.StructureError as error:
            if "more assemblies than can be found" not in str(error):
                raise
            found = []
            self.report.counts["sweeps of the drawing's assembly alone"] += 1
        assembly = rng.choice(found) if found else None
        t = np.linspace(-1.0, 1.0, POSITIONS)[:, np.newaxis] * REACH
        q = q0 + t if q0.size > 1 else (q0 + t)[:, 0]
        name = rng.choice(list(m.dimensions))
        values = m.dimensions[name] * (1.0 + SPREAD * np.linspace(-1.0, 1.0, DESIGNS))
        joint = rng.choice(list(m.joints))
        asked = {
            "greatest": metric.max(f"{joint}.x"),
            "mean": metric.mean(f"{joint}.y"),
        }
        space: dict[str, Any] = {name: values}
        self.report.counts["sweeps"] += 1
        measured = assur.sweep(m, space, q, metrics=asked, assembly=assembly)
        self.missing(measured)
        again = assur.sweep(measured.designs(list(range(DESIGNS))), {}, q, metrics=asked)
        for one in asked:
            have, want = np.asarray(again[one]), np.asarray(measured[one])
            size = np.abs(np.nan_to_num(want)).max(initial=1.0)
            apart = np.abs(np.nan_to_num(have - want))
            if (np.isnan(have) != np.isnan(want)).any() or not apart.max() <= 1e-9 * size:
                text = f"{one} of {joint} over {name}: {have.tolist()}, swept {want.tolist()}"
                self.fail("sweep designs", f"{text}, assembly {assembly!r}")
                return

    def missing(self, measured: Any) -> None:
        """What has no number is not OK."""
        good = np.isin(np.asarray(measured.status), (Status.OK, Status.NEAR_SINGULAR))
        for name in measured:
            for i in np.flatnonzero(good & np.isnan(measured[name]))[:1]:
                self.fail("sweep missing", f"{name} of design {i} is NaN, its status OK")


class Covered(Swept):
    """One machine with a table that ends: over q, a slide or a link."""

    def __init__(self, case: Case) -> None:
        Findings.__init__(self)
        self.rng = rng = random.Random(f"covered {case.seed}")
        m = case.machine.mechanism
        assert m is not None
        self.m, self.d = m, case.description
        if np.size(m.q0) > 1:
            return
        q = float(m.q0) + REACH * np.linspace(-1.0, 1.0, POSITIONS)
        motion = m.solve(q, order=0, on_error="nan")
        if (np.asarray(motion.status) != Status.OK).any():
            return
        over = rng.choice([None, *m.slides, *(n for n in m.links if n != "ground")])
        if over is None:
            values = q
        else:
            kind = "slide" if over in m.slides else "link"
            values = np.asarray(getattr(motion, kind)(over).value)
        low, high = float(values.min()), float(values.max())
        if high - low < 1e-6:
            return
        rows = np.linspace(low - 1.0, low + COVERED * (high - low), 4)
        if rng.random() < 0.5:
            rows = np.linspace(high - COVERED * (high - low), high + 1.0, 4)
        table = assur.Table(rows, [0.0, 5.0, -2.0, 1.0], spline="linear", periodic=False, over=over)
        link = next(n for n in m.links if n != "ground")
        self.machine = assur.Machine(
            m, bodies=case.machine.bodies, loads=[assur.Torque(link, table)]
        )
        self.q, self.table = q, table
        self.report.counts["tables that end"] += 1
        self.guarded(self.ends)

    def ends(self) -> None:
        """In a sweep a status, in reactions NaN, in a run an end that says so."""
        name = self.rng.choice(list(self.m.dimensions))
        values = self.m.dimensions[name] * (1.0 + SPREAD * np.linspace(-1.0, 1.0, DESIGNS))
        space: dict[str, Any] = {name: values}
        asked = {"effort": metric.peak_effort(), "rms": metric.rms_effort()}
        measured = assur.sweep(self.machine, space, self.q, metrics=asked)
        self.missing(measured)
        found = self.machine.reactions(self.q, speed=1.0, on_error="nan")
        # The torque on a link that does not turn changes forces alone, not the driver's.
        known = [f for f in forces(self.d, found, None, {}).values() if f.size]
        if not any(np.isnan(f).any() for f in known):
            self.fail("table reactions", "values everywhere, beyond the table's rows too")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", assur.AssurWarning)
            try:
                run = self.machine.run(1.0, speed0=2.0, rtol=1e-8, max_steps=300)
            except assur.AssurError as error:
                if "table" not in str(error):
                    self.fail("table run", str(error))
                return
        self.report.counts["runs over a table's end"] += run.end == "table ends"
        good = np.isfinite(run.acceleration).all() and math.isfinite(float(np.max(run.t)))
        if not good:
            self.fail("table run", f"no number in a run that ends: {run.end}")
