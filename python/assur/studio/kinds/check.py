"""``check``: the state of a document while it is drawn: it moves, lacks or has too much."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur.errors import AssurError, StructureError
from assur.studio import document
from assur.studio.kinds.remedied import remedied
from assur.studio.kinds.structure import described
from assur.studio.request import Fields
from assur.studio.session import Answer

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism
    from assur.studio.session import Session

# Links that are tried as drivers, if none is named.
MOST_CANDIDATES = 12
# How many drivers, in words.
COUNTS = ("No", "One", "Two", "Three", "Four", "Five", "Six")


def check(data: dict[str, Any], session: Session) -> Answer:
    """Return the state of a document, with the names of the parts concerned."""
    fields = Fields(data, ("document",), ("document",))
    node = document.checked(fields["document"])
    drawing = {"joints": {}, "links": {"ground": []}, **node.value}
    node = document.checked(drawing)
    links = node.table()["links"].table()
    if not set(links) - {"ground"}:
        return _state(drawing, "empty", "Draw a link, or open an example.")
    if drawing.get("driver") in (None, "", []):
        return _without_driver(drawing, session)
    try:
        mechanism = document.read_mechanism(drawing)
    except AssurError as error:
        return _refused(drawing, error)
    return _moves(drawing, mechanism)


def _moves(drawing: dict[str, Any], mechanism: Mechanism) -> Answer:
    mobility = mechanism.structure.mobility
    return _state(drawing, "moves", f"Moves: mobility {mobility}.", **described(mechanism))


def _without_driver(drawing: dict[str, Any], session: Session) -> Answer:
    """Say what could drive it, each tried."""
    candidates: list[str] = []
    first: AssurError | None = None
    structure: dict[str, Any] | None = None
    for name in _on_ground(drawing)[:MOST_CANDIDATES]:
        session.deadline.check()
        try:
            mechanism = document.read_mechanism({**drawing, "driver": name})
        except AssurError as error:
            # Another link may drive where this one cannot.
            if first is None or first.kind == "cannot_drive":
                first = error
            continue
        candidates.append(name)
        structure = structure or described(mechanism)["structure"]
    if candidates or first is None or first.kind == "cannot_drive":
        message = "Nothing drives it yet. Click the link that is driven."
        more = {"candidates": candidates, "structure": structure}
        return _state(drawing, "no_driver", message, **more, remedies=_drives(drawing))
    return _refused(drawing, first)


def _drives(drawing: dict[str, Any]) -> list[dict[str, Any]]:
    """Return possible drivers, as remedies."""
    undriven = {**drawing, "driver": []}
    try:
        document.read_mechanism(undriven)
    except AssurError as error:
        cause = error.__cause__
        return remedied(undriven, cause.remedies) if isinstance(cause, StructureError) else []
    return []


def _on_ground(drawing: dict[str, Any]) -> list[str]:
    """Return the links at a joint of the ground, then the slides on it."""
    node = document.checked(drawing).table()
    links = {name: entry.names() for name, entry in node["links"].table().items()}
    fixed = set(links.get("ground", ()))
    turning = [n for n, joints in links.items() if n != "ground" and fixed & set(joints)]
    if "slides" not in node:
        return turning
    return [*turning, *node["slides"].table()]


def _refused(drawing: dict[str, Any], error: AssurError) -> Answer:
    """Return what a linkage lacks, or has too much of, in the words of the studio."""
    cause = error.__cause__ if isinstance(error.__cause__, AssurError) else error
    text, kind = str(cause), error.kind
    known = {key: drawing.get(key) for key in ("joints", "links", "slides")}
    concerned = {
        key: [n for n in cause.names if isinstance(entries, dict) and n in entries]
        for key, entries in known.items()
    }
    links = listed(concerned["links"])
    state, message, extra = "incomplete", text, {}
    if kind == "immovable":
        state = "stuck"
        message = f"Cannot move: {links} hold each other. Take one out, or let a joint slide."
    elif kind == "mobility" and cause.value is not None:
        state, count = "loose", int(cause.value)
        extra = {"needed": count}
        how = COUNTS[count] if count < len(COUNTS) else str(count)
        drivers = "drivers are" if count != 1 else "driver is"
        message = f"{how} {drivers} needed: with what is driven held, {links or 'a link'} still "
        message += "moves." if len(concerned["links"]) < 2 else "move."
    elif kind in ("over_constrained", "almost_fits", "slides_only"):
        state = "stuck"
    elif kind is None or kind in ("bad_name", "doubled_name", "not_finite", "out_of_range"):
        state = "invalid"
    return _state(
        drawing,
        state,
        message,
        reason=kind,
        hint=cause.hint,
        key=getattr(error, "key", None),
        joint=error.joint,
        link=error.link,
        slide=error.slide,
        concerned=concerned,
        remedies=remedied(drawing, cause.remedies) if isinstance(cause, StructureError) else [],
        **extra,
    )


def _state(drawing: dict[str, Any], state: str, message: str, **more: Any) -> Answer:
    counts: dict[str, Any] = {"counted": _counted(drawing), "structure": None, "remedies": []}
    return Answer({"state": state, "message": message, **counts, **more})


def _counted(drawing: dict[str, Any]) -> dict[str, int]:
    """Count as Chebyshev and Grübler do, even before it is a mechanism."""
    links = {n: on for n, on in drawing["links"].items() if isinstance(on, list)}
    slides = drawing.get("slides")
    slides = slides if isinstance(slides, dict) else {}
    cylinders = [slide for slide in slides.values() if isinstance(slide, dict) and "base" in slide]
    made = [[slide[end]] for slide in cylinders for end in ("base", "end") if end in slide]
    everywhere = [name for on in (*links.values(), *made) for name in dict.fromkeys(map(str, on))]
    turning = len(everywhere) - len(set(everywhere))
    moving = len(links) - ("ground" in links) + len(made)
    return {
        "moving_links": moving,
        "turning_pairs": turning,
        "sliding_pairs": len(slides),
        "mobility": 3 * moving - 2 * (turning + len(slides)),
    }


def listed(names: list[str]) -> str:
    """Return names as a sentence has them: a, b and c."""
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
