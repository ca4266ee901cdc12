"""The first run: two mechanisms described, solved over a turn, printed and drawn.

The crank-rocker of Manzhosov and Petrova (crank 1, coupler 4.5, rocker 1.5,
ground 4.8) and the slider-crank of Chernysh et al. (crank 0.11 m, rod 0.407 m).
"""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
import numpy as np

import assur

mpl.use("Agg")
import matplotlib.pyplot as plt

OUT = Path(__file__).resolve().parent.parent / "out"


def crank_rocker() -> assur.Mechanism:
    """Describe the crank-rocker by its lengths."""
    return assur.FourBar(crank=1.0, coupler=4.5, rocker=1.5, ground=4.8)


def engine() -> assur.Mechanism:
    """Describe the slider-crank by a drawing: any place of A and B with these lengths."""
    crank, rod = 0.11, 0.407
    return assur.Mechanism(
        joints={"O": (0, 0), "A": (0, crank), "B": (np.sqrt(rod**2 - crank**2), 0)},
        links={"ground": ["O"], "crank": ["O", "A"], "rod": ["A", "B"], "piston": ["B"]},
        slides={"bore": assur.Slide("piston", on="ground", angle=0.0, origin="O")},
        driver="crank",
    )


def table(
    title: str, names: tuple[str, ...], degrees: np.ndarray, columns: list[np.ndarray]
) -> None:
    """Print columns over the crank angle."""
    print(f"\n{title}\n{'q, deg':>8}" + "".join(f"{name:>12}" for name in names))
    for row, q in enumerate(degrees):
        print(f"{q:8.0f}" + "".join(f"{column[row]:12.6f}" for column in columns))


def draw(motion: assur.Motion, joint: str, curves: assur.Analogues, name: str, file: str) -> None:
    """Draw the mechanism with a path beside a quantity with its two analogues."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
    motion.plot(joint, ax=left)
    degrees = np.rad2deg(motion.q)
    for label, values in ((name, curves.value), (f"{name}'", curves.d1), (f"{name}''", curves.d2)):
        right.plot(degrees, values, label=label)
    right.set_xticks(range(0, 361, 60))
    right.set_xlabel("crank angle q, deg")
    right.grid(alpha=0.3)
    right.legend()
    left.set_title(motion.mechanism.structure.formula)
    right.set_title(f"{name} and its analogues")
    path = OUT / file
    figure.savefig(path, dpi=120)
    plt.close(figure)
    print(f"drawn: {path}")


def main() -> None:
    """Run the first example."""
    OUT.mkdir(exist_ok=True)
    few = np.arange(0.0, 360.0, 45.0)
    many = np.deg2rad(np.linspace(0.0, 360.0, 361))

    four_bar, slider_crank = crank_rocker(), engine()
    motion = four_bar.solve(np.deg2rad(few))
    rocker, gamma = motion.link("rocker"), motion.transmission_angle("C")
    table(
        f"Crank-rocker, {four_bar.structure.formula} (angles in rad)",
        ("rocker", "rocker'", "rocker''", "gamma"),
        few,
        [rocker.value, rocker.d1, rocker.d2, gamma],
    )
    motion = slider_crank.solve(np.deg2rad(few))
    bore, rod = motion.slide("bore"), motion.link("rod")
    table(
        f"Slider-crank, {slider_crank.structure.formula} (slider, m; rod's angle, rad)",
        ("bore", "bore'", "bore''", "rod", "rod'"),
        few,
        [bore.value, bore.d1, bore.d2, rod.value, rod.d1],
    )
    print()
    motion = four_bar.solve(many)
    draw(motion, "C", motion.link("rocker"), "rocker", "crank_rocker.png")
    motion = slider_crank.solve(many)
    draw(motion, "B", motion.slide("bore"), "bore", "slider_crank.png")


if __name__ == "__main__":
    main()
