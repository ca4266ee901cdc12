"""Files of other programs give the mechanisms that they describe."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from assur import importers
from importers.foreign import PMKS, PMKS_PLUS, Case
from importers.foreign_more import LINKAGE, PYLINKAGE, PYSLVS

if TYPE_CHECKING:
    from pathlib import Path

CASES = {
    f"{case.format}: {name}": case
    for cases in (PMKS, PMKS_PLUS, PYLINKAGE, PYSLVS, LINKAGE)
    for name, case in cases.items()
}


def imported(case: Case, scale: float = 1.0) -> importers.Imported:
    """The case, in the format that is found."""
    return importers.read(case.text, drivers=case.drivers, scale=scale)


@pytest.mark.parametrize("name", CASES)
def test_mechanism_is_the_one_written_directly(name: str) -> None:
    case = CASES[name]
    found, direct = imported(case), case.direct()
    mechanism = found.mechanism
    assert found.format == case.format
    assert mechanism.structure.mobility == case.mobility == direct.structure.mobility
    assert mechanism.driver == direct.driver
    assert mechanism.slides.keys() == direct.slides.keys()
    for name_of_slide, slide in direct.slides.items():
        own = mechanism.slides[name_of_slide]
        assert (own.link, own.on, own.origin) == (slide.link, slide.on, slide.origin)
        assert own.angle == pytest.approx(slide.angle, abs=1e-15)
    assert {link: sorted(on) for link, on in mechanism.links.items()} == {
        link: sorted(on) for link, on in direct.links.items()
    }
    assert mechanism.dimensions.keys() == direct.dimensions.keys()
    for dimension, value in direct.dimensions.items():
        assert mechanism.dimensions[dimension] == pytest.approx(value, rel=1e-14, abs=1e-14)


@pytest.mark.parametrize("name", CASES)
def test_positions_are_those_of_the_one_written_directly(name: str) -> None:
    case = CASES[name]
    found, direct = imported(case).mechanism, case.direct()
    assert np.allclose(found.q0, direct.q0, rtol=1e-14, atol=1e-14)
    steps = np.linspace(-0.5, 0.5, 73) * case.span
    q = np.add.outer(steps, found.q0)
    ours, theirs = (m.solve(q, order=0, on_error="nan") for m in (found, direct))
    # Enough of the turn exists to compare anything.
    assert np.isfinite(theirs.joint(list(case.joints)[-1]).value).all(axis=-1).sum() > 20
    for joint in case.joints:
        values = theirs.joint(joint).value
        assert np.allclose(ours.joint(joint).value, values, rtol=0, atol=1e-12, equal_nan=True)


@pytest.mark.parametrize("name", CASES)
def test_speed_and_what_is_left_out(name: str) -> None:
    case, found = CASES[name], imported(CASES[name])
    speeds = np.array(found.input_speed, np.float64), np.array(case.speed, np.float64)
    assert np.allclose(*speeds, rtol=1e-15, atol=0.0, equal_nan=True)
    assert (found.input_speed is None) == (case.speed is None)
    said = " ".join(found.omitted)
    for sentence in case.omitted:
        assert sentence in said
    assert all(sentence.endswith(".") for sentence in found.omitted)


def test_every_format_has_several_files() -> None:
    counts = [len(cases) for cases in (PMKS, PMKS_PLUS, PYLINKAGE, PYSLVS, LINKAGE)]
    assert min(counts) >= 4
    assert sum(counts) == len(CASES) >= 20
    assert {case.format for case in CASES.values()} == set(importers.FORMATS)


@pytest.mark.parametrize("name", CASES)
def test_files_and_texts_are_the_same(name: str, tmp_path: Path) -> None:
    case = CASES[name]
    ending = {"linkage2": ".linkage2", "pylinkage": ".json"}.get(case.format, ".txt")
    path = tmp_path / f"file{ending}"
    path.write_text("\ufeff" + case.text, encoding="utf-8")
    found, again = importers.read(path, drivers=case.drivers, scale=1.0), imported(case)
    assert found.mechanism == again.mechanism
    assert found.omitted == again.omitted
    named = importers.read(str(path), format=case.format, drivers=case.drivers, scale=1.0)
    assert named.mechanism == again.mechanism
    assert importers.detect(path, case.text) == importers.detect(None, case.text) == case.format


@pytest.mark.parametrize("name", CASES)
def test_scale_makes_metres(name: str) -> None:
    case = CASES[name]
    found, small = imported(case), imported(case, scale=0.01)
    for joint, at in found.mechanism.joints.items():
        assert small.mechanism.joints[joint] == pytest.approx(np.multiply(at, 0.01), abs=1e-15)
    if isinstance(found.mechanism.driver, str) and found.mechanism.driver in found.mechanism.slides:
        assert isinstance(small.input_speed, float) == isinstance(found.input_speed, float)
        if isinstance(small.input_speed, float) and isinstance(found.input_speed, float):
            assert small.input_speed == pytest.approx(0.01 * found.input_speed)
    else:
        assert small.input_speed == found.input_speed
    assert "as they stand" not in " ".join(small.omitted)
