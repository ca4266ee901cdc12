"""The forces on links cut free at one position, which are drawn in place and as a polygon."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import short
from assur._validate import checked_index, checked_names
from assur.description.words import Status, has_analogues
from assur.dynamics.forces.applied_loads import Acting, Positions, acting_on
from assur.dynamics.forces.joint_places import links_at, mass_centre
from assur.dynamics.forces.load_forces import loads_of
from assur.dynamics.loads.loads import Gravity
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from assur._arrays import Float
    from assur.dynamics.forces._reactions import Reactions
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion


class PlacedForce(NamedTuple):
    """A force at a point, and a couple.

    Attributes
    ----------
    kind : {"reaction", "load", "weight", "inertia", "drive"}
        What it is.
    name : str
        The joint or slide, else the link.
    link : str
        The link on which it acts.
    place, force : ndarray
        (2,), m and N, along the drawing's axes.
    couple : float
        N·m.
    inner : bool
        Whether it acts between links that are cut free together.
    """

    kind: str
    name: str
    link: str
    place: Float
    force: Float
    couple: float
    inner: bool


class ForceSystem(NamedTuple):
    """All forces on links at one position, and the motion there."""

    motion: Motion
    links: tuple[str, ...]
    forces: tuple[PlacedForce, ...]


def force_system(
    solved: Reactions, links: str | Sequence[str] | None, at: int | tuple[int, ...]
) -> ForceSystem:
    """Return the forces on links at an index into the shape of reactions.

    With `links=None`, all moving links are cut free, with the forces in the joints between them
    too.
    """
    if solved._source is None:
        message = "a copy of reactions does not keep functions among the loads: draw the original"
        raise InputError(message)
    index = checked_index(at, solved.status.shape, "at")
    positions, motion = _positions(solved, index)
    mechanism = motion.mechanism
    chosen = _checked_links(mechanism, links)
    if not has_analogues(solved.status[index]):
        why = motion.explain()
        if solved.status[index] == Status.NO_VALUE:
            why = "a load or an inertia force is not finite"
        message = f"no reactions there: {why}"
        raise InputError(message)
    forces = [
        force
        for link in chosen
        for force in (*_pairs_and_loads(positions, link, chosen), *_masses(positions, link))
    ]
    if not all(np.isfinite([*force.force, force.couple]).all() for force in forces):
        message = "forces at this position are not finite: friction locks it, or a redundant link"
        raise InputError(f"{message} leaves them undetermined")
    return ForceSystem(motion, chosen, tuple(force for force in forces if _is_any(force)))


def _positions(solved: Reactions, index: tuple[int, ...]) -> tuple[Positions, Motion]:
    """Return the machine of one design at one position, as a row of one."""
    assert solved._source is not None
    machine, _ = solved._source
    mechanism = solved.mechanism
    drivers = mechanism.driver_count
    if mechanism.shape:
        mechanism = mechanism.design(index[: len(mechanism.shape)])
        machine = machine.of(mechanism)
    q, speed, acceleration = (
        np.reshape(array[index], (1, drivers))
        for array in (solved.q, solved.speed, solved.acceleration)
    )
    row = q[:, 0] if drivers == 1 else q
    rates = (speed[:, 0], acceleration[:, 0]) if drivers == 1 else (speed, acceleration)
    motion = mechanism.solve(row, order=2, on_error="nan")
    held = {key: values[index][np.newaxis] for key, values in solved.by_key.items()}
    part = type(solved)(mechanism, (row, *rates), held, solved.status[index].reshape(1))
    loads = [load.at(index) for load in loads_of(solved)]
    at: Any = Positions(machine, motion, part, loads)
    return at, motion[0]


def _checked_links(mechanism: Mechanism, links: str | Sequence[str] | None) -> tuple[str, ...]:
    moving = [link for link in mechanism.links if link != "ground"]
    if links is None:
        return tuple(moving)
    chosen = checked_names(links, "links")
    for link in chosen:
        mechanism.core.index_of("link", link)
    if not chosen or "ground" in chosen:
        message = f"links is {short(links)}: moving links are needed, some of {', '.join(moving)}"
        raise InputError(message)
    return tuple(link for link in moving if link in chosen)


def _is_any(force: PlacedForce) -> bool:
    return bool(np.any(force.force) or force.couple)


def _pairs_and_loads(at: Positions, link: str, chosen: tuple[str, ...]) -> Iterator[PlacedForce]:
    mechanism = at.motion.mechanism
    links_of = links_at(mechanism)
    for acting in acting_on(at, link, couples=True):
        name = acting.name
        if acting.kind == "joint":
            inner = _is_inner(links_of[name], link, chosen)
            yield _placed(acting, "reaction", name, link, inner)
        elif acting.kind == "slide":
            slide = mechanism.slides[name]
            inner = {slide.link, slide.on} <= set(chosen)
            yield _placed(acting, "reaction", name, link, inner)
        elif acting.kind == "drive":
            yield _placed(acting, "drive", link, link, False)
        else:
            yield _placed(acting, "load", acting.joint or link, link, False)


def _is_inner(links: list[str], link: str, chosen: tuple[str, ...]) -> bool:
    """Whether nothing outside meets the links at a joint."""
    return all(meeting in chosen for meeting in links) and link in links


def _placed(acting: Acting, kind: str, name: str, link: str, inner: bool) -> PlacedForce:
    return PlacedForce(
        kind, name, link, acting.place[0], acting.force[0], float(acting.couple[0]), inner
    )


def _masses(at: Positions, link: str) -> Iterator[PlacedForce]:
    """Yield weight and inertia of a link, at its centre of mass."""
    body = at.machine.bodies.get(link)
    if body is None:
        return
    centre = mass_centre(at.motion.mechanism, link, body)
    point = at.motion.point(link, (centre.real, centre.imag))
    rates = at.found.speed, at.found.acceleration
    place = point.value[0]
    fall = np.sum(
        [load.acceleration for load in at.machine.loads if isinstance(load, Gravity)], axis=0
    )
    yield PlacedForce("weight", link, link, place, body.mass * fall * np.ones(2), 0.0, False)
    force = -body.mass * point.acceleration(*rates)[0]
    couple = -body.inertia * float(at.motion.link(link).acceleration(*rates)[0])
    yield PlacedForce("inertia", link, link, place, force, couple, False)
