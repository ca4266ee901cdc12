"""A mechanism over time, its drivers moving by input laws."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, overload

import numpy as np

from assur._arrays import flag, real_array, short
from assur._other_names import renamed
from assur._summary import FORMULA, shortened
from assur._table import Column, Tabular
from assur._validate import one_of
from assur.errors import InputError
from assur.kinematics.solve import solve
from assur.kinematics.solve_arguments import in_radians, warn_if_degrees
from assur.kinematics.table import Options, motion_columns
from assur.laws import Law

if TYPE_CHECKING:
    from collections.abc import Sequence
    from os import PathLike

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import AxesLike, Panels
    from assur.kinematics.model import MechanismModel
    from assur.kinematics.motion import Motion
    from assur.kinematics.quantity import Analogues

__all__ = ["InTime", "TimedMotion"]


class InTime:
    """A quantity over time: its value, and its rates as methods, as those of `Analogues`.

    Attributes
    ----------
    value : ndarray
        m or rad, shape (N,); points with a last axis of 2.

    Notes
    -----
    ``np.asarray`` of it is its value.

    Examples
    --------
    >>> import assur
    >>> law = assur.laws.Uniform(0.0, 1.0, duration=0.5)
    >>> crank = assur.SliderCrank(0.05, 0.2).follow(law, [0.1, 0.2]).link("crank")
    >>> crank.value, crank.velocity()  # rad, rad/s
    (array([0.2, 0.4]), array([2., 2.]))
    """

    __slots__ = ("_analogues", "_rates")

    def __init__(self, analogues: Analogues, rates: tuple[Float, Float, Float]) -> None:
        self._analogues, self._rates = analogues, rates

    @property
    def value(self) -> Float:
        """The value: m, or rad for a link."""
        return self._analogues.value

    def velocity(self) -> Float:
        """Return the velocity.

        Returns
        -------
        ndarray
            m/s or rad/s, of the shape of `value`.

        Examples
        --------
        >>> import assur, numpy as np
        >>> law = assur.laws.Cycloidal(0.0, np.pi, duration=0.5)
        >>> piston = assur.SliderCrank(0.05, 0.2).follow(law, [0.0, 0.25]).slide("bore")
        >>> piston.velocity().round(6)  # m/s
        array([ 0.      , -0.628319])
        """
        return self._analogues.velocity(self._rates[0])

    def acceleration(self) -> Float:
        """Return the acceleration.

        Returns
        -------
        ndarray
            m/s² or rad/s², of the shape of `value`.

        Examples
        --------
        >>> import assur, numpy as np
        >>> law = assur.laws.Harmonic(0.0, np.pi, duration=0.5)
        >>> crank = assur.SliderCrank(0.05, 0.2).follow(law, [0.0, 0.25]).link("crank")
        >>> crank.acceleration().round(6)  # rad/s²
        array([62.012553,  0.      ])
        """
        return self._analogues.acceleration(*self._rates[:2])

    def jerk(self) -> Float:
        """Return the jerk.

        Returns
        -------
        ndarray
            m/s³ or rad/s³, of the shape of `value`.

        Examples
        --------
        >>> import assur, numpy as np
        >>> law = assur.laws.Cycloidal(0.0, 1.0, duration=1.0)
        >>> crank = assur.SliderCrank(0.05, 0.2).follow(law, [0.0, 0.5]).link("crank")
        >>> crank.jerk().round(3)  # rad/s³
        array([ 39.478, -39.478])
        """
        return self._analogues.jerk(*self._rates)

    def __array__(
        self, dtype: npt.DTypeLike | None = None, copy: bool | None = None
    ) -> npt.NDArray[Any]:
        return np.array(self.value, dtype=dtype, copy=copy)

    def __repr__(self) -> str:
        return f"<{self._analogues._name} over time: shape {self.value.shape}>"


class TimedMotion(Tabular):
    """A motion over time; made by `Mechanism.follow`.

    Attributes
    ----------
    t : ndarray
        Times, s, shape (N,).
    q, speed, acceleration, jerk : ndarray
        Of the drivers: (N,), with n drivers (N, n).
    motion : Motion
        The positions and analogues at these coordinates.

    Examples
    --------
    >>> import assur, numpy as np
    >>> law = assur.laws.Cycloidal(0.0, np.pi, duration=0.5)
    >>> moved = assur.SliderCrank(0.05, 0.2).follow(law, np.linspace(0.0, 0.5, 101))
    >>> moved.q[[0, 50, 100]].round(6), moved.speed.max().round(6)  # rad, rad/s
    (array([0.      , 1.570796, 3.141593]), np.float64(12.566371))
    """

    def __init__(self, t: Float, course: tuple[Float, Float, Float, Float], motion: Motion) -> None:
        self.t, self.motion = t, motion
        self.q, self.speed, self.acceleration, self.jerk = course

    def __repr__(self) -> str:
        formula = shortened(self.motion.mechanism.core.formula, FORMULA)
        return f"<assur.TimedMotion of {formula}, {self.t.size} times>"

    def joint(self, name: str | Sequence[str]) -> InTime:
        """Return a joint over time; several are stacked along a new first axis.

        Parameters
        ----------
        name : str or sequence of str
            The joint, or several.

        Returns
        -------
        InTime
            Its value, velocity, acceleration and jerk, m, m/s, m/s², m/s³, each (N, 2).

        Examples
        --------
        >>> import assur, numpy as np
        >>> law = assur.laws.Harmonic(0.0, np.pi, duration=0.5)
        >>> moved = assur.SliderCrank(0.05, 0.2).follow(law, np.linspace(0.0, 0.5, 101))
        >>> moved.joint("A").value.shape, moved.joint("A").velocity()[50].round(6)  # m/s
        ((101, 2), array([-0.49348,  0.     ]))
        """
        return self._in_time(self.motion.joint(name))

    def link(self, name: str | Sequence[str]) -> InTime:
        """Return a link's angle over time.

        Parameters
        ----------
        name : str or sequence of str
            The link, or several.

        Returns
        -------
        InTime
            Its value, velocity, acceleration and jerk, rad, rad/s, rad/s², rad/s³, each (N,).

        Examples
        --------
        >>> import assur
        >>> law = assur.laws.Uniform(0.0, 1.0, duration=0.5)
        >>> moved = assur.SliderCrank(0.05, 0.2).follow(law, [0.1, 0.2])
        >>> moved.link("crank").velocity()  # rad/s
        array([2., 2.])
        """
        return self._in_time(self.motion.link(name))

    def slide(self, name: str | Sequence[str]) -> InTime:
        """Return a slide's value over time.

        Parameters
        ----------
        name : str or sequence of str
            The slide, or several.

        Returns
        -------
        InTime
            Its value, velocity, acceleration and jerk, m, m/s, m/s², m/s³, each (N,).

        Examples
        --------
        >>> import assur, numpy as np
        >>> law = assur.laws.Harmonic(0.0, np.pi, duration=0.5)
        >>> moved = assur.SliderCrank(0.05, 0.2).follow(law, [0.0, 0.5])
        >>> moved.slide("bore").value  # m: the stroke is twice the crank
        array([0.25, 0.15])
        """
        return self._in_time(self.motion.slide(name))

    def point(self, link: str, local: npt.ArrayLike) -> InTime:
        """Return a point of a link over time, as `Motion.point`.

        Parameters
        ----------
        link : str
            The link.
        local : array_like
            (x, y) in the link's frame, m.

        Returns
        -------
        InTime
            Its value, velocity, acceleration and jerk, m, m/s, m/s², m/s³, each (N, 2).

        Examples
        --------
        The middle of the rod goes half as far as the piston:

        >>> import assur, numpy as np
        >>> law = assur.laws.Harmonic(0.0, np.pi, duration=0.5)
        >>> moved = assur.SliderCrank(0.05, 0.2).follow(law, [0.0, 0.5])
        >>> moved.point("rod", (0.1, 0.0)).value.round(6)  # m
        array([[0.15, 0.  ],
               [0.05, 0.  ]])
        """
        return self._in_time(self.motion.point(link, local))

    # Several orders, the usual case, have axes each; of one alone they are not in an array.
    @overload
    def diagram(
        self,
        name: str | Sequence[str],
        *,
        ax: AxesLike | None = ...,
        orders: int,
        degrees: bool = ...,
        dark: bool = ...,
    ) -> Axes: ...
    @overload
    def diagram(
        self,
        name: str | Sequence[str],
        *,
        ax: AxesLike | None = ...,
        orders: Sequence[int] | None = ...,
        degrees: bool = ...,
        dark: bool = ...,
    ) -> Panels: ...
    def diagram(
        self,
        name: str | Sequence[str],
        *,
        ax: AxesLike | None = None,
        orders: int | Sequence[int] | None = None,
        degrees: bool = False,
        dark: bool = False,
    ) -> Axes | Panels:
        """Draw a quantity and its derivatives over time, as `Motion.diagram`.

        Parameters
        ----------
        name : str or sequence of str
            A joint, one of its components ("C.x"), a link or a slide, or several.
        ax : matplotlib axes or array of them, optional
            Where to draw, one for each order; a new figure by default.
        orders : int or sequence of int, optional
            0 the value, 1 velocity, 2 acceleration, 3 jerk; all by default.
        degrees : bool
            Whether angles are in degrees.
        dark : bool
            Colours for a dark canvas.

        Returns
        -------
        matplotlib.axes.Axes or ndarray of them
            The axes drawn on, one for each order.

        Examples
        --------
        >>> import assur, numpy as np
        >>> law = assur.laws.Cycloidal(0.0, np.pi, duration=0.5)
        >>> moved = assur.SliderCrank(0.05, 0.2).follow(law, np.linspace(0.0, 0.5, 101))
        >>> axes = moved.diagram("crank", orders=1)
        >>> axes.get_title(loc="left"), [text.get_text() for text in axes.texts]
        ('Angular velocity, rad/s', ['12.6 at 0.250 s', '0 at 0 s'])
        """
        from assur.pictures.diagrams.diagram import timed_diagram

        axes: Axes | Panels = timed_diagram(self, name, ax, orders, flag(degrees, "degrees"), dark)
        return axes

    def _in_time(self, of: Analogues) -> InTime:
        return InTime(of, (self.speed, self.acceleration, self.jerk))

    def _columns(self, degrees: bool) -> list[Column]:
        """Return time, and values, velocities, accelerations and jerks of what moves."""
        options = Options(self.speed, self.acceleration, self.jerk, degrees=degrees, moving=True)
        first, *rest = motion_columns(self.motion, options)
        return [Column("t", self.t, "s", None), first, *rest]

    @renamed(paths="joint")
    def to_html(
        self,
        path: str | PathLike[str],
        *,
        joint: str | Sequence[str] | None = None,
        diagrams: Sequence[str] | None = None,
        title: str | None = None,
        dark: bool | None = None,
    ) -> None:
        """Write one self-contained page that plays the motion in a browser, as it goes in time.

        Parameters
        ----------
        path : path-like
            The file; one that exists is replaced.
        joint, diagrams, title, dark
            As for `Mechanism.to_html`.

        Raises
        ------
        InputError
            Times that are not evenly spaced, a batch of designs, an unknown name, a file that
            cannot be written.

        Examples
        --------
        >>> import assur, numpy as np, pathlib, tempfile
        >>> law = assur.laws.Cycloidal(0.0, np.pi, duration=0.5)
        >>> moved = assur.SliderCrank(0.05, 0.2).follow(law, np.linspace(0.0, 0.5, 101))
        >>> page = pathlib.Path(tempfile.mkdtemp()) / "law.html"
        >>> moved.to_html(page)
        >>> page.read_text(encoding="utf-8")[:15]
        '<!doctype html>'
        """
        from assur.pictures.page.html import write_page
        from assur.pictures.page.turn_in_time import turn_of_timed

        turn = turn_of_timed(self)
        write_page(turn, path, joint=joint, diagrams=diagrams, title=title, dark=dark)

    def _repr_html_(self) -> str | None:
        """Return what a notebook shows; None for what cannot be played."""
        from assur.pictures.page.html import notebook_html
        from assur.pictures.page.turn_in_time import turn_of_timed

        try:
            return notebook_html(turn_of_timed(self))
        except InputError:
            return None


def follow(
    mechanism: MechanismModel,
    laws: Law | Sequence[Law | float] | None,
    t: npt.ArrayLike | None,
    on_error: Any,
    deg: Law | Sequence[Law | float] | None,
) -> TimedMotion:
    """See `Mechanism.follow`."""
    one_of(on_error, ("raise", "nan"), "on_error")
    if mechanism.shape:
        message = f"follow() is for one design, this is a batch {mechanism.shape}: use design(i)"
        raise InputError(message)
    drivers = mechanism.driver_count
    if (laws is None) == (deg is None):
        both = "neither laws nor deg is" if laws is None else "both laws and deg are"
        message = f"follow(): {both} given: pass laws in rad (or m), or deg in degrees"
        raise InputError(message)
    unit = 1.0
    if deg is not None:
        unit, laws = float(in_radians(mechanism, None, 1.0, "follow")), deg
    if t is None:
        message = "follow(): t is not given: pass the times, s"
        raise InputError(message)
    listed: Any = [laws] if isinstance(laws, Law) else laws
    if not isinstance(listed, list | tuple) or len(listed) != drivers:
        message = f"laws is {short(laws)}: one law (assur.laws) for each driver is needed"
        raise InputError(message)
    if deg is None:
        for law in listed:
            for end in _ends(law):
                warn_if_degrees(mechanism, np.asarray(end))
    times = np.atleast_1d(real_array(t, "t"))
    if times.ndim > 1 or not np.isfinite(times).all():
        message = f"t has shape {times.shape}: finite times (N,) are needed"
        raise InputError(message)
    each = [tuple(unit * x for x in _course(law, times)) for law in listed]
    q, speed, acceleration, jerk = (
        each[0][k] if drivers == 1 else np.stack([course[k] for course in each], axis=-1)
        for k in range(4)
    )
    motion = solve(mechanism, q, order=3, on_error=on_error, from_user=True)
    return TimedMotion(times, (q, speed, acceleration, jerk), motion)


def _ends(law: Any) -> list[float]:
    """Return where a law begins and ends, as far as it says so."""
    parts = getattr(law, "laws", (law,))
    ends = [getattr(part, name, 0.0) for part in parts for name in ("start", "end")]
    return [float(end) for end in ends if isinstance(end, int | float)]


def _course(law: Any, t: Float) -> tuple[Float, Float, Float, Float]:
    if isinstance(law, Law):
        return law.at(t)
    zero = np.zeros_like(t)
    held = real_array(law, "law")
    if held.ndim or not np.isfinite(held):
        message = f"law is {short(law)}: an assur.laws law, or a number for a driver that is held"
        raise InputError(message)
    return zero + held, zero, zero, zero
