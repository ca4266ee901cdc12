"""Figures of the paper on flywheels, drawn into a folder (default: out).

I. M. Matsyuk and E. M. Shlyakhov: reduced moment and inertia of a press (figure 2), its speed over
a turn without a flywheel (3), over the time with the one that keeps it within 1/8 (4); and what
the paper does not draw: moments, energies, and Wittenbauer's diagram of the same.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from assur import flywheel

PHI = np.linspace(0.0, 2.0 * np.pi, 9)
MOMENT = [-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23]
INERTIA = [4.93, 5.07, 5.1, 5.1, 4.93, 5.05, 5.1, 5.14, 4.93]
# The paper does not print it; with this one the greatest speed is the printed 19.649 rad/s.
SPEED0 = 17.971089


def without() -> flywheel.Flywheel:
    """The press by itself."""
    return flywheel.evaluate(PHI, MOMENT, INERTIA, speed0=SPEED0)


def with_flywheel() -> flywheel.Flywheel:
    """The press with the flywheel for δ = 1/8 at 15 rad/s."""
    return flywheel.from_table(PHI, MOMENT, INERTIA, fluctuation=1 / 8, mean_speed=15.0)


def table() -> Any:
    """Figure 2: reduced moment and inertia over the crank's angle, with the rows of the table."""
    axes = without().plot("reduced")
    for ax, rows in zip(axes, (MOMENT, INERTIA), strict=True):
        ax.plot(PHI, rows, "o", color=ax.lines[0].get_color(), markersize=4, gid="rows")
    return axes


FIGURES: dict[str, Any] = {
    "table": table,
    "speed_without": lambda: without().plot("speed"),
    "speed_with": lambda: with_flywheel().plot("time"),
    "moment": lambda: with_flywheel().plot("moment"),
    "energy": lambda: with_flywheel().plot("energy"),
    "energy_mass": lambda: with_flywheel().plot("energy-mass"),
}


def main(folder: Path) -> None:
    """Draw all figures."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in FIGURES.items():
        path = folder / f"flywheel_{name}.png"
        figure = np.ravel(draw())[0].figure
        figure.savefig(path, dpi=110)
        plt.close(figure)
        print(f"drawn: {path}")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path("out"))
