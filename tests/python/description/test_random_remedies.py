"""Remedies of each kind of error and of random broken mechanisms: all move as NumPy's rank says."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assur
from models.errors.error_cases import CASES
from models.mechanisms import dyad_models, mixed_models
from models.mechanisms.mechanism_data import GROUND, Description, DriverSpec, SlideSpec, arguments
from oracles.kinematics.pair_jacobian import jacobian
from support.samples import sample

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

# Singular values of the Jacobian below this are zero, above the next they are not.
ZERO, NOT_ZERO = 1e-11, 1e-9
# Kinds whose case offers nothing.
WITHOUT_REMEDY = {
    "bad_name", "doubled_name", "doubled_joint", "unknown", "not_finite", "out_of_range",
    "zero_length", "no_ground", "same_link", "origin_not_on_link", "slides_only", "flat_dyad",
    "no_length", "bad_sign",
}  # fmt: skip


def plain(parts: Mapping[str, Any]) -> Description:
    """The arguments of a mechanism as plain data."""
    given = parts["driver"] if isinstance(parts["driver"], list) else [parts["driver"]]
    drivers: list[DriverSpec] = []
    for driver in given:
        if isinstance(driver, assur.Drive):
            drivers.append(("angle", driver.link, driver.relative_to))
        else:
            is_slide = driver in parts["slides"]
            drivers.append(("slide", driver) if is_slide else ("angle", driver, GROUND))
    return Description(
        parts["joints"],
        {name: list(on) for name, on in parts["links"].items()},
        {n: SlideSpec(s.link, s.on, s.angle, s.origin) for n, s in parts["slides"].items()},
        drivers,
    )


def freedoms(description: Description) -> int:
    """Degrees of freedom at the drawing: unknowns without the rank of the pairs' rows."""
    joints = {n: complex(*p) for n, p in description.joints.items()}
    along = {n: np.exp(1j * s.angle) for n, s in description.slides.items()}
    rows = jacobian(description, joints, along)
    values = np.linalg.svd(rows, compute_uv=False)
    assert not np.any((values > ZERO) & (values < NOT_ZERO)), "no clear rank"
    return int(rows.shape[-1]) - int(np.count_nonzero(values > NOT_ZERO))


def check(remedies: Iterable[assur.Remedy]) -> None:
    """Each is a mechanism with as many drivers as freedoms; with these held, it is fixed."""
    for remedy in remedies:
        mechanism = assur.Mechanism(**remedy.arguments)
        description = plain(remedy.arguments)
        drivers = len(description.drivers)
        undriven = Description(description.joints, description.links, description.slides, [])
        assert mechanism.structure.mobility == drivers, remedy
        assert mechanism.structure.mobility_at_drawing == drivers == freedoms(undriven), remedy
        assert freedoms(description) == 0, remedy
        status = mechanism.solve(mechanism.q0, order=1, on_error="nan").status
        assert status <= assur.Status.NEAR_SINGULAR, remedy
        assert mechanism.joints.keys() == remedy.arguments["joints"].keys()


def refused(description: Description) -> assur.StructureError | None:
    try:
        assur.Mechanism(**arguments(description))
    except assur.StructureError as error:
        return error
    return None


def braced(own: Description, rng: random.Random) -> Description | None:
    """One more link between joints of two links, or None where two joints are in one place."""
    pairs = [
        (a, b)
        for a in own.joints
        for b in own.joints
        if a < b
        and not any({a, b} <= set(on) for on in own.links.values())
        and np.hypot(*np.subtract(own.joints[a], own.joints[b])) > 1e-3
    ]
    if not pairs:
        return None
    links = {**own.links, "brace": list(rng.choice(pairs))}
    return Description(own.joints, links, own.slides, own.drivers)


def parted(own: Description, rng: random.Random) -> Description:
    """Without one of its links, and without the joints and slides that only this one had."""
    driven = {name for driver in own.drivers for name in driver[1:]}
    driven |= {end for n in driven & set(own.slides) for end in (own.slides[n].link,)}
    driven |= {end for n in driven & set(own.slides) for end in (own.slides[n].on,)}
    out = rng.choice([name for name in own.links if name not in driven | {GROUND}])
    links = {name: on for name, on in own.links.items() if name != out}
    slides = {n: s for n, s in own.slides.items() if out not in (s.link, s.on)}
    used = {joint for on in links.values() for joint in on}
    joints = {name: at for name, at in own.joints.items() if name in used}
    return Description(joints, links, slides, own.drivers)


@pytest.mark.parametrize("kind", CASES["structure"])
def test_every_kind_of_error(kind: str) -> None:
    error = CASES["structure"][kind].raised()
    assert isinstance(error, assur.StructureError)
    assert bool(error.remedies) == (kind not in WITHOUT_REMEDY)
    check(error.remedies)


seeds = st.integers(0, 2**32 - 1)
SOME = settings(max_examples=sample(40, 10_000))


@SOME
@given(case=dyad_models.sequences(4), seed=seeds)
def test_what_cannot_move(case: dyad_models.Case, seed: int) -> None:
    broken = braced(case.description, random.Random(seed))
    error = None if broken is None else refused(broken)
    if error is not None and error.kind == "immovable":
        remedies = error.remedies
        check(remedies)
        # Without the brace it moves.
        assert remedies
        kinds = [remedy.kind for remedy in remedies]
        assert "take_out" in kinds, kinds


@SOME
@given(case=dyad_models.sequences(4), seed=seeds)
def test_what_moves_too_freely(case: dyad_models.Case, seed: int) -> None:
    if len(case.description.links) - len(case.description.drivers) > 1:
        error = refused(parted(case.description, random.Random(seed)))
        if error is not None:
            check(error.remedies)
            if error.kind == "mobility" and error.value == len(case.description.drivers) + 1:
                assert error.remedies, error


@SOME
@given(seed=st.integers(0, 400))
def test_higher_groups(seed: int) -> None:
    own = mixed_models.mixed_case(seed).description
    rng = random.Random(seed)
    for broken in (braced(own, rng), parted(own, rng)):
        error = None if broken is None else refused(broken)
        if error is not None:
            check(error.remedies)


@SOME
@given(case=dyad_models.sequences(4))
def test_drivers(case: dyad_models.Case) -> None:
    """Without a driver, and with one that is no link."""
    own = case.description
    parts = arguments(own)
    for driver in ([], ["ground"], ["nothing"]):
        with pytest.raises(assur.StructureError) as caught:
            assur.Mechanism(**{**parts, "driver": driver})
        remedies = caught.value.remedies
        check(remedies)
        if len(own.drivers) == 1:
            assert {remedy.kind for remedy in remedies} == {"drive"}, driver
