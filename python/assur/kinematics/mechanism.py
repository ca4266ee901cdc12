"""Mechanisms: described once, compiled, solved at any coordinate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
import numpy.typing as npt

from assur._later import explorer, save
from assur._other_names import other_names, renamed, renamed_rates
from assur._validate import checked_index, checked_signs, real_array
from assur.description import encode
from assur.description.words import Cylinder
from assur.kinematics import assembly as assembly_search
from assur.kinematics import extremes as extreme_search
from assur.kinematics import limits as limit_search
from assur.kinematics import solve as solver
from assur.kinematics.assembly import Assembly
from assur.kinematics.drawn import in_assembly, redrive
from assur.kinematics.grashof import grashof
from assur.kinematics.model import MechanismModel, at_place, with_values
from assur.kinematics.named_dimensions import with_dimensions
from assur.kinematics.solve_arguments import in_radians, q_or_deg, warn_if_degrees

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from os import PathLike

    from matplotlib.axes import Axes

    from assur._arrays import Float, Index
    from assur._later import Explorer
    from assur.description.encode import Description
    from assur.description.words import DriverLike, Slide
    from assur.kinematics.assembly import Assemblies
    from assur.kinematics.curve.curve import ConfigurationCurve
    from assur.kinematics.curve.design_defects import Defect
    from assur.kinematics.extremes import Extremes
    from assur.kinematics.grashof import Grashof
    from assur.kinematics.inverse.solutions import InversePath, InverseSolution, InverseSolutions
    from assur.kinematics.limits import Limits
    from assur.kinematics.loci.maps import DesignMap
    from assur.kinematics.loci.singular import SingularLocus, Workspace
    from assur.kinematics.model import Place
    from assur.kinematics.motion import Motion
    from assur.kinematics.named_dimensions import DimensionsLike
    from assur.kinematics.timed import TimedMotion
    from assur.laws import Law

__all__ = ["Mechanism"]


@other_names(
    forward_kinematics="solve(q) has positions, velocities and accelerations",
    inverse_kinematics="find(name, value) has every q and assembly; with near=q it follows one",
    jacobian="solve(q).jacobian(name, by=…)",
    dof="it is structure.mobility",
    mobility="it is structure.mobility",
    simulate="assur.Machine(mechanism, bodies=…).run(t_end)",
    inverse_dynamics="assur.Machine(mechanism, bodies=…).effort(q, speed, acceleration)",
    optimize="assur.sweep() measures designs; solve(q).sensitivity(name) has exact gradients",
    dead_points="it is limits().dead_points; dead centres of a slide are extremes(name)",
    dead_centres="extremes(name) has .min.q and .max.q",
    stroke="extremes(name).stroke",
    swing="extremes(name).stroke",
    time_ratio="extremes(name).time_ratio",
    formula="it is structure.formula",
    structural_formula="it is structure.formula",
    draw="plot(q), or to_html(path)",
    show="plot(q), or to_html(path)",
    to_dxf="to_drawing(path)",
    to_csv="solve(q).to_dataframe().to_csv(path)",
    to_excel="solve(q).to_excel(path)",
    transmission_angle="solve(q).transmission_angle(joint)",
    effort="assur.Machine(mechanism, bodies=…, loads=…).effort(q, speed)",
    torque="assur.Machine(mechanism, bodies=…, loads=…).effort(q, speed)",
    forces="assur.Machine(mechanism, bodies=…, loads=…).reactions(q, speed)",
    reactions="assur.Machine(mechanism, bodies=…, loads=…).reactions(q, speed)",
    run="assur.Machine(mechanism, bodies=…).run(t_end)",
    joint="solve(q).joint(name)",
    link="solve(q).link(name)",
    slide="solve(q).slide(name)",
    animate="solve(q).animate(path), or to_html(path)",
    velocity="solve(q).joint(name).velocity(speed)",
    acceleration="solve(q).joint(name).acceleration(speed)",
    path="solve(q).joint(name).value, drawn by solve(q).plot(name)",
    coupler_curve="solve(q).joint(name).value, drawn by solve(q).plot(name)",
    polygon="solve(q).polygon(what, at=…)",
    velocity_polygon='solve(q).polygon("velocity", at=…)',
    is_grashof="grashof",
    toggle_positions="limits().dead_points are the driver's, extremes(name) a link's",
    inflection_circle="assur.pictures.inflection_circle(motion, link)",
    instant_centre="solve(q).instant_centre(link)",
    instant_center="solve(q).instant_centre(link)",
    inversions="with_driver(link); for another ground describe the links anew",
    cognates="there is no call yet",
)
class Mechanism(MechanismModel):
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
        Length to which the drawing is known, m, and angle of guides, rad: joints are moved, and
        guides turned, by no more than this where redundant links need it; ``structure.adjustment``
        says how far. The angle is by default the length at the size of the linkage; without a
        tolerance only rounding is adjusted, 2e-9 of the size.

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

    __slots__ = ()

    def __init__(
        self,
        joints: Mapping[str, Sequence[float] | Float],
        links: Mapping[str, Iterable[str]],
        driver: DriverLike | Sequence[DriverLike],
        *,
        slides: Mapping[str, Slide | Cylinder] | None = None,
        assembly: Mapping[str, int] | None = None,
        tolerance: float | tuple[float, float] | None = None,
    ) -> None:
        points = tuple(encode.joint(name, at) for name, at in encode.items(joints, "joints"))
        members = [(name, encode.members(name, on)) for name, on in encode.items(links, "links")]
        guides = []
        for name, guide in encode.items({} if slides is None else slides, "slides"):
            if isinstance(guide, Cylinder):
                slide, parts = encode.cylinder(name, guide, points)
                members += parts
            else:
                slide = encode.slide(name, guide, points)
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
        joints: Mapping[str, Sequence[float] | Float],
        links: Mapping[str, Iterable[str]],
        driver: DriverLike | Sequence[DriverLike],
        lengths: Mapping[tuple[str, str], float] | Mapping[str, float],
        *,
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
            letter. Other distances remain as sketched; in a link with more joints, three distances
            make a triangle on the sketch's side, which the sketch must show clearly.

        Returns
        -------
        Mechanism
            At the sketch's q in the assembly that is nearest to it.

        Raises
        ------
        InputError
            A pair without a link, lengths that do not make a triangle, or that contradict each
            other; a joint sketched on the line of two others, beside which the lengths put it.
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
        from assur.kinematics.inverse.from_lengths import sized

        return sized(Mechanism(joints, links, driver, slides=slides, assembly=assembly), lengths)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, (self.description, np.array(self.values), self.place, self._moved))

    # -- what it is ---------------------------------------------------------

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
        return in_assembly(self, assembly)

    # -- other mechanisms ---------------------------------------------------

    def with_dimensions(
        self, dimensions: DimensionsLike | None = None, **by_name: npt.ArrayLike
    ) -> Mechanism:
        """Return the mechanism with other dimensions; arrays make a batch of designs.

        Parameters
        ----------
        dimensions : mapping of str to array_like
            New values, m or rad; arrays broadcast by NumPy's rules, with each
            other and with the designs of this mechanism, to the design shape S.
            A pandas DataFrame has a design in each row, a Series is one; variables of an xarray
            Dataset broadcast by the names of their axes. From a table of results
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
        return with_dimensions(self, dimensions, by_name)

    def with_driver(
        self,
        driver: DriverLike | Sequence[DriverLike],
        *,
        assembly: Mapping[str, int] | None = None,
        q: npt.ArrayLike | None = None,
        deg: npt.ArrayLike | None = None,
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
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

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
        if deg is not None:
            q = in_radians(self, q, deg, "with_driver")
        drivers, signs = encode.drivers(driver), checked_signs(assembly, strict=False)
        return redrive(self, drivers, signs, q)._moved_as(self)

    def __iter__(self) -> Iterator[Mechanism]:
        return (self[i] for i in range(len(self)))

    def __getitem__(self, index: Index) -> Mechanism:
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
        return with_values(self, values)

    # -- moving -------------------------------------------------------------

    def solve(
        self,
        q: npt.ArrayLike | None = None,
        *,
        order: int = 2,
        outputs: Iterable[str] | None = None,
        assembly: Mapping[str, int] | None = None,
        on_error: Literal["raise", "nan"] = "raise",
        threads: int | None = None,
        out: Motion | None = None,
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
            Most threads; by default one per core. One thread does small work, which ends before
            others have started. Results do not depend on it.
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
        from_user = deg is None and q is not None
        if deg is not None or q is None:
            q = in_radians(self, q, deg)
        return solver.solve(self, q, order, outputs, assembly, on_error, threads, out, from_user)

    def follow(
        self,
        laws: Law | Sequence[Law | float] | None = None,
        t: npt.ArrayLike | None = None,
        *,
        on_error: Literal["raise", "nan"] = "raise",
        deg: Law | Sequence[Law | float] | None = None,
    ) -> TimedMotion:
        """Solve positions over time, the driver moving by an input law.

        Parameters
        ----------
        laws : Law or sequence of Law or float
            An input law (`assur.laws`), rad or m; for several drivers one each, or the coordinate
            of a driver that is held.
        t : array_like
            Times, s, shape (N,).
        on_error : {"raise", "nan"}
            As for `solve`.
        deg : Law or sequence of Law or float, optional
            The laws in degrees, in place of `laws`: ``follow(deg=law, t=t)``.

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
        >>> round(float(abs(piston.velocity()).max()), 6), float(piston.velocity()[-1])
        (0.641267, 0.0)
        """
        from assur.kinematics.timed import follow

        return follow(self, laws, t, on_error, deg)

    @overload
    def assemblies(self, q: float, *, threads: int | None = ...) -> Assemblies: ...
    @overload
    def assemblies(self, *, deg: float, threads: int | None = ...) -> Assemblies: ...
    @overload
    def assemblies(
        self,
        q: npt.ArrayLike | None = ...,
        *,
        threads: int | None = ...,
        deg: npt.ArrayLike | None = ...,
    ) -> Assemblies | list[Assemblies]: ...
    def assemblies(
        self,
        q: npt.ArrayLike | None = None,
        *,
        threads: int | None = None,
        deg: npt.ArrayLike | None = None,
    ) -> Assemblies | list[Assemblies]:
        """Return every real assembly at a position, for use as ``solve(q, assembly=a)``.

        Dyads are solved in closed form. For a group above class II, all complex assemblies with
        random dimensions are known and followed to those of the design: no isolated one is missed
        [1]_.

        Parameters
        ----------
        q : array_like
            Coordinate of the driver, as for `solve`.
        threads : int, optional
            Most threads; by default one per core.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        Assemblies
            A list for one position, with `complex_count` and `failures`; for several positions or
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
        q = q_or_deg(self, q, deg, "assemblies")
        warn_if_degrees(self, real_array(q, "q"))
        found: Assemblies | list[Assemblies] = assembly_search.assemblies(self, q, threads)
        return found

    @property
    def grashof(self) -> Grashof:
        """Grashof's type of a four-bar, with the sums of lengths that decide it.

        Any four links in a ring of four turning pairs, however drawn. The crank of the type is the
        link on the ground that the driver turns.

        Raises
        ------
        InputError
            A mechanism that is no four-bar.
        DimensionError
            One design that cannot be assembled.

        Examples
        --------
        >>> import assur
        >>> four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.2)
        >>> four_bar.grashof
        crank-rocker: s + l = 4.2 < p + q = 5.5
        >>> four_bar.with_dimensions({"ground.D.x": 0.4}).grashof.type
        'double-crank'
        """
        return grashof(self)

    def limits(
        self, *, assembly: Mapping[str, int] | None = None, threads: int | None = None
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
        self, name: str, *, order: int = 0, assembly: Mapping[str, int] | None = None
    ) -> Extremes:
        """Return the least and the greatest value of a coordinate, over all q of an assembly.

        Parameters
        ----------
        name : str
            A joint's ``"B.x"`` or ``"B.y"``, a link (its angle) or a slide (its value).
        order : {0, 1, 2, 3}
            Order of the derivative by q: 0 the coordinate itself, 1 to 3 its analogues.
        assembly : mapping of str to int, optional
            As for `solve`; the drawing's by default.

        Returns
        -------
        Extremes
            The least and the greatest value, the stroke and the time ratio.

        Raises
        ------
        InputError
            An unknown name, a batch of designs, several drivers; the angle of a link that turns
            fully with the driver, which has no extremes.
        PositionError
            An assembly that does not exist at any coordinate.

        Examples
        --------
        >>> import assur
        >>> bore = assur.SliderCrank(1.0, 3.0, 0.5).extremes("bore")
        >>> round(bore.stroke, 9), round(bore.time_ratio, 9)
        (2.032135293, 1.084500514)
        >>> round(bore.max.value, 9), round(bore.max.q, 9)
        (3.968626967, 0.125327831)
        """
        return extreme_search.extremes(self, name, order, assembly)

    # A tuple is taken for a value of each coordinate: types do not show how many drivers there are.
    @overload
    def find(
        self, name: str | Sequence[str], value: float | tuple[float, ...]
    ) -> list[InverseSolution]: ...
    @overload
    def find(self, name: str, *, deg: float) -> list[InverseSolution]: ...
    @overload
    def find(
        self,
        name: str | Sequence[str],
        value: float | tuple[float, ...],
        *,
        near: npt.ArrayLike | InverseSolution,
    ) -> InverseSolution: ...
    @overload
    def find(
        self, name: str, *, deg: float, near: npt.ArrayLike | InverseSolution
    ) -> InverseSolution: ...
    @overload
    def find(
        self,
        name: str | Sequence[str],
        value: npt.ArrayLike | None = ...,
        *,
        deg: npt.ArrayLike | None = ...,
        threads: int | None = ...,
    ) -> list[InverseSolution] | InverseSolutions: ...
    @overload
    def find(
        self,
        name: str | Sequence[str],
        value: npt.ArrayLike | None = ...,
        *,
        deg: npt.ArrayLike | None = ...,
        near: npt.ArrayLike | InverseSolution,
        threads: int | None = ...,
    ) -> InverseSolution | InversePath: ...
    def find(
        self,
        name: str | Sequence[str],
        value: npt.ArrayLike | None = None,
        *,
        deg: npt.ArrayLike | None = None,
        near: npt.ArrayLike | InverseSolution | None = None,
        threads: int | None = None,
    ) -> list[InverseSolution] | InverseSolutions | InverseSolution | InversePath:
        """Return every coordinate and assembly at which a coordinate of the motion has a value.

        This is inverse kinematics. With arrays of values, or a batch of designs, it is asked of
        each. With `near` one position is followed instead, in its assembly, by Newton's iteration
        with exact derivatives.

        Parameters
        ----------
        name : str or sequence of str
            A slide, a link (its angle, whole turns apart), or a joint's ``"B.x"`` or ``"B.y"``;
            with two drivers a joint; with n drivers any n of these, ``["P.x", "P.y", "platform"]``.
        value : float or array_like
            The value, m or rad; with two drivers the joint's place (x, y), with n drivers n
            values. Arrays of values have shape (N,), or (N, n) with n drivers; one for each design
            S + (N,) or S + (N, n).
        deg : float or array_like, optional
            The angle of a link in degrees, in place of `value`.
        near : float, array_like or InverseSolution, optional
            Where to start, the drivers' coordinates, rad or m, in the assembly of the mechanism or
            of the solution; S + (n,) for a start of each design. The position found is the one
            reached from there as the value changes straight to the given one; if that way ends, at
            a fold of the coordinate, the nearest one of the assembly. Arrays of values are
            followed one after another: each position is reached straight from the one before, and
            none where that way ends.
        threads : int, optional
            Most threads for arrays; by default one per core.

        Returns
        -------
        list of InverseSolution
            For one value of one design: each with ``.q`` and ``.assembly``, and ``q, assembly =
            solution``. By q, in (−π, π] of an angle; an array of n with n drivers. Empty if the
            value is not reached.
        InverseSolutions
            For arrays: ``.q``, ``.count``, ``.status``, and ``found[i]`` is such a list.
        InverseSolution or InversePath
            With `near`, for one value or for arrays; q of angles near that of the start.

        Raises
        ------
        InputError
            If a name is unknown, a coordinate cannot be set by itself, or a value or `near` has a
            wrong shape. In arrays values that are not finite are NaN with a status.
        PositionError
            If one value with `near` is not reached in the assembly. In arrays that is NaN with a
            status.

        Examples
        --------
        >>> import assur
        >>> engine = assur.SliderCrank(1.0, 3.0)
        >>> [round(solution.q, 6) for solution in engine.find("bore", 3.0)]
        [-1.403348, 1.403348]
        >>> round(engine.find("bore", 3.0, near=1.0).q, 6)
        1.403348
        >>> five_bar = assur.examples.five_bar()
        >>> path = five_bar.find("P", [(0.10, 0.47), (0.11, 0.46), (0.12, 0.45)], near=five_bar.q0)
        >>> path.q.round(4).tolist()
        [[1.9224, 1.279], [1.9284, 1.2132], [1.9311, 1.1504]]
        >>> five_bar.solve(path.q, assembly=path.assembly).joint("P").value.round(9).tolist()
        [[0.1, 0.47], [0.11, 0.46], [0.12, 0.45]]
        """
        from assur.kinematics.inverse.find import find

        return find(self, name, value, deg, near, threads)

    def configuration_curve(self, *, positions: int = 32) -> ConfigurationCurve:
        """Return all positions of a design as a curve: branches, folds, circuits.

        All assemblies are found at a fan of coordinates, and followed to the dead points; where
        these do not explain how many assemblies two neighbours have, the fan is refined.

        Parameters
        ----------
        positions : int
            Number of coordinates of the fan about `q0`, over a turn, or over all that a slide can
            reach: from 2 to 100 000.

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
        from assur.kinematics.curve.search import configuration_curve

        return configuration_curve(self, positions)

    def defects(
        self, q: npt.ArrayLike, joints: Mapping[str, npt.ArrayLike]
    ) -> Defect | npt.NDArray[np.uint8]:
        """Return what keeps designs from going through given positions one after another.

        Parameters
        ----------
        q : array_like
            Coordinates of the driver at K positions, in the wanted order, rad or m; shape (K,) for
            all designs, or S + (K,).
        joints : mapping of str to array_like
            Where joints are then, m, shape S + (K, 2): they determine the assembly.

        Returns
        -------
        Defect or ndarray of uint8
            Flags of `Defect` for each design, shape S, 0 for none; a `Defect` for one design.

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
        *,
        drivers: Sequence[DriverLike] | None = None,
        positions: int = 48,
    ) -> tuple[SingularLocus, ...]:
        """Return the curves of singular positions of a mechanism with two drivers or more.

        All assemblies are found on a grid of the drivers' coordinates; where the numbers of two
        neighbours differ, the fold between them is found and traced by arc length. A curve that
        lies between neighbours with the same numbers is missed: a closer grid shows it.

        Parameters
        ----------
        joint : str, optional
            With it, also those of the first kind, where the joint, locked, does not hold the
            mechanism.
        drivers : sequence of str or Drive, optional
            With more than two drivers the two that move; the others are held at `q0`.
        positions : int
            Number of coordinates of the grid along each axis: over a turn for an angle; for a slide
            over the sum of all lengths, both ways.

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
        A five-bar is singular where its distal links are in line:

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
        self, joint: str, *, drivers: Sequence[DriverLike] | None = None, positions: int = 48
    ) -> Workspace:
        """Return where a joint of a mechanism with two drivers or more can be.

        Parameters
        ----------
        joint : str
            The joint.
        drivers : sequence of str or Drive, optional
            As for `singular_loci`.
        positions : int
            Number of coordinates of the grids, of drivers and joint, along each axis.

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
        self,
        of: str,
        dimensions: Mapping[str, npt.ArrayLike],
        *,
        q: npt.ArrayLike | None = None,
        deg: npt.ArrayLike | None = None,
    ) -> DesignMap:
        """Return a count for every design over two dimensions, and where it changes.

        Parameters
        ----------
        of : {"full_rotation", "assemblies"}
            Whether the driver goes round and the motion closes (1 or 0), as `limits` says; or how
            many assemblies there are at `q`.
        dimensions : mapping of str to array_like
            Two names of dimensions, each with ascending values, m or rad.
        q : float or array_like, optional
            Coordinate for ``"assemblies"``; the drawing's by default.
        deg : float or array_like, optional
            The coordinate in degrees, in place of `q`.

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

        if deg is not None:
            q = in_radians(self, q, deg, "map")
        return design_map(self, of, dimensions, q)

    def save(self, path: str | PathLike[str]) -> None:
        """Write the mechanism, or all designs of a batch, to a TOML file.

        Parameters
        ----------
        path : path-like
            The file; one that exists is replaced. docs/reference/files.md describes the format.

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
        save(self, path)

    def plot(
        self,
        q: npt.ArrayLike | None = None,
        *,
        ax: Axes | None = None,
        assembly: Assembly | None = None,
        labels: Literal["first", "all", "none"] = "first",
        groups: bool = False,
        dark: bool = False,
        deg: npt.ArrayLike | None = None,
    ) -> Axes:
        """Draw the mechanism at one position or at many (needs matplotlib).

        The frame of the picture is that of the whole motion, whatever the position. Artists carry
        names: ``artist.get_gid()`` is ``"link coupler"``, ``"joint B"``, ``"slide bore"`` …

        Parameters
        ----------
        q : float or array_like, optional
            Coordinate; the drawing's by default, or where the assembly was found. The first of
            several is drawn bold, the others light and numbered.
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
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on.

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
        if deg is not None:
            q = in_radians(self, q, deg, "plot")
        from assur.pictures.linkage.mechanism import mechanism_picture

        return mechanism_picture(self, q, ax, assembly, labels, groups, dark)

    @renamed(paths="joint")
    @renamed_rates
    def to_html(
        self,
        path: str | PathLike[str],
        *,
        q: npt.ArrayLike | None = None,
        speed: float | None = None,
        joint: str | Sequence[str] | None = None,
        diagrams: Sequence[str] | None = None,
        title: str | None = None,
        dark: bool | None = None,
        deg: npt.ArrayLike | None = None,
    ) -> None:
        """Write one self-contained page that plays the mechanism in a browser.

        The whole turn of the driver (or what can be reached) is computed beforehand; nothing is
        fetched. The page lets the reader drag or play the mechanism and switch paths, velocities,
        accelerations, groups and other positions; diagrams have a cursor. A notebook shows the
        same.

        Parameters
        ----------
        path : path-like
            The file; one that exists is replaced.
        q : float or array_like, optional
            Where to begin, rad or m: the drawing by default. Several coordinates are played in
            their order, as by `Motion.to_html`.
        speed : float, optional
            Speed of the driver, rad/s or m/s: for arrows, diagrams and the clock.
        joint : str or sequence of str, optional
            Joints whose paths and vectors are shown at first.
        diagrams : sequence of str, optional
            Up to three, by the names of `Motion.to_dataframe`: ``"rocker"``, ``"rocker.omega"``,
            ``"C.x"``, ``"bore.a"`` …; ``"C.v"`` and ``"C.a"`` are magnitudes. By default the
            output with its speed and acceleration.
        title : str, optional
            Above the page; the name of the file by default.
        dark : bool, optional
            As the reader's system by default.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

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
        ...     assur.SliderCrank(0.05, 0.2).to_html(page, speed=10.0, diagrams=["bore", "bore.v"])
        ...     page.stat().st_size < 150_000
        True
        """
        if deg is not None:
            q = in_radians(self, q, deg, "to_html")
        from assur.pictures.page.html import write_page

        write_page(
            self, path, q=q, speed=speed, joint=joint, diagrams=diagrams, title=title, dark=dark
        )

    def explore(self, *, height: int = 640) -> Explorer:
        """Show the studio's view in a notebook: play, drag and change it there.

        Both ways: dragging changes ``view.mechanism``, assigning ``view.mechanism`` redraws. Needs
        anywidget: extra ``notebook``.

        Parameters
        ----------
        height : int
            Height of the cell, px.

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
        return explorer(self, height)

    def to_drawing(
        self,
        path: str | PathLike[str],
        *,
        q: npt.ArrayLike | None = None,
        link: str | None = None,
        scale: float | str | None = None,
        paper: Literal["A4", "A3", "A2", "A1", "A0"] | None = None,
        title: str | None = None,
        outlines: bool = False,
        width: float | None = None,
        hole: float | None = None,
        assembly: Assembly | None = None,
        deg: npt.ArrayLike | None = None,
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
            Title of the sheet; the file's name by default.
        outlines : bool
            A position with the links' outlines in place of symbols.
        width, hole : float, optional
            Width of the links and diameter of the holes, m; in proportion by default.
        assembly : Assembly, optional
            As for `solve`; the drawing's by default.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

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
        if deg is not None:
            q = in_radians(self, q, deg, "to_drawing")
        from assur.pictures.drawing.export import write_drawing

        return write_drawing(
            self, path, q, link, scale, paper, title, outlines, width, hole, assembly
        )

    def _repr_svg_(self) -> str | None:
        """Return a static picture for notebooks; None for a batch."""
        from assur.pictures.page.html import notebook_svg

        return notebook_svg(self)

    def _repr_html_(self) -> str | None:
        """Return what a notebook shows; None for a batch."""
        from assur.pictures.page.html import notebook_html

        return notebook_html(self)


# A mechanism derived from a named one is plain.
Mechanism._plain = Mechanism


def _rebuild(
    description: Description, values: Float, place: Place | None = None, moved: float = 0.0
) -> Mechanism:
    mechanism = Mechanism._make(description, values)
    mechanism._set(_moved=moved)
    if place is None:
        return mechanism
    drawn = place.mechanism
    core = drawn.core.drawn_in(drawn.values.tolist(), list(place.q), place.numbers)
    return at_place(mechanism, place, core)
