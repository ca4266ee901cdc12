"""Texts of good files: written by hand, and saved."""

from __future__ import annotations

from pathlib import Path

from assur.files.write import text_of
from models.machines.file_machines import whole_machines
from models.mechanisms.named_drawings import HIGHER

EXAMPLES = Path(__file__).parents[3] / "examples"

BY_HAND = {path.stem: path.read_text(encoding="utf-8") for path in EXAMPLES.glob("*.toml")}


def saved() -> dict[str, str]:
    """Files with every section and every word."""
    made = {name: text_of(machine) for name, machine in whole_machines().items()}
    loom = next(m for m in (make() for make in HIGHER.values()) if len(m.assemblies(m.q0)) > 1)
    made["drawn"] = text_of(loom.with_assembly(loom.assemblies(loom.q0)[-1]))
    return made


WANTED = """
[solve]
q = { start = 0, stop = 6.28, count = 5, endpoint = false }
order = 3
outputs = ["C"]
on_error = "nan"

[reactions]
q = [0, 0.5]
speed = [1.0, 2]
acceleration = 0.1
t = 0
sense = 1
on_error = "nan"

[run]
t_end = 0.1
q0 = 0.3
speed0 = 1.0
t0 = 0
rtol = 1e-8
atol = [1e-9, 1e-9]
method = "RK45"
breaks = [0.05]
max_step = 0.1
max_steps = 1000
max_seconds = 60

[steady_state]
speed = 3
turns = 1
q0 = 0
mean = "period"
flywheel = 1.0
rtol = 1e-10
method = "DOP853"
breaks = []
max_steps = 1000
max_seconds = 60

[flywheel]
fluctuation = 0.1
mean_speed = 15
mean = "extremes"
on_error = "raise"
turns = 1
"""
