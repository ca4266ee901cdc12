"""Mechanisms: described once, compiled, solved at any coordinate."""

from __future__ import annotations

import math
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from assur._core import KnownSigns
from assur._validate import checked_index, checked_name, checked_signs, real_array
from assur.description import encode
from assur.description.structure import Group, Structure
from assur.description.words import Cylinder
from assur.errors import InputError
from assur.kinematics import assemblies as assembly_search
from assur.kinematics import extremes as extreme_search
from assur.kinematics import find as inverse
from assur.kinematics import limits as limit_search
from assur.kinematics import solve as solver
from assur.kinematics.assembly import Assembly, drawn_in
from assur.kinematics.curve import search as curves
from assur.kinematics.dimensions import Dimensions
from assur.kinematics.named_dimensions import dimensions_by_name
from assur.kinematics.pose import redrive, with_signs

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from os import PathLike

    from assur._arrays import Float
    from assur._core import Mechanism as Core
    from assur.description.encode import Description, DriverLike
    from assur.description.words import Slide
    from assur.kinematics.assembly import Place
    from assur.kinematics.curve.curve import ConfigurationCurve
    from assur.kinematics.extremes import Extremes
    from assur.kinematics.limits import Limits
    from assur.kinematics.loci.maps import DesignMap
    from assur.kinematics.loci.singular import SingularLocus, Workspace
    from assur.kinematics.motion import Motion
    from assur.kinematics.timed import TimedMotion
    from assur.laws import Law
    from assur.studio.notebook import Explorer

__all__ = ["Mechanism"]

# Four units in the last place: by so much a solved place differs from the drawing's by rounding.
TYPED = 1e-15


class Mechanism:
    """A planar linkage with its drivers, or a batch of designs of one.

    Parameters
    ----------
    joints : mapping of str to (x, y)
        A drawing, m: its coordinates set the dimensions and the assembly.
    links : mapping of str to sequence of str
        The joints of each link; ``"ground"`` is the frame.
    driver : str, Drive or sequence of them
        A link (q is its angle, rad), a slide (q is its value, m) or a `Drive`;
        a sequence gives a mechanism of higher mobility.
    slides : mapping of str to Slide or Cylinder, optional
        Sliding pairs (prismatic joints); a `Cylinder` adds its two links.
    assembly : mapping of str to int, optional
        +1 or −1 by inner joint or slide, for dyads drawn with their links
        collinear: the drawing does not show their assembly.
    tolerance : float or (float, float), optional
        Length to which the drawing is known, m, and angle of guides, rad: so far coordinates of
        joints are moved, and guides turned, where redundant links need it;
        ``structure.adjustment`` says how far. The angle is by default the length at the size of
        the linkage; without a tolerance only rounding is adjusted, 2e-9 of the size.

    Raises
    ------
    StructureError
        If the linkage is invalid or its mobility differs from the number of
        drivers; the message names the joint, link or slide.

    Notes
    -----
    Mechanisms are immutable; they can be hashed, compared and pickled.

    Examples
    --------
    >>> import assur
    >>> m = assur.Mechanism(
    ...     joints={"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0)},
    ...     links={"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"},
    ...     driver="crank",
    ... )
    >>> m.structure.formula
    'I(crank) → II(coupler, rocker)'
    >>> m.solve(0.5).joint("C").value
    array([4.368934, 3.247181])
    """

    __slots__ = (
        "__weakref__",
        "_joints",
        "_known_signs",
        "_moved",
        "_names",
        "_structure",
        "core",
        "description",
        "place",
        "signs",
        "values",
    )
    core: Core
    # Designs that earlier calls found to have constant signs.
    _known_signs: KnownSigns
    description: Description
    # By how much joints were moved within the tolerance that was given, m.
    _moved: float
    # Dimensions, shape (number of dimensions, *S).
    values: Float
    _structure: Structure | None
    _joints: MappingProxyType[str, Any] | None
    # Where it is drawn, if not in the drawing.
    place: Place | None
    # Of all dyads, in the drawing; not to be modified.
    signs: list[int]
    # Indices of joints, links and slides by name.
    _names: tuple[dict[str, int], dict[str, int], dict[str, int]] | None

    def __init__(
        self,
        joints: Mapping[str, Sequence[float]],
        links: Mapping[str, Iterable[str]],
        driver: DriverLike | Sequence[DriverLike],
        slides: Mapping[str, Slide | Cylinder] | None = None,
        assembly: Mapping[str, int] | None = None,
        tolerance: float | tuple[float, float] | None = None,
    ) -> None:
        points = tuple(encode.joint(name, at) for name, at in encode.items(joints, "joints"))
        members = [(name, encode.members(name, on)) for name, on in encode.items(links, "links")]
        guides = []
        for name, own in encode.items({} if slides is None else slides, "slides"):
            if isinstance(own, Cylinder):
                slide, parts = encode.cylinder(name, own, points)
                members += parts
            else:
                slide = encode.slide(name, own, points)
            guides.append((name, slide))
        description = encode.Description(
            joints=points,
            links=tuple(members),
            slides=tuple(guides),
            drivers=encode.drivers(driver),
            assembly=checked_signs(assembly, strict=False),
        )
        moved = 0.0
        if tolerance is not None:
            description, moved = encode.fitted(description, tolerance)
        self._initialise(description, None)
        self._set(_moved=moved)

    @classmethod
    def from_lengths(
        cls,
        joints: Mapping[str, Sequence[float]],
        links: Mapping[str, Iterable[str]],
        driver: DriverLike | Sequence[DriverLike],
        lengths: Mapping[Any, float],
        slides: Mapping[str, Slide | Cylinder] | None = None,
        assembly: Mapping[str, int] | None = None,
    ) -> Mechanism:
        """Return a mechanism from a rough sketch and lengths between its joints.

        Parameters
        ----------
        joints, links, driver, slides, assembly
            The sketch, as for the constructor.
        lengths : mapping of (str, str) to float
            Distances of two joints of one link, m: ``("B", "C")``, or ``"BC"`` of names of one
            letter. What is not given remains as sketched; of a link with more joints, three
            distances make a triangle on the sketch's side, which the sketch must show clearly.

        Returns
        -------
        Mechanism
            At the sketch's q in the assembly that is nearest to it.

        Raises
        ------
        InputError
            A pair without a link, lengths that are no triangle, or that contradict each other; a
            joint sketched on the line of two others, beside which the lengths put it.
        PositionError
            If the mechanism does not close at the sketch's q.

        Warns
        -----
        AssurWarning
            A joint sketched so near to that line that its side is doubtful.

        Examples
        --------
        >>> import assur
        >>> m = assur.Mechanism.from_lengths(
        ...     joints={"A": (0, 0), "B": (0, 1), "C": (3, 2), "D": (3, 0), "P": (2, 3)},
        ...     links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        ...     driver="crank",
        ...     lengths={"AD": 3.2, "AB": 1.0, "BC": 3.0, "BP": 2.0, "CP": 1.5, "DC": 2.5},
        ... )
        >>> m.dimensions["ground.D.x"], m.dimensions["coupler.length"], round(m.joints["P"][1], 6)
        (3.2, 3.0, 2.637603)
        """
        from assur.kinematics.from_lengths import sized

        return sized(Mechanism(joints, links, driver, slides, assembly), lengths)

    def _initialise(
        self, description: Description, values: Float | None, core: Core | None = None
    ) -> None:
        core = core or encode.core_of(description)
        self._set(
            core=core,
            description=description,
            _structure=None,
            _joints=None,
            _moved=0.0,
            _names=None,
            place=None,
            signs=[sign for _, sign in core.assembly],
        )
        self._set_values(np.array(core.drawing) if values is None else values)

    def _set(self, **attributes: object) -> None:
        for name, value in attributes.items():
            object.__setattr__(self, name, value)

    def _set_values(self, values: Float) -> None:
        # Takes over the caller's array without a copy: a batch may be large.
        array = np.asarray(values, dtype=np.float64, order="C")
        array.flags.writeable = False
        self._set(values=array, _known_signs=KnownSigns(math.prod(array.shape[1:])))

    @classmethod
    def _make(
        cls, description: Description, values: Float | None, core: Core | None = None
    ) -> Mechanism:
        mechanism = object.__new__(Mechanism)
        mechanism._initialise(description, values, core)
        return mechanism

    def _moved_as(self, other: Mechanism) -> Mechanism:
        """Return self, a mechanism of the other's drawing."""
        self._set(_moved=other._moved)
        return self

    def _with_values(self, values: Float) -> Mechanism:
        """Return the mechanism with other values of its dimensions; the rest is shared."""
        other = object.__new__(Mechanism)
        other._share(self, values)
        return other

    def _drawn_at(self, place: Place, core: Core) -> Mechanism:
        """Return the mechanism drawn at a place of one of its designs."""
        other = object.__new__(Mechanism)
        other._share(self, self.values)
        other._set(core=core, place=place, signs=[sign for _, sign in core.assembly])
        return other

    def _share(self, other: Mechanism, values: Float) -> None:
        """Become the other mechanism with other values of its dimensions."""
        for name in ("core", "description", "_moved", "_structure", "_names", "place", "signs"):
            object.__setattr__(self, name, getattr(other, name))
        self._set(_joints=None)
        self._set_values(values)

    def __setattr__(self, name: str, value: object) -> None:
        message = f"Mechanism is immutable ({name!r}): use with_dimensions() or with_driver()"
        raise AttributeError(message)

    def __delattr__(self, name: str) -> None:
        message = f"Mechanism is immutable ({name!r}): use with_dimensions() or with_driver()"
        raise AttributeError(message)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, (self.description, np.array(self.values), self.place, self._moved))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mechanism):
            return NotImplemented
        return (
            self.description == other.description
            and self.place == other.place
            and self.values.shape == other.values.shape
            and self.values.tobytes() == other.values.tobytes()
        )

    def __hash__(self) -> int:
        return hash((self.description, self.values.shape, self.values.tobytes()))

    def __repr__(self) -> str:
        batch = f", {self.shape} designs" if self.shape else ""
        return f"<assur.Mechanism {self.core.formula}{batch}>"

    # -- what it is ---------------------------------------------------------

    @property
    def shape(self) -> tuple[int, ...]:
        """Design shape S: ``()`` for one mechanism."""
        return self.values.shape[1:]

    @property
    def joints(self) -> Mapping[str, Any]:
        """Positions of the joints at `q0`, m: (x, y), or arrays S + (2,) for a batch.

        NaN for designs that cannot be assembled at `q0`.
        """
        if self._joints is None:
            drawn: dict[str, Any] = {name: (x, y) for name, x, y in self.description.joints}
            if not self._is_as_drawn:
                motion = self.solve(self.q0_array, order=0, on_error="nan")
                arrays = {name: motion.joint(name).value for name in drawn}
                single = not self.shape
                drawn = {
                    name: _as_typed(at, drawn[name]) if single else at
                    for name, at in arrays.items()
                }
            object.__setattr__(self, "_joints", MappingProxyType(drawn))
        assert self._joints is not None
        return self._joints

    @property
    def _is_as_drawn(self) -> bool:
        """Whether this is the drawing, not with another assembly or adjusted redundant links."""
        return (
            self.place is None
            and self.values.tolist() == self.core.drawing
            and not self.description.assembly
            and self.core.adjustment == 0.0
        )

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the joints: unlike `joints`, without solving a design.

        :meta private:
        """
        return tuple(name for name, _, _ in self.description.joints)

    @property
    def links(self) -> Mapping[str, tuple[str, ...]]:
        """Joints of each link."""
        return MappingProxyType(dict(self.description.links))

    @property
    def slides(self) -> Mapping[str, Slide]:
        """Sliding pairs by name."""
        return MappingProxyType(dict(self.description.slides))

    @property
    def driver(self) -> DriverLike | tuple[DriverLike, ...]:
        """The driver, or a tuple of drivers."""
        drivers = self.description.drivers
        return drivers[0] if len(drivers) == 1 else drivers

    @property
    def q0(self) -> float | Float:
        """Coordinate of the driver in the drawing, rad or m; an array (n,) for n drivers."""
        q0 = self.q0_array
        return float(q0) if q0.ndim == 0 else q0

    @property
    def driver_count(self) -> int:
        """Number of drivers.

        :meta private:
        """
        return len(self.description.drivers)

    @property
    def indices(self) -> tuple[dict[str, int], dict[str, int], dict[str, int]]:
        """Indices of joints, links and slides by name; not to be modified.

        :meta private:
        """
        if self._names is None:
            own = self.description
            named = own.joints, own.links, own.slides
            names = tuple({one[0]: i for i, one in enumerate(of)} for of in named)
            object.__setattr__(self, "_names", names)
        assert self._names is not None
        return self._names

    @property
    def q0_array(self) -> Float:
        """The same, of one driver an array ().

        :meta private:
        """
        q0 = np.array(self.core.q0)
        return q0[0] if len(q0) == 1 else q0

    @property
    def structure(self) -> Structure:
        """Mobility, structural formula, Assur groups, redundant links."""
        if self._structure is None:
            real, drawn, counted = self.core.mobility
            links, slides = self.core.redundant
            groups = tuple(
                Group(
                    cls=one["cls"],
                    order=one["order"],
                    kind=one["kind"],
                    artobolevsky_kind=one["artobolevsky_kind"],
                    links=tuple(one["links"]),
                    joints=tuple(one["joints"]),
                    slides=tuple(one["slides"]),
                )
                for one in self.core.groups
            )
            named = dict(self.description.links)
            at_joints = [joint for on in named.values() for joint in on]
            pins = [at_joints.count(joint) - 1 for joint in dict.fromkeys(at_joints)]
            structure = Structure(
                mobility=real,
                mobility_at_drawing=drawn,
                mobility_counted=counted,
                cls=self.core.cls,
                formula=self.core.formula,
                groups=groups,
                redundant=(*links, *slides),
                moving_links=len(named) - ("ground" in named),
                turning_pairs=sum(pins),
                sliding_pairs=len(self.description.slides),
                adjustment=max(self.core.adjustment, self._moved),
            )
            object.__setattr__(self, "_structure", structure)
        assert self._structure is not None
        return self._structure

    @property
    def assembly(self) -> Assembly:
        """The assembly shown by the drawing."""
        return Assembly(dict(self.core.assembly))

    def with_assembly(self, assembly: Assembly) -> Mechanism:
        """Return the mechanism drawn in another assembly, as `assemblies` found it.

        With a group above class II its `q0` is where the assembly was found.

        Parameters
        ----------
        assembly : Assembly
            One of `assemblies`.

        Returns
        -------
        Mechanism
            A new one.

        Examples
        --------
        >>> import assur
        >>> m = assur.FourBar(40, 120, 80, 100)
        >>> crossed = m.with_assembly(m.assemblies(0.7)[1])
        >>> crossed.assembly
        Assembly({'C': -1})
        """
        return self._in_assembly(assembly)

    def _in_assembly(self, assembly: Mapping[str, int] | None) -> Mechanism:
        """Return the mechanism drawn in an assembly, itself in its own."""
        if assembly is None:
            return self
        drawn = drawn_in(self, assembly)
        if drawn is not self:
            return drawn
        return self._in_signs(solver.checked_assembly(self, assembly))

    def _in_signs(self, signs: list[int]) -> Mechanism:
        """Return the mechanism drawn with these signs of all its dyads."""
        if signs == self.signs:
            return self
        if self.place is not None:
            return with_signs(self, self.place, signs)
        named = zip((name for name, _ in self.core.assembly), signs, strict=True)
        description = self.description._replace(assembly=tuple(named))
        return self._make(description, np.array(self.values))._moved_as(self)

    @property
    def dimensions(self) -> Dimensions:
        """The dimensions by name, m or rad: floats, or arrays of shape S.

        Examples
        --------
        >>> import assur
        >>> dict(assur.SliderCrank(1.0, 3.0).dimensions)["rod.length"]
        3.0
        """
        names = self.core.dimension_names
        values = self.values if self.shape else self.values.tolist()
        return Dimensions(dict(zip(names, values, strict=True)))

    # -- other mechanisms ---------------------------------------------------

    def with_dimensions(
        self, dimensions: Mapping[str, npt.ArrayLike] | Any = None, **by_name: npt.ArrayLike
    ) -> Mechanism:
        """Return the mechanism with other dimensions; arrays make a batch of designs.

        Parameters
        ----------
        dimensions : mapping of str to array_like
            New values, m or rad; arrays broadcast by NumPy's rules, with each
            other and with the designs of this mechanism, to the design shape S.
            A pandas DataFrame has a design in each row, a Series is one; variables of an xarray
            Dataset broadcast by the names of their axes. Of a table of results
            (`Measures.to_dataframe`) the dimensions are taken.
        **by_name : array_like
            The same by keyword, for names without a dot.

        Returns
        -------
        Mechanism
            With design shape S.

        Raises
        ------
        InputError
            If a name is unknown (the message suggests similar ones) or shapes do not
            broadcast.
        DimensionError
            If a value is out of range and this is one mechanism; in a batch such
            designs get ``Status.BAD_DIMENSION``.

        Examples
        --------
        >>> import assur, numpy as np
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
        >>> m.with_dimensions({"coupler.length": np.linspace(2.8, 3.2, 5)}).shape
        (5,)
        """
        given = dimensions_by_name(dimensions, self.core.dimension_names)
        wanted = {**{checked_name(name, "dimensions"): v for name, v in given.items()}, **by_name}
        indices = [self.core.dimension(name) for name in wanted]
        new = [real_array(v, f"dimension {name!r}", copy=False) for name, v in wanted.items()]
        try:
            shape = np.broadcast_shapes(self.shape, *(array.shape for array in new))
        except ValueError as error:
            shapes = ", ".join(f"{n!r} {a.shape}" for n, a in zip(wanted, new, strict=True))
            message = f"dimensions do not broadcast: {shapes}, designs {self.shape}"
            raise InputError(message) from error
        replaced = dict(zip(indices, new, strict=True))
        values = np.empty((len(self.values), *shape))
        for index, old in enumerate(self.values):
            values[index] = replaced.get(index, old)
        if not shape:
            self.core.check_dimensions(values.tolist())
        return self._with_values(values)

    def with_driver(
        self,
        driver: DriverLike | Sequence[DriverLike],
        assembly: Mapping[str, int] | None = None,
        q: npt.ArrayLike | None = None,
    ) -> Mechanism:
        """Return the same linkage with another driver.

        Parameters
        ----------
        driver : str, Drive or sequence of them
            As in the constructor.
        assembly : mapping of str to int, optional
            Signs of dyads drawn with their links collinear; the dyads depend on the
            driver.
        q : float or array_like, optional
            Coordinate of the present driver, for one design: the new mechanism is drawn at that
            position, which with the assembly is kept. By default it is `q0`.

        Returns
        -------
        Mechanism
            A new one.

        Examples
        --------
        >>> import assur
        >>> four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.0)
        >>> four_bar.with_driver("rocker").structure.formula
        'I(rocker) → II(crank, coupler)'
        >>> turned = four_bar.with_driver("rocker", q=1.0)
        >>> four_bar.solve(1.0).link("rocker").value - turned.q0
        np.float64(0.0)
        """
        drivers, signs = encode.drivers(driver), checked_signs(assembly, strict=False)
        return redrive(self, drivers, signs, q)._moved_as(self)

    def __len__(self) -> int:
        if not self.shape:
            message = "one mechanism has no length: it is no batch of designs"
            raise TypeError(message)
        return self.shape[0]

    def __bool__(self) -> bool:
        return True

    def __iter__(self) -> Iterator[Mechanism]:
        return (self[i] for i in range(len(self)))

    def __getitem__(self, index: Any) -> Mechanism:
        """Return some designs of a batch, or one.

        They are chosen by an integer, a slice, a mask or indices for each axis of `shape`.

        Examples
        --------
        >>> import assur, numpy as np
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
        >>> batch = m.with_dimensions({"rocker.length": np.linspace(1.8, 2.6, 5)})
        >>> turns = batch[batch.limits().full_rotation]
        >>> len(batch), len(turns), turns[0].dimensions["rocker.length"]
        (5, 5, 1.8)
        """
        from assur.kinematics.select import designs_of

        return designs_of(self, index)

    def design(self, index: int | tuple[int, ...]) -> Mechanism:
        """Return one design of a batch as a single mechanism.

        Parameters
        ----------
        index : int or tuple of int
            Index into `shape`.

        Returns
        -------
        Mechanism
            One design, of shape ().

        Examples
        --------
        >>> import assur
        >>> batch = assur.FourBar(crank=1.0, coupler=[2.8, 3.0, 3.2], rocker=2.5, ground=3.0)
        >>> batch.shape, batch.design(2).dimensions["coupler.length"]
        ((3,), 3.2)
        """
        entry = checked_index(index, self.shape, "design")
        values = np.array(np.moveaxis(self.values, 0, -1)[entry])
        self.core.check_dimensions(values.tolist())
        return self._with_values(values)

    # -- moving -------------------------------------------------------------

    def solve(
        self,
        q: npt.ArrayLike | None = None,
        order: int = 2,
        outputs: Iterable[str] | None = None,
        assembly: Mapping[str, int] | None = None,
        on_error: Literal["raise", "nan"] = "raise",
        threads: int | None = None,
        out: Motion | None = None,
        *,
        deg: npt.ArrayLike | None = None,
    ) -> Motion:
        """Solve positions and analogues.

        Parameters
        ----------
        q : array_like
            Coordinate of the driver, rad or m: a scalar, ``(N,)`` or ``S + (N,)``;
            n drivers add a last axis of n.
        deg : array_like, optional
            The coordinate of a driven angle in degrees, in place of `q`. The motion's own q, and
            everything else, remain in rad.
        order : {2, 0, 1, 3}
            Highest order of the analogues.
        outputs : iterable of str, optional
            Names of joints, links and slides to keep; all by default.
        assembly : mapping of str to int, optional
            Signs of dyads where they differ from the drawing's (see `assemblies`).
        on_error : {"raise", "nan"}
            For unreachable positions: raise an error for the first one, or return NaN,
            each with its own status code.
        threads : int, optional
            Most threads; by default one per core. Small work is done by one, because it ends
            before others have started. Results do not depend on it.
        out : Motion, optional
            A motion of the same shape, order and outputs. It and every array obtained
            from it are overwritten; avoids allocation.

        Returns
        -------
        Motion
            Arrays of shape S + (N,), points with a last axis of 2.

        Raises
        ------
        PositionError, DimensionError, InputError
            With ``on_error="raise"``: for the first position that has no solution.

        Warns
        -----
        AssurWarning
            If coordinates of a driven angle are whole numbers, some beyond two turns: degrees?

        Examples
        --------
        >>> import assur, numpy as np
        >>> motion = assur.SliderCrank(0.05, 0.2).solve(np.linspace(0, 2 * np.pi, 5))
        >>> motion.slide("bore").value.round(4)
        array([0.25  , 0.1936, 0.15  , 0.1936, 0.25  ])
        >>> assur.SliderCrank(0.05, 0.2).solve(deg=[0, 180]).slide("bore").value.round(4)
        array([0.25, 0.15])
        """
        is_typed = deg is None and q is not None
        if deg is not None or q is None:
            q = solver.in_radians(self, q, deg)
        return solver.solve(self, q, order, outputs, assembly, on_error, threads, out, is_typed)

    def follow(
        self,
        laws: Law | Sequence[Law | float],
        t: npt.ArrayLike,
        on_error: Literal["raise", "nan"] = "raise",
    ) -> TimedMotion:
        """Solve positions over time, the driver moving by an input law.

        Parameters
        ----------
        laws : Law or sequence of Law or float
            An input law (`assur.laws`); of several drivers one each, or the coordinate of one that
            is held.
        t : array_like
            Times, s, shape (N,).
        on_error : {"raise", "nan"}
            As for `solve`.

        Returns
        -------
        TimedMotion
            Value, velocity, acceleration and jerk of everything over t.

        Examples
        --------
        >>> import assur, numpy as np
        >>> engine = assur.SliderCrank(0.05, 0.2)
        >>> law = assur.laws.Cycloidal(0.0, np.pi, duration=0.5)
        >>> moved = engine.follow(law, np.linspace(0.0, 0.5, 101))
        >>> piston = moved.slide("bore")
        >>> round(float(abs(piston.velocity).max()), 6), float(piston.velocity[-1])
        (0.641267, 0.0)
        """
        from assur.kinematics.timed import follow

        return follow(self, laws, t, on_error)

    def assemblies(self, q: npt.ArrayLike, threads: int | None = None) -> Any:
        """Return every real assembly at a position, for use as ``solve(q, assembly=a)``.

        Dyads are solved in closed form. Of a group above class II all complex assemblies with
        random dimensions are known, and followed to those of the design: no isolated one is left
        out [1]_.

        Parameters
        ----------
        q : array_like
            Coordinate of the driver, as for `solve`.
        threads : int, optional
            Most threads; by default one per core.

        Returns
        -------
        Assemblies
            The list of one position, with `complex_count` and `failures`; of several positions or
            designs, nested lists in the shape S + (N,).

        Warns
        -----
        AssurWarning
            If an assembly may be missing: the group moves while its driver is locked (a
            parallelogram), or a path could not be followed.

        References
        ----------
        .. [1] A. P. Morgan and A. J. Sommese, "Coefficient-parameter polynomial continuation",
           Appl. Math. Comput. 29 (1989) 123-160.

        Examples
        --------
        >>> import assur
        >>> assur.FourBar(40, 120, 80, 100).assemblies(0.7)
        [Assembly({'C': 1}), Assembly({'C': -1})]
        """
        return assembly_search.assemblies(self, q, threads)

    def limits(
        self, assembly: Mapping[str, int] | None = None, threads: int | None = None
    ) -> Limits:
        """Return where an assembly exists.

        Parameters
        ----------
        assembly : mapping of str to int, optional
            As for `solve`; the drawing's by default.
        threads : int, optional
            Most threads for a batch; by default one per core.

        Returns
        -------
        Limits
            Intervals of q, dead points (to 1e-10), whether the motion closes.

        Examples
        --------
        >>> import assur
        >>> limits = assur.FourBar(3.0, 2.5, 2.0, 4.0).limits()
        >>> limits.intervals.round(6)
        array([[-1.371564,  1.371564]])
        >>> limits.full_rotation, limits.dead_points[0].group
        (False, 'II(coupler, rocker)')
        >>> assur.FourBar(1.0, 4.0, 3.0, 4.5).limits()
        <assur.Limits [-inf, inf], closes in 1 turn>
        """
        return limit_search.limits(self, assembly, threads)

    def extremes(
        self, name: str, order: int = 0, assembly: Mapping[str, int] | None = None
    ) -> Extremes:
        """Return the least and the greatest value of a coordinate, over all q of an assembly.

        Parameters
        ----------
        name : str
            A joint's ``"B.x"`` or ``"B.y"``, a link (its angle) or a slide (its value).
        order : {0, 1, 2, 3}
            Of the derivative by q: 0 the coordinate itself, 1 to 3 its analogues.
        assembly : mapping of str to int, optional
            As for `solve`; the drawing's by default.

        Returns
        -------
        Extremes
            The least and the greatest value, the stroke and the time ratio.

        Examples
        --------
        >>> import assur
        >>> bore = assur.SliderCrank(1.0, 3.0, 0.5).extremes("bore")
        >>> round(bore.stroke, 9), round(bore.time_ratio, 9)
        (2.032135293, 1.084500514)
        >>> round(bore.greatest.value, 9), round(bore.greatest.q, 9)
        (3.968626967, 0.125327831)
        """
        return extreme_search.extremes(self, name, order, assembly)

    def find(self, name: str, value: Any) -> list[tuple[Any, Assembly]]:
        """Return every coordinate and assembly at which a coordinate of the motion has a value.

        Parameters
        ----------
        name : str
            A slide, a link (its angle, whole turns apart), or a joint's ``"B.x"`` or ``"B.y"``;
            with two drivers a joint.
        value : float or array_like
            The value, m or rad; with two drivers the joint's place (x, y).

        Returns
        -------
        list of (q, Assembly)
            By q, in (−π, π] of an angle; an array of two with two drivers.

        Examples
        --------
        >>> import assur
        >>> engine = assur.SliderCrank(1.0, 3.0)
        >>> [(round(q, 6), dict(assembly)) for q, assembly in engine.find("bore", 3.0)]
        [(-1.403348, {'B': 1}), (1.403348, {'B': 1})]
        """
        return inverse.find(self, name, value)

    def configuration_curve(self, positions: int = 32) -> ConfigurationCurve:
        """Return all positions of a design as a curve: branches, folds, circuits.

        All assemblies are found at a fan of coordinates, and followed to the dead points; where
        these do not explain how many assemblies two neighbours have, the fan is refined.

        Parameters
        ----------
        positions : int
            Coordinates of the fan about `q0`, over a turn, or over all that a slide can reach: from
            2 to 100 000.

        Returns
        -------
        ConfigurationCurve
            Its branches, folds and circuits.

        Examples
        --------
        >>> import assur
        >>> curve = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve()
        >>> len(curve.circuits), [round(fold.q, 6) for fold in curve.folds]
        (1, [-1.371564, 1.371564])
        """
        return curves.configuration_curve(self, positions)

    def defects(self, q: npt.ArrayLike, joints: Mapping[str, npt.ArrayLike]) -> Any:
        """Return what keeps designs from going through given positions one after another.

        Parameters
        ----------
        q : array_like
            Coordinates of the driver at K positions, in the wanted order, rad or m; shape (K,) for
            all designs, or S + (K,).
        joints : mapping of str to array_like
            Where joints are then, m, shape S + (K, 2): they tell the assembly.

        Returns
        -------
        Defect or ndarray of uint8
            Of each design, shape S: flags of `Defect`, 0 for none. Of one design a `Defect`.

        Examples
        --------
        The second design reaches the two positions in different assemblies only:

        >>> import assur, numpy as np
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.2).with_dimensions({"rocker.length": [2.5, 2.6]})
        >>> open, crossed = m.solve([0.5, 2.0]), m.solve([0.5, 2.0], assembly={"C": -1})
        >>> c = open.joint("C").value.copy()
        >>> c[1, 1] = crossed.joint("C").value[1, 1]
        >>> m.defects([0.5, 2.0], {"C": c})
        array([0, 3], dtype=uint8)
        >>> assur.Defect(3)
        <Defect.CIRCUIT|BRANCH: 3>
        """
        from assur.kinematics.curve.design_defects import design_defects

        return design_defects(self, q, joints)

    def singular_loci(
        self,
        joint: str | None = None,
        drivers: Sequence[DriverLike] | None = None,
        positions: int = 48,
    ) -> tuple[SingularLocus, ...]:
        """Return the curves of singular positions of a mechanism with two drivers or more.

        All assemblies are found on a grid of the drivers' coordinates; where two neighbours have
        not the same number, the fold between them is found and traced by arc length. A curve that
        lies between neighbours with the same numbers is missed: a closer grid shows it.

        Parameters
        ----------
        joint : str, optional
            With it, also those of the first kind, where the joint, locked, does not hold the
            mechanism.
        drivers : sequence of str or Drive, optional
            With more than two drivers the two that move; the others are held at `q0`.
        positions : int
            Coordinates of the grid along each axis: over a turn of an angle; of a slide over the
            sum of all lengths, both ways.

        Returns
        -------
        tuple of SingularLocus
            Those of the second kind (dead points: the locked drivers do not hold the mechanism),
            then those of the first.

        References
        ----------
        .. [1] C. Gosselin and J. Angeles, "Singularity analysis of closed-loop kinematic chains",
           IEEE Trans. Robotics and Automation 6 (1990) 281-290.

        Examples
        --------
        Of a five-bar, the distal links are in line:

        >>> import assur, numpy as np
        >>> five_bar = assur.Mechanism(
        ...     joints={"A": (0, 0), "B": (0, 1), "P": (0.7, 1.2), "D": (1.4, 0.6), "E": (1, 0)},
        ...     links={"ground": "AE", "left": "AB", "rod": "BP", "arm": "DP", "right": "ED"},
        ...     driver=("left", "right"),
        ... )
        >>> locus = five_bar.singular_loci(positions=16)[0]
        >>> apart = np.linalg.norm(locus.joints["B"] - locus.joints["D"], axis=1)
        >>> lengths = [five_bar.dimensions[f"{name}.length"] for name in ("rod", "arm")]
        >>> bool(np.allclose(apart, sum(lengths), atol=1e-9))
        True
        """
        from assur.kinematics.loci.singular import singular_loci

        return singular_loci(self, joint, drivers, positions)

    def workspace(
        self, joint: str, drivers: Sequence[DriverLike] | None = None, positions: int = 48
    ) -> Workspace:
        """Return where a joint of a mechanism with two drivers or more can be.

        Parameters
        ----------
        joint : str
            The joint.
        drivers : sequence of str or Drive, optional
            As for `singular_loci`.
        positions : int
            Coordinates of the grids, of the drivers and of the joint, along each axis.

        Returns
        -------
        Workspace
            In how many ways the joint reaches each node of a grid, and the curves where that
            number changes: `singular_loci` of the first kind.

        Examples
        --------
        >>> import assur
        >>> five_bar = assur.Mechanism(
        ...     joints={"A": (0, 0), "B": (0, 1), "P": (0.7, 1.2), "D": (1.4, 0.6), "E": (1, 0)},
        ...     links={"ground": "AE", "left": "AB", "rod": "BP", "arm": "DP", "right": "ED"},
        ...     driver=("left", "right"),
        ... )
        >>> five_bar.workspace("P", positions=16).contains([[0.5, 1.2], [0.5, 3.0]])
        array([ True, False])
        """
        from assur.kinematics.loci.singular import workspace

        return workspace(self, joint, drivers, positions)

    def map(
        self, of: str, dimensions: Mapping[str, npt.ArrayLike], q: npt.ArrayLike | None = None
    ) -> DesignMap:
        """Return a number of every design over two dimensions, and where it changes.

        Parameters
        ----------
        of : {"full_rotation", "assemblies"}
            Whether the driver goes round and the motion closes (1 or 0), as `limits` says; or how
            many assemblies there are at `q`.
        dimensions : mapping of str to array_like
            Two names of dimensions, each with ascending values, m or rad.
        q : float or array_like, optional
            Coordinate for ``"assemblies"``; the drawing's by default.

        Returns
        -------
        DesignMap
            Values on the grid, and boundaries as curves (each point to a billionth of the distance
            of two neighbours; what lies within one cell is missed).

        Examples
        --------
        Grashof's limit of a four-bar with crank 1 and coupler 3:

        >>> import assur, numpy as np
        >>> four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.0)
        >>> over = {"rocker.length": [1.5, 2.5, 3.5], "ground.D.x": [1.7, 2.7, 3.7]}
        >>> rotates = four_bar.map("full_rotation", over)
        >>> rotates.values
        array([[0, 1, 0],
               [1, 1, 1],
               [1, 1, 1]])
        >>> rotates.boundaries[0].points.round(6).tolist()
        [[2.3, 1.7], [1.5, 2.5]]
        """
        from assur.kinematics.loci.maps import design_map

        return design_map(self, of, dimensions, q)

    def save(self, path: str | PathLike[str]) -> None:
        """Write the mechanism, or all designs of a batch, to a TOML file.

        Parameters
        ----------
        path : path-like
            The file; one that exists is replaced. docs/files.md describes the format.

        Raises
        ------
        InputError
            A file that cannot be written (`assur.files.FileError`), a batch without designs, or
            with more than a file holds.

        See Also
        --------
        assur.load : returns the mechanism, to the last bit.

        Examples
        --------
        >>> import assur, pathlib, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "linkage.toml"
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"rocker.length": [2.4, 2.5]})
        >>> m.save(path)
        >>> assur.load(path) == m
        True
        """
        import assur

        # Through the package: files are a floor above.
        assur.files.save(self, path)

    def plot(
        self,
        q: npt.ArrayLike | None = None,
        ax: Any = None,
        assembly: Assembly | None = None,
        labels: Literal["first", "all", "none"] = "first",
        groups: bool = False,
        dark: bool = False,
    ) -> Any:
        """Draw the mechanism at one position or at many (needs matplotlib).

        The frame of the picture is that of the whole motion, whatever the position. Artists carry
        names: ``artist.get_gid()`` is ``"link coupler"``, ``"joint B"``, ``"slide bore"`` …

        Parameters
        ----------
        q : float or array_like, optional
            Coordinate; the drawing's by default, or where the assembly was found. Of several the
            first is drawn bold, the others light and numbered.
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        assembly : Assembly, optional
            As for `solve`; the drawing's by default.
        labels : {"first", "all", "none"}
            Names the joints of the first position, or of all; positions are numbered from 0.
        groups : bool
            Each Assur group in a colour of its own, and the structural formula.
        dark : bool
            For dark backgrounds.

        Returns
        -------
        matplotlib.axes.Axes
            Those drawn on.

        Raises
        ------
        InputError
            A batch of designs, or no matplotlib axes.
        PositionError
            If a position does not exist.

        Examples
        --------
        >>> import assur, numpy as np
        >>> axes = assur.FourBar(1.0, 3.0, 2.5, 3.0).plot(q=1.0)
        >>> sorted({artist.get_gid() for artist in axes.patches})[:3]
        ['driver', 'link coupler', 'link crank']
        >>> axes = assur.FourBar(1.0, 3.0, 2.5, 3.0).plot(np.arange(0.0, 6.0, 0.5))
        """
        from assur.pictures.linkage.mechanism import mechanism_picture

        return mechanism_picture(self, q, ax, assembly, labels, groups, dark)

    def to_html(
        self,
        path: str | PathLike[str],
        q: npt.ArrayLike | None = None,
        omega: float | None = None,
        paths: Sequence[str] | None = None,
        diagrams: Sequence[str] | None = None,
        title: str | None = None,
        dark: bool | None = None,
    ) -> None:
        """Write one self-contained page that plays the mechanism in a browser.

        The whole turn of the driver (or what can be reached) is computed beforehand; nothing is
        fetched. On the page the mechanism is dragged or played, paths, velocities, accelerations,
        groups and other positions are switched, diagrams have a cursor. A notebook shows the same.

        Parameters
        ----------
        path : path-like
            The file; one that exists is replaced.
        q : float or array_like, optional
            Where to begin, rad or m: the drawing by default. Several coordinates are played in
            their order, as by `Motion.to_html`.
        omega : float, optional
            Speed of the driver, rad/s or m/s: for arrows, diagrams and the clock.
        paths : sequence of str, optional
            Joints whose paths and vectors are shown at first.
        diagrams : sequence of str, optional
            Up to three, by the names of `Motion.to_dataframe`: ``"rocker"``, ``"rocker.omega"``,
            ``"C.x"``, ``"bore.a"`` …; ``"C.v"`` and ``"C.a"`` are magnitudes. By default the
            output with its speed and acceleration.
        title : str, optional
            Above the page; the name of the file by default.
        dark : bool, optional
            As the reader's system by default.

        Raises
        ------
        InputError
            A batch of designs, several drivers without `q`, an unknown name, a file that cannot be
            written.

        Examples
        --------
        >>> import assur, pathlib, tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     page = pathlib.Path(folder, "press.html")
        ...     assur.SliderCrank(0.05, 0.2).to_html(page, omega=10.0, diagrams=["bore", "bore.v"])
        ...     page.stat().st_size < 150_000
        True
        """
        from assur.pictures.page.html import write_page

        write_page(
            self, path, q=q, speed=omega, paths=paths, diagrams=diagrams, title=title, dark=dark
        )

    def explore(self, height: int = 640) -> Explorer:
        """Show the studio's view in a notebook: play, drag and change it there.

        Both ways: dragging changes ``view.mechanism``, assigning ``view.mechanism`` redraws. Needs
        anywidget: ``pip install assur[notebook]``.

        Parameters
        ----------
        height : int
            Of the cell, px.

        Returns
        -------
        Explorer
            The widget: a notebook shows it if it is the last line of a cell.

        Raises
        ------
        InputError
            A batch of designs, or anywidget is not installed.

        Examples
        --------
        >>> import assur
        >>> view = assur.FourBar(1.0, 3.0, 2.5, 3.0).explore()
        >>> view.mechanism.structure.mobility
        1
        """
        from assur._later import explorer

        return explorer(self, height)

    def to_drawing(
        self,
        path: str | PathLike[str],
        q: npt.ArrayLike | None = None,
        link: str | None = None,
        scale: float | str | None = None,
        *,
        paper: Literal["A4", "A3", "A2", "A1", "A0"] | None = None,
        title: str | None = None,
        outlines: bool = False,
        width: float | None = None,
        hole: float | None = None,
        assembly: Assembly | None = None,
    ) -> float:
        """Write a drawing to scale: DXF, SVG or PDF, by the suffix.

        A position, dimensioned, or links as parts: outline, holes and slots, with the dimensions
        between the holes. Layers are named: ``GROUND``, ``LINK_coupler`` and so on for each link,
        ``JOINTS``, ``DRIVER``, ``CENTRES``, ``DIMENSIONS``, ``TEXT``, ``HATCHING``, ``SHEET``. DXF
        is in mm at full size, with a layout that shows the paper (needs ezdxf); SVG and PDF are as
        large as the paper (need matplotlib).

        Parameters
        ----------
        path : path-like
            The file, ``.dxf``, ``.svg`` or ``.pdf``; one that exists is replaced.
        q : float or array_like, optional
            Coordinate of the position; the drawing's by default.
        link : str, optional
            One link as a part, in its own frame: the first joint at the origin, the second on x;
            ``"all"``: a sheet with every link. By default a position is drawn.
        scale : float or str, optional
            A length on the paper by that of the mechanism, 0.5 or ``"1:2"``; by default the
            largest of 1, 2 and 5 times a power of ten that fits.
        paper : {"A4", "A3", "A2", "A1", "A0"}, optional
            By default A4, or the smallest on which the given scale fits.
        title : str, optional
            Of the sheet; the file's name by default.
        outlines : bool
            A position with the links' outlines in place of symbols.
        width, hole : float, optional
            Width of the links and diameter of the holes, m; in proportion by default.
        assembly : Assembly, optional
            As for `solve`; the drawing's by default.

        Returns
        -------
        float
            The scale.

        Raises
        ------
        InputError
            Another suffix, a path that cannot be written, no such link, a scale that does not
            fit, a batch of designs.
        PositionError
            If the position does not exist.

        Examples
        --------
        >>> import assur, pathlib, tempfile
        >>> folder = pathlib.Path(tempfile.mkdtemp())
        >>> four_bar = assur.FourBar(0.04, 0.12, 0.08, 0.1)
        >>> four_bar.to_drawing(folder / "press.svg")
        1.0
        >>> four_bar.to_drawing(folder / "parts.svg", link="all", scale="1:2")
        0.5
        """
        from assur.pictures.drawing.export import write_drawing

        return write_drawing(
            self, path, q, link, scale, paper, title, outlines, width, hole, assembly
        )

    def _repr_svg_(self) -> str | None:
        """Return a static picture for notebooks; none of a batch."""
        from assur.pictures.page.html import notebook_svg

        return notebook_svg(self)

    def _repr_html_(self) -> str | None:
        """Return what a notebook shows; none of a batch."""
        from assur.pictures.page.html import notebook_html

        return notebook_html(self)


def _rebuild(
    description: Description, values: Float, place: Place | None = None, moved: float = 0.0
) -> Mechanism:
    mechanism = Mechanism._make(description, values)
    mechanism._set(_moved=moved)
    if place is None:
        return mechanism
    own = place.mechanism
    core = own.core.drawn_in(own.values.tolist(), list(place.q), place.numbers)
    return mechanism._drawn_at(place, core)


def _as_typed(solved: Float, drawn: tuple[float, float]) -> tuple[float, ...]:
    """Return a place; coordinates that differ from the drawing's by rounding alone are those."""
    size = float(np.abs(solved).max())
    return tuple(
        own if abs(x - own) <= TYPED * size else x
        for x, own in zip(solved.tolist(), drawn, strict=True)
    )
