"""A panic of the core is an AssurError in Python, and no incomplete result can be read."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from assur import _core

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [
    pytest.mark.skipif(
        not hasattr(_core, "panic_in_chunk"),
        reason="assur was built without the feature test-hooks, as every release is",
    ),
    pytest.mark.usefixtures("threads_at_once"),
]

Q = np.linspace(0.0, 2.0 * np.pi, 50)
MANY = np.linspace(2.9, 3.1, 4000)  # designs: more than one chunk of work


@pytest.fixture(autouse=True)
def _no_panic_is_left() -> Iterator[None]:
    # The hook is compiled for tests alone: maturin develop --features test-hooks (see Makefile).
    yield
    _core.panic_in_chunk(0)


def batch() -> assur.Mechanism:
    return assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"coupler.length": MANY})


@pytest.mark.parametrize("threads", [1, 2, None])
@pytest.mark.parametrize("chunk", [1, 3])
def test_a_panic_is_an_error_that_names_its_place(
    chunk: int, threads: int | None, capfd: pytest.CaptureFixture[str]
) -> None:
    m = batch()
    expected = m.solve(Q)
    _core.panic_in_chunk(chunk)
    with pytest.raises(assur.AssurError) as caught:
        m.solve(Q, threads=threads)
    assert type(caught.value) is assur.AssurError
    text = str(caught.value)
    assert text.startswith("a fault of assur, not of your input: deliberate panic (rust/core/")
    assert "test_hooks.rs:" in text
    assert "please report it" in text
    assert capfd.readouterr() == ("", "")  # the library prints nothing
    again = m.solve(Q, threads=threads)
    np.testing.assert_array_equal(again.joint("C").d2, expected.joint("C").d2)


def test_a_panic_in_a_single_position_is_an_error() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    _core.panic_in_chunk(1)
    with pytest.raises(assur.AssurError, match="deliberate panic"):
        m.solve(1.0)
    assert m.solve(1.0).status == assur.Status.OK


@pytest.mark.parametrize("threads", [1, 2])
def test_no_mixture_of_old_and_new_values_can_be_read(threads: int) -> None:
    m = batch()
    motion = m.solve(Q)
    joint, status = motion.joint("C"), motion.status
    _core.panic_in_chunk(2)
    with pytest.raises(assur.AssurError, match="deliberate panic"):
        m.solve(Q + 0.1, threads=threads, out=motion)
    # What was taken from the motion before shares its memory.
    assert all(np.isnan(a).all() for a in (joint.value, joint.d1, joint.d2))
    assert (status == assur.Status.LOST).all()
    for read in (
        lambda: motion.joint("C"),
        lambda: motion.link("rocker"),
        lambda: motion.status,
        lambda: motion.sensitivity("crank.length"),
        motion.to_dataframe,
    ):
        with pytest.raises(assur.InputError, match="this motion is incomplete"):
            read()
    # Written as a whole it is a motion again.
    again = m.solve(Q + 0.1, out=motion)
    np.testing.assert_array_equal(again.joint("C").value, m.solve(Q + 0.1).joint("C").value)
