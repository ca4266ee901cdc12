"""Where the system refuses memory a call raises `MemoryError`, and the process goes on."""

from __future__ import annotations

import subprocess
import sys

import pytest

resource = pytest.importorskip("resource", reason="limits of memory are set by POSIX")

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="the size of a process is read from /proc"
)

# Each call within so many MiB more than the process has: some are enough, some are not.
CALLS = """
import os
import resource
import sys
import traceback
from pathlib import Path

import numpy as np

import assur
from assur import metric

N = 200_000
many = np.linspace(0.0, 6.0, N)
few = np.linspace(0.0, 6.0, 5)
four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.0)
designs = four_bar.with_dimensions({"coupler.length": np.linspace(2.9, 3.1, N)})
crank = assur.SliderCrank(0.1, 0.35)
bodies = {"piston": assur.Body(mass=1.0), "crank": assur.Body(inertia=0.01)}
loads = [assur.Force("B", (-100.0, 0.0), on="piston")]
smooth = assur.Machine(crank, bodies=bodies, loads=loads)
pin = {"A": assur.JointFriction(0.1, 0.01)}
rough = assur.Machine(crank, bodies=bodies, loads=loads, friction=pin)
angles = np.linspace(0.0, 2.0 * np.pi, N)
turn = four_bar.solve(np.linspace(0.0, 6.0, 5 * N), order=1)
calls = {
    "assemblies": lambda: four_bar.assemblies(many),
    "assemblies of designs": lambda: designs.assemblies(1.0),
    "conditions": lambda: four_bar.solve(many).condition,
    "effort": lambda: rough.effort(many, speed=1.0),
    "flywheel": lambda: assur.flywheel.from_table(
        angles, np.sin(angles), fluctuation=0.1, mean_speed=20.0
    ),
    "instant centres": lambda: turn.instant_centre("coupler"),
    "limits": lambda: designs.limits(),
    "reactions": lambda: rough.reactions(many, speed=1.0),
    "run": lambda: smooth.run(t_end=1e9, q0=1.0, speed0=10.0),
    "runs": lambda: smooth.run(t_end=20.0, q0=angles[:2000], speed0=10.0),
    "self-locking": lambda: rough.self_locking(n=N),
    "solve": lambda: four_bar.solve(many),
    "stroke": lambda: assur.slider_crank.stroke(many, 1.0, 3.0),
    "transmission angles": lambda: turn.transmission_angle("C"),
    "sweep": lambda: assur.sweep(
        four_bar,
        {"coupler.length": np.linspace(2.9, 3.1, 10 * N)},
        few,
        metrics={"stroke": metric.span("C.x")},
        where=[metric.span("C.x") > 100.0],
    ),
}
_, hard = resource.getrlimit(resource.RLIMIT_AS)
four_bar.solve(few)

def outcome_of(call, extra):
    size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (size + (extra << 20), hard))
    try:
        call()
    except MemoryError:
        return "MemoryError"
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
    return "done"


for name, call in calls.items():
    # Each in a process of its own: memory that one call gives back would serve the next.
    child = os.fork()
    if child == 0:
        try:
            for extra in (44, 100):
                outcome = outcome_of(call, extra)
                four_bar.solve(1.0)
                print(name, extra, outcome, sep=", ", flush=True)
        except BaseException:
            traceback.print_exc()
            os._exit(1)
        os._exit(0)
    _, status = os.waitpid(child, 0)
    if status:
        sys.exit(f"{name} ended its process: {os.waitstatus_to_exitcode(status)}")
"""


def test_a_call_that_finds_no_memory_ends_in_order() -> None:
    command = [sys.executable, "-W", "ignore::DeprecationWarning", "-c", CALLS]
    found = subprocess.run(command, capture_output=True, text=True, check=False)
    assert found.returncode == 0, (found.returncode, found.stdout, found.stderr[-2000:])
    assert not found.stderr
    rows = [line.split(", ") for line in found.stdout.splitlines()]
    assert {row[2] for row in rows} <= {"done", "MemoryError"}
    refused = {row[0] for row in rows if row[2] == "MemoryError"}
    assert len(refused) >= 8, rows
