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

import assur
from assur import slider_crank as sc

# Of the size of the paper's example; it prints no lengths.
CRANK, ROD, SPEED = 0.11, 0.407, 31.0  # m, m, rad/s
ANGLE = np.radians(60.0)
PHI = np.linspace(0.0, 2 * np.pi, 721)
BLUE, RED, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "0.6"


def contour() -> Any:
    """Figure 2: l₁ + l₂ = l₃."""
    figure, ax = plt.subplots(figsize=(6, 3), layout="constrained")
    o, a, b, _ = sc.contour(float(ANGLE), CRANK, ROD)
    for start, end, name, colour in ((o, a, "l₁", BLUE), (a, b, "l₂", RED), (o, b, "l₃", GREEN)):
        style = {"arrowstyle": "-|>", "color": colour, "linewidth": 2, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", end, start, arrowprops=style)
        middle = (start + end) / 2
        place = (-18, 2) if name == "l₁" else (4, 5)
        ax.annotate(name, middle, xytext=place, textcoords="offset points", color=colour)
    for point, name in ((o, "O"), (a, "A"), (b, "B")):
        ax.plot(*point, "o", color="black", markerfacecolor="white")
        up = 8 if name == "A" else -14
        ax.annotate(name, point, xytext=(-4, up), textcoords="offset points")
    ax.set(xlim=(-0.05, 0.55), ylim=(-0.05, 0.15), aspect="equal", xlabel="x, m", ylabel="y, m")
    return figure


def positions() -> Any:
    """Figure 4: the mechanism at 60° with the paths of A, B and the rod's middle."""
    engine = assur.SliderCrank(CRANK, ROD)
    ax = engine.plot(float(ANGLE))
    ax.figure.set_size_inches(7, 4)
    motion = engine.solve(PHI, order=0)
    middle = sc.rod_point(PHI, CRANK, ROD, along=ROD / 2).value
    for path in (motion.joint("A").value, motion.joint("B").value, middle):
        ax.plot(*path.T, color=GREY, linewidth=1, zorder=0)
    return ax.figure


def diagrams() -> Any:
    """Figures 5 to 10: stroke, speed and acceleration of the slider and of the rod's angle."""
    s, rod = sc.stroke(PHI, CRANK, ROD), sc.rod_angle(PHI, CRANK, ROD)
    rows = (
        (s.value, "s, m"),
        (s.velocity(SPEED), "v, m/s"),
        (s.acceleration(SPEED), "a, m/s²"),
        (rod.value, "φ₂, rad"),
        (rod.velocity(SPEED), "ω₂, rad/s"),
        (rod.acceleration(SPEED), "ε₂, rad/s²"),
    )
    figure, axes = plt.subplots(3, 2, figsize=(8, 7), sharex=True, layout="constrained")
    for ax, (values, name) in zip(axes.T.flat, rows, strict=True):
        ax.plot(np.degrees(PHI), values, color=BLUE)
        ax.axhline(0.0, color=GREY, linewidth=0.6)
        ax.set(ylabel=name, xticks=range(0, 361, 60))
    for ax in axes[-1]:
        ax.set_xlabel("φ, °")
    return figure


def convergence() -> Any:
    """Largest error of the series: over harmonics, and over terms of each coefficient."""
    figure, axes = plt.subplots(1, 2, figsize=(8, 3.5), sharey=True, layout="constrained")
    counts = np.arange(1, 9)
    for k, colour in ((1.5, RED), (3.0, GREEN), (5.0, BLUE)):
        exact = sc.stroke(PHI, 1.0, k).value
        for ax, kept in zip(axes, (False, True), strict=True):
            errors = [
                np.abs(
                    sc.stroke(
                        PHI,
                        1.0,
                        k,
                        "series",
                        harmonics=2 * n if not kept else 2 * 8,
                        terms=int(n) if kept else None,
                    ).value
                    - exact
                ).max()
                for n in counts.tolist()
            ]
            ax.semilogy(counts, errors, "o-", color=colour, label=f"k = {k:g}")
    axes[0].set(xlabel="even harmonics kept, all terms", ylabel="largest error / crank")
    axes[1].set(xlabel="terms kept, all harmonics")
    axes[1].legend()
    return figure


def deviations() -> Any:
    """Figures 2 and 3 of the second paper: per cent of the exact value, λ = 1/3."""
    figure, axes = plt.subplots(2, 2, figsize=(8, 6), sharex=True, layout="constrained")
    phi = np.linspace(0.0, np.pi, 1001)[1:-1]
    exact = sc.stroke(phi, 1.0, 3.0)
    for column, n in enumerate((1, 2)):
        near = sc.stroke(phi, 1.0, 3.0, "fraction", n=n)
        pairs = ((near.value, exact.value, "stroke"), (near.d1, exact.d1, "velocity analogue"))
        for row, (a, b, name) in enumerate(pairs):
            ax = axes[row, column]
            ax.plot(np.degrees(phi), 100 * (a / b - 1), color=(BLUE, RED)[row])
            ax.axhline(0.0, color=GREY, linewidth=0.6)
            ax.set(title=f"{name}, n = {n}", xticks=range(0, 181, 30))
    for ax in axes[-1]:
        ax.set_xlabel("φ, °")
    for ax in axes[:, 0]:
        ax.set_ylabel("deviation, %")
    return figure


FIGURES = {make.__name__: make for make in (contour, positions, diagrams, convergence, deviations)}


def main(folder: Path) -> None:
    """Draw all of them."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in FIGURES.items():
        figure = make()
        path = folder / f"slider_crank_{name}.png"
        figure.savefig(path, dpi=120)
        plt.close(figure)
        print(f"drawn: {path}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out"))
