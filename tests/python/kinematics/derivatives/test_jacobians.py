"""Jacobians by name, against differences of solved designs and the sensitivities."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur

# Step of central differences, m or rad; their limit is extrapolated (Richardson 1911), so that
# rounding decides: to this part of the greatest entry.
STEP, CLOSE = 4e-5, 1e-7


def differences(mechanism: Any, solve: Any, dimension: str) -> Any:
    """The derivative of an output by a dimension, from solved designs."""
    value = float(np.ravel(mechanism.dimensions[dimension])[0])

    def central(step: float) -> Any:
        low, high = (
            solve(mechanism.with_dimensions({dimension: value + way})) for way in (-step, step)
        )
        return (high - low) / (2.0 * step)

    return (4.0 * central(STEP / 2.0) - central(STEP)) / 3.0


CASES: dict[str, tuple[Any, Any, str, str]] = {
    "a joint": (assur.examples.crank_rocker, np.linspace(0.3, 5.9, 7), "joint", "P"),
    "an angle": (assur.examples.crank_rocker, np.linspace(0.3, 5.9, 7), "link", "rocker"),
    "a slide": (assur.examples.engine, np.linspace(0.3, 5.9, 7), "slide", "bore"),
    "class IV": (assur.examples.loom, np.linspace(0.2, 1.4, 5), "joint", "6"),
    "two drivers": (
        assur.examples.five_bar,
        np.array([1.85, 1.29]) + np.random.default_rng(1).uniform(-0.3, 0.3, (6, 2)),
        "joint",
        "P",
    ),
}


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("case", CASES)
def test_columns_are_differences_of_designs(case: str, order: int) -> None:
    make, q, kind, name = CASES[case]
    mechanism = make()
    motion = mechanism.solve(q, order=2)
    names = list(mechanism.dimensions)
    found = motion.jacobian(name, by=names, order=order)
    assert found.shape == (*getattr(motion, kind)(name).arrays[order].shape, len(names))

    def solve(design: Any) -> Any:
        return getattr(design.solve(q, order=2), kind)(name).arrays[order]

    wanted = np.stack([differences(mechanism, solve, each) for each in names], axis=-1)
    assert np.abs(found - wanted).max() < CLOSE * max(1.0, np.abs(wanted).max())


@pytest.mark.parametrize("case", CASES)
def test_columns_are_the_sensitivities(case: str) -> None:
    make, q, kind, name = CASES[case]
    motion = make().solve(q, order=1)
    for each in motion.mechanism.dimensions:
        one = getattr(motion.sensitivity(each), kind)(name)
        assert (motion.jacobian(name, by=each)[..., 0] == one.value).all()
        assert (motion.jacobian(name, by=[each], order=1)[..., 0] == one.d1).all()


@pytest.mark.parametrize("case", CASES)
def test_the_drivers_are_an_axis_too(case: str) -> None:
    make, q, kind, name = CASES[case]
    motion = make().solve(q, order=3)
    for order in range(3):
        wanted = getattr(motion, kind)(name).arrays[order + 1]
        found = motion.jacobian(name, by="q", order=order)
        assert found.shape[-1] == motion.driver_count
        assert (found.reshape(wanted.shape) == wanted).all()


def test_batches_and_patterns() -> None:
    lengths = np.linspace(2.8, 3.2, 4)
    batch = assur.FourBar(1.0, lengths, 2.5, 3.0).solve([0.5, 1.0, 1.5])
    found = batch.jacobian("C", by=["*.length", "ground.D.?"])
    assert found.shape == (4, 3, 2, 5)
    one = assur.FourBar(1.0, lengths[2], 2.5, 3.0).solve([0.5, 1.0, 1.5])
    names = ["crank.length", "coupler.length", "rocker.length", "ground.D.x", "ground.D.y"]
    assert (one.jacobian("C", by=names) == found[2]).all()
    assert batch.jacobian("C", by=[]).shape == (4, 3, 2, 0)


def test_what_has_no_derivative_is_nan() -> None:
    motion = assur.FourBar(3.0, 2.5, 2.0, 4.0).solve([0.5, 2.0], on_error="nan")
    found = motion.jacobian("C", by="*.length")
    assert np.isfinite(found[0]).all()
    assert np.isnan(found[1]).all()


REFUSED: dict[str, tuple[Any, str]] = {
    "an unknown output": (("Z", {}), "there is no such output of this motion; there are 'A'"),
    "an unknown dimension": (("C", {"by": "x.length"}), 'there is no dimension "x.length"'),
    "a pattern of nothing": (("C", {"by": "*.foo"}), r"no dimension is like '\*\.foo'"),
    "a number": (("C", {"by": 3}), 'by is 3: "q", or names of dimensions'),
    "an order above": (("C", {"order": 2}), r"solve\(q, order=3\) has d3"),
    "an order of 4": (("C", {"order": 4}), "order is 4"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals(name: str) -> None:
    (of, options), message = REFUSED[name]
    motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve([0.5, 1.0])
    with pytest.raises(assur.InputError, match=message):
        motion.jacobian(of, **options)
    redundant = assur.Mechanism(
        joints={"A": (0, 0), "B": (0, 1), "D": (2, 0), "C": (2, 1), "E": (1, 0), "F": (1, 1)},
        links={"ground": "AED", "one": "AB", "two": "DC", "three": "EF", "bar": "BFC"},
        driver="one",
    )
    with pytest.raises(assur.InputError, match="redundant"):
        redundant.solve(1.0).jacobian("C", by="one.length")
