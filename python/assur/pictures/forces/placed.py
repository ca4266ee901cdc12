"""Forces in their places on the mechanism: see `Reactions.plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError
from assur.pictures.axes import scale_bar
from assur.pictures.linkage.artists import Drawn
from assur.pictures.linkage.position import name_joints
from assur.pictures.linkage.subject import Subject
from assur.pictures.numerals import number
from assur.pictures.style import style_of
from assur.pictures.text import name_font, text_size
from assur.pictures.vectors.arrows import LOOKS, arrow, moment_arc
from assur.pictures.vectors.beside import Beside
from assur.pictures.vectors.heading import LINE_HEIGHT, place_text, write_heading
from assur.pictures.vectors.mass_centre import mass_centre
from assur.pictures.vectors.symbols import symbol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import ForceSystem, PlacedForce
    from assur.pictures.axes import Canvas

# The longest vector, relative to the greater side of the frame; the least one that is drawn.
LONGEST, LEAST = 0.22, 1e-6
# How faintly links are drawn, and those not cut free.
OWN, OTHERS = 0.55, 0.18
# Arcs of inertia's moments.
SMALL = 0.75
LETTERS = {"reaction": ("R", ""), "load": ("F", ""), "weight": ("G", ""), "inertia": ("F", "i")}


def forces_picture(
    system: ForceSystem, links: str | Sequence[str] | None, ax: Any, dark: bool
) -> Axes:
    """See `Reactions.plot`."""
    subject = Subject(system.motion)
    chosen = [force for force in system.forces if links is None or not force.inner]
    if links is None:
        chosen = _once(chosen)
    greatest = max((float(np.hypot(*force.force)) for force in chosen), default=0.0)
    torque = max((abs(force.couple) for force in chosen), default=0.0)
    joints = np.concatenate(list(subject.whole.joints().values()))
    side = float((np.nanmax(joints, axis=0) - np.nanmin(joints, axis=0)).max())
    longest = LONGEST * side / greatest if greatest else 0.0
    tips = [force.place + longest * force.force for force in chosen]
    points = np.array(tips).reshape(-1, 2)
    on = subject.canvas(ax, style_of(dark), [points], 2.0 * LINE_HEIGHT)
    frames = subject.frames[0]
    _draw_faintly(subject, on, ("ground", *system.links) if links is None else system.links)
    forces = [f for f in chosen if np.hypot(*f.force) > LEAST * greatest]
    moments = [f for f in chosen if abs(f.couple) > LEAST * torque]
    shafts = [np.array([f.place, f.place + longest * f.force]) for f in forces]
    # Weights and inertia forces act there.
    centres = {force.link: force.place for force in chosen if force.kind in ("weight", "inertia")}
    for link, place in centres.items():
        mass_centre(on, place, link)
    for force, shaft in zip(forces, shafts, strict=True):
        colour = force_colour(on, force)
        arrow(
            on,
            shaft[0],
            shaft[1],
            LOOKS["force"],
            colour,
            force_gid(force),
            dashed=force.kind == "inertia",
            zorder=3.5,
        )
    arcs = [
        moment_arc(
            on,
            f.place,
            f.couple,
            force_colour(on, f),
            f"moment {force_gid(f)}",
            size=SMALL if f.kind == "inertia" else 1.0,
        )
        for f in moments
    ]
    names = name_joints(subject, on, frames, [*shafts, *arcs])
    beside = Beside(on, [*subject.lines(on, frames), *shafts, *arcs])
    for name in names:
        half = np.array(text_size(name.get_text(), name_font())) / 2.0
        beside.block(np.array(name.get_position()), half)
    for force, shaft in sorted(
        zip(forces, shafts, strict=True), key=lambda pair: -float(np.hypot(*pair[0].force))
    ):
        texts, gid = force_texts(force), f"{force_gid(force)} text"
        beside.write(shaft[0], shaft[1], texts, on.style.ink, gid)
    for force, arc in zip(moments, arcs, strict=True):
        _write_moment(beside, on, force, arc)
    write_heading(on, _heading(system, links))
    scale_bar(on)
    return on.ax


def _draw_faintly(subject: Subject, on: Canvas, chosen: tuple[str, ...]) -> None:
    """Draw the mechanism, links other than its own still fainter."""
    drawn = Drawn(on, subject.scene, subject.frames[0])
    links = {part.name: part.link for part in subject.scene.parts}
    for artist in drawn.artists:
        artist.set_alpha(OWN if links.get(artist.get_gid()) in chosen else OTHERS)


def _once(forces: Sequence[PlacedForce]) -> list[PlacedForce]:
    """Keep, of the forces between two moving links, the one on the first."""
    seen: set[str] = set()
    kept = []
    for force in forces:
        if force.inner:
            if force.name in seen:
                continue
            seen.add(force.name)
        kept.append(force)
    return kept


def force_gid(force: PlacedForce) -> str:
    """Return the name of a force's artists."""
    if force.name == force.link:
        return f"{force.kind} {force.link}"
    return f"{force.kind} {force.name} on {force.link}"


def force_colour(on: Canvas, force: PlacedForce) -> str:
    """Return the colour of a force: reactions have that of links, the drive its own."""
    if force.kind == "drive":
        return on.style.driver
    return on.style.ink if force.kind == "reaction" else on.style.force


def force_texts(force: PlacedForce) -> tuple[str, str]:
    """Return symbol and value of a force, and the symbol alone."""
    letter, upper = LETTERS.get(force.kind, ("F", ""))
    short = symbol(letter, [force.name], upper)
    return f"{short} = {force_value(float(np.hypot(*force.force)))}", short


def force_value(force: float) -> str:
    """Write a force with its unit."""
    return f"{number(force / 1e3)} kN" if abs(force) >= 1e3 else f"{number(force)} N"


def _write_moment(beside: Beside, on: Canvas, force: PlacedForce, arc: Float) -> None:
    upper = "i" if force.kind == "inertia" else ""
    value = number(abs(force.couple) / (1e3 if abs(force.couple) >= 1e3 else 1.0))
    unit = "kN·m" if abs(force.couple) >= 1e3 else "N·m"
    name = symbol("M", [force.name], upper)
    middle = len(arc) // 2
    tangent = arc[middle + 1] - arc[middle - 1]
    tangent = tangent / np.hypot(*tangent) * 30.0 / on.scale
    # Level above the arc.
    top = arc[middle]
    gid = f"moment {force_gid(force)} text"
    beside.write(
        top - tangent, top + tangent, (f"{name} = {value} {unit}", name), on.style.ink, gid
    )


def _heading(system: ForceSystem, links: str | Sequence[str] | None) -> list[str]:
    whole = "Forces" if links is None else f"Forces on {', '.join(system.links)}"
    return [whole, place_text(system.motion)]


def require_forces(system: ForceSystem) -> None:
    """Refuse a polygon without sides."""
    if not any(np.hypot(*force.force) for force in system.forces):
        message = f"no force acts on {', '.join(system.links)}: there is no polygon"
        raise InputError(message)
