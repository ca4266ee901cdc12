"""`assur.sweep`: many designs, for their motions or for metrics of these."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, overload

from assur._validate import checked_order, checked_threads, one_of, real_array
from assur.description.words import has_analogues
from assur.dynamics.machine import Machine
from assur.errors import InputError
from assur.kinematics import solve as solver
from assur.kinematics.solve_arguments import q_or_deg
from assur.sweeps.degrees import warn_of_degrees
from assur.sweeps.designs import Designs
from assur.sweeps.engine import checked_engine
from assur.sweeps.machine_metrics import warn_of_jumps
from assur.sweeps.measuring import Measuring
from assur.sweeps.motions import Course, Solving, in_blocks, moving
from assur.sweeps.progress import reporter, silent

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    import numpy.typing as npt

    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion
    from assur.kinematics.named_dimensions import DimensionsLike
    from assur.sweeps.engine import Engine
    from assur.sweeps.measures import Measures
    from assur.sweeps.progress import Progress, Report
    from assur.sweeps.terms import Condition, Metric

__all__ = ["sweep"]


@overload
def sweep(
    mechanism: Mechanism,
    dimensions: DimensionsLike,
    q: npt.ArrayLike | None = ...,
    *,
    deg: npt.ArrayLike | None = ...,
    outputs: Iterable[str] | None = ...,
    order: int | None = ...,
    assembly: Mapping[str, int] | None = ...,
    metrics: None = ...,
    where: None = ...,
    gradient: None = ...,
    on_error: Literal["nan", "raise", "drop"] = ...,
    threads: int | None = ...,
    progress: Progress = ...,
    out: Motion | None = ...,
    engine: Engine | None = ...,
) -> Motion: ...
@overload
def sweep(
    mechanism: Mechanism | Machine,
    dimensions: DimensionsLike,
    q: npt.ArrayLike | None = ...,
    *,
    deg: npt.ArrayLike | None = ...,
    assembly: Mapping[str, int] | None = ...,
    metrics: Mapping[str, Metric],
    where: Iterable[Condition | Metric] | None = ...,
    gradient: str | Sequence[str] | None = ...,
    threads: int | None = ...,
    progress: Progress = ...,
    engine: Engine | None = ...,
) -> Measures: ...
def sweep(
    mechanism: Mechanism | Machine,
    dimensions: DimensionsLike,
    q: npt.ArrayLike | None = None,
    *,
    outputs: Iterable[str] | None = None,
    order: int | None = None,
    assembly: Mapping[str, int] | None = None,
    metrics: Mapping[str, Metric] | None = None,
    where: Iterable[Condition | Metric] | None = None,
    gradient: str | Sequence[str] | None = None,
    on_error: Literal["nan", "raise", "drop"] = "nan",
    threads: int | None = None,
    progress: Progress = False,
    out: Motion | None = None,
    engine: Engine | None = None,
    deg: npt.ArrayLike | None = None,
) -> Motion | Measures:
    """Solve many designs of a mechanism, or measure them.

    Parameters
    ----------
    mechanism : Mechanism or Machine
        Of any class; a machine for the metrics of forces, `assur.metric.peak_reaction`.
    dimensions : mapping of str to array_like
        Dimensions of the designs, m or rad, as for `Mechanism.with_dimensions` (a pandas
        DataFrame or an xarray Dataset too): arrays of one length pair, an `assur.Grid` makes
        every combination.
    q : array_like
        Coordinate of the driver, rad or m: as for `Mechanism.solve`; with `metrics` of
        shape (N,), n drivers add a last axis of n.
    outputs : iterable of str, optional
        Names of joints, links and slides to keep; all by default. Not with `metrics`.
    order : {2, 0, 1, 3}, optional
        Highest order of the analogues. Not with `metrics`, which have an order each.
    assembly : mapping of str to int, optional
        Signs of dyads where they differ from the drawing's.
    metrics : mapping of str to metric, optional
        What to measure of each design (see `assur.metric`). Positions are not kept: memory
        does not grow with them.
    where : iterable of Condition, optional
        Conditions on metrics, ``assur.metric.min_transmission_angle("C") > 0.7``, also on their
        sums and multiples. A design that misses one is dropped: after a few positions, if more of
        them cannot change that (a span only grows, a least value only falls). Put the quickest
        first. `metric.full_rotation` and `metric.reachable` are conditions by themselves. Only with
        `metrics`.
    gradient : str or sequence of str, optional
        Dimensions, also as patterns (``"*.length"``), by which the metrics are differentiated as
        well: `Measures.gradient`. For ``min``, ``max``, ``span``, ``mean``, ``rms``,
        ``min_transmission_angle``, ``path_error``, ``function_error``, ``pose_error`` and what is
        made of them. An extreme changes as its coordinate
        does at the position where it is; where another position takes it over there is a bend.
        NaN of an ``rms`` that is 0: a root has no derivative there. Only with `metrics`.
    on_error : {"nan", "raise", "drop"}
        For positions that cannot be solved: NaN, each with its status; an error for the first
        one; or the motion of only those designs that move over all of q, with their indices in
        `Motion.kept`. With `metrics` it is "nan": `Measures.kept` has the indices.
    threads : int, optional
        Maximum number of threads; by default one per core (of each task of an engine: 1).
        Results do not depend on it. Threads share designs, not the positions of one.
    progress : bool or callable, default False
        Called after every block of designs with the number of designs done, and of all; True
        shows a bar (needs tqdm). With "drop" designs that do not move are done first.
    out : Motion, optional
        A motion of the same call: overwritten. Not with `metrics`.
    engine : optional
        Where blocks of designs are solved: a Dask client, a
        `concurrent.futures.ProcessPoolExecutor`, or anything with ``submit(function, argument)``
        that returns a future. Results are the same bits. Functions in `metrics` must be picklable.
    deg : array_like, optional
        The coordinates in degrees, in place of `q`.

    Returns
    -------
    Motion or Measures
        Arrays of shape S + (N,), of one design shape S; or, with `metrics`, arrays of shape S
        by name, with ``.status`` and ``.kept``.

    Raises
    ------
    InputError
        For meaningless arguments, as for `Mechanism.solve` and the metrics.
    DimensionError
        For one design (S is ``()``) whose dimensions are invalid; in a batch it has
        ``Status.BAD_DIMENSION``.
    PositionError
        With ``on_error="raise"``, for the first position that has no solution.
    AssurError
        If a task of an engine fails; the message names its designs.

    Examples
    --------
    The straightest path of a coupler point among four-bars that transmit well:

    >>> import assur, numpy as np
    >>> four_bar = assur.Mechanism(
    ...     joints={"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0), "P": (3, 4)},
    ...     links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
    ...     driver="crank",
    ... )
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> rng = np.random.default_rng(1)
    >>> space = {name: rng.uniform(1.5, 5, 2000) for name in ("coupler.length", "rocker.length")}
    >>> found = assur.sweep(
    ...     four_bar, space, q,
    ...     metrics={"off": assur.metric.deviation("P", shape="line", relative=True)},
    ...     where=[assur.metric.min_transmission_angle("C") > np.radians(40)],
    ... )
    >>> bool(0.0 < np.nanmin(found["off"]) < 0.02)
    True
    """
    machine = mechanism if isinstance(mechanism, Machine) else None
    designs = Designs(machine.mechanism if machine else mechanism, dimensions, assembly)
    q = q_or_deg(designs.mechanism, q, deg, "sweep")
    one_of(on_error, ("nan", "raise", "drop"), "on_error")
    engine, threads = checked_engine(engine), checked_threads(threads)
    # Each worker of an engine is a core by itself.
    threads = 1 if threads is None and engine is not None else threads
    if metrics is None:
        if machine is not None:
            message = "a machine is for metrics=; motions need machine.mechanism"
            raise InputError(message)
        if where is not None:
            message = "where= is for metrics=; on_error='drop' keeps the designs that move"
            raise InputError(message)
        if gradient is not None:
            message = "gradient= is for metrics=; of a motion there is motion.jacobian(name, by=…)"
            raise InputError(message)
        every = checked_order(2 if order is None else order)
        solving = Solving(every, outputs, threads)
        warn_of_degrees(designs.mechanism, real_array(q, "q", copy=False))
        with reporter(progress, designs.count) as report:
            return _motions(designs, q, solving, on_error, out, report, engine)
    _refuse_for_metrics(outputs=outputs, order=order, out=out)
    if on_error != "nan":
        message = (
            f"on_error={on_error!r} is for motions; with metrics= designs that do not move have "
            "NaN and a status, and .kept has the indices of the others"
        )
        raise InputError(message)
    measuring = Measuring(designs.mechanism, machine, q, metrics, where, threads, gradient)
    warn_of_degrees(designs.mechanism, measuring.q, measuring)
    if machine is not None:
        warn_of_jumps(measuring.functions, machine)
    with reporter(progress, designs.count) as report:
        return measuring.run(designs, report, engine)


def _refuse_for_metrics(**options: object) -> None:
    for name, value in options.items():
        if value is not None:
            message = f"{name}= is for motions, not for metrics="
            if name == "order":
                message += ": each metric has an order of its own, metric.span('rocker', order=1)"
            raise InputError(message)


def _motions(
    designs: Designs,
    q: npt.ArrayLike,
    solving: Solving,
    on_error: str,
    out: Motion | None,
    report: Report,
    engine: Any,
) -> Motion:
    every = designs.all()
    if on_error == "drop":
        return _moving(designs, Course(every, q), solving, out, report, engine)
    course = Course(every, q)
    # One call writes everything where blocks are not needed.
    reports = engine is not None or report is not silent
    if reports and designs.shape and designs.count:
        motion = in_blocks(designs, every, course, solving, out, report, engine)
    else:
        motion = solving.solve((every, course.whole), out)
        report(designs.count)
    if on_error == "raise" and not has_analogues(motion.status).all():
        # It raises the first failure, and counts the others.
        solver.solve(every, q, solving.order, (), None, "raise", solving.threads, None)
    return motion


def _moving(
    designs: Designs,
    course: Course,
    solving: Solving,
    out: Motion | None,
    report: Report,
    engine: Any,
) -> Motion:
    """Solve the designs that move over all of q, in a first pass for their statuses alone."""
    kept = moving(designs, course, solving, report, engine)
    some = Designs(designs.some(kept), {})
    dropped = designs.count - len(kept)
    rest = silent if report is silent else lambda done: report(dropped + done)
    motion = _motions(some, course.of(kept), solving, "nan", out, rest, engine)
    motion.kept = kept
    return motion
