"""Joint forces and driving torque of four-bars that turn: all of them, or their peaks."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
import spaces
from assur import metric
from rivals import newton_euler
from rivals.newton_euler import COUPLER, CRANK, FORCE, ROCKER, SPEED
from subject import OURS, Case, Contender, Subject, installed, turn

if TYPE_CHECKING:
    from subject import Float

PINS = (("A", "crank"), ("B", "coupler"), ("C", "rocker"), ("D", "rocker"))
# Forces are up to some thousand newtons, and lose the digits of the positions' condition.
TOLERANCE = 1e-6


def case(quick: bool) -> Case:
    designs, positions = (40, 36) if quick else (1_000, 360)
    return Case("forces", "position", {"": partial(subject, designs, positions)}, plotted=False)


def subject(designs: int, positions: int) -> Subject:
    space, q = spaces.turning_four_bars(designs), turn(positions)
    links = {"crank": CRANK, "coupler": COUPLER, "rocker": ROCKER}
    bodies = {
        link: assur.Body(mass=m, inertia=inertia, at=at)
        for link, (m, inertia, *at) in links.items()
    }
    loads = [assur.Gravity(), assur.Force("C", FORCE, on="rocker")]
    batch = space.batch()
    machine = assur.Machine(batch, bodies=bodies, loads=loads)
    drawn = assur.Machine(space.mechanism, bodies=bodies, loads=loads)
    asked = {joint: metric.peak_reaction(joint, on=on, speed=SPEED) for joint, on in PINS}
    asked["effort"] = metric.peak_effort(speed=SPEED)
    solved_forces = np.empty((designs, positions, 9))
    few = min(designs, 100)

    def answer(reactions: assur.Reactions) -> list[Float]:
        forces = [reactions.joint(joint, on=on) for joint, on in PINS]
        return [*(force[..., axis] for force in forces for axis in (0, 1)), reactions.driver]

    def columns(solved: Float) -> list[Float]:
        return [solved[..., k] for k in range(9)]

    contenders: dict[str, Contender] = {
        OURS: Contender(lambda: machine.reactions(q, SPEED), answer),
        f"{OURS}, five peaks": Contender(
            lambda: assur.sweep(drawn, space.columns, q, metrics=asked)
        ),
        f"{OURS}, positions and two analogues": Contender(lambda: batch.solve(q, order=2)),
        "NumPy, nine equations": Contender(
            lambda: newton_euler.solve(space.values[:, :few], q), columns, few
        ),
    }
    if installed("numba"):
        from rivals import newton_euler_numba

        def by_numba() -> Any:
            newton_euler_numba.solve(space.values, q, solved_forces)
            return solved_forces

        contenders["numba, nine equations"] = Contender(by_numba, columns)
    return Subject(designs, positions, contenders, designs * positions, tolerance=TOLERANCE)
