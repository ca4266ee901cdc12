"""Reactions of machines: forces in pairs, efforts of drivers, shaking forces."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import real_array, short
from assur._validate import checked_name, checked_threads, one_of
from assur.description.words import Status
from assur.dynamics import bearing as bearings
from assur.dynamics.along import times
from assur.dynamics.friction import SlideFriction
from assur.dynamics.reduce import with_designs
from assur.dynamics.values import function_values
from assur.errors import InputError, MotionError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.along import DrivenMotion
    from assur.dynamics.bearing import Bearing
    from assur.dynamics.model import MachineModel, OnError
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Reactions", "SlideReaction"]


@dataclass(frozen=True)
class Key:
    """A reaction: its kind, and the indices of the joint or slide and of the link."""

    kind: str
    index: int = 0
    on: int = 0


SOLUTIONS, SAFETY, RESIDUAL = Key("solutions"), Key("safety"), Key("residual")
# What the core says where it would have to search for too many solutions, or cannot know a force.
UNSOLVED, UNDETERMINED = -1.0, -2.0


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
    """

    normal: Any
    moment: Any
    along: Any
    friction: Any


class Reactions:
    """Forces in the pairs of a machine, by `Machine.reactions`.

    All arrays have the shape S + (N,), S the shape of the designs; forces have a last axis (x, y)
    along the drawing's axes.

    Attributes
    ----------
    q, speed, acceleration : ndarray
        The motion of the drivers, broadcast.
    driver : ndarray
        Torque of the drive, counter-clockwise on the driven link, N·m; of a driven slide its force
        along the guide on the sliding link, N. With n drivers (..., n). A motor's rotor is not in
        it.
    shaking_force, shaking_moment : ndarray
        Inertia forces of all bodies, N, and their moment about the drawing's origin, N·m.
    status : ndarray of uint8
        `assur.Status` of every position.
    undetermined : tuple of str
        Reactions that redundant links leave undetermined.
    locked : ndarray of bool
        Where friction leaves no solution: the drive cannot move the machine against its loads,
        however strong it is. Forces are NaN there.
    losses : dict of str to ndarray
        Power that friction takes in each joint and slide that has some, W.
    efficiency : ndarray
        1 − loss/max(P₀ + loss, −P₀), with P₀ the power of the drive without friction: what comes
        out of what goes in, whichever way power flows. Negative where friction alone holds the
        loads that drive the machine (self-locking in reverse). NaN at rest.
    solutions : tuple of Reactions
        All that agree with the law of friction. The first is this one; where there are fewer
        solutions than elsewhere, the later ones are NaN.
    residual : ndarray
        By how much the law of friction is missed, in parts of the greatest friction: rounding where
        the iteration has converged; 0 without friction.
    safety : ndarray
        By what all coefficients of friction can be multiplied before the solution ends to which
        friction leads as it grows from nothing: below 1 where this one does not follow from it. At
        most 1e6.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        motion: tuple[Float, Float, Float],
        found: dict[Key, Float],
        status: npt.NDArray[np.uint8],
        again: Callable[[list[Key], int], Reactions] | None = None,
    ) -> None:
        self._mechanism = mechanism
        self.q, self.speed, self.acceleration = motion
        self._found = found
        self._again = again
        self.status = status

    def __repr__(self) -> str:
        pins = [links for links in _links_at(self._mechanism).values() if len(links) > 1]
        joints, slides = len(pins), len(self._mechanism.slides)
        return f"<assur.Reactions of {joints} joints, {slides} slides, shape {self.status.shape}>"

    @property
    def driver(self) -> Any:
        """Torque or force of the drive."""
        count = int(np.size(self._mechanism.q0))
        each = [self._found[Key("driver", index)] for index in range(count)]
        return each[0][()] if count == 1 else np.stack(each, axis=-1)

    @property
    def shaking_force(self) -> Any:
        """Inertia forces of all bodies, N."""
        return self._found[Key("shaking force")]

    @property
    def shaking_moment(self) -> Any:
        """Moment of the inertia forces about the drawing's origin, N·m."""
        return self._found[Key("shaking moment")][()]

    @property
    def undetermined(self) -> tuple[str, ...]:
        """Reactions of redundant links that no balance determines somewhere: they are NaN there."""
        solved = self.status <= Status.NEAR_SINGULAR
        joints, links = self._mechanism._joint_names, list(self._mechanism.links)
        slides = list(self._mechanism.slides)
        names = []
        for key, values in self._found.items():
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
    def locked(self) -> Any:
        """Where friction leaves no solution."""
        return np.asarray(self._found.get(SOLUTIONS, np.ones(self.status.shape)) == 0.0)[()]

    @property
    def losses(self) -> dict[str, Any]:
        """Power that friction takes in each pair, W."""
        joints, slides = self._mechanism._joint_names, list(self._mechanism.slides)
        names = {"joint loss": joints, "slide loss": slides}
        return {
            names[key.kind][key.index]: values[()]
            for key, values in self._found.items()
            if key.kind in names
        }

    @property
    def efficiency(self) -> Any:
        """What comes out of what goes in."""
        loss = np.sum(list(self.losses.values()), axis=0) + np.zeros(self.status.shape)
        power = np.asarray(self.driver * self.speed)
        if np.size(self._mechanism.q0) > 1:
            power = power.sum(axis=-1)
        with np.errstate(invalid="ignore", divide="ignore"):
            return (1.0 - loss / np.maximum(power, loss - power))[()]

    @property
    def solutions(self) -> tuple[Reactions, ...]:
        """All reactions that agree with the law of friction."""
        if self._again is None:
            return (self,)
        counts = self._found[SOLUTIONS]
        most = int(np.nanmax(counts, initial=0.0))
        keys = list(self._found)
        return (self, *(self._again(keys, index) for index in range(1, most)))[:most]

    @property
    def residual(self) -> Any:
        """By how much the law of friction is missed, in parts of the greatest friction."""
        return self._found.get(RESIDUAL, np.zeros(self.status.shape))[()]

    @property
    def safety(self) -> Any:
        """By what coefficients of friction can be multiplied before this solution ends."""
        if self._again is None:
            return np.full(self.status.shape, np.inf)[()]
        return self._again([SAFETY], 0)._found[SAFETY][()]

    def joint_moment(self, name: str, on: str) -> Any:
        """Return the moment of friction on a link at a joint.

        Parameters
        ----------
        name : str
            The joint.
        on : str
            The link; one that has the joint.

        Returns
        -------
        ndarray
            N·m, counter-clockwise; 0 without friction. The moments on all links of a joint add up
            to zero.

        Raises
        ------
        InputError
            A joint or link that does not exist, or a link without this joint.
        """
        key = key_of_joint(self._mechanism, checked_name(name, "joint"), checked_name(on, "on"))
        moment = self._found.get(Key("joint moment", key.index, key.on))
        if moment is None:
            return np.where(np.isnan(self.shaking_moment), np.nan, 0.0)[()]
        return moment[()]

    def joint(self, name: str, on: str) -> Float:
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
        """
        core = self._mechanism._core
        key = key_of_joint(self._mechanism, checked_name(name, "joint"), checked_name(on, "on"))
        links, joint = _links_at(self._mechanism)[name], key.index
        if len(links) == 1:
            return np.where(np.isnan(self.shaking_force), np.nan, 0.0)
        if key in self._found:
            return self._found[key]
        indices = [core.require("link", other) for other in links[:-1]]
        total = self._found[Key("joint", joint, indices[0])]
        for index in indices[1:]:
            total = total + self._found[Key("joint", joint, index)]
        return -total

    def bearing(
        self, name: str, on: str, *, frame: str | None = None, against: str | None = None
    ) -> Bearing:
        """Return the force on a link at a joint as polar data, in the frame of a link there.

        Parameters
        ----------
        name : str
            The joint.
        on : str
            The link on which the force acts; one of those at the joint.
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
        >>> print(f"{pin.greatest.value:.1f} N at q = {pin.greatest.at}, mean {pin.mean:.1f} N")
        229.9 N at q = 0.0, mean 189.8 N
        >>> print(f"{pin.pv(diameter=0.02, width=0.015).max() / 1e6:.3f} MPa·m/s")
        0.082 MPa·m/s
        """
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
        """
        index = self._mechanism._core.require("slide", checked_name(name, "slide"))
        normal, moment, along = (
            self._found[Key(kind, index)][()] for kind in ("normal", "moment", "along")
        )
        friction = self._found.get(Key("friction", index), np.where(np.isnan(normal), np.nan, 0.0))
        return SlideReaction(normal, moment, along, friction[()])


def _links_at(mechanism: Mechanism) -> dict[str, list[str]]:
    """Return the links of every joint, in the order of the description."""
    return {
        joint: [link for link, joints in mechanism.links.items() if joint in joints]
        for joint in mechanism._joint_names
    }


def key_of_joint(mechanism: Mechanism, name: str, on: str | None) -> Key:
    """Return the force at a joint on a link; with `on=None` on one of two links, whichever."""
    core = mechanism._core
    joint, links = core.require("joint", name), _links_at(mechanism)[name]
    if on is None:
        if len(links) != 2:
            message = f'joint "{name}" is one of {", ".join(links)}: say on which link, on='
            raise InputError(message, joint=name)
        on = links[0]
    link = core.require("link", on)
    if on not in links:
        message = f'link "{on}" has no joint "{name}", which is one of {", ".join(links)}'
        raise InputError(message, joint=name, link=on)
    return Key("joint", joint, link)


def _keys(mechanism: Mechanism) -> list[Key]:
    core = mechanism._core
    is_redundant = any(core.redundant)
    keys: list[Key] = []
    for joint, links in _links_at(mechanism).items():
        index = core.require("joint", joint)
        # What the last link takes follows from the others, unless these are undetermined.
        asked = links if is_redundant and len(links) > 1 else links[:-1]
        keys += [Key("joint", index, core.require("link", link)) for link in asked]
    for slide in range(len(mechanism.slides)):
        keys += [Key(kind, slide) for kind in ("normal", "moment", "along")]
    keys += [Key("driver", driver) for driver in range(int(np.size(mechanism.q0)))]
    return [*keys, Key("shaking force"), Key("shaking moment")]


def _keys_of_friction(machine: MachineModel) -> list[Key]:
    mechanism = machine.mechanism
    assert mechanism is not None
    core, links_at = mechanism._core, _links_at(mechanism)
    keys: list[Key] = []
    for name, friction in machine.friction.items():
        if isinstance(friction, SlideFriction):
            slide = core.require("slide", name)
            keys += [Key("friction", slide), Key("slide loss", slide)]
            continue
        joint = core.require("joint", name)
        links = [core.require("link", link) for link in links_at[name]]
        keys += [*(Key("joint moment", joint, link) for link in links), Key("joint loss", joint)]
    return [*keys, SOLUTIONS, RESIDUAL] if keys else []


def _require_solved(found: dict[Key, Float]) -> None:
    """Raise InputError where the core has not looked for the frictions of a position."""
    counts = found[SOLUTIONS]
    if np.any(counts == UNDETERMINED):
        message = (
            "redundant links leave forces in a pair with friction undetermined, and its friction "
            "with them: leave it out, or the redundant links"
        )
        raise InputError(message)
    if np.any(counts == UNSOLVED):
        message = (
            "so many pairs with friction depend on one another that their solutions are not "
            "searched for, and there may be several or none: leave out the friction that matters "
            "least"
        )
        raise InputError(message)


def reactions(
    machine: MachineModel,
    motion: DrivenMotion,
    threads: int | None,
    on_error: OnError,
    keys: list[Key] | None = None,
    sense: float | Sequence[float] | None = None,
    solution: int = 0,
) -> Reactions:
    """Return the reactions of a machine; see `Machine.reactions`.

    Some of them, if `keys` are given, without errors.
    """
    mechanism = machine.mechanism
    if mechanism is None:
        message = "a machine of a table has no joints: reactions need a mechanism"
        raise InputError(message)
    one_of(on_error, ("raise", "nan"), "on_error")
    drivers = machine._drivers
    if keys is None:
        keys = [*_keys(mechanism), *_keys_of_friction(machine)]
    moving = broadcast_motion(machine, motion)
    x, v, a, shape = moving
    arrays, status, failure = _solved(
        machine, moving, motion.t, threads, keys, squares=False, friction=(sense, solution)
    )
    full = shape if drivers == 1 else (*shape, drivers)
    everywhere = np.broadcast_to(x, full)
    if on_error == "raise" and failure is not None:
        raise failure
    if on_error == "raise":
        drives = [arrays[keys.index(Key("driver", driver))] for driver in range(drivers)]
        each = drives[0][:, None] if drivers == 1 else np.stack(drives, axis=-1)
        is_locked = np.zeros(status.shape, np.bool_)
        if SOLUTIONS in keys:
            is_locked = arrays[keys.index(SOLUTIONS)] <= 0.0
        _require_finite("reactions are", each, status, everywhere, is_locked)
    found: dict[Key, Float] = {}
    for key, array in zip(keys, arrays, strict=True):
        two = key.kind in ("joint", "shaking force")
        array.flags.writeable = False
        found[key] = array.reshape((*shape, 2) if two else shape)
    if SOLUTIONS in found:
        _require_solved(found)
    given_motion = everywhere, np.broadcast_to(v, full), np.broadcast_to(a, full)

    # Not a closure, which could not be pickled.
    again = partial(_again, machine, motion, threads, sense)
    rubs = again if machine.friction and SOLUTIONS in found else None
    return Reactions(mechanism, given_motion, found, status.reshape(shape), rubs)


def _again(
    machine: MachineModel,
    motion: DrivenMotion,
    threads: int | None,
    sense: float | Sequence[float] | None,
    keys: list[Key],
    solution: int,
) -> Reactions:
    """Return some reactions of the same motion, in one of the solutions."""
    return reactions(machine, motion, threads, "nan", keys, sense, solution)


def reaction_squares(
    machine: MachineModel, motion: DrivenMotion, threads: int | None, keys: list[Key]
) -> dict[Key, Float]:
    """Return the greatest and the mean square of reactions over all positions, (designs, 2).

    NaN where a position of a design has no value. Nothing is kept of the positions.
    """
    moving = broadcast_motion(machine, motion)
    arrays, _, _ = _solved(machine, moving, motion.t, threads, keys, squares=True)
    return {key: array.reshape(-1, 2) for key, array in zip(keys, arrays, strict=True)}


def _solved(
    machine: MachineModel,
    moving: tuple[Float, Float, Float, tuple[int, ...]],
    t: npt.ArrayLike,
    threads: int | None,
    keys: list[Key],
    squares: bool,
    friction: tuple[float | Sequence[float] | None, int] = (None, 0),
) -> tuple[list[Float], npt.NDArray[np.uint8], Any]:
    """Return an array for each key, the statuses, and the exception of the first failure."""
    mechanism = machine.mechanism
    assert mechanism is not None
    drivers, designs = machine._drivers, machine.shape
    x, v, a, shape = moving
    per_design = bool(designs) and x.ndim > (1 if drivers == 1 else 2)
    full = shape if drivers == 1 else (*shape, drivers)
    everywhere, functions = np.broadcast_to(x, full), machine._core.load_functions
    # One speed for all positions is not repeated; (2, 1) of two drivers are two positions.
    given_once = ((),) if drivers == 1 else ((drivers,),)
    speeds, accelerations = (
        np.ascontiguousarray(one if one.shape in given_once else np.broadcast_to(one, full)).ravel()
        for one in (v, a)
    )
    coordinates = np.ascontiguousarray(everywhere if per_design else x).ravel()
    senses = _senses(machine, np.broadcast_to(v, full).reshape(-1, drivers), friction[0])
    at = times(t, shape)
    given = np.empty(0)
    if functions:
        rows = everywhere.reshape(-1, drivers), np.broadcast_to(v, full).reshape(-1, drivers)
        given = function_values(functions, *rows, at.ravel())
    found: tuple[list[Float], npt.NDArray[np.uint8], Any] = machine._core.reactions(
        mechanism._values.reshape(-1),
        coordinates,
        per_design,
        speeds,
        accelerations,
        given,
        keys,
        math.prod(designs if squares else shape),
        squares,
        (senses, friction[1]),
        checked_threads(threads),
        list(designs),
    )
    return found


def _senses(
    machine: MachineModel, speeds: Float, sense: float | Sequence[float] | None
) -> list[float]:
    """Return in which sense each driver is about to move at rest, which friction needs."""
    if sense is not None:
        senses = real_array(sense, "sense").ravel()
        if senses.size != machine._drivers or not np.isin(senses, (-1.0, 1.0)).all():
            wanted = "+1 or −1" if machine._drivers == 1 else f"{machine._drivers} of +1 or −1"
            message = f"sense is {short(sense)}: {wanted} is needed"
            raise InputError(message)
        found: list[float] = senses.tolist()
        return found
    if machine.friction and not speeds.any(axis=1).all():
        message = (
            "speed is 0: friction needs sense=+1 or −1, the way in which the drive is about to move"
        )
        raise InputError(message, value=0.0)
    return []


def _require_finite(
    what: str,
    drives: Float,
    status: npt.NDArray[np.uint8],
    q: Float,
    is_locked: npt.NDArray[np.bool_] | bool = False,
) -> None:
    """Raise MotionError where a load or an inertia force is not finite, though the position is.

    `drives`: torques or forces of the drivers, (positions, drivers).
    """
    finite = np.isfinite(drives).all(axis=-1)
    beyond = np.flatnonzero(~finite & (status <= Status.NEAR_SINGULAR) & ~np.asarray(is_locked))
    if beyond.size:
        at = q.reshape(drives.shape)[beyond[0]].tolist()
        shown = ", ".join(f"{number:.15g}" for number in at)
        message = (
            f"the {what} not finite at q = {shown}: a load, a speed or a mass is too great "
            "there, a table ends, or a damper or spring has length zero (on_error='nan' keeps the "
            "others)"
        )
        raise MotionError(message, kind="not_finite", q=at[0] if len(at) == 1 else tuple(at))


def broadcast_motion(
    machine: MachineModel, motion: DrivenMotion
) -> tuple[Float, Float, Float, tuple[int, ...]]:
    """Return coordinates, speeds, accelerations, and the shape of the positions of all designs."""
    n, designs = machine._drivers, machine.shape
    q, speed, acceleration, _ = motion
    x = real_array(q, "q")
    v, a = real_array(speed, "speed"), real_array(acceleration, "acceleration")
    if n > 1 and (x.ndim == 0 or x.shape[-1] != n):
        message = f"q has the shape {x.shape}: with {n} drivers its last axis must be {n}"
        raise InputError(message)
    for name, values, given in (("speed", v, speed), ("acceleration", a, acceleration)):
        if not np.isfinite(values).all():
            message = f"{name} is {short(given)}: finite numbers are needed"
            raise InputError(message)
    shape = with_designs(x.shape if n == 1 else x.shape[:-1], designs)
    full = shape if n == 1 else (*shape, n)
    for name, values in (("speed", v), ("acceleration", a)):
        if not _broadcasts(values, full):
            message = f"{name} has the shape {values.shape}, q {x.shape}: they do not fit"
            raise InputError(message)
    return x, v, a, shape


def _broadcasts(values: Float, shape: tuple[int, ...]) -> bool:
    try:
        return np.broadcast_shapes(values.shape, shape) == shape
    except ValueError:
        return False


def effort(
    machine: MachineModel,
    motion: DrivenMotion,
    on_error: OnError,
    sense: float | Sequence[float] | None = None,
) -> Any:
    """Return the effort of the drivers by virtual power; see `Machine.effort`."""
    n = machine._drivers
    if machine.friction:
        # What friction takes depends on the forces in its pairs.
        keys = [*(Key("driver", driver) for driver in range(n)), SOLUTIONS]
        return reactions(machine, motion, None, on_error, keys, sense).driver
    x, v, a, shape = broadcast_motion(machine, motion)
    full = shape if n == 1 else (*shape, n)
    # A motor's rotor belongs to the drive.
    bare = machine
    if machine.motor is not None and machine.mechanism is not None:
        bare = type(machine)(machine.mechanism, machine.bodies, machine.loads)
    inertia, rates, moment, _ = bare._reduce(x, v, on_error, times(motion.t, shape))
    speeds = np.broadcast_to(v, full).reshape(*shape, n)
    accelerations = np.broadcast_to(a, full).reshape(*shape, n)
    out = -moment
    with np.errstate(over="ignore", invalid="ignore"):
        for i in range(n):
            for j in range(n):
                out[..., i] += inertia[..., i, j] * accelerations[..., j]
                for k in range(n):
                    # Lagrange's equations: Σ (∂Mᵢⱼ/∂k − ½ ∂Mⱼₖ/∂i) q̇ⱼ q̇ₖ.
                    rate = rates[..., k, i, j] - 0.5 * rates[..., i, j, k]
                    out[..., i] += rate * speeds[..., j] * speeds[..., k]
    if on_error == "raise":
        solved = np.full(out.size // n, Status.OK, dtype=np.uint8)
        _require_finite("effort is", out.reshape(-1, n), solved, np.broadcast_to(x, full))
    out[np.isinf(out)] = np.nan
    return out[..., 0][()] if n == 1 else out
