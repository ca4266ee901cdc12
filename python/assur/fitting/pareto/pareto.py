"""`assur.pareto`: designs between several goals."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur._callers import level_of_caller
from assur._validate import checked_threads, whole_number
from assur.dynamics.machine import Machine
from assur.errors import AssurWarning, InputError
from assur.fitting.effort import MOST_EVALUATIONS, checked_effort, reporter
from assur.fitting.pareto.candidates import Candidates
from assur.fitting.pareto.conflict import no_design
from assur.fitting.pareto.evolution import Budget, Evolution
from assur.fitting.pareto.front import ParetoFront
from assur.fitting.pareto.objectives import checked_objectives, undominated
from assur.fitting.pareto.space import bounded_variables
from assur.fitting.wanted import MOST_SEED
from assur.kinematics.mechanism import Mechanism
from assur.kinematics.solve_arguments import q_or_deg
from assur.sweeps.degrees import warn_of_degrees
from assur.sweeps.machine_metrics import warn_of_jumps
from assur.sweeps.measuring import Measuring
from assur.sweeps.progress import silent

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    import numpy.typing as npt

    from assur.fitting.effort import Progress
    from assur.fitting.pareto.objectives import Objective
    from assur.sweeps.terms import Condition, Metric

__all__ = ["pareto"]

# Fewer have nothing to cross; pymoo compares each design with each, in time and memory.
POPULATION = (4, 2_000)


def pareto(
    mechanism: Mechanism | Machine,
    q: npt.ArrayLike | None = None,
    *,
    minimize: Mapping[str, Metric] | None = None,
    maximize: Mapping[str, Metric] | None = None,
    bounds: Mapping[str, tuple[float, float]],
    vary: str | Iterable[str] | None = None,
    ties: Iterable[tuple[Any, ...]] = (),
    where: Iterable[Condition | Metric] = (),
    population: int = 100,
    generations: int = 100,
    evaluations: int | None = None,
    time_limit: float | None = None,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress = False,
    deg: npt.ArrayLike | None = None,
) -> ParetoFront:
    """Find designs between several goals: none is better in one goal without being worse in others.

    A population of designs within the bounds evolves by NSGA-II (needs pymoo); each generation is
    one sweep. The front is that of all generations, its designs spread from end to end. What is
    returned was measured anew by the solver: it keeps all conditions, and no other design returned
    is at least as good in all goals. It is near the true front; more generations bring it nearer.

    Parameters
    ----------
    mechanism : Mechanism or Machine
        One design, in the assembly that all are to have; a machine for the metrics of forces.
    q : array_like
        Coordinate of the driver, rad or m, at which all metrics are measured: (N,), as for
        `assur.sweep`.
    minimize, maximize : mapping of str to metric
        The goals by name, each one of `assur.metric`, to be made small or large. Together two or
        more; beyond three nearly every design is between them.
    bounds : mapping of str to (float, float)
        Least and greatest value of dimensions, m or rad, by name or pattern (``"*.length"``); the
        last that matches counts.
    vary : str or iterable of str, optional
        Dimensions that change, by name or pattern; by default those with bounds.
    ties : iterable of tuple
        ``("rocker.length", "coupler.length")`` makes the first equal to the second, a third entry
        is a factor.
    where : iterable of Condition
        Conditions on metrics, as for `assur.sweep`: ``metric.min_transmission_angle("C") > 0.7``.
    population : int
        Designs of a generation, 4 to 2 000, and the most that the front has in the end. With more
        of them it has smaller gaps.
    generations : int
        How many. The first is chosen among ten times the population, at random.
    evaluations : int, optional
        In place of generations: about how many designs to measure.
    time_limit : float, optional
        Time after which no further generation begins, s.
    seed : int
        Another one gives other designs. The same one gives the same, with the same versions of
        pymoo and NumPy, unless the time ends it.
    threads : int, optional
        Maximum number of threads; by default one per core. Results do not depend on it.
    progress : bool or callable
        Called after every generation with the part that is done, 0 to 1, and the number of designs
        between the goals so far; True shows a bar (needs tqdm).
    deg : array_like, optional
        The coordinates in degrees, in place of `q`.

    Returns
    -------
    ParetoFront
        The designs, the best in the first goal first.

    Raises
    ------
    InputError
        For meaningless arguments; the message has the name and says what to do.
    FitError
        If no design keeps all conditions: the message says which is missed, and by how much.
    ImportError
        Without pymoo.

    Warns
    -----
    AssurWarning
        After Ctrl-C: the front that there is by then is returned. A Ctrl-C in the first generation
        raises KeyboardInterrupt.

    Examples
    --------
    A slider-crank's stroke is twice the crank; the longer it is, the worse it transmits at B:

    >>> import assur, numpy as np
    >>> front = assur.pareto(
    ...     assur.SliderCrank(0.1, 0.4),
    ...     np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False),
    ...     maximize={
    ...         "stroke": assur.metric.span("bore"),
    ...         "angle": assur.metric.min_transmission_angle("B"),
    ...     },
    ...     bounds={"crank.length": (0.05, 0.2), "rod.length": (0.3, 0.5)},
    ...     population=20, generations=10,
    ... )
    >>> bool(front.values["stroke"][0] > front.values["stroke"][-1])
    True
    >>> bool(front.values["angle"][0] < front.values["angle"][-1])
    True
    >>> front[0].solve(0.0).slide("bore").value.shape
    ()
    """
    machine = mechanism if isinstance(mechanism, Machine) else None
    m = machine.mechanism if machine is not None else mechanism
    if not isinstance(m, Mechanism):
        message = f"mechanism is {short(m)}: an assur.Mechanism or an assur.Machine is needed"
        raise InputError(message)
    if m.shape:
        message = f"mechanism is a batch of designs {m.shape}: one design is needed"
        raise InputError(message)
    objectives = checked_objectives(minimize, maximize)
    variables = bounded_variables(m, vary, bounds, ties)
    budget = _budget(generations, evaluations, time_limit)
    size = whole_number(population, "population", *POPULATION)
    sown = whole_number(seed, "seed", 0, MOST_SEED)
    at = q_or_deg(m, q, deg, "pareto")
    goals = {goal.name: goal.metric for goal in objectives}
    measuring = Measuring(m, machine, at, goals, where, checked_threads(threads))
    warn_of_degrees(m, measuring.q, measuring)
    if machine is not None:
        warn_of_jumps(measuring.functions, machine)
    candidates = Candidates(m, machine, objectives, measuring, variables)
    evolution = Evolution(candidates, size, sown)
    with reporter(progress, "designs") as report:
        try:
            evolution.run(budget, report)
        except KeyboardInterrupt:
            if not evolution.generation:
                raise
            message = (
                f"pareto was interrupted after {budget.elapsed:.3g} s, in generation "
                f"{evolution.generation + 1}: the front that there is by then is returned"
            )
            warnings.warn(message, AssurWarning, stacklevel=level_of_caller())
    return _measured(evolution, objectives, budget)


def _budget(generations: Any, evaluations: Any, time_limit: Any) -> Budget:
    count = whole_number(generations, "generations", 1, MOST_EVALUATIONS)
    if time_limit is not None:
        time_limit = checked_effort(time_limit, None).time_limit
    if evaluations is not None:
        evaluations = whole_number(evaluations, "evaluations", 1, MOST_EVALUATIONS)
    return Budget(count, evaluations, time_limit)


def _measured(evolution: Evolution, objectives: list[Objective], budget: Budget) -> ParetoFront:
    """Return the front of all generations, measured anew by one sweep."""
    candidates = evolution.candidates
    places = evolution.archive.front()
    if not len(places):
        raise no_design(candidates, budget)
    measures = candidates.measuring.run(candidates.designs(places), silent)
    if not len(measures.kept):
        raise no_design(candidates, budget)
    costs = [goal.cost(measures[goal.name][measures.kept]) for goal in objectives]
    order = measures.kept[undominated(np.column_stack(costs))]
    return ParetoFront(
        measures.designs(order),
        {goal.name: measures[goal.name][order] for goal in objectives},
        {goal.name: (goal.metric, goal.is_maximized) for goal in objectives},
        seed=evolution.seed,
        generations=evolution.generation,
        evaluations=candidates.evaluations,
        elapsed=budget.elapsed,
    )
