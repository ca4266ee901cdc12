"""Arrays of any type and layout count as their numbers; anything without numbers is refused."""

from __future__ import annotations

import copy
import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assur
from assur.dynamics.equations.dynamics import Dynamics
from fuzzing.array_entries import ENTRIES, PICTURES, array_parameters, public
from support.samples import sample

pytestmark = pytest.mark.filterwarnings("ignore::assur.AssurWarning")

EXAMPLES = sample(10, 400)

KINDS = [
    "<f8",
    ">f8",
    "<f4",
    ">f4",
    "f2",
    "g",
    "i1",
    "<i4",
    ">i4",
    "i8",
    "u1",
    ">u2",
    "u8",
    "?",
    "O",
]
LAYOUTS = [
    "plain",
    "every second",
    "backward",
    "Fortran",
    "read-only",
    "misaligned",
    "stride of 0",
    "list",
    "tuple",
    "matrix",
    "subclass",
    "masked nowhere",
]


class Own(np.ndarray[Any, Any]):
    """A subclass, as many libraries have."""


def laid_out(array: Any, layout: str) -> Any:
    """The same numbers (a stride of 0: the first of them) in another layout."""
    if layout == "every second":
        wide = np.repeat(array, 2, axis=-1) if array.ndim else array
        return wide[..., ::2] if array.ndim else wide
    if layout == "backward" and array.ndim:
        return np.ascontiguousarray(array[..., ::-1])[..., ::-1]
    if layout == "Fortran":
        return np.asfortranarray(array)
    if layout == "read-only":
        array = array.copy()
        array.flags.writeable = False
        return array
    if layout == "misaligned" and array.dtype.kind != "O":
        room = bytearray(array.nbytes + 1)
        moved = np.ndarray(array.shape, array.dtype, buffer=room, offset=1)
        moved[...] = array
        return moved
    if layout == "stride of 0" and array.size:
        return np.broadcast_to(array.flat[0], array.shape)
    if layout in ("list", "tuple"):
        return array.tolist() if layout == "list" or array.ndim != 1 else tuple(array.tolist())
    if layout == "matrix" and array.ndim == 2 and array.dtype.kind != "O":
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", PendingDeprecationWarning)
            return np.matrix(array)
    if layout == "subclass":
        return array.view(Own)
    return np.ma.array(array, mask=False) if layout == "masked nowhere" else array


# What a result of the package is made of, where it is not a tuple or a dataclass.
INSIDE: dict[type, Any] = {
    assur.Motion: lambda one: (
        one.q,
        one.status,
        one._results.joints,
        one._results.links,
        one._results.slides,
    ),
    assur.Mechanism: lambda one: dict(one.dimensions),
    assur.Analogues: lambda one: one.arrays,
    Dynamics: lambda one: (one.mass_matrix, one.d_mass_matrix, one.bias, one.gravity),
    assur.Machine: lambda one: one._rebuild_with[1],
    assur.SteadyState: lambda one: (one.run, one.mean_speed, one.delta),
    assur.Runs: lambda one: (one.t_end, one.q_end, one.speed_end, one.status),
    assur.Run: lambda one: (one.t, one.q, one.speed, one.acceleration),
    assur.flywheel.Flywheel: lambda one: (one.inertia, one.speed0, one.motor_moment, one.period),
}


def bits(result: Any) -> Any:
    """Every number of a result, bit for bit."""
    for kind, inside in INSIDE.items():
        if isinstance(result, kind):
            return bits(inside(result))
    if hasattr(result, "__dataclass_fields__"):
        return [bits(getattr(result, name)) for name in result.__dataclass_fields__]
    if isinstance(result, Mapping):
        return {key: bits(value) for key, value in result.items()}
    if isinstance(result, list | tuple):
        return [bits(one) for one in result]
    if isinstance(result, np.ndarray | np.generic):
        return type(result), result.dtype.str, result.shape, result.tobytes()
    return type(result), repr(result)


def outcome(call: Any, value: Any) -> Any:
    try:
        return bits(call(value))
    except assur.AssurError as error:
        return type(error)


@pytest.mark.parametrize("name", list(ENTRIES))
@settings(max_examples=EXAMPLES)
@given(data=st.data())
def test_an_array_is_the_numbers_it_holds(name: str, data: st.DataObject) -> None:
    entry = ENTRIES[name]
    array = data.draw(st.sampled_from(entry.arrays))
    kind, layout = data.draw(st.sampled_from(KINDS)), data.draw(st.sampled_from(LAYOUTS))
    disguised = laid_out(np.asarray(array).astype(kind), layout)
    plain = np.array(np.asarray(disguised).tolist(), dtype=np.float64).reshape(np.shape(disguised))
    before = copy.deepcopy(disguised)
    assert outcome(entry.call, disguised) == outcome(entry.call, plain)
    # And nothing was written to it.
    np.testing.assert_array_equal(np.asarray(disguised), np.asarray(before))


@pytest.mark.parametrize("name", list(ENTRIES))
def test_entries_accept_valid_arrays(name: str) -> None:
    """Else two refusals would count as agreement."""
    entry = ENTRIES[name]
    assert any(not isinstance(outcome(entry.call, array), type) for array in entry.arrays)


def not_numbers(array: Any) -> dict[str, Any]:
    """The same shape, of something that NumPy would convert."""
    shape, fields = array.shape, [("x", "f8")]
    objects = array.astype(object)
    objects.flat[0] = "1.0"
    return {
        "masked": np.ma.array(array, mask=np.arange(array.size).reshape(shape) == 0),
        "masked in a list": [np.ma.array(array, mask=True)],
        "strings": array.astype(str),
        "bytes": array.astype("S"),
        "text": "1.0",
        "bytes of text": b"12",
        "a buffer of text": bytearray(b"12"),
        "dates": array.astype("i8").astype("M8[D]"),
        "times": array.astype("i8").astype("m8[s]"),
        "records": array.astype(fields),
        "text among objects": objects,
        "text in a list": ["1.0"],
        "complex": array.astype(complex),
        "nothing": None if array.ndim else [None],
        "a mapping": {"x": 1.0},
        "lists of different lengths": [[1.0, 2.0], [3.0]],
    }


# What may be left out.
OPTIONAL = (
    "Mechanism.find.near",
    "Machine.acceleration.effort",
    "Machine.d_acceleration.effort",
    "Machine.linearize.effort",
    "Machine.step.atol",
    "assur.fit.timing",
    "Machine.step.effort",
    "Mechanism.map.deg",
    "Mechanism.with_driver.deg",
    "Mechanism.with_driver.q",
    "Mechanism.solve.deg",
    "Mechanism.map.q",
    "Motion.to_",
    "FourBar.__init__.point",
    "Machine.run",
    "Run.at",
    "Runs.at",
    "Machine.equilibria",
    "Machine.impact.impulse",
    "Machine.flywheel",
    "Machine.steady_state",
    "assur.flywheel",
)


@pytest.mark.parametrize("name", list(ENTRIES))
def test_arrays_without_numbers_are_refused(name: str) -> None:
    entry = ENTRIES[name]
    for array in entry.arrays:
        for what, value in not_numbers(array).items() if array.size else ():
            if value is None and name.startswith(OPTIONAL):
                continue
            with pytest.raises(assur.InputError):
                raise AssertionError((what, entry.call(value)))


def test_every_function_that_takes_arrays_is_among_the_entries() -> None:
    """A new one must be added to `array_entries`."""
    wanted = {
        f"{name}.{one}"
        for name, call in public()
        if name.rpartition(".")[2] not in PICTURES
        for one in array_parameters(call)
    }
    assert len(wanted) > 80
    assert wanted - set(ENTRIES) == set()
