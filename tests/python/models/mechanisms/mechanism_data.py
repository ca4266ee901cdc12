"""A mechanism as plain data, the same for the oracle and for assur."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import assur

DriverSpec = tuple[str, ...]  # ("angle", link, relative_to) or ("slide", name)

GROUND = "ground"


@dataclass(frozen=True)
class SlideSpec:
    """A sliding pair as in assur.Slide: `link` slides along a guide fixed on `on`."""

    link: str
    on: str
    angle: float
    origin: str | None = None


@dataclass(frozen=True)
class Description:
    """A mechanism: the drawing gives dimensions and assembly; "ground" is the frame."""

    joints: dict[str, tuple[float, float]]
    links: dict[str, list[str]]
    slides: dict[str, SlideSpec] = field(default_factory=dict)
    drivers: list[DriverSpec] = field(default_factory=list)


def arguments(description: Description) -> dict[str, Any]:
    """Keyword arguments of assur.Mechanism."""
    import assur

    drivers: list[Any] = []
    for kind, name, *other in description.drivers:
        relative = other[0] if other else GROUND
        plain = kind == "slide" or relative == GROUND
        drivers.append(name if plain else assur.Drive(name, relative_to=relative))
    slides = {
        n: assur.Slide(s.link, on=s.on, angle=s.angle, origin=s.origin)
        for n, s in description.slides.items()
    }
    driver = drivers[0] if len(drivers) == 1 else drivers
    return {
        "joints": description.joints,
        "links": description.links,
        "slides": slides,
        "driver": driver,
    }


def described(m: assur.Mechanism) -> Description:
    """A mechanism of assur as plain data."""
    slides = {n: SlideSpec(s.link, s.on, s.angle, s.origin) for n, s in m.slides.items()}
    given = m.driver if isinstance(m.driver, tuple) else (m.driver,)
    drivers: list[DriverSpec] = []
    for driver in given:
        link, relative = getattr(driver, "link", driver), getattr(driver, "relative_to", GROUND)
        name = str(link)
        drivers.append(("slide", name) if name in m.slides else ("angle", name, relative))
    links = {name: list(joints) for name, joints in m.links.items()}
    return Description(dict(m.joints), links, slides, drivers)
