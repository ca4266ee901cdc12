"""The papers' figures are drawn, and show what they should."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
import pytest
import slider_crank_papers

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.parametrize("name", slider_crank_papers.FIGURES)
def test_figures_of_the_slider_crank(name: str) -> None:
    figure = slider_crank_papers.FIGURES[name]()
    lines = [line for ax in figure.axes for line in ax.lines if len(line.get_xdata()) > 2]
    assert figure.axes
    if name != "contour":
        assert lines
        assert all(np.isfinite(line.get_ydata()).all() for line in lines)
    plt.close(figure)


def test_the_script_draws_them_all(tmp_path: Path) -> None:
    slider_crank_papers.main(tmp_path)
    drawn = {path.stem for path in tmp_path.glob("*.png")}
    assert drawn == {f"slider_crank_{name}" for name in slider_crank_papers.FIGURES}
