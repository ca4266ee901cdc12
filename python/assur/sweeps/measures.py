"""The metrics of a sweep."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from difflib import get_close_matches
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypeVar, overload

import numpy as np
import numpy.typing as npt

from assur._arrays import flag, short
from assur._other_names import other_names
from assur._table import Column, Tabular, design_columns
from assur._validate import one_of, whole_number
from assur.description.words import Status, is_reached
from assur.errors import InputError
from assur.kinematics.table import dimension_column
from assur.sweeps.measures_axes import shown_axes
from assur.sweeps.measures_dataset import dataset
from assur.sweeps.metric_units import unit_of_metric
from assur.sweeps.reasons import explained, reasons

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from assur._arrays import Index
    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps._measured import Asked
    from assur.sweeps.designs import Designs

__all__ = ["Measures"]

Float: TypeAlias = npt.NDArray[np.float64]
T = TypeVar("T")
# Names of metrics are printed if they fit in a line.
MOST_LETTERS = 70


@other_names(
    best="nsmallest(n, by) or nlargest(n, by)", least="see nsmallest", greatest="see nlargest"
)
class Measures(Tabular, Mapping[str, Float]):
    """The metrics of designs by name, arrays of shape S; made by `assur.sweep`.

    Every design is one of four: it does not move over all of q (its `status` says why not), it
    misses a condition of ``where=`` (it is in `missed`), one of the metrics has no value (its
    `status` is ``NO_VALUE``; the other metrics are there), or it is in `kept`. The others have NaN
    (`metric.reachable` has 0 for those that do not move). `explain` says why a design is not
    kept.

    Attributes
    ----------
    status : numpy.ndarray
        A `Status` of each design, S: that of a position that cannot be solved, if there is one, or
        the worst. With a ``SINGULAR`` position metrics of derivatives are NaN; otherwise a metric
        that is NaN makes it ``NO_VALUE``: a load's table ends, friction locks the machine, a path
        is not closed. A design that misses a condition is not solved further: it has ``OK``, or
        what its solved positions have.
    kept : numpy.ndarray
        Indices (of designs in C order) of those that move over all of q, meet all conditions
        and have all metrics, ascending.

    Examples
    --------
    >>> import assur, numpy as np
    >>> found = assur.sweep(
    ...     assur.SliderCrank(0.1, 0.4),
    ...     {"crank.length": [0.1, 0.2, 0.5]},
    ...     np.linspace(0, 2 * np.pi, 72, endpoint=False),
    ...     metrics={"stroke": assur.metric.span("bore")},
    ... )
    >>> found["stroke"].round(6), found.kept, found.status
    (array([0.2, 0.4, nan]), array([0, 1]), array([0, 0, 3], dtype=uint8))
    """

    def __init__(
        self,
        values: dict[str, Float],
        status: npt.NDArray[np.uint8],
        kept: npt.NDArray[np.intp],
        designs: Designs,
        measuring: Asked,
        gradient: dict[str, Float] | None = None,
    ) -> None:
        self._values = values
        self._gradient = gradient or {}
        self.status = status
        self.kept = kept
        self._designs = designs
        self._measuring = measuring

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the designs."""
        return self.status.shape

    @property
    def gradient(self) -> Mapping[str, Float]:
        """With ``sweep(gradient=…)`` the derivatives of each metric by these dimensions, S + (D,).

        In the order of `gradient_by`; NaN of designs that are not in `kept`.
        """
        return MappingProxyType(self._gradient)

    @property
    def gradient_by(self) -> tuple[str, ...]:
        """Names of the dimensions of `gradient`, in the order of its last axis."""
        return self._measuring.gradient_by

    @property
    def missed(self) -> npt.NDArray[np.intp]:
        """Indices (of designs in C order) of those that miss a condition of ``where=``."""
        rest = is_reached(self.status).reshape(-1)
        rest[self.kept] = False
        return np.flatnonzero(rest)

    def nsmallest(self, n: int, by: str) -> npt.NDArray[np.intp]:
        """Return the indices of the n designs with the least values of a metric, least first.

        Parameters
        ----------
        n : int
            Number of designs; fewer are returned if fewer have a value.
        by : str
            Name of the metric. NaN is left out; equal values keep their order.

        Returns
        -------
        numpy.ndarray
            Indices of designs in C order, for `designs`.

        Raises
        ------
        InputError
            If no design has a value.

        Examples
        --------
        >>> import assur, numpy as np
        >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
        >>> space = {"coupler.length": [2.0, 2.5, 3.0, 9.0]}
        >>> angle = {"angle": assur.metric.min_transmission_angle("C")}
        >>> found = assur.sweep(assur.FourBar(1.0, 3.0, 2.5, 3.0), space, q, metrics=angle)
        >>> found.nsmallest(2, by="angle")
        array([2, 1])
        """
        return self._first("nsmallest", n, by, 1.0)

    def nlargest(self, n: int, by: str) -> npt.NDArray[np.intp]:
        """Return the indices of the n designs with the greatest values of a metric, greatest first.

        Parameters
        ----------
        n, by
            As for `nsmallest`.

        Returns
        -------
        numpy.ndarray
            Indices of designs in C order, for `designs`.

        Examples
        --------
        >>> import assur, numpy as np
        >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
        >>> space = {"coupler.length": [2.0, 2.5, 3.0, 9.0]}
        >>> angle = {"angle": assur.metric.min_transmission_angle("C")}
        >>> found = assur.sweep(assur.FourBar(1.0, 3.0, 2.5, 3.0), space, q, metrics=angle)
        >>> found.nlargest(2, by="angle")
        array([0, 1])
        """
        return self._first("nlargest", n, by, -1.0)

    def _first(self, method: str, n: Any, by: Any, sign: float) -> npt.NDArray[np.intp]:
        """Return the indices of designs by the values of a metric times a sign."""
        if isinstance(n, str):
            message = (
                f"{method}({short(n)}, {short(by)}): the number comes first: "
                f"{method}(10, by={short(n)})"
            )
            raise InputError(message)
        count = whole_number(n, "n", 1)
        if not isinstance(by, str) or by not in self._values:
            names = ", ".join(map(repr, self._values))
            message = f"by={short(by)}: one of {names} is needed{self._near(by)}"
            raise InputError(message)
        values = self._values[by].reshape(-1)
        indices = np.flatnonzero(~np.isnan(values))
        if len(indices) == 0:
            message = f"{method}: no design has a value of {by!r}: {counts_text(self)}"
            raise InputError(message)
        some = sign * values[indices]
        if count < len(some):
            # Sorting all would take longer than measuring them.
            few = np.flatnonzero(some <= np.partition(some, count - 1)[count - 1])
            indices, some = indices[few], some[few]
        return indices[np.argsort(some, kind="stable")[:count]]

    def explain(self, index: int | tuple[int, ...]) -> str | None:
        """Return why a design is not kept, or None if it is.

        Parameters
        ----------
        index : int or tuple of int
            Index of the design in C order, or into S.

        Returns
        -------
        str or None
            A sentence: the position that cannot be solved, the condition missed, or the metric
            without a value and why, a load by its name and place.

        Examples
        --------
        A force over a stroke that a longer crank exceeds:

        >>> import assur, numpy as np
        >>> work = assur.Table([0.3, 0.5], [0.0, -900.0], over="bore")
        >>> loads = [assur.Force("B", (work, 0.0))]
        >>> press = assur.Machine(assur.SliderCrank(0.1, 0.4), loads=loads)
        >>> asked, cranks = {"T": assur.metric.peak_effort()}, {"crank.length": [0.1, 0.12]}
        >>> found = assur.sweep(press, cranks, [0.0, 1.0, 2.0], metrics=asked)
        >>> found.kept, assur.Status(found.status[1]).name
        (array([0]), 'NO_VALUE')
        >>> print(found.explain(1))  # doctest: +NORMALIZE_WHITESPACE
        T: loads[0], the Force at 'B': a table over 'bore' covers 0.3 to 0.5: 0.52, at q = 0,
        is not in it; extend the table
        """
        return explained(self, self._flat(index))

    def designs(self, indices: Index) -> Mechanism:
        """Return some designs, in the assembly measured: one mechanism, or a batch (n,).

        Parameters
        ----------
        indices : int, sequence of int, tuple, or array
            Indices of designs in C order, as in `kept`; a tuple is an index into S, an entry for
            each axis; an array of bool of shape S chooses.

        Returns
        -------
        Mechanism
            One design, or a batch of several; `Machine.of` gives their machine.

        Raises
        ------
        InputError
            If there is no such design.

        Examples
        --------
        >>> import assur, numpy as np
        >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
        >>> space = {"coupler.length": np.linspace(2.0, 4.0, 21)}
        >>> angle = {"angle": assur.metric.min_transmission_angle("C")}
        >>> found = assur.sweep(assur.FourBar(1.0, 3.0, 2.5, 3.0), space, q, metrics=angle)
        >>> best = found.designs(np.nanargmax(found["angle"]))
        >>> round(best.dimensions["coupler.length"], 3)
        2.0
        """
        flat = self._flat(indices)
        some = self._designs.some(np.atleast_1d(flat))
        return some if flat.ndim else some.design(0)

    def _flat(self, indices: Any) -> npt.NDArray[np.intp]:
        """Return indices in C order, one or (n,)."""
        if isinstance(indices, tuple):
            shape, indices_of_axes = self.shape, indices
        else:
            shape, indices_of_axes = (self._designs.count,), (indices,)
        entries: tuple[npt.NDArray[Any], ...] = ()
        with suppress(ValueError):
            entries = tuple(np.broadcast_arrays(*(np.asarray(entry) for entry in indices_of_axes)))
        if len(entries) == 1 and entries[0].dtype == np.bool_ and entries[0].shape == self.shape:
            return np.flatnonzero(entries[0])
        axes = zip(entries, shape, strict=False)
        fits = len(entries) == len(shape) and all(
            entry.ndim <= 1
            and (entry.dtype.kind in "iu" or entry.size == 0)
            and ((-size <= entry) & (entry < size)).all()
            for entry, size in axes
        )
        if not fits:
            what = f"one index into the shape {self.shape}"
            message = f"designs: {short(indices)}: indices below {self._designs.count}, or {what}"
            raise InputError(message)
        flat = np.zeros((), dtype=np.intp)
        for entry, size in zip(entries, shape, strict=True):
            flat = flat * size + entry.astype(np.intp) % max(1, size)
        return np.asarray(flat)

    def plot(
        self,
        name: str,
        *,
        ax: Axes | None = None,
        dark: bool = False,
        at: Mapping[str, float] | None = None,
        best: Literal["min", "max", "both", "none"] = "both",
        degrees: bool = False,
    ) -> Axes:
        """Draw a metric over the one or two dimensions of the sweep (needs matplotlib).

        Two dimensions make a map: contours with their values, and hatched, with the reason written
        in it, where designs have none. One makes a curve with gaps.

        Parameters
        ----------
        name : str
            The metric.
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        dark : bool
            For dark backgrounds.
        at : mapping of str to float, optional
            Values of the grid's other dimensions, m or rad, where it has more than two.
        best : {"both", "min", "max", "none"}
            Which design is marked.
        degrees : bool
            Whether values of the metric are angles, rad, to be written in degrees.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on. Data are in m and rad; the ticks are written in the units that suit.

        Raises
        ------
        InputError
            An unknown metric; designs that are not a grid of one or two dimensions.

        Examples
        --------
        >>> import assur, numpy as np
        >>> lengths = np.linspace(1.5, 3.5, 9)
        >>> found = assur.sweep(
        ...     assur.FourBar(1.0, 3.0, 2.5, 3.0),
        ...     assur.Grid({"rocker.length": lengths, "ground.D.x": lengths}),
        ...     np.linspace(0, 2 * np.pi, 72, endpoint=False),
        ...     metrics={"angle": assur.metric.min_transmission_angle("C")},
        ... )
        >>> axes = found.plot("angle", degrees=True)
        >>> [text.get_text() for text in axes.texts if text.get_gid() == "reason"]
        ['crank stops']
        """
        from assur.pictures.maps.map import metric_picture

        values = self[name]
        one_of(best, ("both", "min", "max", "none"), "best")
        axes, designs = shown_axes(self, at)
        shown = values.reshape(-1)[designs]
        why = [(text, which[designs]) for text, which in reasons(self, values)]
        return metric_picture(name, axes, shown, why, ax, dark, best, flag(degrees, "degrees"))

    def _columns(self, degrees: bool) -> list[Column]:
        """Return a row for each design.

        The design's index (one for each axis of S), the dimensions that the sweep changes, status,
        whether it is kept, and every metric; one named like another column as ``metric status``.
        """
        columns = design_columns(self.shape, len(self.shape))
        for name, values in changed_dimensions(self).items():
            columns.append(dimension_column(name, values, degrees))
        kept = np.isin(np.arange(self.status.size), self.kept)
        columns.append(Column("status", self.status.reshape(-1), "", None))
        columns.append(Column("kept", kept, "", None))
        taken = {column.name for column in columns}
        for name, values in self._values.items():
            shown = f"metric {name}" if name in taken else name
            columns.append(self._metric_column(name, shown, values.reshape(-1), degrees))
        return columns

    def _metric_column(self, name: str, shown: str, values: Float, degrees: bool) -> Column:
        unit = unit_of_metric(self._measuring.metrics[name], self._designs.mechanism)
        if degrees and unit == "rad":
            values, unit = np.degrees(values), "deg"
        return Column(shown, values, unit, "metrics")

    def to_xarray(self, *, degrees: bool = False) -> xr.Dataset:
        """Return an xarray Dataset over the axes of S (needs xarray).

        Dimensions that the sweep changes are coordinates. An axis along which one of them changes
        alone, as in an `assur.Grid`, is named like it; others are ``design``, or ``design0``, ….
        Columns `status` and `kept` and every metric are variables.

        Parameters
        ----------
        degrees : bool
            Dimensions and metrics that are angles in degrees.

        Returns
        -------
        xarray.Dataset
            Units are those of the metrics.

        Examples
        --------
        >>> import assur, numpy as np
        >>> grid = assur.Grid({"crank.length": [0.1, 0.2], "rod.length": [0.3, 0.4, 0.5]})
        >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
        >>> asked = {"stroke": assur.metric.span("bore")}
        >>> found = assur.sweep(assur.SliderCrank(0.1, 0.4), grid, q, metrics=asked)
        >>> data = found.to_xarray()
        >>> round(float(data["stroke"].sel({"crank.length": 0.2, "rod.length": 0.5})), 6)
        0.4
        """
        return dataset(self, flag(degrees, "degrees"))

    # As a mapping it would compare arrays.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def __getitem__(self, name: str) -> Float:
        if name not in self:
            names = ", ".join(map(repr, self._values))
            message = (
                f"[{short(name)}]: no metric has this name; there are {names}{self._near(name)}"
            )
            raise InputError(message)
        return self._values[name]

    # `Mapping` requires a KeyError.
    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and name in self._values

    @overload
    def get(self, name: str, default: None = None) -> Float | None: ...
    @overload
    def get(self, name: str, default: Float | T) -> Float | T: ...
    def get(self, name: str, default: Float | T | None = None) -> Float | T | None:
        """Return the values of a metric, or the default if there is no such metric.

        Parameters
        ----------
        name : str
            Name of the metric.
        default : object
            The value to return otherwise.

        Returns
        -------
        ndarray or object
            Of shape S.

        Examples
        --------
        >>> import assur
        >>> asked = {"stroke": assur.metric.span("bore")}
        >>> found = assur.sweep(assur.SliderCrank(0.1, 0.4), {}, [0.0, 3.0], metrics=asked)
        >>> found.get("stroke").shape, found.get("time") is None
        ((), True)
        """
        return self._values[name] if name in self else default

    def _near(self, name: object) -> str:
        """Return a question that suggests what was meant, or nothing."""
        near = get_close_matches(name, self._values, n=1) if isinstance(name, str) else []
        return f"; did you mean {near[0]!r}?" if near else ""

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        names = ", ".join(map(repr, self._values))
        if len(names) > MOST_LETTERS:
            names = f"{len(self._values)} metrics"
        return f"<assur.Measures of {names}, shape {self.shape}, {len(self.kept)} kept>"


def counts_text(measures: Measures) -> str:
    """Say how many designs are kept, and what the others lack."""
    kept, missed = len(measures.kept), len(measures.missed)
    without = int(np.count_nonzero(measures.status == Status.NO_VALUE))
    fail = measures.status.size - kept - missed - without
    of = f"of {measures.status.size} designs {fail} do not move"
    undefined = f"{without} lack a metric, " if without else ""
    return f"{of}, {missed} miss a condition, {undefined}{kept} are kept"


def changed_dimensions(measures: Measures) -> dict[str, Float]:
    """Return the dimensions that a sweep changed, for all designs in C order."""
    return {name: measures._designs.values(name) for name in measures._designs.changed}
