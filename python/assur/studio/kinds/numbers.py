"""``position``: the numbers of one position. ``sensitivity``: an output by every dimension."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur.description.dotted_names import split_name, unit_of
from assur.studio import document
from assur.studio.kinds.least import transmission_angles
from assur.studio.request import Fields
from assur.studio.session import Answer

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.quantity import Analogues
    from assur.studio.session import Session

COMPONENTS = ("x", "y")


def position(data: dict[str, Any], session: Session) -> Answer:
    """Return places, speeds and accelerations of all parts, and the transmission angles."""
    del session
    fields = Fields(data, ("document", "q", "speed", "acceleration"), ("document",))
    mechanism = document.read_mechanism(fields["document"])
    q = fields.drivers("q", mechanism)
    speed = fields.drivers("speed", mechanism, 1.0)
    acceleration = fields.drivers("acceleration", mechanism, 0.0)
    motion = mechanism.solve(q, order=2)

    def numbers(of: Analogues) -> dict[str, Any]:
        return {
            "value": of.value,
            "speed": of.velocity(speed),
            "acceleration": of.acceleration(speed, acceleration),
        }

    return Answer(
        {
            "q": q,
            "joints": {name: numbers(motion.joint(name)) for name in mechanism.joints},
            "links": {name: numbers(motion.link(name)) for name in mechanism.links},
            "slides": {name: numbers(motion.slide(name)) for name in mechanism.slides},
            "transmission": {name: float(angle) for name, angle in transmission_angles(motion)},
            "status": int(motion.status),
        }
    )


def sensitivity(data: dict[str, Any], session: Session) -> Answer:
    """Return the derivative of an output at q by each dimension."""
    fields = Fields(data, ("document", "q", "of", "order"), ("document", "of"))
    mechanism = document.read_mechanism(fields["document"])
    q = fields.drivers("q", mechanism)
    order = fields.whole("order", 0, 0, 2)
    kind, name, component = _output(fields, mechanism)
    motion = mechanism.solve(q, order=order, outputs=[name])
    by: dict[str, Any] = {}
    for dimension in mechanism.dimensions:
        session.deadline.check()
        derivative = getattr(motion.sensitivity(dimension), kind)(name)
        by[dimension] = _component(derivative, order, component)
    value = _component(getattr(motion, kind)(name), order, component)
    unit = "rad" if kind == "link" else "m"
    units = {name: f"{unit}/{unit_of(name)}" for name in by}
    return Answer({"q": q, "value": value, "unit": unit, "by": by, "units": units})


def _output(fields: Fields, mechanism: Mechanism) -> tuple[str, str, int | None]:
    """Return what "rocker", "bore" or "P.x" names: a kind, its name, a component."""
    text = fields.text("of")
    name, component = split_name(text)
    if name in mechanism.joints and component in COMPONENTS:
        return "joint", name, COMPONENTS.index(component)
    if text in mechanism.links and name != "ground":
        return "link", name, None
    if text in mechanism.slides:
        return "slide", name, None
    raise fields.error("of", 'the name of a link or slide, or a joint with .x or .y ("P.x")')


def _component(of: Analogues, order: int, component: int | None) -> Any:
    values = of.arrays[order]
    return values if component is None else values[component]
