"""Figures of the paper on flywheels, drawn into a folder (default: out).

I. M. Matsyuk and E. M. Shlyakhov: reduced moment and inertia of a press (figure 2), its speed over
a turn without a flywheel (3), over the time with the one that keeps it within 1/8 (4); and
Wittenbauer's diagram of the same, which the paper does not draw.
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
    """Figure 2: reduced moment and inertia over the crank's angle."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    q = np.linspace(0.0, 2.0 * np.pi, 361)
    press = without()
    curves = (
        (press.reduced_moment(q), MOMENT, "M, N·m"),
        (press.reduced_inertia(q), INERTIA, "I, kg·m²"),
    )
    for ax, (curve, rows, label) in zip(axes, curves, strict=True):
        ax.plot(q, curve, color="#0072B2")
        ax.plot(PHI, rows, "o", color="#D55E00", markersize=4)
        ax.set(xlabel="φ, rad", ylabel=label)
    return figure


def speed_without() -> Any:
    """Figure 3: the speed over the crank's angle, no flywheel."""
    return without().plot("speed").figure


def speed_with() -> Any:
    """Figure 4: the speed over the time, δ = 1/8."""
    return with_flywheel().plot("time").figure


def energy_mass() -> Any:
    """Wittenbauer's diagram and its two tangents."""
    return with_flywheel().plot("energy-mass").figure


FIGURES = {
    "table": table,
    "speed_without": speed_without,
    "speed_with": speed_with,
    "energy_mass": energy_mass,
}


def main(folder: Path) -> None:
    """Draw all figures."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in FIGURES.items():
        path = folder / f"flywheel_{name}.png"
        figure = draw()
        figure.savefig(path, dpi=110)
        plt.close(figure)
        print(f"drawn: {path}")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path("out"))
