"""Every metric of a motion against a textbook; a new one is named here by a failing test.

They are the methods of `Motion` that return an array: curvature and the like.
"""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from models.mechanisms.textbook_four_bars import mechanism_of
from oracles.kinematics import textbook

if TYPE_CHECKING:
    from collections.abc import Callable

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "conventions.md"
# Derivatives of outputs are no metrics.
METRICS = {
    name
    for name, method in vars(assur.Motion).items()
    if inspect.isfunction(method) and method.__annotations__.get("return") == "Float"
} - {"d_transmission_angle", "jacobian", "jvp", "vjp"}

Q = 0.1 + np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
POINT = (1.3, 0.8)
COUNT = 40


def four_bars() -> tuple[assur.Mechanism, textbook.FourBars]:
    """Crank-rockers whose transmission angles are never small."""
    rng = np.random.default_rng(4)
    crank = rng.uniform(0.4, 1.0, COUNT)
    coupler, rocker = rng.uniform(2.6, 3.2, (2, COUNT))
    ground = rng.uniform(2.2, 3.0, COUNT)
    four_bars = textbook.FourBars(crank, coupler, rocker, ground, POINT)
    return mechanism_of(four_bars), four_bars


class Textbook:
    """The path of P as complex numbers, and angles, each with three derivatives by q."""

    def __init__(self, oracle: textbook.FourBars) -> None:
        motion = oracle.motion(Q)
        self.point = [x + 1j * y for x, y in zip(motion["P.x"], motion["P.y"], strict=True)]
        self.coupler, self.rocker = motion["coupler"], motion["rocker"]
        self.transmission = oracle.transmission(Q)

    def curvature(self) -> Any:
        _, d1, d2, _ = self.point
        return (np.conj(d1) * d2).imag / np.abs(d1) ** 3

    def instant_centre(self) -> Any:
        # Its velocity is zero: P' = iω (P − I).
        centre = self.point[0] + 1j * self.point[1] / self.coupler[1]
        return np.stack([centre.real, centre.imag], axis=-1)


EXPECTED: dict[str, tuple[str, Callable[[Textbook], Any]]] = {
    "curvature": ("P", Textbook.curvature),
    "instant_centre": ("coupler", Textbook.instant_centre),
    "mechanical_advantage": ("rocker", lambda book: 1.0 / book.rocker[1]),
    "transmission_angle": ("C", lambda book: book.transmission),
}


def test_each_is_here() -> None:
    assert set(EXPECTED) == METRICS


@pytest.mark.parametrize("name", EXPECTED)
def test_it_is_that_of_the_textbook(name: str) -> None:
    batch, oracle = four_bars()
    of, formula = EXPECTED[name]
    expected = formula(Textbook(oracle))
    found = getattr(batch.solve(Q), name)(of)
    assert found.shape == expected.shape
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("name", sorted(METRICS))
def test_several_drivers_are_refused_or_measured(name: str) -> None:
    m = assur.examples.five_bar()
    method = getattr(m.solve(np.tile(np.asarray(m.q0), (4, 1))), name)
    of = "P" if name == "transmission_angle" or "joint" in parameters(method) else "left_rod"
    try:
        found = method(of)
    except assur.InputError as error:
        assert f"{name} is defined for one driver" in str(error)  # noqa: PT017
    else:
        assert np.isfinite(found).all()


def parameters(method: Callable[..., Any]) -> set[str]:
    return set(inspect.signature(method).parameters)


def test_each_is_in_the_conventions() -> None:
    section = PAGE.read_text(encoding="utf-8").partition("\n## Metrics\n")[2].partition("\n## ")[0]
    first_cells = " ".join(line.split("|")[1] for line in section.splitlines() if "|" in line)
    missing = sorted(name for name in METRICS if f"`{name}(" not in first_cells)
    assert not missing, f"define these in the table of {PAGE.name}, Metrics: {missing}"
