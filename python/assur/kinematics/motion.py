"""Motions: positions and analogues (derivatives by q) as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, overload

import numpy as np
import numpy.typing as npt

from assur import _core
from assur._arrays import flag, short
from assur._other_names import other_names, renamed, renamed_rates
from assur._validate import (
    checked_index,
    checked_name,
    real_array,
    refuse_without_speed,
    require_one_driver,
)
from assur.errors import InputError
from assur.kinematics import transmission
from assur.kinematics.derivatives import jacobian as derivatives
from assur.kinematics.derivatives.sensitivity import Sensitivity
from assur.kinematics.motion_model import MotionModel

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from os import PathLike

    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes

    from assur._arrays import Float, Index
    from assur._faces import AxesLike, Panels
    from assur.kinematics.quantity import Analogues

__all__ = ["Motion"]


@other_names(
    positions="joint(name).value",
    angles="link(name).value",
    velocity="joint(name).velocity(speed), link(name).velocity(speed)",
    acceleration="joint(name).acceleration(speed, acceleration)",
    angular_velocity="link(name).velocity(speed)",
    angle="link(name).value",
    velocities="joint(name).velocity(speed), link(name).velocity(speed)",
    accelerations="joint(name).acceleration(speed, acceleration)",
    export="to_excel(path), to_parquet(path), to_dataframe().to_csv(path)",
    extremes="mechanism.extremes(name), of all positions",
    to_csv="to_dataframe().to_csv(path)",
    save="to_excel, to_parquet; to_dataframe().to_csv(path)",
    instant_center="instant_centre(link)",
    curvature_radius="1 / curvature(joint)",
    radius_of_curvature="1 / curvature(joint)",
    velocity_polygon='polygon("velocity", at=…)',
    acceleration_polygon='polygon("acceleration", at=…)',
    inflection_circle="assur.pictures.inflection_circle(motion, link)",
)
class Motion(MotionModel):
    """Positions and analogues of a mechanism; made by `Mechanism.solve`.

    Attributes
    ----------
    q : numpy.ndarray
        Coordinates of the driver, rad or m.
    order : int
        Highest order of the analogues.
    kept : numpy.ndarray or None
        After a sweep with ``on_error="drop"``: indices of its designs among all.

    Examples
    --------
    >>> import assur
    >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve([0.0, 1.0, 2.0])
    >>> motion.shape, motion.order
    ((3,), 2)
    >>> motion["rocker"].value.round(6)  # rad
    array([1.696124, 1.554646, 1.894736])
    """

    def point(self, link: str, local: npt.ArrayLike) -> Analogues:
        """Return a point of a link that has no joint there, m, with its analogues.

        Parameters
        ----------
        link : str
            The link.
        local : array_like
            (x, y) in the link's frame: at its first joint, x toward the second (the ground's is
            that of the drawing); or several, shape (P, 2), stacked along a new first axis.

        Returns
        -------
        Analogues
            Values of shape S + (N, 2).

        Examples
        --------
        The middle of a coupler:

        >>> import assur
        >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(1.0)
        >>> middle = motion.point("coupler", (1.5, 0.0))
        >>> bool((abs(middle.d1 - motion.joint(["B", "C"]).d1.mean(axis=0)) < 1e-15).all())
        True
        """
        from assur.kinematics.point import point_of

        return point_of(self, link, local)

    @overload
    def __getitem__(self, index: str) -> Analogues: ...
    @overload
    def __getitem__(self, index: Index) -> Motion: ...
    def __getitem__(self, index: str | Index) -> Analogues | Motion:
        """Return a joint, link or slide by its name, or a part of the motion.

        A part is chosen by an integer, a slice, a mask or indices for each axis of `shape`.

        Examples
        --------
        >>> import assur, numpy as np
        >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(np.linspace(0.0, 3.0, 7))
        >>> motion["C"].value.shape
        (7, 2)
        >>> motion[::2].q
        array([0., 1., 2., 3.])
        """
        if not isinstance(index, str):
            from assur.kinematics.select import part_of

            return part_of(self, index)
        kinds = self.request.mechanism.indices
        for names, of in zip(kinds, (self.joint, self.link, self.slide), strict=True):
            if index in names:
                return of(index)
        known = ", ".join(repr(name) for kind in kinds for name in kind)
        message = f"[{short(index)}]: no joint, link or slide has this name; there are {known}"
        raise InputError(message)

    def __iter__(self) -> Iterator[Motion]:
        return (self[i] for i in range(len(self)))

    def curvature(self, joint: str) -> Float:
        """Return the curvature of a joint's path, 1/m, positive where it turns left as q grows.

        NaN where the joint stands still (a cusp or a dwell).

        Parameters
        ----------
        joint : str
            The joint.

        Returns
        -------
        ndarray
            1/m, S + (N,).

        Examples
        --------
        A crank's pin goes round a circle of 0.1 m:

        >>> import assur
        >>> assur.SliderCrank(crank=0.1, rod=0.4).solve([0.0, 1.0]).curvature("A")
        array([10., 10.])
        """
        require_one_driver(self.driver_count, "curvature")
        point = self.joint(checked_name(joint, "curvature"))
        values = _core.curvature(point.d1.reshape(-1), point.d2.reshape(-1))
        return values.reshape(self.shape)

    def instant_centre(self, link: str, other: str = "ground") -> Float:
        """Return the instant centre of two links in the ground's frame, m, S + (N, 2).

        Infinite where the relative motion is a translation, NaN where there is
        none.

        Parameters
        ----------
        link, other : str
            The links.

        Returns
        -------
        ndarray
            m, S + (N, 2).

        Examples
        --------
        At a dead point the rod turns about the piston's pin:

        >>> import assur
        >>> motion = assur.SliderCrank(crank=3.0, rod=5.0).solve(0.0)
        >>> motion.instant_centre("rod")
        array([8., 0.])
        """
        require_one_driver(self.driver_count, "instant_centre")
        parts = [
            (
                self.reference_points[name].value.reshape(-1),
                self.reference_points[name].d1.reshape(-1),
                self.link(name).d1.reshape(-1),
            )
            for name in (link, other)
        ]
        return _core.instant_centre(parts[0], parts[1]).reshape((*self.shape, 2))

    def mechanical_advantage(self, name: str) -> Float:
        """Return output torque (link) or force (slide) over the driver's, without losses.

        Input and output power are equal, so it is the inverse of the output's first
        analogue: infinite where the output is at rest.

        Parameters
        ----------
        name : str
            The link or slide.

        Returns
        -------
        ndarray
            S + (N,); without unit for a link, 1/m for a slide.

        Raises
        ------
        InputError
            A link that only slides: its slide has the force.

        Examples
        --------
        With the crank at a right angle to the bore 1 N·m presses with 10 N:

        >>> import assur, numpy as np
        >>> motion = assur.SliderCrank(crank=0.1, rod=0.4).solve(np.pi / 2)
        >>> motion.mechanical_advantage("bore").round(6)
        np.float64(-10.0)
        """
        require_one_driver(self.driver_count, "mechanical_advantage")
        is_slide = checked_name(name, "mechanical_advantage") in self.request.mechanism.slides
        output = self.slide(name) if is_slide else self.link(name)
        if not is_slide and not any(map(np.any, output.arrays[1:])):
            every = self.request.mechanism.slides.items()
            slides = [key for key, slide in every if slide.link == name]
            if slides:
                message = f"link {name!r} does not turn: it gives its force along {slides[0]!r}"
                raise InputError(message, link=name)
        with np.errstate(divide="ignore"):
            ratio: Float = 1.0 / output.d1
        return ratio

    def transmission_angle(self, name: str, *, between: tuple[str, str] | None = None) -> Float:
        """Return the transmission angle, rad, in 0..π/2.

        Parameters
        ----------
        name : str
            The inner joint of a dyad (the acute angle between the lines to its outer joints, also
            where its links carry other dyads), another joint where two links meet (the acute angle
            between them), or a slide or the joint of a sliding link (the complement of the
            pressure angle).
        between : (str, str), optional
            Two joints: the angle between the lines from `name` to them. Needed elsewhere if more
            than two links meet, or a link has several other joints.

        Returns
        -------
        numpy.ndarray
            Shape S + (N,).

        Examples
        --------
        >>> import assur, numpy as np
        >>> motion = assur.FourBar(1.0, 4.5, 1.5, 4.8).solve(np.pi)
        >>> motion.transmission_angle("C")
        array(0.600266)
        """
        return transmission.angle(self, name, between)

    def d_transmission_angle(
        self,
        name: str,
        *,
        by: str | Sequence[str] = "q",
        between: tuple[str, str] | None = None,
    ) -> Float:
        """Return exact derivatives of the transmission angle by drivers or dimensions.

        Parameters
        ----------
        name : str
            As in `transmission_angle`.
        by : str or sequence of str
            As in `jacobian`.
        between : (str, str), optional
            As in `transmission_angle`.

        Returns
        -------
        numpy.ndarray
            S + (N, D), rad per m or per rad. NaN where there is no position, and where the angle
            is 0 or π/2: there it turns back.

        Raises
        ------
        InputError
            As in `transmission_angle` and `jacobian`.

        Examples
        --------
        A longer coupler opens the angle:

        >>> import assur
        >>> motion = assur.FourBar(1.0, 4.5, 1.5, 4.8).solve(2.0)
        >>> motion.d_transmission_angle("C", by=["coupler.length"]).round(4)
        array([0.8308])
        """
        return transmission.derivative(self, name, by, between)

    @overload
    def jacobian(self, name: str, *, by: str | Sequence[str] = "q", order: int = 0) -> Float: ...
    @overload
    def jacobian(
        self, name: list[str] | tuple[str, ...], *, by: str | Sequence[str] = "q", order: int = 0
    ) -> dict[str, Float]: ...
    def jacobian(
        self,
        name: str | list[str] | tuple[str, ...],
        *,
        by: str | Sequence[str] = "q",
        order: int = 0,
    ) -> Float | dict[str, Float]:
        """Return exact derivatives of joints, angles or slides by drivers or dimensions.

        Parameters
        ----------
        name : str or list of str
            A joint, link or slide among the outputs of this motion; or several.
        by : str or sequence of str
            ``"q"``, the drivers' coordinates; or dimensions, columns in this order. ``*``, ``?``
            and ``[…]`` stand for parts of names: ``"*.length"`` is every length.
        order : {0, 1, 2, 3}
            Of the value, or of its analogue of this order.

        Returns
        -------
        numpy.ndarray or dict of str to numpy.ndarray
            The last axis is that of the drivers (also of one) or dimensions: S + (N, 2, D) for a
            joint, S + (N, D) else; with n drivers each order adds an axis of n before it. Per m, or
            per rad for angles. NaN where there is no position or no derivative. Of several names an
            array each.

        Raises
        ------
        InputError
            An unknown name; a motion that was solved to a lower order (`by` of ``"q"`` needs one
            more); a linkage with redundant links.

        See Also
        --------
        jvp, vjp : Its products with vectors, without the matrix.
        sensitivity : All outputs by one dimension.

        Notes
        -----
        All dimensions come from one pass backward through the mechanism for each component (the
        adjoint method): it costs about as much as solving, however many dimensions there are.

        Examples
        --------
        >>> import assur
        >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve([0.5, 1.0])
        >>> motion.jacobian("rocker", by="q").shape, motion.jacobian("C", by="*.length").shape
        ((2, 1), (2, 2, 3))
        >>> motion.jacobian("rocker", by=["coupler.length", "ground.D.x"]).round(4)  # rad/m
        array([[-0.5609,  0.4149],
               [-0.4852,  0.4044]])
        """
        return derivatives.jacobian(self, name, by, order)

    @overload
    def jvp(self, name: str, rates: Mapping[str, npt.ArrayLike], *, order: int = 0) -> Float: ...
    @overload
    def jvp(
        self,
        name: list[str] | tuple[str, ...],
        rates: Mapping[str, npt.ArrayLike],
        *,
        order: int = 0,
    ) -> dict[str, Float]: ...
    def jvp(
        self,
        name: str | list[str] | tuple[str, ...],
        rates: Mapping[str, npt.ArrayLike],
        *,
        order: int = 0,
    ) -> Float | dict[str, Float]:
        """Return how fast joints, angles or slides change where dimensions change at given rates.

        This is the Jacobian times a vector, in one pass forward through the mechanism.

        Parameters
        ----------
        name : str or list of str
            A joint, link or slide among the outputs of this motion; or several.
        rates : dict of str to array_like
            The rate of each dimension that changes: a number, or one for each design of a batch.
        order : {0, 1, 2, 3}
            Of the value, or of its analogue of this order.

        Returns
        -------
        numpy.ndarray or dict of str to numpy.ndarray
            S + (N, 2) for a joint, S + (N,) else, with an axis of n for each order with n drivers.
            NaN where there is no position or no derivative. Of several names an array each.

        Raises
        ------
        InputError
            As in `jacobian`; rates of another shape.

        See Also
        --------
        vjp : The product from the other side.

        Examples
        --------
        All four links grow alike: the joints move away from A, the angles stay.

        >>> import assur
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
        >>> alike = {"crank.length": 1.0, "coupler.length": 3.0, "rocker.length": 2.5}
        >>> rates = m.solve(1.0).jvp(["C", "rocker"], alike | {"ground.D.x": 3.0})
        >>> (rates["C"] - m.solve(1.0).joint("C").value).round(12), abs(rates["rocker"]) < 1e-12
        (array([0., 0.]), np.True_)
        """
        return derivatives.jvp(self, name, rates, order)

    def vjp(
        self,
        weights: Mapping[str, npt.ArrayLike],
        *,
        by: str | Sequence[str] = "*",
        order: int = 0,
        total: bool = False,
    ) -> Float:
        """Return the derivatives by dimensions of a weighted sum of joints, angles and slides.

        This is a vector times the Jacobian, by one pass backward through the mechanism (the
        adjoint method): all dimensions cost as much as one.

        Parameters
        ----------
        weights : dict of str to array_like
            For each joint, link or slide the weights of its components at every position,
            S + (N, 2) for a joint and S + (N,) else; arrays that broadcast to it, too. With n
            drivers each order adds an axis of n.
        by : str or sequence of str
            Dimensions, as in `jacobian`; all of them by default, as in ``m.dimensions``.
        order : {0, 1, 2, 3}
            The weights belong to the values, or to their analogues of this order.
        total : bool
            Whether to sum over the positions of each design: the gradient of a sum over them.

        Returns
        -------
        numpy.ndarray
            The derivatives at every position, S + (N, D); with `total` their sum, S + (D,). NaN
            where there is no position or no derivative, of the sum where one of them is missing.

        Raises
        ------
        InputError
            As in `jacobian`; weights of another shape.

        See Also
        --------
        jvp : The product from the other side.

        Examples
        --------
        The gradient of the squared distance of a coupler point from a path, by all dimensions:

        >>> import assur, numpy as np
        >>> m, q = assur.examples.crank_rocker(), np.linspace(0.0, 6.0, 7)
        >>> wanted = m.solve(q).joint("P").value
        >>> longer = 1.01 * float(m.dimensions["coupler.length"])
        >>> motion = m.with_dimensions({"coupler.length": longer}).solve(q)
        >>> apart = motion.joint("P").value - wanted
        >>> gradient = motion.vjp({"P": 2.0 * apart}, by="*.length", total=True)
        >>> gradient.shape
        (3,)
        """
        return derivatives.vjp(self, weights, by, order, total)

    def sensitivity(self, dimension: str) -> Sensitivity:
        """Return derivatives by a dimension of all values and analogues of this motion.

        They are exact: the closure equations are differentiated once more.

        Parameters
        ----------
        dimension : str
            A name of ``mechanism.dimensions``, such as ``"coupler.length"``.

        Returns
        -------
        Sensitivity
            Its ``joint(name).value`` is ∂P/∂dimension, ``.d1`` that of the first analogue, and so
            on; per m, or per rad for an angle. NaN where there is no position, and at dead points
            and change points, where the derivative does not exist.

        Raises
        ------
        InputError
            An unknown name, or a linkage with redundant links: changing one dimension alone would
            break their fit.

        Examples
        --------
        At its dead point the piston moves by as much as the crank grows:

        >>> import assur
        >>> motion = assur.SliderCrank(1.0, 3.0).solve(0.0)
        >>> float(motion.sensitivity("crank.length").slide("bore").value)
        1.0
        """
        return Sensitivity(self, dimension)

    @property
    def residual(self) -> Float:
        """Largest loop-closure error at each position, relative to the mechanism's size."""
        return self._diagnose()[0]

    @property
    def condition(self) -> Float:
        """Condition κ of each position: 1/sin of the angle between a dyad's legs.

        For dyads in sequence, the product along the worst chain. Beside a change point the error of
        a k-th analogue is up to 1.8e-15 κ^(k + 1) of the mechanism's size: four digits remain of a
        second one up to κ = 3800, of a third up to κ = 480.

        Examples
        --------
        >>> import assur
        >>> motion = assur.SliderCrank(1.0, 1.3, 0.3).solve([-1.58, -1.571], order=3)
        >>> motion.status.tolist(), (motion.condition < 480.0).tolist()
        ([0, 0], [True, False])
        """
        return self._diagnose()[1]

    def _diagnose(self) -> tuple[Float, Float]:
        if self._diagnostics is None:
            residual, condition = self.request.mechanism.core.diagnostics(
                *self.request.flat(), self.request.signs
            )
            self._diagnostics = (residual.reshape(self.shape), condition.reshape(self.shape))
            for array in self._diagnostics:
                array.flags.writeable = False
        return self._diagnostics

    def coordinate(self, index: int | tuple[int, ...]) -> float | tuple[float, ...]:
        """Return the driver's coordinate at an index into `shape`; a tuple for several drivers.

        Parameters
        ----------
        index : int or tuple of int
            Index into `shape`.

        Returns
        -------
        float or tuple of float
            rad or m.

        Examples
        --------
        >>> import assur
        >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve([0.0, 1.0, 2.0])
        >>> motion.coordinate(2)
        2.0
        """
        entry = checked_index(index, self.shape, "index")
        designs = 0 if self.request.per_design else len(self.request.mechanism.shape)
        q = self.q[entry[designs:]] if self.request.positions else self.q
        return float(q) if self.driver_count == 1 else tuple(float(x) for x in q)

    def explain(self, index: int | tuple[int, ...] = ()) -> str:
        """Return the status of one position as a sentence, as ``on_error="raise"`` words it.

        Parameters
        ----------
        index : int or tuple of int
            Index into `shape`.

        Returns
        -------
        str
            A sentence.

        Examples
        --------
        >>> import assur
        >>> m = assur.FourBar(40, 120, 80, 300)
        >>> m.solve([0.0, 3.0], on_error="nan").explain(1)
        'at q = 3, dyad "C" cannot be assembled: its links miss each other by 139.6 m'
        """
        entry = checked_index(index, self.shape, "index")
        q = self.coordinate(entry)
        mechanism = self.request.mechanism
        values = np.moveaxis(mechanism.values, 0, -1)[entry[: len(mechanism.shape)]]
        coordinates = [q] if isinstance(q, float) else list(q)
        return mechanism.core.explain(values.tolist(), coordinates, self.request.signs)

    @renamed_rates
    def to_dataframe(
        self,
        *,
        speed: npt.ArrayLike | None = None,
        acceleration: npt.ArrayLike = 0.0,
        jerk: npt.ArrayLike = 0.0,
        degrees: bool = False,
        moving: bool = False,
    ) -> pd.DataFrame:
        """Return a pandas DataFrame with one row per position (needs pandas).

        Parameters
        ----------
        speed, acceleration, jerk : array_like, optional
            Speed, acceleration and jerk of the driver, as for `Analogues.jerk`. With them
            velocities, accelerations and jerks stand in place of the analogues; without `speed`
            the others must be 0.
        degrees : bool
            Angles in degrees; angular velocities remain rad/s, analogues per rad.
        moving : bool
            Only what moves: no fixed joints, no ground.

        Returns
        -------
        pandas.DataFrame
            The design's index and the dimensions that differ between designs, q, status, and
            everything held: values ``C.x``, ``coupler``, ``bore``; their analogues ``C.x.d1``,
            ``coupler.d2`` or, with `speed`, ``C.vx``, ``C.ax``, ``coupler.omega``,
            ``coupler.alpha``, ``bore.v``. A link or slide whose name is one of the first columns
            appears as ``link q``. ``attrs["units"]`` has the units.

        Examples
        --------
        >>> import assur
        >>> motion = assur.SliderCrank(0.05, 0.2).solve([0.0, 1.0], outputs=["A", "bore"])
        >>> list(motion.to_dataframe(speed=10.0, degrees=True))
        ['q', 'status', 'A.x', 'A.y', 'A.vx', 'A.vy', 'A.ax', 'A.ay', 'bore', 'bore.v', 'bore.a']
        """
        from assur._table import frame
        from assur.kinematics.table import Options, motion_columns

        return frame(motion_columns(self, Options(speed, acceleration, jerk, degrees, moving)))

    @renamed_rates
    def to_excel(
        self,
        path: str | PathLike[str],
        *,
        speed: npt.ArrayLike | None = None,
        acceleration: npt.ArrayLike = 0.0,
        jerk: npt.ArrayLike = 0.0,
        degrees: bool = False,
        moving: bool = False,
    ) -> None:
        """Write a workbook, a sheet for each joint, link and slide (needs openpyxl).

        Parameters are those of `to_dataframe`. Units stand in the second row; cells without a
        position are empty.

        Parameters
        ----------
        path : path-like
            The file.
        speed, acceleration, jerk, degrees, moving
            As for `to_dataframe`.

        Examples
        --------
        >>> import assur, pathlib, tempfile
        >>> motion = assur.SliderCrank(0.05, 0.2).solve([0.0, 1.0])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     motion.to_excel(pathlib.Path(folder, "press.xlsx"), speed=10.0, degrees=True)
        """
        from assur._table import write_excel
        from assur.kinematics.table import Options, motion_columns

        write_excel(path, motion_columns(self, Options(speed, acceleration, jerk, degrees, moving)))

    @renamed_rates
    def to_parquet(
        self,
        path: str | PathLike[str],
        *,
        speed: npt.ArrayLike | None = None,
        acceleration: npt.ArrayLike = 0.0,
        jerk: npt.ArrayLike = 0.0,
        degrees: bool = False,
        moving: bool = False,
    ) -> None:
        """Write `to_dataframe` as a Parquet file, units in its metadata (needs pandas, pyarrow).

        Parameters
        ----------
        path : path-like
            The file.
        speed, acceleration, jerk, degrees, moving
            As for `to_dataframe`.

        Examples
        --------
        >>> import assur, pathlib, tempfile
        >>> motion = assur.SliderCrank(0.05, 0.2).solve([0.0, 1.0])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     motion.to_parquet(pathlib.Path(folder, "press.parquet"), speed=10.0)
        """
        from assur._table import write_parquet
        from assur.kinematics.table import Options, motion_columns

        write_parquet(
            path, motion_columns(self, Options(speed, acceleration, jerk, degrees, moving))
        )

    @renamed_rates
    def to_xarray(
        self,
        *,
        speed: npt.ArrayLike | None = None,
        acceleration: npt.ArrayLike = 0.0,
        jerk: npt.ArrayLike = 0.0,
        degrees: bool = False,
        moving: bool = False,
    ) -> xr.Dataset:
        """Return `to_dataframe` as an xarray Dataset with named axes and units (needs xarray).

        Parameters
        ----------
        speed, acceleration, jerk, degrees, moving
            As for `to_dataframe`.

        Returns
        -------
        xarray.Dataset
            Variables ``C``, ``C.d1``, ``coupler``, ``bore.d2`` … or, with `speed`, ``C.v``,
            ``coupler.omega``, ``bore.a`` …, each with its ``units``, over the axes design,
            position, component (x, y of a joint) and, with several drivers, driver0, driver1 …
            of each derivative. Coordinates: q, status, and the dimensions that differ between
            designs.

        Examples
        --------
        >>> import assur, numpy as np
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
        >>> batch = m.with_dimensions({"rocker.length": np.linspace(2.4, 2.6, 3)})
        >>> data = batch.solve(np.linspace(0.0, 6.0, 5)).to_xarray()
        >>> dict(data["C"].sizes), data["C.d1"].attrs["units"]
        ({'design': 3, 'position': 5, 'component': 2}, 'm/rad')
        """
        from assur.kinematics.table import Options, dataset

        return dataset(self, Options(speed, acceleration, jerk, degrees, moving))

    # Several orders, the usual case, have axes each; of one alone they are not in an array.
    @overload
    def diagram(
        self,
        name: str | Sequence[str],
        *,
        ax: AxesLike | None = ...,
        speed: npt.ArrayLike | None = ...,
        acceleration: npt.ArrayLike = ...,
        jerk: npt.ArrayLike = ...,
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
        speed: npt.ArrayLike | None = ...,
        acceleration: npt.ArrayLike = ...,
        jerk: npt.ArrayLike = ...,
        orders: Sequence[int] | None = ...,
        degrees: bool = ...,
        dark: bool = ...,
    ) -> Panels: ...
    @renamed_rates
    def diagram(
        self,
        name: str | Sequence[str],
        *,
        ax: AxesLike | None = None,
        speed: npt.ArrayLike | None = None,
        acceleration: npt.ArrayLike = 0.0,
        jerk: npt.ArrayLike = 0.0,
        orders: int | Sequence[int] | None = None,
        degrees: bool = False,
        dark: bool = False,
    ) -> Axes | Panels:
        """Draw a quantity and its derivatives over the driver's coordinate (needs matplotlib).

        One diagram per order, with the extremes of the curve (not of its samples) marked. A batch
        of designs is drawn as a band from the least to the greatest, with the median.

        Parameters
        ----------
        name : str or sequence of str
            A joint (x, y and the magnitude), one of its components ("C.x"), a link or a slide;
            several in the same diagrams.
        ax : matplotlib axes or array of them, optional
            Where to draw, one for each order; a new figure by default.
        speed, acceleration, jerk : array_like, optional
            Speed, acceleration and jerk of the driver, as for `Analogues.jerk`; without `speed`
            analogues are drawn, and the others must be 0.
        orders : int or sequence of int, optional
            0 the value, 1 velocity, 2 acceleration, 3 jerk; all that the motion has by default.
        degrees : bool
            Whether q and angles of links are in degrees.
        dark : bool
            Colours for a dark canvas.

        Returns
        -------
        matplotlib.axes.Axes or ndarray of them
            The axes drawn on, one for each order.

        Raises
        ------
        InputError
            Names of different units, several drivers, a single position, or designs that each have
            their own q.

        Examples
        --------
        >>> import assur, numpy as np
        >>> motion = assur.SliderCrank(0.05, 0.2).solve(np.linspace(0.0, 2 * np.pi, 181))
        >>> axes = motion.diagram("bore", speed=10.0, degrees=True)
        >>> [ax.get_title(loc="left") for ax in axes.flat]
        ['Displacement, m', 'Velocity, m/s', 'Acceleration, m/s²']
        >>> [text.get_text() for text in axes.flat[1].texts]
        ['0.515 at 283°', '−0.515 at 77°']
        """
        from assur.pictures.diagrams.diagram import motion_diagram

        refuse_without_speed(speed, "speed", acceleration=acceleration, jerk=jerk)
        speeds = None
        if speed is not None:
            speeds = (
                real_array(speed, "speed"),
                real_array(acceleration, "acceleration"),
                real_array(jerk, "jerk"),
            )
        axes: Axes | Panels = motion_diagram(
            self, name, ax, speeds, orders, flag(degrees, "degrees"), dark
        )
        return axes

    @renamed_rates
    def plot(
        self,
        joint: str | Sequence[str] | None = None,
        *,
        ax: Axes | None = None,
        at: int | None = None,
        vectors: str | Sequence[str] | None = None,
        speed: npt.ArrayLike = 1.0,
        acceleration: npt.ArrayLike = 0.0,
        groups: bool = False,
        dark: bool = False,
    ) -> Axes:
        """Draw paths of joints with the mechanism at one position (needs matplotlib).

        Parameters
        ----------
        joint : str or sequence of str, optional
            The joint, or several; without it the mechanism alone. Dots stand at equal steps of q.
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        at : int, optional
            Index of the position; the first that exists by default.
        vectors : {"velocity", "acceleration"} or both, optional
            Arrows along the paths, with the value at the position that is drawn.
        speed, acceleration : array_like
            Speed and acceleration of the driver, as for `Analogues.velocity`.
        groups : bool
            Each Assur group in a colour of its own, and the structural formula.
        dark : bool
            For dark backgrounds.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on.

        Raises
        ------
        InputError
            An unknown joint, a batch of designs, a position that does not exist.

        Examples
        --------
        >>> import assur, numpy as np
        >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(np.linspace(0, 6.0, 61))
        >>> axes = motion.plot("C")
        >>> [line.get_gid() for line in axes.lines if line.get_gid().startswith("path")]
        ['path C']
        """
        from assur.pictures.linkage.path import path_picture

        return path_picture(self, joint, ax, at, vectors, (speed, acceleration), groups, dark)

    def animate(
        self,
        path: str | PathLike[str],
        *,
        joint: str | Sequence[str] | None = None,
        frames: int = 72,
        seconds: float = 3.0,
        groups: bool = False,
        dark: bool = False,
    ) -> None:
        """Write a moving picture of the mechanism (needs matplotlib).

        A motion that closes is shown round and round, another one to and fro.

        Parameters
        ----------
        path : path-like
            The file: ``.gif``, ``.webp``, or ``.mp4`` (needs the program ffmpeg).
        joint : str or sequence of str, optional
            Joints whose paths are shown.
        frames : int
            Greatest number of pictures in one round; never more than there are positions.
        seconds : float
            How long one round takes, s.
        groups : bool
            Each Assur group in a colour of its own, and the structural formula.
        dark : bool
            For dark backgrounds.

        Raises
        ------
        InputError
            A batch of designs, a motion of fewer than two positions, a file that cannot be written.

        Examples
        --------
        >>> import assur, numpy as np, pathlib, tempfile
        >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(np.linspace(0, 2 * np.pi, 13))
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "four_bar.gif"
        >>> motion.animate(path, joint="C")
        >>> path.read_bytes()[:6]
        b'GIF89a'
        """
        from assur.pictures.linkage.animate import animate

        animate(self, path, joint, frames, seconds, groups, dark)

    @renamed(paths="joint")
    @renamed_rates
    def to_html(
        self,
        path: str | PathLike[str],
        *,
        speed: float | None = None,
        duration: float | None = None,
        joint: str | Sequence[str] | None = None,
        diagrams: Sequence[str] | None = None,
        title: str | None = None,
        dark: bool | None = None,
    ) -> None:
        """Write one self-contained page that plays these positions in a browser.

        With one driver whose coordinate only grows or only falls, they are played along the
        coordinate; otherwise (several drivers, to and fro) along time, at equal steps of it.

        Parameters
        ----------
        path : path-like
            The file; one that exists is replaced.
        speed : float, optional
            Speed along the coordinate, rad/s or m/s.
        duration : float, optional
            Duration of all positions, s: they are then played along time; 4 s for several drivers.
        joint, diagrams, title, dark
            As for `Mechanism.to_html`.

        Raises
        ------
        InputError
            A batch of designs, fewer than two positions, an unknown name, a file that cannot be
            written.

        Examples
        --------
        >>> import assur, numpy as np, pathlib, tempfile
        >>> low, high = np.array(assur.examples.RANGES["excavator"])
        >>> parts = (1.0 - np.cos(np.linspace(0.0, 2.0 * np.pi, 61)[:, np.newaxis])) / 2.0
        >>> motion = assur.examples.excavator().solve(low + parts * (high - low))
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     page = pathlib.Path(folder, "dig.html")
        ...     motion.to_html(page, duration=8.0, joint="tip")
        ...     page.read_text(encoding="utf-8")[:15]
        '<!doctype html>'
        """
        from assur.pictures.page.html import write_page

        write_page(
            self,
            path,
            speed=speed,
            duration=duration,
            joint=joint,
            diagrams=diagrams,
            title=title,
            dark=dark,
        )

    def _repr_html_(self) -> str | None:
        """Return what a notebook shows; None for a batch or for one position."""
        from assur.pictures.page.html import notebook_html

        return notebook_html(self)

    @renamed_rates
    def polygon(
        self,
        what: str,
        *,
        at: int | tuple[int, ...] = (),
        speed: npt.ArrayLike = 1.0,
        acceleration: npt.ArrayLike = 0.0,
        ax: Axes | None = None,
        dark: bool = False,
    ) -> Axes:
        """Draw the plan of velocities or accelerations of one position (needs matplotlib).

        Every joint has its image: vectors from the pole o to them are their velocities. The image
        of a link is similar to it. Values stand where they have room.

        Parameters
        ----------
        what : {"velocity", "acceleration"}
            Which plan. Accelerations relative to another point of a link are drawn as normal
            (solid) and tangential parts (dashed), those of slides on moving guides as Coriolis
            part (solid) and relative acceleration (dashed).
        at : int or tuple of int
            Index of the position into `shape`.
        speed, acceleration : array_like
            Speed and acceleration of the driver, as for `Analogues.velocity`: rad/s and rad/s² or
            m/s and m/s².
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        dark : bool
            Light lines on a dark ground.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on. Artists have names, `get_gid`: ``velocity C``, ``velocity C relative
            to B``, ``normal C relative to B``, ``sliding A relative to A of lever``.

        Raises
        ------
        InputError
            An index outside the shape, a position without analogues, a mechanism at rest.

        Examples
        --------
        >>> import assur, numpy as np
        >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(np.linspace(0.0, 6.0, 7))
        >>> axes = motion.polygon("velocity", at=2, speed=10.0)
        >>> tip = next(a for a in axes.patches if a.get_gid() == "velocity C head")
        >>> bool(np.allclose(tip.get_path().vertices[0], motion.joint("C").velocity(10.0)[2]))
        True
        """
        from assur.pictures.plans.polygon import polygon_picture

        return polygon_picture(self, what, at, speed, acceleration, ax, dark)
