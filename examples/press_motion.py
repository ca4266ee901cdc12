"""A press that a motor starts: its motion, the periodic one it comes to, and the flywheel for it.

Drawn into a folder (default: out).
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

import assur

# Resistance of the work over the crank's angle, N: the piston presses on its way to the frame.
WORK = assur.Table([0.0, 1.8, 2.9, 3.1, 2 * np.pi], [0.0, 0.0, 12000.0, 0.0, 0.0], spline="linear")
# On the stroke of 0.16 m the work is some 400 J a turn; the motor turns 12 times as fast.
MOTOR = assur.InductionMotor(
    breakdown=32.0, slip=0.25, synchronous=157.08, ratio=12.0, rotor_inertia=0.01
)


def press() -> assur.Machine:
    """Return the press."""
    return assur.Machine(
        assur.SliderCrank(crank=0.08, rod=0.3),
        bodies={
            "crank": assur.Body(inertia=0.2),
            "rod": assur.Body(mass=6.0, inertia=0.08, at=(0.1, 0.0)),
            "piston": assur.Body(mass=25.0),
        },
        loads=[assur.Gravity((-9.81, 0.0)), assur.Force("B", (WORK, 0.0))],
        motor=MOTOR,
    )


def draw(machine: assur.Machine) -> Any:
    """Speed over the time from rest, and over a turn in periodic motion."""
    start = machine.run(t_end=3.0, q0=0.0, events=[assur.events.Rest(stop=False)])
    evened = machine.flywheel(fluctuation=0.05)
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4), layout="constrained")
    start.plot("speed", ax=axes[0])
    axes[0].set_title("from rest", loc="right")
    steady = machine.steady_state()
    q = np.linspace(0.0, 2 * np.pi, 721)
    for speed, label, delta in (
        (steady.at(q).speed, "as it is", steady.delta),
        (evened.speed(q), f"with a flywheel of {evened.inertia:.2f} kg·m²", evened.delta),
    ):
        axes[1].plot(q, speed, label=f"{label}: δ = {delta:.3g}")
    axes[1].set_title("Speed, rad/s", loc="left", fontweight="bold")
    axes[1].set_title("periodic", loc="right")
    axes[1].set(xlabel="q, rad")
    axes[1].margins(y=0.5)
    axes[1].legend(loc="upper right")
    return figure


def main(folder: Path) -> None:
    """Draw the picture and say what it shows."""
    machine = press()
    steady = machine.steady_state(mean="period")
    print(
        f"mean speed {steady.mean_speed:.3f} rad/s, δ = {steady.delta:.3f}, "
        f"{steady.motor_work:.1f} J a turn, {steady.power:.0f} W"
    )
    folder.mkdir(parents=True, exist_ok=True)
    draw(machine).savefig(folder / "press_motion.png", dpi=150)
    print(f"drawn: {folder / 'press_motion.png'}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out"))
