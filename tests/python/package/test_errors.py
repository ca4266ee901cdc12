"""Every kind of error: its class, its fields, and a message without leftovers."""

from __future__ import annotations

import copy
import pickle
import re
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from assur import _core, errors
from models.errors.error_cases import CASES, FIELDS, UNREACHABLE

if TYPE_CHECKING:
    from collections.abc import Callable

KINDS = [(origin, kind) for origin, cases in CASES.items() for kind in cases]
# Braces of Python stay: assembly={"C": +1}.
LEFTOVERS = re.compile(r"(?<!=)\{|\bSome\(|\bOk\(|None|\bnan\b|  | [,;:.]|[,;:]{2}|\.\.|;$|:$")
QUOTED = re.compile(r'"([^"]+)"')
REST_OF_BATCH = re.compile(r" \(and \d+ more of \d+; on_error='nan' keeps the others\)$")


@cache
def raised(origin: str, kind: str) -> assur.AssurError:
    return CASES[origin][kind].raised()


def test_every_kind_has_a_case_or_a_reason() -> None:
    known = {origin: set(kinds) for origin, kinds in _core.error_kinds()}
    assert {origin: {*CASES[origin], *UNREACHABLE[origin]} for origin in known} == known
    assert set(CASES) == set(UNREACHABLE) == set(known)
    assert not any(set(CASES[origin]) & set(UNREACHABLE[origin]) for origin in known)


@pytest.mark.parametrize(("origin", "kind"), KINDS)
def test_class_kind_and_fields(origin: str, kind: str) -> None:
    case, error = CASES[origin][kind], raised(origin, kind)
    assert (type(error), error.kind) == (case.error, kind)
    expected = dict.fromkeys(FIELDS) | case.fields
    for name, wanted in expected.items():
        found = getattr(error, name)
        if isinstance(wanted, float):
            assert type(found) is float
            assert found == pytest.approx(wanted, rel=1e-6, abs=1e-12, nan_ok=True), name
        else:
            assert found == wanted, name


@pytest.mark.parametrize(("origin", "kind"), KINDS)
def test_the_message_ends_with_the_hint_and_has_no_leftovers(origin: str, kind: str) -> None:
    error = raised(origin, kind)
    message = REST_OF_BATCH.sub("", str(error))
    found = LEFTOVERS.search(message)
    assert found is None, f"{found} in {message}"
    values = CASES[origin][kind].fields.values()
    assert ("NaN" in message) == any(isinstance(x, float) and np.isnan(x) for x in values)
    if error.hint is not None:
        assert error.hint
        assert message.endswith(f"; {error.hint}")


@pytest.mark.parametrize("kind", [kind for origin, kind in KINDS if origin == "structure"])
def test_names_are_all_names_that_the_message_quotes(kind: str) -> None:
    error = raised("structure", kind)
    quoted = QUOTED.findall(str(error).removesuffix(error.hint or ""))
    assert error.names == tuple(dict.fromkeys(quoted))


@pytest.mark.parametrize("kind", [kind for origin, kind in KINDS if origin == "structure"])
def test_one_of_the_names_is_a_field(kind: str) -> None:
    error = raised("structure", kind)
    fields = {error.joint, error.link, error.slide, error.driver}
    assert not error.names or fields & set(error.names)


def test_names_of_a_position_and_of_an_argument() -> None:
    assert raised("position", "parallel_guides").names == ("s1", "s2")
    assert raised("position", "not_closed").names == ("C",)
    assert raised("position", "signs_do_not_return").names == ()
    assert raised("request", "bad_dimension").names == ("coupler.length",)


@pytest.mark.parametrize(("origin", "kind"), KINDS)
@pytest.mark.parametrize(
    "again",
    [copy.copy, copy.deepcopy, lambda error: pickle.loads(pickle.dumps(error))],
    ids=["copy", "deepcopy", "pickle"],
)
def test_copies_have_all_fields(
    again: Callable[[assur.AssurError], assur.AssurError], origin: str, kind: str
) -> None:
    error = raised(origin, kind)
    other = again(error)
    assert type(other) is type(error)
    assert str(other) == str(error)
    fields = {name for name in error.__dict__ if not name.startswith("_")}
    assert set(FIELDS) | {"kind", "hint"} == fields
    for name in fields:
        np.testing.assert_equal(getattr(other, name), getattr(error, name))  # NaN is NaN
    if isinstance(error, assur.StructureError):
        assert isinstance(other, assur.StructureError)
        assert other.remedies == error.remedies


def test_every_class_of_errors_is_raised() -> None:
    classes = {getattr(errors, name) for name in errors.__all__} - {assur.AssurWarning}
    raised = {one.error for cases in CASES.values() for one in cases.values()}
    # A bug in the library is an AssurError: test_panics.py. Python alone raises a FitError:
    # fitting/test_search.py.
    assert raised == classes - {assur.AssurError, assur.FitError}


@pytest.mark.skipif(not hasattr(_core, "panic_in_chunk"), reason="built without test-hooks")
def test_a_fault_of_the_library_is_of_the_kind_internal() -> None:
    _core.panic_in_chunk(1)
    try:
        with pytest.raises(assur.AssurError) as caught:
            assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(1.0)
    finally:
        _core.panic_in_chunk(0)
    assert (type(caught.value), caught.value.kind) == (assur.AssurError, "internal")
