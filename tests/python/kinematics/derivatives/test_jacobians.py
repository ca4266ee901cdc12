"""Jacobians by name, against differences of solved designs and the sensitivities."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur

# Step of central differences, m or rad; their limit is extrapolated (Richardson 1911), so that
# rounding decides: to this part of the greatest entry.
STEP, CLOSE = 4e-5, 1e-7
# Of the same number by two orders of summation, relative to the greatest: a hundred roundings at
# conditions of a few tens.
SAME = 1e-12


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
        for order, wanted in enumerate((one.value, one.d1)):
            found = motion.jacobian(name, by=[each], order=order)[..., 0]
            assert np.abs(found - wanted).max() <= SAME * max(1.0, np.abs(wanted).max())


@pytest.mark.parametrize("case", CASES)
def test_the_drivers_are_an_axis_too(case: str) -> None:
    make, q, kind, name = CASES[case]
    motion = make().solve(q, order=3)
    for order in range(3):
        wanted = getattr(motion, kind)(name).arrays[order + 1]
        found = motion.jacobian(name, by="q", order=order)
        assert found.shape[-1] == motion.driver_count
        assert (found.reshape(wanted.shape) == wanted).all()


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("case", CASES)
def test_products_are_those_of_the_matrix(case: str, order: int) -> None:
    """Forward and backward passes share no code beyond the solved closures."""
    make, q, _, name = CASES[case]
    motion = make().solve(q, order=order)
    names = list(motion.mechanism.dimensions)
    matrix = motion.jacobian(name, by=names, order=order)
    random = np.random.default_rng(order)
    along = random.normal(size=len(names))
    forward = motion.jvp(name, dict(zip(names, along, strict=True)), order=order)
    size = np.abs(matrix).max() * np.abs(along).sum()
    assert np.abs(forward - matrix @ along).max() <= SAME * size
    weights = random.normal(size=matrix.shape[:-1])
    backward = motion.vjp({name: weights}, order=order)
    rows = len(q)
    wanted = np.einsum(
        "rc,rcd->rd", weights.reshape(rows, -1), matrix.reshape(rows, -1, len(names))
    )
    assert np.abs(backward - wanted).max() <= SAME * max(1.0, np.abs(wanted).max())


def test_several_results_at_once() -> None:
    motion = assur.examples.crank_rocker().solve(np.linspace(0.3, 5.9, 7), order=1)
    both = motion.jacobian(["P", "rocker"], by="*", order=1)
    rates = motion.jvp(["P", "rocker"], {"coupler.length": 0.3, "ground.D.y": -0.2})
    for name in ("P", "rocker"):
        assert (both[name] == motion.jacobian(name, by="*", order=1)).all()
        alone = motion.jvp(name, {"coupler.length": 0.3, "ground.D.y": -0.2})
        assert (rates[name] == alone).all()
    weighted = motion.vjp({"P": [1.0, 2.0], "rocker": 3.0})
    wanted = motion.vjp({"P": [1.0, 2.0]}) + motion.vjp({"rocker": 3.0})
    np.testing.assert_allclose(weighted, wanted, rtol=SAME, atol=SAME)
    assert motion.jacobian([], by="*") == {}
    assert (motion.vjp({}) == 0.0).all()


def test_each_position_has_the_bits_that_it_has_alone() -> None:
    batch = assur.FourBar(1.0, np.linspace(2.8, 3.2, 5), 2.5, 3.0)
    q = np.linspace(0.2, 6.0, 13)
    motion = batch.solve(q, order=2)
    rates = np.linspace(1.0, 2.0, 5)
    forward = motion.jvp("C", {"coupler.length": rates, "crank.length": 0.5})
    found = motion.jacobian("C", by="*", order=2), forward, motion.vjp({"C": 1.0})
    for threads in (1, 2):
        again = batch.solve(q, order=2, threads=threads)
        assert (again.jacobian("C", by="*", order=2) == found[0]).all()
    for i in range(5):
        design = batch.design(i)
        for k in (0, 7, 12):
            one = design.solve(q[k], order=2)
            assert (one.jacobian("C", by="*", order=2) == found[0][i, k]).all()
            alone = one.jvp("C", {"coupler.length": rates[i], "crank.length": 0.5})
            assert (alone == forward[i, k]).all()
            assert (one.vjp({"C": 1.0}) == found[2][i, k]).all()


def beside_the_pivot() -> Any:
    """A slotted lever whose guide misses its pivot: else its pressure angle is always 0."""
    return assur.examples.whitworth().with_dimensions({"slot.offset": 0.05})


ANGLES: dict[str, tuple[Any, Any, str]] = {
    "a joint": (assur.examples.crank_rocker, np.linspace(0.3, 5.9, 7), "C"),
    "a fixed guide": (assur.examples.engine, np.linspace(0.3, 5.9, 7), "bore"),
    "a turning guide": (beside_the_pivot, np.linspace(0.3, 5.9, 7), "slot"),
}


@pytest.mark.parametrize("case", ANGLES)
def test_transmission_angles(case: str) -> None:
    make, q, name = ANGLES[case]
    mechanism = make()
    motion = mechanism.solve(q, order=1)
    names = list(mechanism.dimensions)
    found = motion.d_transmission_angle(name, by=names)

    def solve(design: Any) -> Any:
        return design.solve(q).transmission_angle(name)

    wanted = np.stack([differences(mechanism, solve, each) for each in names], axis=-1)
    assert np.abs(found - wanted).max() < CLOSE * max(1.0, np.abs(wanted).max())
    by_q = motion.d_transmission_angle(name)[:, 0]
    step = 1e-5
    beside = [mechanism.solve(q + way).transmission_angle(name) for way in (step, -step)]
    assert np.abs(by_q - (beside[0] - beside[1]) / (2.0 * step)).max() < 1e-8


def test_an_angle_that_turns_back_has_no_derivative() -> None:
    motion = assur.examples.whitworth().solve([0.3, 1.0])
    assert np.isnan(motion.d_transmission_angle("slot", by="*.length")).all()
    # 3, 4, 5: coupler and rocker at right angles.
    right = assur.FourBar(1.0, 3.0, 4.0, 6.0).solve([0.0, 1.0])
    found = right.d_transmission_angle("C", by="*.length")
    assert np.isnan(found[0]).all()
    assert np.isfinite(found[1]).all()


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
    "a number as a name": ((3, {}), "name is 3: a name, or a list of names"),
}
PRODUCTS: dict[str, tuple[str, Any, str]] = {
    "rates in a list": ("jvp", ("C", [1.0]), r"rates is \[1.0\]: a mapping such as"),
    "an unknown rate": ("jvp", ("C", {"x.length": 1.0}), 'there is no dimension "x.length"'),
    "rates of three": ("jvp", ("C", {"crank.length": [1.0] * 3}), "rate of 'crank.length' has"),
    "a rate in words": ("jvp", ("C", {"crank.length": "fast"}), "rate of 'crank.length'"),
    "weights in a list": ("vjp", ([1.0],), r"weights is \[1.0\]: a mapping such as"),
    "weights of three": ("vjp", ({"C": [1.0] * 3},), r"weights of 'C' .*\(2, 2\) is needed"),
    "weights of nobody": ("vjp", ({"Z": 1.0},), "no such output"),
}


@pytest.mark.parametrize("name", PRODUCTS)
def test_refusals_of_products(name: str) -> None:
    call, arguments, message = PRODUCTS[name]
    motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve([0.5, 1.0])
    with pytest.raises(assur.InputError, match=message):
        getattr(motion, call)(*arguments)


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
