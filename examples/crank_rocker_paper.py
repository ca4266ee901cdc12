"""Figures of the paper on the crank-rocker with friction, drawn into a folder (default: out).

V. K. Manzhosov and T. E. Petrova: zone of existence (figure 3), push and pull (4), least
transmission angle (5), transmission angle over the crank's (6), successive positions of the
mechanism that changes its structure (8), and its support and transmission angle meanwhile.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from assur import crank_rocker as cr

CRANK, COUPLER, ROCKER = 1.0, 4.5, 1.5
GROUNDS = (4.8, 4.85, 4.9, 4.95, 4.995)
LEAST = 0.2  # rad


def jammed() -> cr.JammingRun:
    """Return a turn with l₄ = 4.995, for which the friction is too great near φ₁ = 0."""
    start = math.radians(-60.0)
    return cr.run(CRANK, COUPLER, ROCKER, GROUNDS[-1], gamma_min=LEAST, phi0=start)


FIGURES: dict[str, Any] = {
    "zone": lambda: cr.plot_zone(coupler=4.0, gamma_min=LEAST),
    "push_and_pull": lambda: cr.plot_push_and_pull(CRANK, COUPLER, ROCKER, GROUNDS[0]),
    "least_angle": cr.plot_least_angle,
    "transmission": lambda: cr.plot_transmission(CRANK, COUPLER, ROCKER, GROUNDS, gamma_min=LEAST),
    "successive_positions": lambda: jammed().plot(),
    "support": lambda: jammed().plot("ground"),
    "jammed_angle": lambda: jammed().plot("angle"),
}


def main(folder: Path) -> None:
    """Draw all of them."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, draw in FIGURES.items():
        figure = np.ravel(draw())[0].figure
        path = folder / f"crank_rocker_{name}.png"
        figure.savefig(path, dpi=120)
        plt.close(figure)
        print(f"drawn: {path}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out"))
