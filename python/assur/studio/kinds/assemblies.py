"""``assemblies``: every way to put the mechanism together at one coordinate.

There are 2 to the number of dyads. A long list is cut to those that differ from the present one in
one dyad: step by step all can be reached.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.description.words import has_analogues
from assur.errors import AssurError
from assur.kinematics.assembly import SAME, Assembly
from assur.kinematics.configuration import size_of
from assur.studio import document
from assur.studio.kinds.turn import reach_of
from assur.studio.request import Fields
from assur.studio.session import Answer

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism
    from assur.studio.session import Session

# The greatest number of assemblies that are all listed.
MOST_LISTED = 64


def assemblies(data: dict[str, Any], session: Session) -> Answer:
    """Return each assembly with its joints, its reach, and the document drawn in it."""
    fields = Fields(data, ("document", "q"), ("document",))
    mechanism = document.read_mechanism(fields["document"])
    q = fields.drivers("q", mechanism)
    most = 2 ** len(mechanism.assembly)
    if most > MOST_LISTED:
        listed = _neighbours(mechanism, q)
        # Other solutions of a group above class II are not searched.
        is_complete = mechanism.core.cls <= 2
        rest: dict[str, Any] = {"failures": [], "is_complete": is_complete, "complex_count": []}
    else:
        every = mechanism.assemblies(q)
        # Each with its joints where the driver is.
        listed = [(assembly, dict(assembly.joints or {})) for assembly in every]
        rest = {"failures": every.failures, "is_complete": every.is_complete}
        rest |= {"complex_count": every.complex_count}
    described = []
    for assembly, joints in listed:
        session.deadline.check()
        # Limits of long chains take long: the last ones go without.
        is_late = session.deadline.left() < session.deadline.seconds / 2.0
        described.append(
            {
                "joints": joints,
                "signs": dict(assembly),
                "is_double": assembly.is_double,
                "is_current": _is_current(mechanism, joints, q),
                "reach": None if is_late else _reach(mechanism, assembly),
                "document": _drawn_in(fields["document"], mechanism, assembly),
            }
        )
    return Answer({"q": q, "assemblies": described, "most": most, **rest})


def _neighbours(mechanism: Mechanism, q: Any) -> list[tuple[Assembly, dict[str, Any]]]:
    """Return the present assembly and those that differ in one dyad, as far as they exist at q."""
    signs = dict(mechanism.assembly)
    flipped = [{**signs, name: -sign} for name, sign in signs.items()]
    listed = []
    for assembly in (Assembly(signs), *map(Assembly, flipped)):
        motion = mechanism.solve(q, order=0, assembly=assembly, on_error="nan")
        if has_analogues(motion.status):
            joints = {name: motion.joint(name).value.tolist() for name in mechanism.joints}
            listed.append((assembly, joints))
    return listed


def _drawn_in(data: dict[str, Any], mechanism: Mechanism, assembly: Assembly) -> dict[str, Any]:
    """Return the document drawn in an assembly; signs alone leave the drawing."""
    if assembly.q is None:
        return {**data, "assembly": dict(assembly)}
    beside = {key: data[key] for key in document.BESIDE if key in data}
    return {**document.document_of(mechanism.with_assembly(assembly)), **beside}


def _is_current(mechanism: Mechanism, joints: dict[str, Any], q: Any) -> bool:
    motion = mechanism.solve(q, order=0, on_error="nan")
    there = np.array([motion.joint(name).value for name in joints])
    places = np.array(list(joints.values()))
    return bool((np.abs(there - places) <= SAME * size_of(mechanism)).all())


def _reach(mechanism: Mechanism, assembly: Assembly) -> dict[str, Any] | None:
    """Return where the driver can move it; None with several drivers."""
    if mechanism.driver_count > 1:
        return None
    try:
        return reach_of(mechanism.limits(assembly=assembly))
    except AssurError:
        return None
