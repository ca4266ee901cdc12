"""Figures of the paper on the crank-rocker with friction, drawn into a folder (default: out).

V. K. Manzhosov and T. E. Petrova: zone of existence (figure 3), push and pull (4), least
transmission angle (5), transmission angle over the crank's (6), successive positions of the
mechanism that changes its structure (8).
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from assur import crank_rocker as cr

COUPLER, ROCKER = 4.5, 1.5
GROUNDS = (4.8, 4.85, 4.9, 4.95, 4.995)
LEAST = 0.2  # rad
BLUE, RED, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "0.6"


def zone() -> Any:
    """Figure 3: grounds for which the crank turns, l₂ = 4, margins 0.05; with friction too."""
    figure, ax = plt.subplots(figsize=(5, 4), layout="constrained")
    rockers = np.linspace(1.05, 4.0, 60)
    ends = np.array([cr.ground_range(4.0, float(l3)) for l3 in rockers])
    ax.fill_between(rockers, *ends.T, color=BLUE, alpha=0.25, label="margins 0.05")
    wide = [float(l3) for l3 in rockers if l3 > 1.1]
    friction = np.array([cr.ground_range(4.0, l3, gamma_min=LEAST) for l3 in wide])
    ax.fill_between(wide, *friction.T, color=GREEN, alpha=0.4, label="and γ > 0.2 rad")
    ax.set(xlabel="rocker / crank", ylabel="ground / crank")
    ax.legend(loc="upper left")
    return figure


def push_and_pull() -> Any:
    """Figure 4: the coupler pushes the rocker while its angle grows, and pulls it after."""
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.2), layout="constrained")
    for ax, phi in zip(axes, (1.6, 4.2), strict=True):
        found = cr.solve(phi, 1.0, COUPLER, ROCKER, 4.8)
        b = np.array([math.cos(phi), math.sin(phi)])
        d = np.array([-4.8, 0.0])
        c = d + ROCKER * np.array([math.cos(found.phi3), math.sin(found.phi3)])
        for ends, colour in (((np.zeros(2), b), BLUE), ((b, c), RED), ((c, d), GREEN)):
            ax.plot(*np.array(ends).T, "o-", color=colour, markerfacecolor="white", linewidth=2)
        along = (c - b) / COUPLER * (1.0 if bool(found.pushes) else -1.0)
        style = {"arrowstyle": "-|>", "color": "black", "linewidth": 1.5}
        ax.annotate("", c + 0.8 * along, c, arrowprops=style)
        ax.plot(*(c + 1.1 * along), alpha=0.0)
        name = "pushes" if bool(found.pushes) else "pulls"
        ax.set(title=f"{name}, γ = {float(found.gamma):.3f} rad", aspect="equal")
    return figure


def least_angle() -> Any:
    """Figure 5: γ_min = arcsin f_p; below it nothing is passed on."""
    figure, ax = plt.subplots(figsize=(5, 3.5), layout="constrained")
    reduced = np.linspace(0.0, 0.999, 300)
    least = [cr.least_transmission_angle(float(f), 1.0, 0.0, 0.0, 1.0) for f in reduced]
    ax.plot(reduced, least, color=BLUE)
    ax.fill_between(reduced, 0.0, least, color=GREY, alpha=0.5)
    ax.annotate("blocked", (0.7, 0.2))
    ax.annotate("moves", (0.2, 1.0))
    ax.set(xlabel="f_p", ylabel="γ_min, rad", xlim=(0, 1), ylim=(0, math.pi / 2))
    return figure


def transmission() -> Any:
    """Figure 6: γ₂₃ and γ over φ₁, and where γ is below 0.2 rad."""
    figure, axes = plt.subplots(2, 1, figsize=(6, 6), sharex=True, layout="constrained")
    phi = np.linspace(0.0, 2 * math.pi, 721)
    for ground in GROUNDS:
        found = cr.solve(phi, 1.0, COUPLER, ROCKER, ground)
        for ax, values in zip(axes, (found.gamma23, found.gamma), strict=True):
            ax.plot(np.degrees(phi), values, label=f"l₄ = {ground:g}")
    axes[1].axhspan(0.0, LEAST, color=GREY, alpha=0.4)
    for low, high in cr.blocked(1.0, COUPLER, ROCKER, GROUNDS[-1], LEAST):
        for turn in (0.0, 360.0):
            axes[1].axvspan(
                math.degrees(low) + turn, math.degrees(high) + turn, color=RED, alpha=0.2
            )
    axes[0].set(ylabel="γ₂₃, rad", xlim=(0, 360), xticks=range(0, 361, 60))
    axes[1].set(ylabel="γ, rad", xlabel="φ₁, °", ylim=(0, None))
    axes[0].legend(ncols=2)
    return figure


def successive_positions() -> Any:
    """Figure 8: l₄ = 4.995; red where D slides. The lower picture is D's place over the turn."""
    result = cr.run(1.0, COUPLER, ROCKER, 4.995, gamma_min=LEAST, phi0=math.radians(-60))
    figure, axes = plt.subplots(2, 1, figsize=(8, 6), layout="constrained", height_ratios=(3, 1))
    ax = axes[0]
    for i in range(0, len(result.t), 20):
        colour = RED if result.sliding[i] else GREY
        chain = np.array([[0.0, 0.0], result.B[i], result.C[i], result.D[i]])
        ax.plot(*chain.T, color=colour, linewidth=0.8)
    ax.plot(*result.C.T, color=BLUE, linewidth=1.5)
    ax.set(aspect="equal", xlabel="x", ylabel="y")
    axes[1].plot(np.degrees(result.phi1), -result.D[:, 0], color=BLUE)
    for event in result.events:
        axes[1].axvline(math.degrees(event.phi1), color=RED, linewidth=0.8)
        axes[1].annotate(event.kind, (math.degrees(event.phi1), 4.98), rotation=90, ha="right")
    axes[1].set(xlabel="φ₁, °", ylabel="AD")
    return figure


FIGURES = {
    make.__name__: make
    for make in (zone, push_and_pull, least_angle, transmission, successive_positions)
}


def main(folder: Path) -> None:
    """Draw all of them."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in FIGURES.items():
        figure = make()
        path = folder / f"crank_rocker_{name}.png"
        figure.savefig(path, dpi=120)
        plt.close(figure)
        print(f"drawn: {path}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out"))
