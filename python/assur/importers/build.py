"""From a sketch to a mechanism."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from assur._summary import summary
from assur._validate import real_number
from assur.description.words import Cylinder, Drive, Slide
from assur.errors import InputError
from assur.importers.names import Names, listed
from assur.importers.resolution import tolerance_of
from assur.importers.sketch import GROUND
from assur.importers.tidy import tidy
from assur.kinematics.mechanism import Mechanism

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from typing import Any

    from assur.importers.resolution import Tolerance
    from assur.importers.sketch import Input, Sketch
    from assur.importers.source import Source

# Fraction of the file's resolution from which moves of joints are reported.
LEAST_SAID = 1e-6


@dataclass(frozen=True)
class Imported:
    """A linkage of another program.

    Attributes
    ----------
    mechanism : Mechanism
        The linkage.
    format : str
        The format it was read from.
    omitted : tuple of str
        A sentence for everything in the file that the mechanism does not have, or has in another
        way.
    input_speed : float, tuple of float or None or None
        Speed of the driver, rad/s or m/s, where the file gives one; a tuple for several drivers.

    Examples
    --------
    A line of PMKS a joint: its links, the pair, the place, flags:

    >>> from assur import importers
    >>> text = "ground crank R 0 0 0 ffft|crank rod R 0 1|rod block R 3 0|ground block P 3 0 0"
    >>> found = importers.read(text)
    >>> found.format, found.mechanism.structure.formula
    ('pmks', 'I(crank) → II(rod, block)')
    >>> found.omitted
    ('Joints J3 and J4 are at one place of link block: they are one joint, J3.',)
    """

    __repr__ = summary

    mechanism: Mechanism
    format: str
    omitted: tuple[str, ...]
    input_speed: float | tuple[float | None, ...] | None


def finish(
    source: Source,
    sketch: Sketch,
    source_format: str,
    scale: float,
    assembly: Mapping[str, int] | None,
) -> Imported:
    """Make the mechanism of a sketch; `scale` is the file's unit of length in m."""
    scale = real_number(scale, "scale")
    if not 1e-50 < scale < 1e50:
        message = f"scale is {scale:g}: a positive length in m is needed"
        raise InputError(message, value=scale)
    source.require_few(len(sketch.joints))
    source.require_few(len(sketch.links) + len(sketch.slots) + len(sketch.cylinders), "links")
    source.require_few(sum(map(len, sketch.links.values())) // 4, "joints of links")
    had_inputs = bool(sketch.inputs)
    tidy(source, sketch)
    if not sketch.inputs:
        why = (
            "what its input drives is left out" if had_inputs else "no joint is marked as its input"
        )
        left = " ".join(sketch.omitted)
        raise source.error("", f"the linkage has no driver: {why}. {left}".rstrip())
    return _build(source, sketch, source_format, scale, assembly)


def _build(
    source: Source,
    sketch: Sketch,
    source_format: str,
    scale: float,
    assembly: Mapping[str, int] | None,
) -> Imported:
    names = _Mapping(sketch)
    links = {GROUND: _named(sketch.links[GROUND], names.joints)}
    slides: dict[str, Slide | Cylinder] = {}
    turned = {driven.link: driven.joint for driven in sketch.inputs if driven.link}
    for link, members in sketch.links.items():
        # The angle of a driven link is that of the ray from its axis.
        first = [turned[link]] if turned.get(link) in members else []
        ordered = dict.fromkeys([*(joint for joint in first if joint), *members])
        links[names.links[link]] = _named(ordered, names.joints)
    for name, slot in sketch.slots.items():
        if slot.carrier in slot.riders:
            problem = f"joint {slot.joint!r} slides on its own link {slot.carrier!r}"
            raise source.error("", problem, joint=slot.joint, link=slot.carrier)
        sliding = names.blocks[name] if slot.turns else names.links[slot.riders[0]]
        if slot.turns:
            links[sliding] = [names.joints[slot.joint]]
        carrier = names.links[slot.carrier]
        slides[names.slides[name]] = Slide(sliding, on=carrier, angle=slot.angle)
    for name, (base, end) in sketch.cylinders.items():
        barrel, rod = names.tubes[name]
        ends = names.joints[base], names.joints[end]
        slides[names.slides[name]] = Cylinder(*ends, barrel=barrel, rod=rod)
    drivers = [_driver(driven, names) for driven in sketch.inputs]
    joints = {
        names.joints[joint]: (x * scale, y * scale) for joint, (x, y) in sketch.joints.items()
    }
    driver = drivers[0] if len(drivers) == 1 else drivers
    known_to = tolerance_of(sketch, scale)
    mechanism = Mechanism(
        joints, links, driver, slides=slides, assembly=assembly, tolerance=known_to
    )
    _say_adjustment(sketch, mechanism, known_to)
    speeds = tuple(_speed(driven, scale) for driven in sketch.inputs)
    is_known = any(speed is not None for speed in speeds)
    speed = speeds[0] if len(speeds) == 1 else speeds if is_known else None
    return Imported(mechanism, source_format, (*sketch.omitted, *names.changed), speed)


def _say_adjustment(sketch: Sketch, mechanism: Mechanism, known_to: Tolerance) -> None:
    """Say that joints are not where the file has them."""
    structure = mechanism.structure
    length = known_to[0] if isinstance(known_to, tuple) else known_to
    # Less is the rounding of binary numbers.
    if length is not None and structure.adjustment > LEAST_SAID * length:
        sketch.omitted.append(
            f"Joints are moved by up to {structure.adjustment:.2g} m, within the decimals of the "
            f"file, so that {listed(list(structure.redundant))} fits."
        )


def _driver(driven: Input, names: _Mapping) -> str | Drive:
    if driven.slide is not None:
        return names.slides[driven.slide]
    assert driven.link is not None
    assert driven.base is not None
    link = names.links[driven.link]
    return link if driven.base == GROUND else Drive(link, relative_to=names.links[driven.base])


def _speed(driven: Input, scale: float) -> float | None:
    if driven.speed is None or driven.slide is None:
        return driven.speed
    return driven.speed * scale


def _named(keys: Iterable[str], names: dict[str, str]) -> list[str]:
    return [names[key] for key in keys]


class _Mapping:
    """Names of the mechanism by those of the file; `changed` says which differ."""

    def __init__(self, sketch: Sketch) -> None:
        self._names = Names()
        self._names.add(GROUND)
        self.changed: list[str] = []
        self.joints = self._all("Joint", sketch.joints)
        self.links = self._all("Link", (link for link in sketch.links if link != GROUND))
        self.links[GROUND] = GROUND
        self.slides = self._all("Slide", (*sketch.slots, *sketch.cylinders))
        self.blocks = {
            name: self._names.add(f"{self.joints[slot.joint]}_block")
            for name, slot in sketch.slots.items()
            if slot.turns
        }
        self.tubes = {
            name: (
                self._names.add(f"{self.slides[name]}_barrel"),
                self._names.add(f"{self.slides[name]}_rod"),
            )
            for name in sketch.cylinders
        }

    def _all(self, kind: str, keys: Iterable[Any]) -> dict[str, str]:
        names = {key: self._names.add(key) for key in keys}
        for key, name in names.items():
            if name != key:
                self.changed.append(f"{kind} {key[:60]!r} is called {name}.")
        return names
