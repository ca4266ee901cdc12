"""Ways to put a mechanism together."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np

from assur._arrays import as_number, short
from assur._callers import level_of_caller
from assur._summary import listed, shortened
from assur._validate import checked_signs, checked_threads
from assur.errors import AssurWarning, InputError
from assur.kinematics.model import Place, at_place, with_values
from assur.kinematics.request import at_position
from assur.kinematics.solve_arguments import checked_coordinates

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import numpy.typing as npt

    from assur._arrays import Number
    from assur._core import Mechanism as Core
    from assur._faces import AxesLike, Panels
    from assur.kinematics.model import AnyMechanism, AssemblyNumbers, MechanismModel

__all__ = ["Assemblies", "Assembly"]

# Positions nearer than this (relative to the size) are those of one assembly.
SAME = 1e-6
# Joints in a repr.
SHOWN = 2


class FoundAssemblies(TypedDict):
    """The assemblies of a position as the core found them."""

    assemblies: list[AssemblyNumbers]
    complex_count: list[int]
    failures: list[str]
    is_complete: bool


class Assembly(Mapping[str, int]):
    """One way to put a mechanism together.

    It maps every dyad with two solutions, by inner joint or slide, to its sign (+1 or −1). A group
    above class II has no such sign: its assembly is what can be reached from a place, which
    `Mechanism.assemblies` finds.

    Parameters
    ----------
    signs : mapping of str to int
        The signs.

    Attributes
    ----------
    q : float or ndarray or None
        The coordinate at which it was found, rad or m; None if it was named instead.
    joints : mapping of str to tuple or None
        Positions of the joints there, m.
    is_double : bool
        Whether two assemblies meet there.
    complex_count : tuple of int
        Number of complex assemblies of each group above class II.

    Notes
    -----
    Assemblies of class II are equal if their signs are. Others are equal if one of them, followed
    to the place of the other, arrives there.

    Examples
    --------
    >>> import assur
    >>> a = assur.Assembly({"C": 1})
    >>> a
    Assembly({'C': 1})
    >>> a["C"], -a
    (1, Assembly({'C': -1}))
    """

    __slots__ = ("_complex_count", "_core", "_shown", "_signs", "place")

    def __init__(self, signs: Mapping[str, int]) -> None:
        self._signs = checked_signs(signs)
        self.place: Place | None = None
        self._complex_count: tuple[int, ...] = ()
        # The mechanism drawn in it, made when first needed.
        self._core: Core | None = None
        # Joints that distinguish it from the others it was found with.
        self._shown: tuple[str, ...] = ()

    @classmethod
    def _found(
        cls, place: Place, complex_count: Iterable[int], shown: tuple[str, ...] = ()
    ) -> Assembly:
        # Signs of the core need no checks.
        assembly = cls.__new__(cls)
        names = (name for name, _ in place.mechanism.core.assembly)
        assembly._signs = tuple(zip(names, place.numbers["signs"], strict=True))
        assembly.place = place
        assembly._complex_count = tuple(complex_count)
        assembly._core = None
        assembly._shown = shown
        return assembly

    @property
    def q(self) -> Number | None:
        """Where it was found, rad or m; with several drivers an array."""
        if self.place is None:
            return None
        q = self.place.q
        return as_number(q[0] if len(q) == 1 else np.array(q))

    @property
    def joints(self) -> Mapping[str, tuple[float, float]] | None:
        """Positions of the joints where it was found, m."""
        if self.place is None:
            return None
        names = self.place.mechanism.joint_names
        return MappingProxyType(dict(zip(names, self.place.numbers["joints"], strict=True)))

    @property
    def is_double(self) -> bool:
        """Whether two assemblies meet where it was found."""
        return self.place is not None and self.place.numbers["is_double"]

    @property
    def complex_count(self) -> tuple[int, ...]:
        """Number of complex assemblies of each group above class II."""
        return self._complex_count

    def __getitem__(self, name: str) -> int:
        given: object = name
        for key, sign in self._signs:
            # An array would be compared element by element.
            if isinstance(given, str) and key == given:
                return sign
        raise KeyError(name)

    def __iter__(self) -> Iterator[str]:
        return (name for name, _ in self._signs)

    def __len__(self) -> int:
        return len(self._signs)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mapping):
            return NotImplemented
        if dict(self) != dict(other):
            return False
        theirs = other.place if isinstance(other, Assembly) else None
        own = self.place
        if own is None or theirs is None or not (own.is_traced and theirs.is_traced):
            # A named assembly says nothing about groups above class II.
            return not any(place is not None and place.is_traced for place in (own, theirs))
        mechanism, another = own.mechanism, theirs.mechanism
        is_same = (
            mechanism.description == another.description
            and mechanism.values.tobytes() == another.values.tobytes()
        )
        return is_same and self._leads_to(theirs)

    def _leads_to(self, place: Place) -> bool:
        """Whether following it to a place arrives there."""
        assert self.place is not None
        drawn = drawn_in(place.mechanism, self)
        arrays, _ = at_position(drawn, place.q)
        joints = np.array(place.numbers["joints"])
        there = np.array([arrays.joints[name][0] for name in drawn.joint_names])
        slides = np.array([arrays.slides[name][0] for name in drawn.slides])
        size = max(np.ptp(joints, axis=0).max(), 1e-300)
        errors = np.abs(np.concatenate([there - joints], axis=None))
        gaps = np.abs(slides - np.array(place.numbers["slides"]))
        return bool((errors <= SAME * size).all() and (gaps <= SAME * size).all())

    def __hash__(self) -> int:
        # Beside a change point a sign may differ from that of an equal assembly elsewhere.
        traced = self.place is not None and self.place.is_traced
        return hash(frozenset(self if traced else self._signs))

    def __neg__(self) -> Assembly:
        """Return the assembly with every sign reversed."""
        if self.place is not None and self.place.is_traced:
            message = "an assembly of a group above class II has no opposite: see assemblies()"
            raise InputError(message)
        return Assembly({name: -sign for name, sign in self._signs})

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, (dict(self._signs), self.place, self._complex_count, self._shown))

    def __repr__(self) -> str:
        if self.place is None or not self.place.is_traced:
            return shortened(f"Assembly({dict(self._signs)!r})")
        q = ", ".join(f"{q:.6g}" for q in self.place.q)
        signs = f"{dict(self._signs)!r}, " if self._signs else ""
        at = dict(self.joints or {})
        fixed = dict(self.place.mechanism.description.links).get("ground", ())
        moving = [name for name in at if name not in fixed]
        shown = self._shown or moving[-1:]
        places = "".join(f", {name}=({at[name][0]:.4g}, {at[name][1]:.4g})" for name in shown)
        return shortened(f"<assur.Assembly {signs}q={q}{places}>")


def joints_that_differ(names: Sequence[str], poses: Sequence[AssemblyNumbers]) -> tuple[str, ...]:
    """Return the first joints whose places differ among the assemblies of a position."""
    if not poses:
        return ()
    at = np.array([pose["joints"] for pose in poses])
    spans = np.ptp(at, axis=0).max(axis=1, initial=0.0)
    size = max(np.ptp(at.reshape(-1, 2), axis=0).max(initial=0.0), 1e-300)
    differ = [name for name, span in zip(names, spans, strict=True) if span > SAME * size]
    return tuple(differ[:SHOWN])


def drawn_in(mechanism: AnyMechanism, assembly: Mapping[str, int]) -> AnyMechanism:
    """Return the mechanism drawn where an assembly of a group above class II was found.

    Any other assembly is given by its signs: the mechanism itself is returned.
    """
    if not isinstance(assembly, Assembly):
        # Signs by name.
        return mechanism
    place = assembly.place
    if place is None or not place.is_traced:
        return mechanism
    if place.mechanism.description != mechanism.description:
        message = "assembly: it is one of another mechanism"
        raise InputError(message)
    if assembly._core is None:
        values = place.mechanism.values.tolist()
        assembly._core = place.mechanism.core.drawn_in(values, list(place.q), place.numbers)
    return at_place(mechanism, place, assembly._core)


def _rebuild(
    signs: dict[str, int],
    place: Place | None,
    complex_count: tuple[int, ...],
    shown: tuple[str, ...] = (),
) -> Assembly:
    assembly = Assembly(signs)
    assembly._shown = shown
    assembly.place = place
    assembly._complex_count = complex_count
    return assembly


class Assemblies(list[Assembly]):
    """Every real assembly of a design at one position: a list, with what is known of the rest.

    Attributes
    ----------
    complex_count : tuple of int
        Number of complex assemblies of each group above class II, with dimensions that are not
        special.
    failures : tuple of str
        Paths of the search that found no assembly of their own, each with its reason.
    is_complete : bool
        Whether no assembly can be missing: failures, if any, are at infinity or where two
        assemblies meet.

    Examples
    --------
    >>> import assur
    >>> found = assur.FourBar(1.0, 3.0, 2.5, 3.0).assemblies(1.0)
    >>> len(found), found.complex_count, found.is_complete
    (2, (), True)
    >>> [tuple(round(x, 4) for x in assembly.joints["C"]) for assembly in found]  # m
    [(3.0404, 2.4997), (1.5008, -2.0006)]
    """

    __slots__ = ("complex_count", "failures", "is_complete")

    def __init__(
        self,
        assemblies: Iterable[Assembly],
        complex_count: Iterable[int],
        failures: Iterable[str],
        is_complete: bool,
    ) -> None:
        super().__init__(assemblies)
        self.complex_count = tuple(complex_count)
        self.failures = tuple(failures)
        self.is_complete = is_complete

    def __repr__(self) -> str:
        return listed(self)

    def plot(self, *, ax: AxesLike | None = None, dark: bool = False) -> Panels:
        """Draw all assemblies side by side in one scale (needs matplotlib).

        Parameters
        ----------
        ax : sequence of matplotlib.axes.Axes, optional
            Where to draw, axes for each; a new figure by default, which shows 24 at most and says
            how many there are.
        dark : bool
            For dark backgrounds.

        Returns
        -------
        ndarray of matplotlib.axes.Axes
            The axes drawn on, one for each assembly; titles have their signs.

        Raises
        ------
        InputError
            If there is no assembly, or too few axes.

        Examples
        --------
        >>> import assur
        >>> axes = assur.FourBar(1.0, 3.0, 2.5, 3.0).assemblies(1.0).plot()
        >>> [one.get_title() for one in axes]
        ['[0]   C +', '[1]   C −']
        """
        from assur.pictures.linkage.assemblies import assemblies_picture

        return assemblies_picture(self, ax, dark)

    def __reduce__(self) -> tuple[Any, ...]:
        arguments = (list(self), self.complex_count, self.failures, self.is_complete)
        return (Assemblies, arguments)


def assemblies(mechanism: MechanismModel, q: npt.ArrayLike, threads: int | None = None) -> Any:
    """See `Mechanism.assemblies`."""
    array, positions, per_design = checked_coordinates(mechanism, q)
    if not np.isfinite(array).all():
        message = f"q = {short(q)}: a finite coordinate is needed"
        raise InputError(message, value=float(array[~np.isfinite(array)][0]))
    drivers = mechanism.driver_count
    answers = mechanism.core.assemblies(
        mechanism.values.ravel(), array.ravel(), per_design, checked_threads(threads)
    )
    shape = (*mechanism.shape, *positions)
    rows = np.broadcast_to(array if drivers > 1 else array[..., None], (*shape, drivers)).reshape(
        -1, drivers
    )
    designs = np.moveaxis(mechanism.values, 0, -1).reshape(-1, len(mechanism.values))
    each = max(len(answers) // max(len(designs), 1), 1)
    if not answers and shape:
        # No positions, or no designs.
        empty: Any = []
        for size in reversed(shape[:-1]):
            empty = [list(empty) for _ in range(size)]
        return empty
    lists: list[Any] = []
    for index, (answer, row) in enumerate(zip(answers, rows.tolist(), strict=True)):
        design = (
            mechanism if not mechanism.shape else with_values(mechanism, designs[index // each])
        )
        lists.append(_named(design, tuple(row), answer))
    for size in reversed(shape[1:]):
        lists = [lists[i : i + size] for i in range(0, len(lists), size)]
    return lists if shape else lists[0]


def _named(mechanism: MechanismModel, q: tuple[float, ...], answer: FoundAssemblies) -> Assemblies:
    count = answer["complex_count"]
    shown = joints_that_differ(mechanism.joint_names, answer["assemblies"])
    named = [
        Assembly._found(Place(mechanism, q, numbers), count, shown)
        for numbers in answer["assemblies"]
    ]
    if not answer["is_complete"]:
        message = f"assemblies at q = {q}: the list may be incomplete: {answer['failures'][0]}"
        warnings.warn(message, AssurWarning, stacklevel=level_of_caller())
    return Assemblies(named, count, answer["failures"], answer["is_complete"])
