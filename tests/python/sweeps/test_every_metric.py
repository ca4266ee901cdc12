"""What holds of every metric of `assur.metric`; a new one is named here by a failing test."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assur
from assur import metric
from assur.sweeps import machine_metrics

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "conventions.md"
FUNCTIONS = {name for name in metric.__all__ if name.islower()} - {"function"}
OF_MACHINES = set(machine_metrics.__all__)
OF_MOTIONS = FUNCTIONS - OF_MACHINES

# At least 32 positions: eight of them are tried first.
Q = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
ORDERS: list[dict[str, Any]] = [
    *({"of": of} for of in ("P.x", "B.x", "rod", "bore")),
    *({"of": of, "order": order} for of in ("P.y", "rod", "bore") for order in (1, 2, 3)),
]
TARGET = [(1.0, 0.2), (1.4, 0.9), (0.6, 0.8), (1.0, 0.2)]
# Arguments for an engine: the pin B goes to and fro on a straight line.
ARGUMENTS: dict[str, list[dict[str, Any]]] = {
    "span": ORDERS,
    "min": ORDERS,
    "max": ORDERS,
    "mean": ORDERS,
    "rms": ORDERS,
    "argmin": ORDERS,
    "argmax": ORDERS,
    "time_ratio": [{"of": "P.x"}, {"of": "bore"}],
    "min_transmission_angle": [{"at": "B"}, {"at": "bore"}, {"at": "A", "between": ("O", "B")}],
    "deviation": [
        {"of": of, "shape": shape, "relative": relative}
        for of in ("P", "B")
        for shape in ("line", "circle")
        for relative in (False, True)
    ],
    "path_error": [
        {"of": of, "points": TARGET, "kind": kind}
        for of in ("P", "B")
        for kind in ("points", "chamfer", "ordered")
    ],
    "function_error": [
        {"of": of, "theta": Q[::9], "value": 0.2 * np.sin(Q[::9]), "offset": offset}
        for of in ("P.x", "rod", "bore")
        for offset in ("fixed", "free")
    ],
    "pose_error": [{"link": "rod", "poses": [(0.3, 0.4, -0.2), (-0.1, 0.5, 0.1)]}],
    "reachable": [{}],
    "full_rotation": [{}],
}


def parameters(name: str) -> set[str]:
    return set(inspect.signature(getattr(metric, name)).parameters)


def engines(count: int) -> assur.Mechanism:
    rng = np.random.default_rng(6)
    one = assur.Mechanism(
        joints={"O": (0, 0), "A": (0.3, 0.4), "B": (2.0, 0.0), "P": (1.0, 0.8)},
        links={"ground": "O", "crank": "OA", "rod": "ABP", "piston": "B"},
        slides={"bore": assur.Slide("piston", on="ground", angle=0.0, origin="O")},
        driver="crank",
    )
    return one.with_dimensions(
        {
            "crank.length": rng.uniform(0.3, 0.7, count),
            "rod.length": rng.uniform(1.5, 3.0, count),
            "bore.angle": rng.uniform(-3.0, 3.0, count),
        }
    )


def test_each_is_in_the_conventions() -> None:
    section = PAGE.read_text(encoding="utf-8").partition("\n## Sweeps\n")[2].partition("\n## ")[0]
    first_cells = " ".join(line.split("|")[1] for line in section.splitlines() if "|" in line)
    missing = sorted(name for name in FUNCTIONS if f"`{name}`" not in first_cells)
    assert not missing, f"define these in the table of {PAGE.name}, Sweeps: {missing}"


def test_each_is_here() -> None:
    assert set(ARGUMENTS) == OF_MOTIONS


@pytest.mark.parametrize("name", ARGUMENTS)
def test_it_is_written_as_it_is_called(name: str) -> None:
    for arguments in ARGUMENTS[name]:
        assert repr(getattr(metric, name)(**arguments)).startswith(f"{name}(")


@pytest.mark.parametrize("name", ARGUMENTS)
def test_a_condition_that_a_design_just_meets_keeps_it(name: str) -> None:
    """Few positions drop none that all would keep: a `Growth` holds to the last bit."""
    batch = engines(40)
    for arguments in ARGUMENTS[name]:
        asked = getattr(metric, name)(**arguments)
        values = assur.sweep(batch, {}, Q, metrics={"value": asked})["value"]
        known = np.flatnonzero(~np.isnan(values))
        for design in known:
            limit = float(values[design])
            where = [asked <= limit, asked >= limit]
            kept = assur.sweep(batch[design], {}, Q, metrics={}, where=where).kept
            assert len(kept) == 1, (arguments, design)


@pytest.mark.parametrize("name", [name for name in ARGUMENTS if "over" in parameters(name)])
def test_no_number_is_made_across_the_gaps_of_a_part(name: str) -> None:
    """Positions of `over` in any order give the same number, or are refused."""
    batch, mixed = engines(10), np.random.default_rng(2).permutation(Q)
    for arguments in ARGUMENTS[name]:
        asked = {"value": getattr(metric, name)(**arguments, over=(1.0, 3.0))}
        expected = assur.sweep(batch, {}, Q, metrics=asked)["value"]
        try:
            found = assur.sweep(batch, {}, mixed, metrics=asked)["value"]
        except assur.InputError as error:
            assert "do not follow each other" in str(error)  # noqa: PT017
        else:
            np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-13)
