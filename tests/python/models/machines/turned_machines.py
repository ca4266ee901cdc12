"""A machine in a turned and shifted frame, renamed, its lists in another order.

Its links keep their own frames, so that what is given in these stays. A load is made to depend on
no order first: it acts on a named link, along the axes of a link.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from models.mechanisms.mechanism_data import GROUND, arguments
from models.mechanisms.variants import KINDS

if TYPE_CHECKING:
    from models.mechanisms.mechanism_data import Description
    from models.mechanisms.variants import Variant


def ordered(d: Description, machine: assur.Machine) -> assur.Machine:
    """The machine, whose loads do not depend on the order of links."""
    axes = next(n for n, own in d.links.items() if n != GROUND and own)
    mechanism = machine.mechanism
    assert mechanism is not None

    def fixed(load: Any) -> Any:
        if isinstance(load, assur.Force):
            own = axes if load.axes in (None, GROUND) else load.axes
            return replace(load, at=on_link(d, load.at), axes=own)
        if isinstance(load, assur.Spring | assur.Damper):
            return replace(load, first=on_link(d, load.first), second=on_link(d, load.second))
        return load

    loads = [fixed(load) for load in machine.loads]
    return assur.Machine(
        mechanism,
        bodies=machine.bodies,
        loads=loads,
        motor=machine.motor,
        friction=machine.friction,
    )


def on_link(d: Description, at: Any) -> Any:
    """A joint as a point of the first link that has it."""
    if not isinstance(at, str):
        return at
    link = next(n for n, own in d.links.items() if at in own)
    if link == GROUND:
        return link, d.joints[at]
    own = d.links[link]
    start = complex(*d.joints[own[0]])
    far = complex(*d.joints[at]) - start
    if far == 0.0:
        return link, (0.0, 0.0)
    along = complex(*d.joints[own[1]]) - start
    local = far * (along / abs(along)).conjugate()
    return link, (local.real, local.imag)


def turned(d: Description, machine: assur.Machine, v: Variant) -> assur.Machine:
    """The same machine by another description of its mechanism."""
    return _Turning(d, machine, v).machine()


class _Turning:
    """What names, angles and coordinates become."""

    def __init__(self, d: Description, machine: assur.Machine, v: Variant) -> None:
        self.own, self.frame = machine, v.frame
        self.joint, self.link, self.slide = (v.names[kind] for kind in KINDS)
        one, two = machine.mechanism, assur.Mechanism(**arguments(v.description))
        assert one is not None
        self.mechanism = two
        self.q = np.atleast_1d(two.q0) - np.atleast_1d(one.q0)
        drawn = one.solve(one.q0, order=0), two.solve(two.q0, order=0)
        # Angles are counted from the drawing's, which are in (−π, π].
        self.angle = {GROUND: 0.0}
        for n in d.links:
            if n != GROUND:
                there, here = drawn[1].link(self.link[n]), drawn[0].link(n)
                self.angle[n] = float(there.value - here.value)

    def machine(self) -> assur.Machine:
        own, motor = self.own, self.own.motor
        many = isinstance(motor, tuple)
        return assur.Machine(
            self.mechanism,
            bodies={self.link[n]: self.body(one) for n, one in own.bodies.items()},
            loads=[self.load(one) for one in own.loads],
            motor=[self.motor(one) for one in motor] if many else self.motor(motor),
            friction={{**self.joint, **self.slide}[n]: one for n, one in own.friction.items()},
        )

    def value(self, one: Any) -> Any:
        """A number, a table or a function of (t, q, speed)."""
        if isinstance(one, assur.Table):
            shift = self.angle.get(one.over, 0.0) if one.over else self.q[0]
            over = None if one.over is None else {**self.link, **self.slide}[one.over]
            return assur.Table(
                one.q + shift, one.value, spline=one.spline, periodic=one.periodic, over=over
            )
        if callable(one):
            shift = self.q if len(self.q) > 1 else self.q[0]
            return lambda t, x, v: one(t, x - shift, v)
        return one

    def motor(self, one: Any) -> Any:
        turns = isinstance(one, assur.ConstantTorque)
        return replace(one, torque=self.value(one.torque)) if turns else one

    def body(self, one: assur.Body) -> assur.Body:
        return replace(one, at=self.joint[one.at]) if isinstance(one.at, str) else one

    def place(self, at: Any) -> Any:
        name, (x, y) = at
        if name == GROUND:
            x, y = (self.frame.matrix @ (x, y) + self.frame.shift).tolist()
        return self.link[name], (x, y)

    def load(self, one: Any) -> Any:
        if isinstance(one, assur.Gravity):
            x, y = (self.frame.matrix @ one.acceleration).tolist()
            return assur.Gravity((x, y))
        if isinstance(one, assur.Force):
            assert one.axes is not None
            force = tuple(self.value(f) for f in one.force)
            return replace(one, at=self.place(one.at), axes=self.link[one.axes], force=force)
        if isinstance(one, assur.Spring | assur.Damper):
            return replace(one, first=self.place(one.first), second=self.place(one.second))
        more: dict[str, Any] = {}
        if isinstance(one, assur.TorsionSpring):
            more = {"angle": one.angle + self.angle[one.link] - self.angle[one.on]}
        if isinstance(one, assur.Torque):
            more = {"torque": self.value(one.torque)}
        return replace(one, link=self.link[one.link], on=self.link[one.on], **more)


def forces(
    d: Description, found: Any, v: Variant | None, friction: Any
) -> dict[str, np.ndarray[Any, Any]]:
    """All forces and moments of pairs; of a variant under the first's names, in its frame."""
    joint, link, slide = ((v.names[kind] if v else None) for kind in ("joint", "link", "slide"))
    turn = v.frame.matrix if v else np.eye(2)

    def name(table: dict[str, str] | None, one: str) -> str:
        return table[one] if table else one

    out: dict[str, Any] = {"driver": np.asarray(found.driver)}
    for j in d.joints:
        links = [n for n, own in d.links.items() if j in own]
        for n in links if len(links) > 1 else ():
            force = found.joint(name(joint, j), on=name(link, n))
            out[f"joint {j} on {n}"] = force @ turn
            if j in friction:
                moment = found.joint_moment(name(joint, j), on=name(link, n))
                out[f"moment {j} on {n}"] = np.asarray(moment)
    for s in d.slides:
        guide = found.slide(name(slide, s))
        for what in ("normal", "moment", "friction"):
            out[f"{what} of {s}"] = np.asarray(getattr(guide, what))
    return out
