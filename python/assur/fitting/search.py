"""`assur.search`: the linkage that draws a path, its structure and its dimensions."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur._validate import checked_name
from assur.errors import AssurWarning, InputError
from assur.fitting.conflicts import nothing_found
from assur.fitting.effort import checked_effort, evolve, reporter
from assur.fitting.fits import Fits
from assur.fitting.measured import Spent, measured
from assur.fitting.naming import check_name
from assur.fitting.sensitivity import perturbed_errors
from assur.fitting.target import PathTarget, checked_target
from assur.fitting.wanted import Wanted, checked_wanted, started

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur import _core
    from assur.fitting.effort import Effort, Progress, Report
    from assur.fitting.linkage import LinkageFit
    from assur.fitting.measured import Found

__all__ = ["search"]


def search(
    targets: Mapping[str, npt.ArrayLike],
    *,
    joints: int = 12,
    min_apex_angle: float = math.pi / 9.0,
    frame: float = 20.0,
    min_arc: float = math.pi / 2.0,
    closed: bool | None = None,
    joint_price: float = 0.02,
    robust: float | None = None,
    time_limit: float = 10.0,
    evaluations: int | None = None,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress = False,
) -> Fits[LinkageFit]:
    """Find linkages that draw a path: their structure and their dimensions.

    Each has one crank, which goes round, and dyads of bars. Random linkages come first; the most
    alike of them evolve, by exact derivatives and by changes of their structure. What is returned
    was measured and proved anew by the solver, over the whole turn.

    Parameters
    ----------
    targets : mapping of str to array_like
        The traced joint's name, and the points of its path in order, (N, 2), m: ``{"P": points}``.
        The path is the line through them; it may cross itself and go back.
    joints : int
        The greatest number of joints, 4 to 40. With more the path gets nearer, and the lengths
        need more accuracy.
    min_apex_angle : float
        The least angle between the two bars of a dyad over the whole turn, rad, below π/2: the
        least transmission angle. 20° by default.
    frame : float
        Diameter of the circle about the path's centroid that no joint leaves over the whole turn,
        in root mean square radii of the path. Without it a huge linkage wins with any curve.
    min_arc : float
        The least turn of the crank over an open path, rad, at most 6. A quarter turn by default.
    closed : bool, optional
        Whether the last point leads back to the first, and the path takes the whole turn. By
        default it does if these two are the same.
    joint_price : float
        By which part a further joint must lower the error; 0 to less than 1.
    robust : float, optional
        A relative tolerance of lengths, 1e-3: the linkages are then ranked by the greatest error
        after one length has changed by so much of itself, not by the error alone.
    time_limit : float
        Time for all of it, s. The start takes some tenths of a second, however short the limit.
    evaluations : int, optional
        In place of the time: about how many linkages to evaluate. The start takes up to some
        40 000, and a second of a core some 40 000. The same seed then gives the same bits on any
        machine.
    seed : int
        Another one gives other linkages.
    threads : int, optional
        Maximum number of threads; by default one per core.
    progress : bool or callable
        Called after every tenth of a second or so with the part that is done, 0 to 1, and the least
        value so far (near the error); True shows a bar (needs tqdm).

    Returns
    -------
    Fits
        Different linkages, the best first. Each `Fit` has its mechanism, its errors over
        the path's root mean square radius, the proof, and its sensitivity.

    Raises
    ------
    InputError
        For meaningless arguments; the message has the number and says what to do.
    FitError
        If no linkage keeps all conditions: the message says which of them is in the way.

    Warns
    -----
    AssurWarning
        After Ctrl-C: what has been found by then is returned. A Ctrl-C in the start raises
        KeyboardInterrupt.

    Examples
    --------
    >>> import assur
    >>> hook = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
    >>> found = assur.search({"P": hook}, joints=8, evaluations=1)
    >>> best = found[0]
    >>> best.error < 0.1, best.joints <= 8, best.mechanism.limits().full_rotation
    (True, True, True)
    >>> axes = best.mechanism.plot()
    """
    joint, points = _one_path(targets)
    target = checked_target(joint, points, closed)
    wanted = checked_wanted(
        target, joints, min_apex_angle, frame, min_arc, joint_price, robust, seed, threads
    )
    effort = checked_effort(time_limit, evaluations)
    core = started(target, wanted)
    course = Course(core, target, wanted)
    with reporter(progress) as report:
        core.start()
        return course.run(effort, report, apart=True)


@dataclass(slots=True)
class Course:
    """A search that can go on."""

    core: _core.PathSearch
    target: PathTarget
    wanted: Wanted
    # Time that it has taken so far, s.
    elapsed: float = 0.0

    def run(self, effort: Effort, report: Report, apart: bool) -> Fits[LinkageFit]:
        """Let linkages evolve, then finish, measure and rank them."""
        found: list[Found] = []
        try:
            if apart:
                evolve(self.core, effort, report, apart=True)
                # Together the best displace what is different.
                found = self.core.finish()
            evolve(self.core, effort, report, apart=False)
            found = [*self.core.finish(), *found]
        except KeyboardInterrupt:
            self._say_interrupted(effort)
            found = [*self.core.finish(), *found]
        self.elapsed += effort.elapsed
        spent = Spent(self.elapsed, self.core.evaluations)
        fits, rejected = measured(found, self.target, self.wanted, spent)
        if not fits:
            raise nothing_found(self.target, self.wanted, rejected, spent)
        fits.sort(key=self._rank)
        report(1.0, fits[0].error)
        return Fits(fits, rejected, self._resume)

    def _rank(self, fit: LinkageFit) -> tuple[float, float]:
        """Return what the linkages are ranked by, and what decides between equal ones."""
        price = (1.0 + self.wanted.joint_price) ** fit.joints
        if self.wanted.robust is None:
            return price * fit.error, 0.0
        errors = perturbed_errors(fit.mechanism, fit.arc, self.target, self.wanted.robust)
        return price * max(fit.error, *errors.values()), price * fit.error

    def _resume(self, time_limit: Any, evaluations: Any, progress: Any) -> Fits[LinkageFit]:
        effort = checked_effort(time_limit, evaluations, self.core.evaluations)
        with reporter(progress) as report:
            return self.run(effort, report, apart=False)

    def _say_interrupted(self, effort: Effort) -> None:
        message = (
            f"the search was interrupted after {self.elapsed + effort.elapsed:.3g} s: what it had "
            "found by then is returned; resume() goes on"
        )
        warnings.warn(message, AssurWarning, stacklevel=4)


def _one_path(targets: Any) -> tuple[str, Any]:
    """Return the one traced joint and its points."""
    if not isinstance(targets, Mapping) or len(targets) != 1:
        message = f"targets is {short(targets)}: the path of one joint is needed, {{'P': points}}"
        raise InputError(message)
    ((name, points),) = targets.items()
    joint = checked_name(name, "targets")
    check_name(joint)
    return joint, points
