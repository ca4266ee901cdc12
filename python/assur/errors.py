"""Exceptions and warnings."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._remedy import Remedy

__all__ = [
    "AssurError",
    "AssurWarning",
    "DimensionError",
    "FitError",
    "InputError",
    "MotionError",
    "PositionError",
    "StructureError",
]


# A name that a user took from an array is shown by its letters.
OF_NUMPY = re.compile(r"np\.str_\(('[^']*'|\"[^\"]*\")\)")


class AssurError(Exception):
    """Base of all errors of this package.

    Attributes
    ----------
    kind : str or None
        What failed, in a word: ``"not_closed"``, ``"bad_dimension"``. docs/reference/errors.md
        lists all kinds that the core raises; None for arguments that Python refuses.
    hint : str or None
        What to do about it, the end of the message.
    joint, link, slide, driver, dimension : str or None
        Name of the first item concerned, if any.
    names : tuple of str
        Every joint, link, slide, driver and dimension that the message names before its hint, in
        that order.
    group : str or None
        The Assur group concerned: a dyad by its inner joint or slide, a higher group by class and
        links.
    design : tuple of int or None
        Index of the design in a batch.
    q : float or tuple of float or None
        The coordinate.
    t : float or None
        The time, s.
    value : float or None
        The wrong number, or by how much something fails.

    Examples
    --------
    Read the fields rather than the message:

    >>> import assur
    >>> try:
    ...     assur.FourBar(1.0, 9.0, 2.5, 3.0).solve(0.5)
    ... except assur.AssurError as error:
    ...     print(error.kind, error.joint, error.q)
    not_closed C 0.5
    """

    # The load, body or motor that has no value, as messages name it: see `subject_of`.
    _subject: str | None = None

    def __init__(
        self,
        message: str = "",
        *,
        kind: str | None = None,
        hint: str | None = None,
        joint: str | None = None,
        link: str | None = None,
        slide: str | None = None,
        driver: str | None = None,
        dimension: str | None = None,
        names: tuple[str, ...] = (),
        group: str | None = None,
        design: tuple[int, ...] | None = None,
        q: float | tuple[float, ...] | None = None,
        t: float | None = None,
        value: float | None = None,
    ) -> None:
        super().__init__(OF_NUMPY.sub(r"\1", message) if "np.str_(" in message else message)
        self.kind = kind
        self.hint = hint
        self.joint = None if joint is None else str(joint)
        self.link = None if link is None else str(link)
        self.slide = None if slide is None else str(slide)
        self.driver = None if driver is None else str(driver)
        self.dimension = None if dimension is None else str(dimension)
        self._names = names
        self.group = group
        self.design = design
        self.q = q
        self.t = t
        self.value = value

    @property
    def names(self) -> tuple[str, ...]:
        """Every joint, link, slide, driver and dimension that the message names, in its order.

        Examples
        --------
        >>> import assur
        >>> try:
        ...     assur.Mechanism(
        ...         joints={"A": (0, 0), "B": (1, 0), "C": (0, 1)},
        ...         links={"ground": "AC", "crank": "AB", "rod": "BC"},
        ...         driver="crank",
        ...     )
        ... except assur.StructureError as error:
        ...     print(error.names)
        ('crank', 'rod')
        """
        fields = (self.joint, self.link, self.slide, self.driver, self.dimension)
        return tuple(dict.fromkeys(self._names or (name for name in fields if name is not None)))

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), self.args, self.__dict__)


class StructureError(AssurError, ValueError):
    """An invalid linkage, or one whose mobility differs from its number of drivers.

    `remedies` has changes that make it a mechanism.

    Examples
    --------
    >>> import assur
    >>> assur.Mechanism(
    ...     joints={"A": (0, 0), "B": (1, 0), "C": (0, 1)},
    ...     links={"ground": "AC", "crank": "AB", "rod": "BC"},
    ...     driver="crank",
    ... )
    Traceback (most recent call last):
    ...
    assur.errors.StructureError: the linkage cannot move (mobility 0, counted 0 by ...
    """

    # Finds the remedies of the description that was refused, when they are first asked for.
    _find_remedies: Callable[[], tuple[Remedy, ...]] | None = None
    _remedies: tuple[Remedy, ...] | None = None

    @property
    def remedies(self) -> tuple[Remedy, ...]:
        """Up to three changes that make a mechanism of the linkage, the likeliest first.

        Each was built before it is offered. Empty if nothing was found, or if the error is about a
        name or a number, not about the structure.

        Examples
        --------
        >>> import assur
        >>> try:
        ...     assur.Mechanism(
        ...         joints={"A": (0, 0), "B": (1, 0), "C": (0, 1)},
        ...         links={"ground": "AC", "crank": "AB", "rod": "BC"},
        ...         driver="crank",
        ...     )
        ... except assur.StructureError as error:
        ...     print(error.remedies[0])
        ...     m = assur.Mechanism(**error.remedies[0].arguments)
        Let C slide on the ground: rod stays, its foot follows
        >>> m.structure.formula
        'I(crank) → II(rod, C_block)'
        """
        if self._remedies is None:
            self._remedies = () if self._find_remedies is None else self._find_remedies()
        return self._remedies


class DimensionError(AssurError, ValueError):
    """A dimension that is not finite or out of range, or a length that is not positive.

    Examples
    --------
    >>> import assur
    >>> assur.FourBar(1.0, -3.0, 2.5, 3.0)
    Traceback (most recent call last):
    ...
    assur.errors.DimensionError: dimension "coupler.length" is -3: a length must be positive
    """


class InputError(AssurError, ValueError):
    """A wrong argument: an unknown name, a shape, an order, a NaN.

    Examples
    --------
    >>> import assur
    >>> assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(0.0, order=4)
    Traceback (most recent call last):
    ...
    assur.errors.InputError: order is 4: 0, 1, 2 or 3
    """


class PositionError(AssurError, ArithmeticError):
    """A position that this assembly cannot reach, or without the analogues needed.

    Examples
    --------
    >>> import assur
    >>> assur.FourBar(1.0, 9.0, 2.5, 3.0).solve(0.5)
    Traceback (most recent call last):
    ...
    assur.errors.PositionError: at q = 0.5, dyad "C" cannot be assembled: its links miss ...
    """


class MotionError(AssurError, ArithmeticError):
    """A motion in time that does not exist: a stall, a runaway, no balance, no periodic motion.

    Examples
    --------
    A motor that is too weak for its load:

    >>> import assur
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4),
    ...     bodies={"crank": assur.Body(inertia=0.5)},
    ...     loads=[assur.Torque("crank", -3.0)],
    ...     motor=assur.LinearMotor(stall=1.0, no_load=10.0),
    ... )
    >>> machine.steady_state()
    Traceback (most recent call last):
    ...
    assur.errors.MotionError: the motor cannot carry the load: even at 10 rad/s the machine ...
    """


class FitError(AssurError, ArithmeticError):
    """No linkage keeps all conditions of a search: the message says which of them is in the way.

    Examples
    --------
    >>> import assur
    >>> hook = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
    >>> assur.search({"P": hook}, min_apex_angle=1.55, evaluations=1)
    Traceback (most recent call last):
    ...
    assur.errors.FitError: no linkage keeps all conditions: at most 12 joints, apex angles of ...
    """


class AssurWarning(UserWarning):
    """Worth knowing; the computation continues.

    Examples
    --------
    >>> import warnings
    >>> import assur
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4),
    ...     bodies={"piston": assur.Body(mass=20.0)},
    ...     loads=[assur.Torque("crank", -3.0)],
    ...     motor=assur.ConstantTorque(5.0),
    ... )
    >>> with warnings.catch_warnings(record=True) as found:
    ...     warnings.simplefilter("always", assur.AssurWarning)
    ...     flywheel = machine.flywheel(fluctuation=0.05, mean_speed=20.0)
    >>> print(found[0].message)
    the motor gives the driver 5 N·m, the loads take 3 on average: the flywheel is sized for ...
    """


def offer_remedies(error: StructureError, find: Callable[[], tuple[Remedy, ...]]) -> None:
    """Let an error find remedies, when they are first asked for."""
    error._find_remedies = find


def with_subject(error: AssurError, subject: str) -> AssurError:
    """Return an error that knows which load, body or motor it is about."""
    error._subject = subject
    return error


def subject_of(error: AssurError) -> str | None:
    """Return the load, body or motor that an error is about, as messages name it."""
    return error._subject
