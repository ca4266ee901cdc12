"""Figures of the two papers on the slider-crank, drawn into a folder (default: out).

Chernysh and others (2021): the closed contour (figure 2), positions and paths (4), diagrams (5
to 10), and how the series comes near the exact stroke. Ambarcumyanc and Subbotina (2017): how far
the approximations of the fraction are off (figures 2 and 3).
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from assur import slider_crank as sc

# Of the size of the paper's example; it prints no lengths.
CRANK, ROD, SPEED = 0.11, 0.407, 31.0  # m, m, rad/s
ANGLE = float(np.radians(60.0))

FIGURES: dict[str, Any] = {
    "contour": lambda: sc.plot_contour(ANGLE, CRANK, ROD),
    "positions": lambda: sc.plot_positions(ANGLE, CRANK, ROD),
    "stroke": lambda: sc.plot_motion("stroke", CRANK, ROD, speed=SPEED),
    "rod": lambda: sc.plot_motion("rod", CRANK, ROD, speed=SPEED),
    "convergence": sc.plot_convergence,
    "deviations": sc.plot_deviation,
}


def main(folder: Path) -> None:
    """Draw all of them."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in FIGURES.items():
        figure = np.ravel(draw())[0].figure
        path = folder / f"slider_crank_{name}.png"
        figure.savefig(path, dpi=120)
        plt.close(figure)
        print(f"drawn: {path}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out"))
