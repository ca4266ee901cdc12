"""Reactions of machines: forces in pairs, efforts of drivers, shaking forces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._other_names import other_names
from assur._summary import summary
from assur._table import Column, Tabular
from assur._validate import checked_name
from assur.description.structure import Group
from assur.description.words import has_analogues
from assur.dynamics.forces import bearing as bearings
from assur.dynamics.forces.force_system import force_system
from assur.dynamics.forces.joint_places import links_at
from assur.dynamics.forces.reaction_key import RESIDUAL, SAFETY, SOLUTIONS, Key
from assur.errors import InputError
from assur.kinematics.table import driven_angles, row_columns

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur.dynamics.forces.bearing import Bearing
    from assur.dynamics.model import MachineModel
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Reactions", "SlideReaction"]


class SlideReaction(NamedTuple):
    """What a guide does to the link that slides on it.

    Attributes
    ----------
    normal : ndarray
        Force along the guide turned by +90°, N.
    moment : ndarray
        Moment about the sliding point (the link's first joint), N·m.
    along : ndarray
        Where on the guide the normal force alone has this moment: the slide's value plus
        moment / normal, m.
    friction : ndarray
        Force of friction along the guide, N; 0 without.

    Examples
    --------
    A force beside the piston's pin tilts the piston:

    >>> import assur, numpy as np
    >>> force = assur.Force(("piston", (0.0, 0.01)), (-1000.0, 0.0))
    >>> machine = assur.Machine(assur.SliderCrank(crank=0.3, rod=0.5), loads=[force])
    >>> bore = machine.reactions(np.pi / 2).slide("bore")
    >>> bore.normal.round(6), bore.moment.round(6), bore.along.round(6)  # N, N·m, m
    (np.float64(750.0), np.float64(-10.0), np.float64(0.386667))
    """

    normal: Float
    moment: Float
    along: Float
    friction: Float

    def __repr__(self) -> str:
        return summary(self)


@other_names(
    pin="joint(name, on=…), bearing(name, on=…)",
    cylinder="driver, the forces of the drivers",
    torque="driver",
    effort="driver",
)
class Reactions(Tabular):
    """Forces in the pairs of a machine, by `Machine.reactions`.

    All arrays have the shape S + (N,), S the shape of the designs; forces have a last axis (x, y)
    along the drawing's axes.

    Attributes
    ----------
    q, speed, acceleration : ndarray
        The motion of the drivers, broadcast.
    driver : ndarray
        Torque of the drive, counter-clockwise on the driven link, N·m; for a driven slide its force
        along the guide on the sliding link, N. With n drivers (..., n). A motor's rotor is not in
        it.
    shaking_force, shaking_moment : ndarray
        Inertia forces of all bodies, N, and their moment about the drawing's origin, N·m.
    status : ndarray of uint8
        `assur.Status` of every position; with ``on_error="nan"`` ``NO_VALUE`` where a load or an
        inertia force is not finite.
    undetermined : tuple of str
        Reactions that redundant links leave undetermined.
    at_rest : ndarray of bool
        Where a run stays at rest, so that friction may have any value up to that of sliding: forces
        are NaN there.
    locked : ndarray of bool
        Where friction leaves no solution: the drive cannot move the machine against its loads,
        however strong it is. Forces are NaN there.
    losses : dict of str to ndarray
        Power that friction takes in each joint and slide that has some, W.
    efficiency : ndarray
        1 − loss/max(P₀ + loss, −P₀), with P₀ the power of the drive without friction: output over
        input, whichever way power flows. Negative where friction alone holds the loads that drive
        the machine (self-locking in reverse). NaN at rest.
    solutions : tuple of Reactions
        All that agree with the law of friction. The first is this one; where there are fewer
        solutions than elsewhere, the later ones are NaN.
    residual : ndarray
        Residual of the law of friction, relative to the greatest friction: rounding where the
        iteration has converged; 0 without friction.
    safety : ndarray
        Factor on all coefficients of friction at which the solution that continues the frictionless
        one ends: below 1 where this one does not follow from it. At most 1e6.

    Examples
    --------
    >>> import assur, numpy as np
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
    ... )
    >>> found = machine.reactions([np.pi / 3, np.pi / 2], speed=10.0)
    >>> found.shaking_force.round(3)  # N
    array([[ 75.022,   0.   ],
           [-51.64 ,   0.   ]])
    >>> found.driver.round(3)  # N·m
    array([ 7.329, -5.164])
    """

    def __init__(
        self,
        mechanism: Mechanism,
        motion: tuple[Float, Float, Float],
        by_key: dict[Key, Float],
        status: npt.NDArray[np.uint8],
        again: Callable[[list[Key], int], Reactions] | None = None,
        source: tuple[MachineModel, Callable[[list[Key], int], Reactions]] | None = None,
        at_rest: npt.NDArray[np.bool_] | None = None,
    ) -> None:
        self.mechanism = mechanism
        self.q, self.speed, self.acceleration = motion
        self.by_key = by_key
        self._again = again
        # The machine, and other reactions of the same motion: with them what acts can be drawn.
        self._source = source
        self.status = status
        rests = np.zeros(status.shape, np.bool_) if at_rest is None else at_rest
        self.at_rest: npt.NDArray[np.bool_] = rests[()]

    def __getstate__(self) -> dict[str, Any]:
        # Functions of the user cannot be pickled.
        source = self._source
        kept = source is not None and not source[0].core.load_functions
        return {**self.__dict__, "_source": source if kept else None}

    def _columns(self, degrees: bool) -> list[Column]:
        """Return all forces: those at a joint on every link but the first, which takes the rest."""
        mechanism, shape = self.mechanism, self.status.shape
        angles = driven_angles(mechanism)
        columns = row_columns(mechanism, self.q, self.status, degrees)

        def add(name: str, values: Any, unit: str, quantity: str) -> None:
            columns.append(Column(name, np.broadcast_to(values, shape).reshape(-1), unit, quantity))

        for k, is_angle in enumerate(angles):
            tail, drive = (f"{k}", self.driver[..., k]) if len(angles) > 1 else ("", self.driver)
            add(f"driver{tail}", drive, "N m" if is_angle else "N", "driver")
        for joint, links in links_at(mechanism).items():
            for link in links[1:]:
                force = self.joint(joint, on=link)
                add(f"{joint}.x on {link}", force[..., 0], "N", joint)
                add(f"{joint}.y on {link}", force[..., 1], "N", joint)
        for slide in mechanism.slides:
            for name, values in self.slide(slide)._asdict().items():
                unit = {"moment": "N m", "along": "m"}.get(name, "N")
                add(f"{slide}.{name}", values, unit, slide)
        add("shaking_force.x", self.shaking_force[..., 0], "N", "shaking")
        add("shaking_force.y", self.shaking_force[..., 1], "N", "shaking")
        add("shaking_moment", self.shaking_moment, "N m", "shaking")
        return columns

    def __repr__(self) -> str:
        pins = [links for links in links_at(self.mechanism).values() if len(links) > 1]
        joints, slides = len(pins), len(self.mechanism.slides)
        moves = np.any(self.speed) or np.any(self.acceleration)
        statics = "" if moves else ", at rest (statics)"
        of = f"{joints} joints, {slides} slides, shape {self.status.shape}"
        return f"<assur.Reactions of {of}{statics}>"

    @property
    def driver(self) -> Float:
        """Torque or force of the drive."""
        count = int(np.size(self.mechanism.q0))
        each = [self.by_key[Key("driver", index)] for index in range(count)]
        return each[0][()] if count == 1 else np.stack(each, axis=-1)

    @property
    def shaking_force(self) -> Float:
        """Inertia forces of all bodies, N."""
        return self.by_key[Key("shaking force")]

    @property
    def shaking_moment(self) -> Float:
        """Moment of the inertia forces about the drawing's origin, N·m."""
        return self.by_key[Key("shaking moment")][()]

    @property
    def undetermined(self) -> tuple[str, ...]:
        """Reactions of redundant links that no balance determines somewhere; they are NaN there."""
        solved = has_analogues(self.status) & ~self.at_rest
        joints, links = self.mechanism.joint_names, list(self.mechanism.links)
        slides = list(self.mechanism.slides)
        names = []
        for key, values in self.by_key.items():
            kind, index, on = key.kind, key.index, key.on
            if kind not in ("joint", "normal", "moment", "driver"):
                continue
            missing = np.isnan(values[..., 0] if kind == "joint" else values) & ~self.locked
            if not np.any(missing & solved):
                continue
            if kind == "joint":
                names.append(f'joint "{joints[index]}" on "{links[on]}"')
            elif kind == "driver":
                names.append(f"driver {index}")
            else:
                names.append(f'{kind} of slide "{slides[index]}"')
        return tuple(names)

    @property
    def locked(self) -> npt.NDArray[np.bool_]:
        """Where friction leaves no solution."""
        return np.asarray(self.by_key.get(SOLUTIONS, np.ones(self.status.shape)) == 0.0)[()]

    @property
    def losses(self) -> dict[str, Float]:
        """Power that friction takes in each pair, W."""
        joints, slides = self.mechanism.joint_names, list(self.mechanism.slides)
        names = {"joint loss": joints, "slide loss": slides}
        return {
            names[key.kind][key.index]: values[()]
            for key, values in self.by_key.items()
            if key.kind in names
        }

    @property
    def efficiency(self) -> Float:
        """Output power over input power."""
        loss = np.sum(list(self.losses.values()), axis=0) + np.zeros(self.status.shape)
        power = np.asarray(self.driver * self.speed)
        if np.size(self.mechanism.q0) > 1:
            power = power.sum(axis=-1)
        with np.errstate(invalid="ignore", divide="ignore"):
            found: Float = (1.0 - loss / np.maximum(power, loss - power))[()]
        return found

    @property
    def solutions(self) -> tuple[Reactions, ...]:
        """All reactions that agree with the law of friction."""
        if self._again is None:
            return (self,)
        counts = self.by_key[SOLUTIONS]
        most = int(np.nanmax(counts, initial=0.0))
        keys = list(self.by_key)
        return (self, *(self._again(keys, index) for index in range(1, most)))[:most]

    @property
    def residual(self) -> Float:
        """Residual of the law of friction, relative to the greatest friction."""
        return self.by_key.get(RESIDUAL, np.zeros(self.status.shape))[()]

    @property
    def safety(self) -> Float:
        """Factor on the coefficients of friction at which this solution ends."""
        if self._again is None:
            return np.full(self.status.shape, np.inf)[()]
        return self._again([SAFETY], 0).by_key[SAFETY][()]

    def joint_moment(self, name: str, on: str | None = None) -> Float:
        """Return the moment of friction on a link at a joint.

        Parameters
        ----------
        name : str
            The joint.
        on : str
            The link; one that has the joint. Needed.

        Returns
        -------
        ndarray
            N·m, counter-clockwise; 0 without friction. The moments on all links of a joint add up
            to zero.

        Raises
        ------
        InputError
            A joint or link that does not exist, or a link without this joint.

        Examples
        --------
        A pin of 0.02 m with f = 0.1 that bears 1000 N:

        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4),
        ...     loads=[assur.Force("B", (-1000.0, 0.0), on="piston")],
        ...     friction={"B": assur.JointFriction(0.1, radius=0.02)},
        ... )
        >>> found = machine.reactions(0.0, speed=10.0)
        >>> found.joint_moment("B", on="rod").round(3)  # N·m
        np.float64(2.0)
        """
        on = given_link(self.mechanism, name, on)
        key = key_of_joint(self.mechanism, checked_name(name, "joint"), checked_name(on, "on"))
        moment = self.by_key.get(Key("joint moment", key.index, key.on))
        if moment is None:
            return np.where(np.isnan(self.shaking_moment), np.nan, 0.0)[()]
        return moment[()]

    def joint(self, name: str, on: str | None = None) -> Float:
        """Return the force on a link from all other links at a joint.

        Parameters
        ----------
        name : str
            The joint.
        on : str
            The link; one that has the joint.

        Returns
        -------
        ndarray
            N, along the drawing's axes, (..., 2). The forces on all links of a joint add up to
            zero; a joint of one link has none.

        Raises
        ------
        InputError
            A joint or link that does not exist, or a link without this joint.

        Examples
        --------
        What the rod does to the piston, the crank to the rod:

        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> found = machine.reactions(0.0, speed=10.0)
        >>> found.joint("B", on="piston"), found.joint("A", on="rod")  # N
        (array([-250.,   -0.]), array([-250.,   -0.]))
        """
        core = self.mechanism.core
        on = given_link(self.mechanism, name, on)
        key = key_of_joint(self.mechanism, checked_name(name, "joint"), checked_name(on, "on"))
        links, joint = links_at(self.mechanism)[name], key.index
        if len(links) == 1:
            return np.where(np.isnan(self.shaking_force), np.nan, 0.0)
        if key in self.by_key:
            return self.by_key[key]
        indices = [core.index_of("link", link) for link in links[:-1]]
        total = self.by_key[Key("joint", joint, indices[0])]
        for index in indices[1:]:
            total = total + self.by_key[Key("joint", joint, index)]
        return -total

    def bearing(
        self,
        name: str,
        on: str | None = None,
        *,
        frame: str | None = None,
        against: str | None = None,
    ) -> Bearing:
        """Return the force on a link at a joint as polar data, in the frame of a link there.

        Parameters
        ----------
        name : str
            The joint.
        on : str
            The link on which the force acts; one of those at the joint. Needed.
        frame : str, optional
            The link in whose frame directions are given (x from its first joint toward its
            second): one of those at the joint, or the ground; `on` by default.
        against : str, optional
            The link whose turning relative to `on` counts for `pv`; by default the other one.

        Returns
        -------
        Bearing
            Angle and size of the force, mean and extremes, pressure times velocity.

        Raises
        ------
        InputError
            A joint or link that does not exist, or is not at this joint; a joint of one link.

        Examples
        --------
        >>> import assur
        >>> import numpy as np
        >>> linkage = assur.FourBar(0.05, 0.15, 0.12, 0.16)
        >>> machine = assur.Machine(linkage, loads=[assur.Torque("rocker", -20.0)])
        >>> pin = machine.reactions(np.linspace(0.0, 6.0, 7), speed=30.0).bearing("C", on="rocker")
        >>> print(f"{pin.max.value:.1f} N at q = {pin.max.q}, mean {pin.mean:.1f} N")
        229.9 N at q = 0.0, mean 189.8 N
        >>> print(f"{pin.pv(diameter=0.02, width=0.015).max() / 1e6:.3f} MPa·m/s")
        0.082 MPa·m/s
        """
        on = given_link(self.mechanism, name, on)
        return bearings.bearing(self, name, on, frame, against)

    def slide(self, name: str) -> SlideReaction:
        """Return what a guide does to the link that slides on it.

        Parameters
        ----------
        name : str
            The slide.

        Returns
        -------
        SlideReaction
            Normal force and moment about the sliding point on the sliding link, where on the guide
            their resultant acts, and friction.

        Examples
        --------
        >>> import assur, numpy as np
        >>> force = assur.Force("B", (-1000.0, 0.0))
        >>> machine = assur.Machine(assur.SliderCrank(crank=0.3, rod=0.5), loads=[force])
        >>> machine.reactions(np.pi / 2).slide("bore").normal.round(6)  # N: 1000 · 3/4
        np.float64(750.0)
        """
        index = self.mechanism.core.index_of("slide", checked_name(name, "slide"))
        normal, moment, along = (
            self.by_key[Key(kind, index)][()] for kind in ("normal", "moment", "along")
        )
        friction = self.by_key.get(Key("friction", index), np.where(np.isnan(normal), np.nan, 0.0))
        return SlideReaction(normal, moment, along, friction[()])

    def plot(
        self,
        links: str | Sequence[str] | None = None,
        *,
        at: int | tuple[int, ...] = (),
        ax: Axes | None = None,
        dark: bool = False,
    ) -> Axes:
        """Draw the forces of one position in their places (needs matplotlib).

        Parameters
        ----------
        links : str or sequence of str, optional
            Links that are cut free: what acts on them from outside is drawn. By default the whole
            mechanism with the force in every joint, on the first link there that moves.
        at : int or tuple of int
            Index of the position into the shape of `status`.
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        dark : bool
            Light lines on a dark ground.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on. Artists are named ``reaction B on rod``, ``load B on piston``,
            ``weight rod``, ``inertia rod`` (dashed: the opposite of mass times acceleration),
            ``drive crank``; moments are arcs, ``moment`` stands before their names.

        Raises
        ------
        InputError
            An unknown link, an index outside the shape, a position without reactions.

        Examples
        --------
        >>> import assur
        >>> force = assur.Force("B", (-1000.0, 0.0), on="piston")
        >>> machine = assur.Machine(assur.SliderCrank(crank=0.3, rod=0.5), loads=[force])
        >>> axes = machine.reactions(1.0).plot()
        >>> "reaction A on crank" in [line.get_gid() for line in axes.lines]
        True
        """
        from assur.pictures.forces.placed import forces_picture

        return forces_picture(force_system(self, links, at), links, ax, dark)

    def polygon(
        self,
        links: str | Sequence[str] | Group,
        *,
        at: int | tuple[int, ...] = (),
        ax: Axes | None = None,
        dark: bool = False,
    ) -> Axes:
        """Draw the force polygon of links that are cut free (needs matplotlib).

        Loads, weights and inertia forces follow each other, then the forces of the links outside:
        the polygon closes.

        Parameters
        ----------
        links : str, sequence of str or Group
            A link, some links, or an Assur group of ``mechanism.structure.groups``.
        at : int or tuple of int
            Index of the position into the shape of `status`.
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        dark : bool
            Light lines on a dark ground.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on; artists are named as those of `plot`.

        Raises
        ------
        InputError
            An unknown link, an index outside the shape, a position without reactions or without
            any force.

        Examples
        --------
        >>> import assur
        >>> force = assur.Force("B", (-1000.0, 0.0), on="piston")
        >>> machine = assur.Machine(assur.SliderCrank(crank=0.3, rod=0.5), loads=[force])
        >>> group = machine.mechanism.structure.groups[0]
        >>> axes = machine.reactions(1.0).polygon(group)
        >>> [a.get_gid() for a in axes.lines if "head" not in a.get_gid()][:3]
        ['load B on piston', 'reaction A on rod', 'reaction bore on piston']
        """
        from assur.pictures.forces.polygon import force_polygon

        names = links.links if isinstance(links, Group) else links
        return force_polygon(force_system(self, names, at), ax, dark)


def given_link(mechanism: Mechanism, name: str, on: str | None) -> str:
    """Return the link on which a force at a joint is asked for; it must be given."""
    if on is not None:
        return on
    mechanism.core.index_of("joint", checked_name(name, "joint"))
    links = links_at(mechanism)[name]
    message = (
        f'joint "{name}" is one of {", ".join(links)}: say on which of them it acts, '
        f'on="{links[-1]}"'
    )
    raise InputError(message, joint=name)


def key_of_joint(mechanism: Mechanism, name: str, on: str | None) -> Key:
    """Return the force at a joint on a link; with `on=None` on either of two links."""
    core = mechanism.core
    joint, links = core.index_of("joint", name), links_at(mechanism)[name]
    if on is None:
        if len(links) != 2:
            message = f'joint "{name}" is one of {", ".join(links)}: say on which link, on='
            raise InputError(message, joint=name)
        on = links[0]
    link = core.index_of("link", on)
    if on not in links:
        message = f'link "{on}" has no joint "{name}", which is one of {", ".join(links)}'
        raise InputError(message, joint=name, link=on)
    return Key("joint", joint, link)
