"""Results, mechanisms and errors are values: read-only, copied and pickled whole."""

from __future__ import annotations

import copy
import pickle

import pytest

import assur
from assur import _core
from models.errors.refusals import APART, BATCH, MOTION, TWO, M, refused


def test_results_are_read_only() -> None:
    pickled = pickle.loads(pickle.dumps(MOTION))
    for motion in (MOTION, pickled, copy.deepcopy(MOTION)):
        c = motion.joint("C")
        for array in (c.value, c.d2, motion.q, motion.status, motion.residual, motion.condition):
            assert not array.flags.writeable
            assert array.flags.c_contiguous


@pytest.mark.parametrize("m", [M, BATCH, TWO, APART, assur.SliderCrank(1, 3)])
def test_mechanisms_are_values(m: assur.Mechanism) -> None:
    for other in (pickle.loads(pickle.dumps(m)), copy.copy(m), copy.deepcopy(m)):
        assert other == m
        assert hash(other) == hash(m)
        assert other.structure == m.structure
    assert m != 3
    for name in ("joints", "driver", "structure", "anything"):
        with pytest.raises(AttributeError):
            setattr(m, name, 1)
    with pytest.raises(TypeError):
        m.joints["A"] = (1, 1)  # type: ignore[index]


def test_errors_are_pickled_with_their_fields() -> None:
    error = refused(assur.PositionError, "C assembled", lambda: APART.solve(3.0), joint="C", q=3.0)
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert (str(again), again.__dict__) == (str(error), error.__dict__)


def test_codes_are_those_of_the_core() -> None:
    known = {s.name: s.value for s in assur.Status}
    # No position has this one: it is of forces and metrics.
    assert known.pop("NO_VALUE") == len(known)
    assert dict(_core.Mechanism.statuses()) == known
