"""Writes a sheet of a position, of a link, or of all links: see `Mechanism.to_drawing`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import flag, real_number, short
from assur._files import checked_path, writing
from assur._validate import checked_name
from assur.errors import InputError
from assur.pictures.axes import GREATEST_EXTENT, nice_length
from assur.pictures.drawing.layers import layer_names
from assur.pictures.drawing.link_part import MM, Workshop, link_drawing
from assur.pictures.drawing.names import name_marks
from assur.pictures.drawing.position import PX, dimensioned, outlines, schematic
from assur.pictures.drawing.sheet import PAPERS, lay_out
from assur.pictures.drawing.strokes import strokes
from assur.pictures.linkage.subject import Subject
from assur.pictures.scene.extent import usual_link
from assur.pictures.scene.slides import Slides

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from assur._faces import Mechanism, Motion
    from assur.pictures.drawing.marks import Mark

FORMATS = (".dxf", ".svg", ".pdf")
OWN_LAYERS = ("GROUND", "JOINTS", "DRIVER", "HATCHING", "CENTRES", "DIMENSIONS", "TEXT", "SHEET")
# The width of links, relative to their median length; a hole, relative to the width.
WIDTH, HOLE = 0.18, 0.4
# Digits of a dimension before and after the point, together; most after it.
DIGITS, MOST_DECIMALS = 5, 6


def write_drawing(
    mechanism: Mechanism,
    path: Any,
    q: Any,
    link: Any,
    scale: Any,
    paper: Any,
    title: Any,
    show_outlines: bool,
    width: Any,
    hole: Any,
    assembly: Mapping[str, int] | None,
) -> float:
    """See `Mechanism.to_drawing`."""
    target = checked_path(path, FORMATS)
    form = target.suffix.lower()
    if mechanism.shape:
        message = f"a drawing is of one design, this is a batch {mechanism.shape}: use design(i)"
        raise InputError(message)
    links = _checked_links(mechanism, link, q)
    fixed_scale = None if scale is None else _checked_scale(scale)
    if paper is not None and (not isinstance(paper, str) or paper not in PAPERS):
        message = f"paper is {short(paper)}: one of {', '.join(PAPERS)} is needed"
        raise InputError(message)
    flag(show_outlines, "outlines")
    if title is not None and not isinstance(title, str):
        message = f"title is {short(title)}: a text is needed"
        raise InputError(message)
    motion = _position(mechanism, q, assembly)
    subject = Subject(motion)
    sizes = _sizes(subject, width, hole)
    texts = [name.text for name in subject.scene.names]
    points = MM * subject.places(subject.frames[0])
    symbols = np.array([name.radius * PX for name in subject.scene.names])

    exact = strokes(subject, motion)
    slides = Slides(mechanism, subject.whole, frozenset(), frozenset(), exact)

    def views(per: float) -> list[list[Mark]]:
        shop = _workshop(subject, slides, *sizes, per)
        if links is not None:
            return [link_drawing(shop, name) for name in links]
        if show_outlines:
            marks, radii = outlines(subject, shop), np.full(len(texts), sizes[0] / 2.0 / per)
        else:
            marks, radii = schematic(subject, shop.layers, per), symbols
        marks = [*marks, *dimensioned(subject, marks, per)]
        return [[*marks, *name_marks(texts, points, radii, marks, per)]]

    heading = _heading(target, title, link)
    thinnest = sizes[0] if links is not None or show_outlines else np.inf
    sheet = lay_out(views, _size(subject, links, sizes[0]), thinnest, heading, fixed_scale, paper)
    decimals = int(np.clip(DIGITS - np.ceil(np.log10(_size(subject, None, 0.0))), 0, MOST_DECIMALS))
    if form == ".dxf":
        from assur.pictures.drawing.dxf import dxf_bytes

        contents = dxf_bytes(sheet, decimals)
    else:
        from assur.pictures.drawing.paper import paper_bytes

        contents = paper_bytes(sheet, decimals, form[1:])
    with writing(target):
        target.write_bytes(contents)
    return sheet.scale


def _checked_links(mechanism: Mechanism, link: Any, q: Any) -> list[str] | None:
    """Return the links that are drawn as parts; None for a position."""
    if link is None:
        return None
    if q is not None:
        message = "q is given, and link: a part has no position, leave one of them out"
        raise InputError(message)
    if not isinstance(link, str):
        message = f'link is {short(link)}: the name of a link is needed, or "all"'
        raise InputError(message)
    if link == "all":
        shaped = [name for name in mechanism.links if _has_shape(mechanism, name)]
        return shaped or list(mechanism.links)
    link = checked_name(link, "link")
    mechanism.core.index_of("link", link)
    if not _has_shape(mechanism, link):
        message = f"link {link!r} has no joint and no slide: there is nothing to draw"
        raise InputError(message)
    return [link]


def _has_shape(mechanism: Mechanism, link: str) -> bool:
    slides = mechanism.slides.values()
    return bool(mechanism.links[link]) or any(link in (slide.link, slide.on) for slide in slides)


def _checked_scale(scale: Any) -> float:
    """Return a scale given as a number, or as a text such as "1:2"."""
    if isinstance(scale, str):
        above, colon, below = scale.partition(":")
        try:
            value = float(above) / float(below) if colon else float("nan")
        except (ValueError, ZeroDivisionError):
            value = float("nan")
    else:
        value = real_number(scale, "scale", finite=False)
    if not (np.isfinite(value) and 1e-9 <= value <= 1e9):
        message = f'scale is {short(scale)}: a number from 1e-9 to 1e9, 0.5 or "1:2", is needed'
        raise InputError(message)
    return value


def _position(mechanism: Mechanism, q: Any, assembly: Mapping[str, int] | None) -> Motion:
    assembly_q = getattr(assembly, "q", None)
    at = next(value for value in (q, assembly_q, mechanism.q0_array) if value is not None)
    motion = mechanism.solve(at, order=0, assembly=assembly)
    if motion.shape:
        message = f"q has positions {motion.shape}: a drawing shows one"
        raise InputError(message)
    return motion


def _sizes(subject: Subject, width: Any, hole: Any) -> tuple[float, float]:
    """Return the width of links and the diameter of holes, mm."""
    usual = MM * usual_link(subject.whole)
    if width is None and not usual > 0.0:
        message = "width is not given, and no link has a length that it would follow from"
        raise InputError(message)
    wide = nice_length(WIDTH * usual) if width is None else MM * _length(width, "width")
    bore = HOLE * wide if hole is None else MM * _length(hole, "hole")
    if not bore < wide:
        message = (
            f"hole is {bore / MM:g} m and width {wide / MM:g} m: links must be wider than holes"
        )
        raise InputError(message)
    return wide, bore


def _length(value: Any, what: str) -> float:
    length = real_number(value, what)
    if not length > 0.0:
        message = f"{what} is {length:g}: a positive length is needed, m"
        raise InputError(message)
    if length > GREATEST_EXTENT:
        message = f"{what} is {length:g} m: up to {GREATEST_EXTENT:g} can be drawn"
        raise InputError(message, value=length)
    return length


def _workshop(subject: Subject, slides: Slides, width: float, hole: float, per: float) -> Workshop:
    mechanism = subject.mechanism
    named = layer_names([*OWN_LAYERS, *(f"LINK_{link_name}" for link_name in mechanism.links)])
    layers = {link: named[f"LINK_{link}"] for link in mechanism.links}
    layers["ground"] = "GROUND"
    count: dict[str, int] = {}
    for joints in mechanism.links.values():
        for joint in joints:
            count[joint] = count.get(joint, 0) + 1
    sliding = {
        joint
        for slide in mechanism.slides.values()
        for joint in list(mechanism.links[slide.link])[:1]
    }
    pins = {joint for joint, links in count.items() if links > 1} | sliding
    return Workshop(
        frames=subject.whole,
        slides=slides,
        names=tuple(mechanism.slides),
        pins=frozenset(pins),
        width=width,
        hole=hole,
        per=per,
        layers=layers,
        dimensions={name: float(value) for name, value in mechanism.dimensions.items()},
        origins={name: slide.origin for name, slide in mechanism.slides.items()},
    )


def _size(subject: Subject, links: list[str] | None, width: float) -> float:
    """Return the extent of a position, or of the largest of some links, mm."""
    if links is None:
        points = [np.concatenate(list(subject.at.joints().values()))]
    else:
        points = [np.array(list(subject.at.local[link].values())).reshape(-1, 2) for link in links]
    extents = [MM * float(np.ptp(corners, axis=0).max()) for corners in points if len(corners)]
    return max(*extents, width, 1e-300)


def _heading(target: Path, title: str | None, link: Any) -> str:
    text = target.stem if title is None else title
    return text if link in (None, "all") else f"{text}: {link}"
