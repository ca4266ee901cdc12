"""``assemblies``: every way to put the mechanism together at one coordinate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import AssurError
from assur.files.read_machine import SECTIONS
from assur.kinematics.assembly import SAME
from assur.kinematics.place import size_of
from assur.studio import document
from assur.studio.kinds.turn import reach_of
from assur.studio.request import Fields
from assur.studio.session import Answer

if TYPE_CHECKING:
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.mechanism import Mechanism
    from assur.studio.session import Session


def assemblies(data: dict[str, Any], session: Session) -> Answer:
    """Return each assembly with its joints, its reach, and the document drawn in it."""
    fields = Fields(data, ("document", "q"), ("document",))
    mechanism = document.read_mechanism(fields["document"])
    q = fields.drivers("q", mechanism)
    found = mechanism.assemblies(q)
    machine = {key: fields["document"][key] for key in SECTIONS if key in fields["document"]}
    listed = []
    for one in found:
        session.deadline.check()
        listed.append(_described(mechanism, one, q, machine))
    return Answer(
        {
            "q": q,
            "assemblies": listed,
            "complex_count": found.complex_count,
            "is_complete": found.is_complete,
            "failures": found.failures,
        }
    )


def _described(
    mechanism: Mechanism, one: Assembly, q: Any, machine: dict[str, Any]
) -> dict[str, Any]:
    drawn = mechanism.with_assembly(one)
    return {
        "joints": dict(one.joints or {}),
        "signs": dict(one),
        "is_double": one.is_double,
        "is_current": _is_current(mechanism, one, q),
        "reach": _reach(drawn),
        "document": {**document.document_of(drawn), **machine},
    }


def _is_current(mechanism: Mechanism, one: Assembly, q: Any) -> bool:
    motion = mechanism.solve(q, order=0, on_error="nan")
    there = np.array([motion.joint(name).value for name in mechanism.joints])
    own = np.array(list((one.joints or {}).values()))
    return bool((np.abs(there - own) <= SAME * size_of(mechanism)).all())


def _reach(drawn: Mechanism) -> dict[str, Any] | None:
    """Return where the driver can move it; None with several drivers."""
    if drawn._driver_count > 1:
        return None
    try:
        limits = drawn.limits()
    except AssurError:
        return None
    return reach_of(limits)
