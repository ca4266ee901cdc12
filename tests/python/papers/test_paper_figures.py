"""The papers' figures are drawn, and show what they should."""

from __future__ import annotations

from typing import TYPE_CHECKING

import crank_rocker_paper
import flywheel_paper
import matplotlib.pyplot as plt
import numpy as np
import pytest
import slider_crank_papers

if TYPE_CHECKING:
    from pathlib import Path


FIGURES = {
    **slider_crank_papers.FIGURES,
    **crank_rocker_paper.FIGURES,
    **flywheel_paper.FIGURES,
}


@pytest.mark.parametrize("name", FIGURES)
def test_figures(name: str) -> None:
    figure = FIGURES[name]()
    lines = [line for ax in figure.axes for line in ax.lines if len(line.get_xdata()) > 2]
    assert figure.axes
    if name not in ("contour", "zone", "push_and_pull"):
        assert lines
        assert all(np.isfinite(line.get_ydata()).all() for line in lines)
    plt.close(figure)


def test_the_scripts_draw_them_all(tmp_path: Path) -> None:
    slider_crank_papers.main(tmp_path)
    crank_rocker_paper.main(tmp_path)
    flywheel_paper.main(tmp_path)
    drawn = {path.stem for path in tmp_path.glob("*.png")}
    wanted = {f"slider_crank_{name}" for name in slider_crank_papers.FIGURES}
    wanted |= {f"crank_rocker_{name}" for name in crank_rocker_paper.FIGURES}
    assert drawn == wanted | {f"flywheel_{name}" for name in flywheel_paper.FIGURES}
