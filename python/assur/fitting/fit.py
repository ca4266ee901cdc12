"""`assur.fit`: the dimensions of a mechanism for a task."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from assur import _core
from assur._arrays import flag, short
from assur._validate import checked_threads, whole_number
from assur.errors import AssurWarning, InputError
from assur.fitting.designs import Asked, measured_designs, no_design
from assur.fitting.effort import checked_effort, reporter
from assur.fitting.fits import Fits
from assur.fitting.goals import checked_goals
from assur.fitting.limits import checked_limits, guards, taken
from assur.fitting.variables import checked_variables
from assur.fitting.wanted import MOST_SEED
from assur.kinematics.model import MechanismModel

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    import numpy.typing as npt

    from assur.fitting.design import DesignFit
    from assur.fitting.effort import Effort, Progress
    from assur.fitting.goals import Goal
    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps.terms import Condition

__all__ = ["fit"]

# Assemblies of more dyads are too many to try: that of the drawing is taken.
MOST_SIGNS = 6
# A fit ends once so many descents, in so many rounds at least, have led to the best design.
AGREEING, ROUNDS = 20, 4


def fit(
    mechanism: Mechanism,
    targets: Mapping[str, Any],
    *,
    vary: str | Iterable[str] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    ties: Iterable[tuple[Any, ...]] = (),
    where: Iterable[Condition] = (),
    timing: npt.ArrayLike | None = None,
    closed: bool | None = None,
    similarity: bool | str = False,
    full_rotation: bool | None = None,
    robust: float | None = None,
    time_limit: float = 10.0,
    evaluations: int | None = None,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress = False,
) -> Fits[DesignFit]:
    """Find dimensions with which a mechanism does a task.

    Random designs that move are placed where they are most alike the target; the best of them
    descend by damped least squares with exact derivatives, in all assemblies. What is returned
    was measured and proved anew by the solver.

    Parameters
    ----------
    mechanism : Mechanism
        One design with one driver: its joints, links and slides. Its own dimensions matter for
        what does not vary, and for what has neither a path nor bounds.
    targets : mapping of str to target
        What it is to do, by name: points (N, 2), m, for a joint; a pair (coordinates, values) for
        a link's angle, rad, a slide, m, or a coordinate ``"P.x"``; poses (N, 3) for a link; or
        the classes of `assur.target`, which say more. With several, residuals are added.
    vary : str or iterable of str, optional
        Dimensions that change, by name or pattern (``"coupler.*"``); all by default.
    bounds : mapping of str to (float, float), optional
        Least and greatest value of dimensions, by name or pattern; the last that matches counts.
        By default lengths are from 0.001 to 40 root mean square radii of the target.
    ties : iterable of tuple
        ``("rocker.length", "coupler.length")`` makes the first equal to the second, a third entry
        is a factor: -1.0 makes them symmetric.
    where : iterable of Condition
        Conditions on metrics over the travel, ``metric.min_transmission_angle("C") > 0.7``.
    timing : array_like, optional
        The driver's coordinate at each point of a path or at each pose, (N,), rad or m.
    closed : bool, optional
        Whether a path leads from the last point to the first; by default if these are the same.
    similarity : bool or "place"
        Whether a path may be moved, turned and scaled; ``"place"`` moves and turns the mechanism
        as a whole, beside its dimensions.
    full_rotation : bool, optional
        Whether the driver must turn fully. By default for paths, not for functions and poses:
        these need the travel from the first position to the last.
    robust : float, optional
        A relative tolerance of lengths, 1e-3: designs are then ranked by the greatest error after
        one length has changed by so much of itself.
    time_limit : float
        Time for all of it, s. A fit ends earlier when many starts have led to the best design.
    evaluations : int, optional
        In place of the time: about how many designs to evaluate; a round has some 5 000. The same
        seed then gives the same bits on any machine.
    seed : int
        Another one gives other starts.
    threads : int, optional
        Maximum number of threads; by default one per core.
    progress : bool or callable
        Called after every round with the part that is done, 0 to 1, and the least error so far;
        True shows a bar (needs tqdm).

    Returns
    -------
    Fits
        Up to 16 different designs, the best first: each a `DesignFit`.

    Raises
    ------
    InputError
        For meaningless arguments; the message has the name and says what to do.
    FitError
        If no design keeps all conditions: the message says which is missed, and by how much.

    Warns
    -----
    AssurWarning
        After Ctrl-C: what has been found by then is returned.

    Examples
    --------
    A four-bar whose point P goes through five points, wherever it is placed:

    >>> import assur
    >>> from assur import metric
    >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
    >>> arch = [(0.0, 0.0), (0.5, 0.4), (1.0, 0.5), (1.5, 0.4), (2.0, 0.0)]
    >>> found = assur.fit(m, {"P": arch}, evaluations=1)
    >>> found[0].error < 0.01
    True

    The rocker as a function of the crank, rad:

    >>> import numpy as np
    >>> theta = np.linspace(1.0, 2.0, 11)
    >>> found = assur.fit(m, {"rocker": (theta, 1.0 + 0.3 * np.sin(theta))}, evaluations=1)
    >>> found[0].error < 0.01
    True
    """
    given: object = mechanism
    if not isinstance(given, MechanismModel):
        message = f"mechanism is {short(given)}: a Mechanism is needed"
        raise InputError(message)
    if mechanism.shape:
        message = f"mechanism is a batch of designs {mechanism.shape}: one design is needed"
        raise InputError(message)
    if mechanism.driver_count != 1:
        message = f"mechanism has {mechanism.driver_count} drivers: fit is for one"
        raise InputError(message)
    if any(mechanism.core.redundant):
        names = ", ".join(repr(one) for of in mechanism.core.redundant for one in of)
        message = f"{names} is redundant: changing one dimension alone would break its fit"
        raise InputError(message)
    goals, metrics = checked_goals(mechanism, targets, timing, closed, similarity)
    size = max([goal.radius for goal in goals if goal.in_radii], default=drawn_size(mechanism))
    variables = checked_variables(mechanism, vary, bounds, ties, size)
    limits, must_turn = checked_limits(mechanism, where)
    goes_round = any(goal.goes_round for goal in goals) or not goals
    is_slide = isinstance(mechanism.driver, str) and mechanism.driver in mechanism.slides
    if is_slide:
        _refuse_for_slides(goals, mechanism.driver, full_rotation)
        goes_round = False
    turns = goes_round if full_rotation is None else flag(full_rotation, "full_rotation")
    if not (goals or turns or must_turn):
        message = (
            "full_rotation=False: metrics alone are measured over a whole turn; leave it out, or "
            "add a path, a function or poses"
        )
        raise InputError(message)
    asked = Asked(
        mechanism=mechanism,
        goals=goals,
        metrics=metrics,
        limits=limits,
        variables=variables,
        assemblies=_assemblies(mechanism),
        full_rotation=turns or must_turn,
        robust=None if robust is None else _tolerance(robust),
        seed=whole_number(seed, "seed", 0, MOST_SEED),
    )
    core = _core.Fit(
        mechanism.core,
        variables.base,
        variables.each,
        [goal.parts for goal in goals],
        [
            *(limit.parts for limit in (*limits, *guards(mechanism, limits))),
            *(
                (taken(mechanism, near.metric), "near", near.value, near.unit or 1.0)
                for near in metrics.values()
            ),
        ],
        [[sign for _, sign in assembly] for assembly in asked.assemblies],
        asked.full_rotation,
        asked.seed,
        checked_threads(threads),
    )
    effort = checked_effort(time_limit, evaluations)
    with reporter(progress) as report:
        return Course(core, asked).run(effort, report)


@dataclass(slots=True)
class Course:
    """A fit that can go on."""

    core: _core.Fit
    asked: Asked
    # Time that it has taken so far, s.
    elapsed: float = 0.0

    def run(self, effort: Effort, report: Any) -> Fits[DesignFit]:
        """Do rounds, then measure and rank what they found."""
        try:
            rounds = 0
            while True:
                self.core.round()
                rounds += 1
                part = effort.part(self.core)
                report(min(part, 1.0), self.core.best())
                if part >= 1.0 or (rounds >= ROUNDS and self.core.is_settled(AGREEING)):
                    break
        except KeyboardInterrupt:
            message = (
                f"the fit was interrupted after {self.elapsed + effort.elapsed:.3g} s: what it had "
                "found by then is returned; resume() goes on"
            )
            warnings.warn(message, AssurWarning, stacklevel=3)
        self.elapsed += effort.elapsed
        spent = (self.elapsed, self.core.evaluations)
        found, nearest = self.core.found()
        fits, rejected = measured_designs(found, self.asked, spent)
        if not fits:
            raise no_design(nearest, self.asked, rejected, spent)
        return Fits(fits, rejected, self._resume)

    def _resume(self, time_limit: Any, evaluations: Any, progress: Any) -> Fits[DesignFit]:
        effort = checked_effort(time_limit, evaluations, self.core.evaluations)
        with reporter(progress) as report:
            return self.run(effort, report)


def _refuse_for_slides(goals: list[Goal], driver: Any, full_rotation: Any) -> None:
    """Refuse what a slide cannot do as a driver: turn, or be sought over a turn."""
    if full_rotation:
        message = f"full_rotation: the driver {driver!r} is a slide, which does not turn"
        raise InputError(message)
    for goal in goals:
        if goal.parts[2] in ("ordered", "free"):
            message = (
                f"targets[{goal.name!r}]: the driver {driver!r} is a slide: say by timing= which "
                "value it has at each position, or drive a link"
            )
            raise InputError(message)
    if not goals:
        message = f"targets: metrics alone need a driver that turns, and {driver!r} is a slide"
        raise InputError(message)


def _assemblies(m: Mechanism) -> list[list[tuple[str, int]]]:
    """Return all combinations of signs, that of the drawing first."""
    drawn = list(m.core.assembly)
    if len(drawn) > MOST_SIGNS:
        return [drawn, [(name, -sign) for name, sign in drawn]]
    return [
        [
            (name, sign if choice >> place & 1 == 0 else -sign)
            for place, (name, sign) in enumerate(drawn)
        ]
        for choice in range(1 << len(drawn))
    ]


def drawn_size(m: Mechanism) -> float:
    """Return the size of a drawing, m."""
    places = list(m.joints.values())
    sides = [max(axis) - min(axis) for axis in zip(*places, strict=True)]
    return float(max(*sides)) or 1.0


def _tolerance(robust: Any) -> float:
    if isinstance(robust, int | float) and 0.0 < robust < 0.1:
        return float(robust)
    message = f"robust is {short(robust)}: a relative tolerance above 0 and below 0.1 is needed"
    raise InputError(message)
