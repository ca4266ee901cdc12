"""A few pictures beside those that were looked at: `python tests/python/pictures/test_images.py`.

The script draws them anew: look at each before it is committed. Without texts, whose shapes depend
on versions of fonts.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.testing.compare import compare_images

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

BASELINE = Path(__file__).parent / "baseline"
# Root of the mean square of a pixel's difference, of 255: antialiasing of other versions gives 2,
# a bar moved by a pixel 4 and more.
TOLERANCE = 3.0
TURN = np.radians(np.arange(0.0, 360.0, 30.0))


def _path() -> Any:
    klann = assur.examples.klann_leg()
    return klann.solve(np.linspace(0.0, 2.0 * np.pi, 121)).plot("F", groups=True)


PICTURES: dict[str, Callable[[], Any]] = {
    "crank_rocker_positions": lambda: assur.examples.crank_rocker().plot(TURN),
    "shaper": lambda: assur.examples.shaper().plot(0.6),
    "excavator": lambda: assur.examples.excavator().plot(),
    "loom_dark": lambda: assur.examples.loom().plot(groups=True, dark=True),
    "klann_path": _path,
}


def write(name: str, path: Path) -> None:
    ax = PICTURES[name]()
    for text in ax.texts:
        text.set_visible(False)
    ax.figure.savefig(
        path, dpi=50, facecolor=ax.figure.get_facecolor(), metadata={"Software": None}
    )
    plt.close(ax.figure)


@pytest.mark.parametrize("name", list(PICTURES))
def test_pictures_are_those_that_were_looked_at(name: str, tmp_path: Path) -> None:
    drawn = tmp_path / f"{name}.png"
    write(name, drawn)
    difference = compare_images(str(BASELINE / f"{name}.png"), str(drawn), TOLERANCE)
    assert difference is None, difference


def test_a_moved_bar_is_seen(tmp_path: Path) -> None:
    """The tolerance is fine enough: a crank turned by two degrees fails."""
    ax = assur.examples.shaper().plot(0.6 + np.radians(2.0))
    for text in ax.texts:
        text.set_visible(False)
    moved = tmp_path / "moved.png"
    figure = ax.get_figure(root=True)
    assert figure
    figure.savefig(moved, dpi=50, facecolor=figure.get_facecolor())
    plt.close(figure)
    assert compare_images(str(BASELINE / "shaper.png"), str(moved), TOLERANCE)


if __name__ == "__main__":
    for one in PICTURES:
        write(one, BASELINE / f"{one}.png")
