"""Designs between several goals, with what each has of them."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from assur._arrays import counted, flag, short
from assur._summary import shortened
from assur._table import Column, Tabular, design_columns
from assur.errors import InputError
from assur.kinematics.table import dimension_columns
from assur.sweeps.metric_units import unit_of_metric

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from os import PathLike

    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism
    from assur.pictures.fronts.goal import Goal
    from assur.sweeps.terms import Metric

__all__ = ["ParetoFront"]

# Of the printed goals: with their number a line.
MOST_LETTERS = 84


class ParetoFront(Tabular, Sequence["Mechanism"]):
    """Designs of which none is better in all goals, the best in the first first.

    Made by `assur.pareto`. ``front[i]`` is the design i as a mechanism.

    Attributes
    ----------
    designs : Mechanism
        All designs, a batch (n,).
    values : mapping of str to ndarray
        Of each goal the metric's value of each design, (n,), in the metric's unit.
    seed : int
        Seed of the random numbers.
    generations : int
        Generations until then.
    evaluations : int
        Designs that were measured.
    elapsed : float
        Time that it took, s.

    Examples
    --------
    >>> import assur, numpy as np
    >>> front = assur.pareto(
    ...     assur.SliderCrank(0.1, 0.4),
    ...     np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False),
    ...     maximize={
    ...         "stroke": assur.metric.span("bore"),
    ...         "angle": assur.metric.min_transmission_angle("B"),
    ...     },
    ...     bounds={"crank.length": (0.05, 0.2)},
    ...     population=8, generations=5,
    ... )
    >>> list(front.values), front.designs.shape == (len(front),)
    (['stroke', 'angle'], True)
    >>> list(front.to_dataframe())
    ['design', 'crank.length', 'stroke', 'angle']
    """

    def __init__(
        self,
        designs: Mechanism,
        values: Mapping[str, Float],
        goals: Mapping[str, tuple[Metric, bool]],
        *,
        seed: int,
        generations: int,
        evaluations: int,
        elapsed: float,
    ) -> None:
        self.designs = designs
        for array in values.values():
            array.flags.writeable = False
        self._values = dict(values)
        self._goals = dict(goals)
        self.seed = seed
        self.generations = generations
        self.evaluations = evaluations
        self.elapsed = elapsed

    @property
    def values(self) -> Mapping[str, Float]:
        """The metric's value of each design by goal, (n,)."""
        return MappingProxyType(self._values)

    @overload
    def __getitem__(self, index: int) -> Mechanism: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Mechanism]: ...
    def __getitem__(self, index: int | slice) -> Mechanism | Sequence[Mechanism]:
        if isinstance(index, slice):
            return tuple(self.designs.design(i) for i in range(len(self))[index])
        return self.designs.design(range(len(self))[index])

    def __len__(self) -> int:
        return int(self.designs.shape[0])

    def __iter__(self) -> Iterator[Mechanism]:
        return (self.designs.design(index) for index in range(len(self)))

    def plot(
        self,
        x: str | None = None,
        y: str | None = None,
        *,
        ax: Axes | None = None,
        dark: bool = False,
        degrees: bool = False,
    ) -> Axes:
        """Draw the values of two goals of all designs, with their indices (needs matplotlib).

        Parameters
        ----------
        x, y : str, optional
            Names of the goals; by default the first and the second.
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        dark : bool
            For dark backgrounds.
        degrees : bool
            Angles in degrees.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on. Data are in m and rad; the ticks are written in the units that suit.

        Raises
        ------
        InputError
            An unknown goal, or the same twice.

        Examples
        --------
        >>> import assur, numpy as np
        >>> front = assur.pareto(
        ...     assur.SliderCrank(0.1, 0.4),
        ...     np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False),
        ...     maximize={
        ...         "stroke": assur.metric.span("bore"),
        ...         "angle": assur.metric.min_transmission_angle("B"),
        ...     },
        ...     bounds={"crank.length": (0.05, 0.2)},
        ...     population=8, generations=5,
        ... )
        >>> axes = front.plot("stroke", "angle", degrees=True)
        >>> axes.get_xlabel()
        'stroke, m (maximize)'
        """
        from assur.pictures.fronts.picture import front_picture

        shown = self._shown(x, y, flag(degrees, "degrees"))
        return front_picture(shown, ax, flag(dark, "dark"))

    def to_html(
        self,
        path: str | PathLike[str],
        *,
        x: str | None = None,
        y: str | None = None,
        degrees: bool = False,
        title: str | None = None,
        dark: bool | None = None,
    ) -> None:
        """Write one self-contained page: the front, whose points open the designs.

        A design opens as `Mechanism.to_html` shows it: it plays, and can be dragged. Some 30 kB a
        design.

        Parameters
        ----------
        path : path-like
            The file; one that exists is replaced.
        x, y : str, optional
            Names of the goals of the picture; by default the first and the second. A table has
            all.
        degrees : bool
            Angles in degrees.
        title : str, optional
            Above the page; the name of the file by default.
        dark : bool, optional
            As the reader's system by default.

        Raises
        ------
        InputError
            An unknown goal, designs of several drivers, a file that cannot be written.

        Examples
        --------
        >>> import assur, pathlib, tempfile, numpy as np
        >>> front = assur.pareto(
        ...     assur.SliderCrank(0.1, 0.4),
        ...     np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False),
        ...     maximize={
        ...         "stroke": assur.metric.span("bore"),
        ...         "angle": assur.metric.min_transmission_angle("B"),
        ...     },
        ...     bounds={"crank.length": (0.05, 0.2)},
        ...     population=8, generations=5,
        ... )
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     page = pathlib.Path(folder, "front.html")
        ...     front.to_html(page, degrees=True)
        ...     page.stat().st_size < 500_000
        True
        """
        from assur.pictures.fronts.page import write_front_page

        shown = self._shown(x, y, flag(degrees, "degrees"))
        write_front_page(shown, list(self), path, title, dark)

    def _shown(self, x: Any, y: Any, degrees: bool) -> list[Goal]:
        """Return the goals as pictures show them, those of the axes first."""
        from assur.pictures.fronts.goal import Goal

        names = list(self._values)
        chosen = [self._named(names[0] if x is None else x, "x")]
        rest = [name for name in names if name != chosen[0]]
        chosen.append(self._named(rest[0] if y is None else y, "y"))
        if chosen[0] == chosen[1]:
            message = f"x and y are both {short(chosen[0])}: two goals are needed"
            raise InputError(message)
        chosen += [name for name in names if name not in chosen]
        return [
            Goal(name, self._values[name], self._unit(name), self._goals[name][1], degrees)
            for name in chosen
        ]

    def _named(self, name: Any, what: str) -> str:
        if isinstance(name, str) and name in self._values:
            return str(name)
        message = f"{what} is {short(name)}: one of {', '.join(map(repr, self._values))} is needed"
        raise InputError(message)

    def _unit(self, name: str) -> str:
        return unit_of_metric(self._goals[name][0], self.designs)

    def _columns(self, degrees: bool) -> list[Column]:
        """Return a row for each design: its index, the dimensions that differ, the goals."""
        shape = (len(self),)
        columns = [*design_columns(shape, 1), *dimension_columns(self.designs, shape, degrees)]
        taken = {column.name for column in columns}
        for name, values in self._values.items():
            unit, shown = self._unit(name), values
            if degrees and unit == "rad":
                shown, unit = np.degrees(values), "deg"
            columns.append(Column(f"goal {name}" if name in taken else name, shown, unit, "goals"))
        return columns

    # As a sequence it would compare arrays.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def __repr__(self) -> str:
        ranges = ", ".join(
            f"{name} {values.min():.4g} to {values.max():.4g}"
            for name, values in self._values.items()
        )
        goals = shortened(ranges, MOST_LETTERS)
        return f"<assur.ParetoFront: {counted(len(self), 'design')}; {goals}>"
