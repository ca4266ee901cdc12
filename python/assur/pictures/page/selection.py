"""What a page shows at first, by the column names of `Motion.to_dataframe`."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from assur._faces import Mechanism


OF_JOINT = ("x", "y", "v", "a", "vx", "vy", "ax", "ay")
OF_LINK = ("omega", "alpha")
OF_SLIDE = ("v", "a")
MOST_DIAGRAMS = 3


def names_of_quantities(mechanism: Mechanism) -> list[str]:
    """Return all names: of joints ``"C.x"``, of links ``"rocker.omega"``, of slides ``"bore"``."""
    links = [link for link in mechanism.links if link != "ground"]
    return [
        *(f"{joint}.{of}" for joint in mechanism.joints for of in OF_JOINT),
        *(name for link in links for name in (link, *(f"{link}.{of}" for of in OF_LINK))),
        *(n for slide in mechanism.slides for n in (slide, *(f"{slide}.{of}" for of in OF_SLIDE))),
    ]


def checked_diagrams(mechanism: Mechanism, asked: Any) -> list[str]:
    """Return the diagrams shown at first; by default the output with two derivatives."""
    if asked is None:
        return _output(mechanism)
    names = _listed(asked, "diagrams")
    if len(names) > MOST_DIAGRAMS:
        message = f"diagrams has {len(names)} names: a page shows up to {MOST_DIAGRAMS}"
        raise InputError(message)
    _require(names, names_of_quantities(mechanism), "diagrams", "quantity")
    return names


def checked_joints(mechanism: Mechanism, asked: Any) -> list[str]:
    """Return the joints whose paths are shown at first."""
    if asked is None:
        return _traced(mechanism)
    names = _listed(asked, "joint")
    _require(names, list(mechanism.joints), "joint", "joint")
    return names


def _listed(asked: Any, what: str) -> list[str]:
    listed = [asked] if isinstance(asked, str) else asked
    if not isinstance(listed, list | tuple) or not all(isinstance(name, str) for name in listed):
        message = f"{what} is {short(asked)}: a name or a list of names is needed"
        raise InputError(message)
    return list(dict.fromkeys(listed))


def _require(names: Iterable[str], known: list[str], what: str, noun: str) -> None:
    for name in names:
        if name not in known:
            similar = difflib.get_close_matches(name, known, 3)
            hint = f"; did you mean {' or '.join(map(repr, similar))}?" if similar else ""
            message = f"{what}: there is no {noun} {name!r}{hint}"
            raise InputError(message)


def _output(mechanism: Mechanism) -> list[str]:
    """Return the output of the driver: a slide of the ground, else the last link."""
    drivers = mechanism.description.drivers
    free = {n: slide for n, slide in mechanism.slides.items() if n not in drivers}
    slides = [n for n, slide in free.items() if slide.on == "ground"]
    groups = mechanism.structure.groups
    if slides:
        return [slides[-1], f"{slides[-1]}.v", f"{slides[-1]}.a"]
    links = [link for group in groups for link in group.links]
    on_ground = [
        link for link in links if set(mechanism.links[link]) & set(mechanism.links["ground"])
    ]
    moving = [link for link in mechanism.links if link != "ground"]
    # Several drivers carry a tool, which does not hang on the ground.
    link = ((on_ground if len(drivers) == 1 else links) or links or moving)[-1]
    return [link, f"{link}.omega", f"{link}.alpha"]


def _traced(mechanism: Mechanism) -> list[str]:
    """Return points of one link alone, which are drawn for their path; else the last joint."""
    at: dict[str, list[str]] = {}
    for link, joints in mechanism.links.items():
        for joint in joints:
            at.setdefault(joint, []).append(link)
    moving = {joint: links for joint, links in at.items() if "ground" not in links}
    points = [joint for joint, links in moving.items() if len(links) == 1]
    sliding = [slide.link for slide in mechanism.slides.values()]
    return [p for p in points if at[p][0] not in sliding] or list(moving)[-1:]
