"""Tables of motions hold everything, whatever the names of the parts."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur

NAMES = ("q", "status", "design", "q0", "q1", "design0", "design1")


def four_bar(coupler: str, rocker: str) -> assur.Mechanism:
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0)},
        links={"ground": "AD", "crank": "AB", coupler: "BC", rocker: "DC"},
        driver="crank",
    )


def five_bar(first: str, second: str) -> assur.Mechanism:
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (0.3, 1), "C": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)},
        links={"ground": "AE", "left": "AB", first: "BC", second: "CD", "right": "ED"},
        driver=["left", "right"],
    )


def slider_crank(slide: str) -> assur.Mechanism:
    return assur.Mechanism(
        joints={"O": (0, 0), "A": (0.05, 0), "B": (0.25, 0)},
        links={"ground": "O", "crank": "OA", "rod": "AB", "piston": "B"},
        slides={slide: assur.Slide("piston", on="ground", angle=0.0, origin="O")},
        driver="crank",
    )


def width(motion: assur.Motion, designs: int) -> int:
    """Columns: the bookkeeping, and a value with its analogues of each quantity."""
    m, n = motion.mechanism, motion.driver_count
    each = sum(n**order for order in range(motion.order + 1))
    quantities = 2 * len(m.joints) + len(m.links) + len(m.slides)
    differing = 1 if designs else 0
    return designs + differing + n + 1 + int(each) * quantities


def column(frame: Any, name: str) -> Any:
    """One column; two of a name would be a frame."""
    found = frame[name].to_numpy()
    assert found.ndim == 1
    return found


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("designs", [0, 1, 2])
def test_a_link_called_as_a_column_keeps_its_own(name: str, designs: int) -> None:
    lengths = np.array([[4.4, 4.5], [4.6, 4.7]])
    batch = np.array(lengths[(0,) * (2 - designs)])
    m, plain = four_bar(name, "rocker"), four_bar("coupler", "rocker")
    motion = m.with_dimensions({f"{name}.length": batch}).solve([0.5, 1.0, 1.5], on_error="nan")
    same = plain.with_dimensions({"coupler.length": batch}).solve([0.5, 1.0, 1.5], on_error="nan")
    frame, other = motion.to_dataframe(), same.to_dataframe()
    assert frame.shape == (3 * batch.size, width(motion, designs))
    # Columns are in the same order; only one name is another.
    if designs:
        np.testing.assert_array_equal(column(frame, f"{name}.length"), np.repeat(batch, 3))
    for own, plainly in zip(frame.columns, other.columns, strict=True):
        np.testing.assert_array_equal(column(frame, own), column(other, plainly))
    taken = {"q", "status"} | ({"design"} if designs == 1 else set())
    taken |= {"design0", "design1"} if designs == 2 else set()
    called = f"link {name}" if name in taken else name
    np.testing.assert_array_equal(column(frame, called), motion.link(name).value.ravel())
    np.testing.assert_array_equal(column(frame, f"{called}.d1"), motion.link(name).d1.ravel())
    np.testing.assert_array_equal(column(frame, "status"), motion.status.ravel())


def test_links_called_as_the_drivers_columns_keep_their_own() -> None:
    motion = five_bar("q0", "q").solve([[1.3, 1.1], [1.2, 1.0]])
    frame = motion.to_dataframe()
    assert frame.shape == (2, width(motion, 0))
    np.testing.assert_array_equal(column(frame, "q0"), [1.3, 1.2])
    np.testing.assert_array_equal(column(frame, "link q0"), motion.link("q0").value)
    np.testing.assert_array_equal(column(frame, "link q0.d2[0,1]"), motion.link("q0").d2[:, 0, 1])
    # With two drivers no column is called q.
    np.testing.assert_array_equal(column(frame, "q"), motion.link("q").value)


def test_a_slide_called_as_a_column_keeps_its_own() -> None:
    motion = slider_crank("status").solve([0.5, 1.0])
    frame = motion.to_dataframe()
    assert frame.shape == (2, width(motion, 0))
    np.testing.assert_array_equal(column(frame, "slide status"), motion.slide("status").value)
    np.testing.assert_array_equal(column(frame, "status"), [0, 0])
    joint = assur.Mechanism(
        joints={"q": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0)},
        links={"ground": ["q", "D"], "crank": ["q", "B"], "coupler": "BC", "rocker": "DC"},
        driver="crank",
    ).solve([0.5, 1.0])
    np.testing.assert_array_equal(column(joint.to_dataframe(), "q"), [0.5, 1.0])
    np.testing.assert_array_equal(column(joint.to_dataframe(), "q.x"), [0.0, 0.0])
