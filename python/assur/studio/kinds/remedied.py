"""Remedies of a document: the same document with the change made, as far as it still fits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur.description.words import Drive
from assur.errors import AssurError
from assur.files.read_machine import NO_MOTOR
from assur.studio import document

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping

    from assur._remedy import Remedy
    from assur.description.words import DriverLike, Slide

Table = dict[str, Any]
WITHOUT_MOTOR: Table = {"type": NO_MOTOR}


def remedied(own: Table, remedies: Collection[Remedy]) -> list[Table]:
    """Return each remedy with the whole document as it is then; only what can be read."""
    found = []
    for remedy in remedies:
        edited = next(_readable(_edited(own, remedy)), None)
        if edited is not None:
            found.append(
                {
                    "text": remedy.text,
                    "detail": remedy.detail,
                    "kind": remedy.kind,
                    "names": remedy.names,
                    "document": edited,
                }
            )
    return found


def _readable(edited: Table) -> Iterator[Table]:
    """Yield the document with as much of the old one as it takes, beginning with all."""
    geometry = {key: value for key, value in edited.items() if key != "dimensions"}
    for one in (edited, geometry):
        try:
            document.read(one)
        except AssurError:
            continue
        yield one
    # Masses or loads that were wrong before are none of the remedy's business.
    for one in (edited, geometry):
        try:
            document.read_mechanism(one)
        except AssurError:
            continue
        yield one


def _edited(own: Table, remedy: Remedy) -> Table:
    """Return the document with the change, without what belongs to things that are gone."""
    parts = remedy.arguments
    joints, links, slides = parts["joints"], parts["links"], parts["slides"]
    entries = _slides(own.get("slides") or {}, parts)
    made = {end for name, entry in entries.items() for end in _cylinder_links(name, entry)}
    edited: Table = {key: value for key, value in own.items() if key not in ("drawn", "assembly")}
    edited["driver"] = _driver(parts["driver"])
    # Another driver has a speed of its own, and perhaps another unit.
    if edited["driver"] != own.get("driver"):
        edited.pop("input_speed", None)
    edited["joints"] = {name: list(at) for name, at in joints.items()}
    edited["links"] = {name: list(on) for name, on in links.items() if name not in made}
    edited["slides"] = entries
    edited["assembly"] = parts["assembly"]
    for key in ("slides", "assembly"):
        if not edited[key] and key not in own:
            del edited[key]
    there = {*joints, *links, *slides}
    gone = _names(own) - there
    if isinstance(own.get("bodies"), dict):
        edited["bodies"] = {name: one for name, one in own["bodies"].items() if name in links}
    if isinstance(own.get("friction"), dict):
        pairs = own["friction"].items()
        edited["friction"] = {name: one for name, one in pairs if name not in gone}
    if "motor" in own:
        edited["motor"] = _motor(own["motor"], _listed(own.get("driver")), edited["driver"])
        if edited["motor"] == WITHOUT_MOTOR:
            del edited["motor"]
    if isinstance(own.get("loads"), list):
        edited["loads"] = [one for one in own["loads"] if not _mentions(one, gone)]
    if isinstance(own.get("dimensions"), dict):
        same = _unchanged(own, parts)
        edited["dimensions"] = {
            name: value
            for name, value in own["dimensions"].items()
            if name.partition(".")[0] in same and not gone & set(name.split("."))
        }
    return edited


def _slides(old: Mapping[str, Any], parts: Table) -> Table:
    """Return the slides' entries: those of the document where they still say the same."""
    entries: Table = {}
    for name, slide in parts["slides"].items():
        entry = old.get(name)
        is_same = entry is not None and _says_the_same(name, entry, slide, parts)
        entries[name] = entry if is_same else _entry(slide)
    return entries


def _says_the_same(name: str, entry: Table, slide: Slide, parts: Table) -> bool:
    """Whether a slide, or a cylinder with its two links, is as it was."""
    if "base" in entry:
        barrel, rod = _cylinder_links(name, entry)
        links = parts["links"]
        return (slide.link, slide.on) == (rod, barrel) and (
            (links.get(barrel), links.get(rod)) == ((entry["base"],), (entry["end"],))
        )
    if (entry["link"], entry["on"]) != (slide.link, slide.on):
        return False
    along = entry.get("along", ())
    return entry.get("origin") == slide.origin and all(end in parts["joints"] for end in along)


def _cylinder_links(name: str, entry: Table) -> tuple[str, ...]:
    """Return the names of barrel and rod; none of a plain slide."""
    if "base" not in entry:
        return ()
    return (entry.get("barrel", f"{name}_barrel"), entry.get("rod", f"{name}_rod"))


def _entry(slide: Slide) -> Table:
    entry: Table = {"link": slide.link, "on": slide.on, "angle": slide.angle}
    if slide.origin is not None:
        entry["origin"] = slide.origin
    return {**entry, "length": True} if slide.length else entry


def _driver(driver: DriverLike | list[DriverLike]) -> Any:
    if isinstance(driver, list):
        return [_driver(one) for one in driver]
    if isinstance(driver, Drive):
        return {"link": driver.link, "relative_to": driver.relative_to}
    return driver


def _listed(one: Any) -> list[Any]:
    return one if isinstance(one, list) else [one]


def _motor(motor: Any, old: list[Any], driver: Any) -> Any:
    """Return the motor, or the motors of several drivers: what did not drive before has none."""
    drivers = _listed(driver)
    if len(drivers) == len(old) or not old:
        return motor
    known = list(zip(old, _listed(motor), strict=False))
    motors = [next((m for d, m in known if d == own), WITHOUT_MOTOR) for own in drivers]
    return motors if isinstance(driver, list) else motors[0]


def _names(own: Table) -> set[str]:
    """Return the names of everything in a document."""
    names = {name for key in ("joints", "links", "slides") for name in own.get(key) or {}}
    for name, entry in (own.get("slides") or {}).items():
        names.update(_cylinder_links(name, entry))
    return names


def _mentions(load: Any, names: Collection[str]) -> bool:
    """Whether a load names something."""
    if isinstance(load, dict):
        return any(_mentions(one, names) for one in load.values())
    if isinstance(load, list):
        return any(_mentions(one, names) for one in load)
    return isinstance(load, str) and load in names


def _unchanged(own: Table, parts: Table) -> set[str]:
    """Return the links and slides whose dimensions mean what they did."""
    links = {name for name, on in own["links"].items() if parts["links"].get(name) == tuple(on)}
    old = own.get("slides") or {}
    slides = {
        name
        for name, slide in parts["slides"].items()
        if name in old and _says_the_same(name, old[name], slide, parts)
    }
    made = {end for name in slides for end in _cylinder_links(name, old[name])}
    return links | slides | made | {"ground"}
