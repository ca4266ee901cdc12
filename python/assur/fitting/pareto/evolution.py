"""NSGA-II of pymoo over the sweep engine: a generation is one sweep.

Source: K. Deb, A. Pratap, S. Agarwal, T. Meyarivan, "A fast and elitist multiobjective genetic
algorithm: NSGA-II", IEEE Transactions on Evolutionary Computation 6 (2002) 182-197. Designs that
miss a condition rank behind those that keep all, by how much they miss (section VI).
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.fitting.pareto.archive import Archive, far_apart
from assur.fitting.pareto.objectives import undominated

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.fitting.effort import Report
    from assur.fitting.pareto.candidates import Candidates, Scores

# Random designs of which the first generation is chosen, over the population: where few designs
# move, or keep the conditions, a population of them alone would have nothing to begin with.
FIRST = 10


@dataclass(frozen=True, slots=True)
class Budget:
    """How long to go on: generations, or evaluations in their place, and at most a time, s."""

    generations: int
    evaluations: int | None
    time_limit: float | None
    started: float = field(default_factory=time.monotonic)

    @property
    def elapsed(self) -> float:
        """Time since it began, s."""
        return time.monotonic() - self.started

    def part(self, generation: int, evaluations: int) -> float:
        """Return which part of it is spent."""
        done = generation / self.generations
        if self.evaluations is not None:
            done = evaluations / self.evaluations
        in_time = 0.0 if self.time_limit is None else self.elapsed / self.time_limit
        return max(done, in_time)


@dataclass(slots=True)
class Evolution:
    """A population that comes nearer to the front, generation by generation.

    Attributes
    ----------
    archive : Archive
        The designs of all generations that keep all conditions.
    generation : int
        Generations so far.
    """

    candidates: Candidates
    population: int
    seed: int
    archive: Archive = field(init=False)
    generation: int = 0

    def __post_init__(self) -> None:
        self.archive = Archive(self.population)

    def run(self, budget: Budget, report: Report) -> None:
        """Go on until the budget is spent; what was found is in the archive, after Ctrl-C too."""
        evolve = _nsga2(self._first(), self.population, self.candidates, self.seed)
        part = 0.0
        while part < 1.0:
            asked = evolve.ask()
            if asked is None or not len(asked):
                # Every design that crossing gives is there already.
                break
            scores = self._measure(asked.get("X"))
            self.generation += 1
            _tell(evolve, asked, scores)
            part = budget.part(self.generation, self.candidates.evaluations)
            between = int((evolve.opt.get("CV") <= 0.0).sum())
            report(min(part, 1.0), float(between))

    def _first(self) -> Float:
        """Return the best of random places, and of the drawing."""
        shape = (FIRST * self.population, self.candidates.size)
        places = np.random.default_rng(self.seed).random(shape)
        drawn = self.candidates.drawn()
        if drawn is not None:
            places = np.concatenate([drawn, places])
        scores = self._measure(places)
        keep_all = np.flatnonzero(scores.misses <= 0.0)
        best = keep_all[undominated(scores.costs[keep_all])]
        best = best[far_apart(scores.costs[best], self.population)]
        nearest = np.argsort(scores.misses, kind="stable")
        chosen = list(dict.fromkeys([*best.tolist(), *nearest.tolist()]))
        return places[chosen[: self.population]]

    def _measure(self, places: Float) -> Scores:
        """Measure designs and keep those that keep all conditions."""
        scores = self.candidates.measure(places)
        kept = scores.misses <= 0.0
        self.archive.add(places[kept], scores.costs[kept])
        return scores


def _nsga2(first: Float, population: int, candidates: Candidates, seed: int) -> Any:
    """Return pymoo's algorithm, to be asked for designs and told their scores."""
    try:
        from pymoo.algorithms.moo.nsga2 import NSGA2  # type: ignore[import-untyped]
        from pymoo.config import Config  # type: ignore[import-untyped]
        from pymoo.core.problem import Problem  # type: ignore[import-untyped]
        from pymoo.core.termination import NoTermination  # type: ignore[import-untyped]
    except ImportError as error:
        message = 'pareto needs pymoo: pip install "assur[pareto]"'
        raise ImportError(message) from error
    # It would print where its compiled parts are missing.
    Config.warnings["not_compiled"] = False
    evolve = NSGA2(pop_size=population, sampling=first)
    problem = Problem(
        n_var=candidates.size, n_obj=len(candidates.objectives), n_ieq_constr=1, xl=0.0, xu=1.0
    )
    evolve.setup(problem, termination=NoTermination(), seed=seed, verbose=False)
    return evolve


def _tell(evolve: Any, asked: Any, scores: Scores) -> None:
    """Tell the algorithm the scores of the designs that it asked for."""
    from pymoo.core.evaluator import Evaluator  # type: ignore[import-untyped]
    from pymoo.problems.static import StaticProblem  # type: ignore[import-untyped]

    known = {"F": scores.costs, "G": scores.misses[:, np.newaxis]}
    Evaluator().eval(StaticProblem(evolve.problem, **known), asked)
    evolve.tell(infills=asked)
