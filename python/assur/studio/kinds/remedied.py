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


def remedied(table: Table, remedies: Collection[Remedy]) -> list[Table]:
    """Return each remedy with the whole resulting document, if that can be read."""
    documents = []
    for remedy in remedies:
        edited = next(_readable(_edited(table, remedy)), None)
        if edited is not None:
            documents.append(
                {
                    "text": remedy.text,
                    "detail": remedy.detail,
                    "kind": remedy.kind,
                    "names": remedy.names,
                    "document": edited,
                }
            )
    return documents


def _readable(edited: Table) -> Iterator[Table]:
    """Yield the document with as much of the old one as it takes, beginning with all."""
    geometry = {key: value for key, value in edited.items() if key != "dimensions"}
    for candidate in (edited, geometry):
        try:
            document.read(candidate)
        except AssurError:
            continue
        yield candidate
    # Masses or loads that were wrong before do not concern the remedy.
    for candidate in (edited, geometry):
        try:
            document.read_mechanism(candidate)
        except AssurError:
            continue
        yield candidate


def _edited(table: Table, remedy: Remedy) -> Table:
    """Return the document with the change, without data of parts that are gone."""
    parts = remedy.arguments
    joints, links, slides = parts["joints"], parts["links"], parts["slides"]
    entries = _slides(table.get("slides") or {}, parts)
    made = {end for name, entry in entries.items() for end in _cylinder_links(name, entry)}
    edited: Table = {key: value for key, value in table.items() if key not in ("drawn", "assembly")}
    edited["driver"] = _driver(parts["driver"])
    # Another driver has a speed of its own, and perhaps another unit.
    if edited["driver"] != table.get("driver"):
        edited.pop("input_speed", None)
    edited["joints"] = {name: list(at) for name, at in joints.items()}
    edited["links"] = {name: list(on) for name, on in links.items() if name not in made}
    edited["slides"] = entries
    edited["assembly"] = parts["assembly"]
    for key in ("slides", "assembly"):
        if not edited[key] and key not in table:
            del edited[key]
    there = {*joints, *links, *slides}
    gone = _names(table) - there
    if isinstance(table.get("bodies"), dict):
        edited["bodies"] = {name: body for name, body in table["bodies"].items() if name in links}
    if isinstance(table.get("friction"), dict):
        pairs = table["friction"].items()
        edited["friction"] = {name: friction for name, friction in pairs if name not in gone}
    if "motor" in table:
        edited["motor"] = _motor(table["motor"], _listed(table.get("driver")), edited["driver"])
        if edited["motor"] == WITHOUT_MOTOR:
            del edited["motor"]
    if isinstance(table.get("loads"), list):
        edited["loads"] = [load for load in table["loads"] if not _mentions(load, gone)]
    if isinstance(table.get("dimensions"), dict):
        same = _unchanged(table, parts)
        edited["dimensions"] = {
            name: value
            for name, value in table["dimensions"].items()
            if name.partition(".")[0] in same and not gone & set(name.split("."))
        }
    return edited


def _slides(old: Mapping[str, Any], parts: Mapping[str, Any]) -> Table:
    """Return the slides' entries: those of the document where they still say the same."""
    entries: Table = {}
    for name, slide in parts["slides"].items():
        entry = old.get(name)
        is_same = entry is not None and _says_the_same(name, entry, slide, parts)
        entries[name] = entry if is_same else _entry(slide)
    return entries


def _says_the_same(name: str, entry: Table, slide: Slide, parts: Mapping[str, Any]) -> bool:
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
        return [_driver(drive) for drive in driver]
    if isinstance(driver, Drive):
        return {"link": driver.link, "relative_to": driver.relative_to}
    return driver


def _listed(entry: Any) -> list[Any]:
    return entry if isinstance(entry, list) else [entry]


def _motor(motor: Any, old: list[Any], driver: Any) -> Any:
    """Return the motor, or the motors of several drivers: new drivers have none."""
    drivers = _listed(driver)
    if len(drivers) == len(old) or not old:
        return motor
    known = list(zip(old, _listed(motor), strict=False))
    motors = [next((m for d, m in known if d == drive), WITHOUT_MOTOR) for drive in drivers]
    return motors if isinstance(driver, list) else motors[0]


def _names(table: Table) -> set[str]:
    """Return the names of everything in a document."""
    names = {name for key in ("joints", "links", "slides") for name in table.get(key) or {}}
    for name, entry in (table.get("slides") or {}).items():
        names.update(_cylinder_links(name, entry))
    return names


def _mentions(load: Any, names: Collection[str]) -> bool:
    """Whether a load names something."""
    if isinstance(load, dict):
        return any(_mentions(part, names) for part in load.values())
    if isinstance(load, list):
        return any(_mentions(part, names) for part in load)
    return isinstance(load, str) and load in names


def _unchanged(table: Table, parts: Mapping[str, Any]) -> set[str]:
    """Return the links and slides whose dimensions mean what they did."""
    links = {name for name, on in table["links"].items() if parts["links"].get(name) == tuple(on)}
    old = table.get("slides") or {}
    slides = {
        name
        for name, slide in parts["slides"].items()
        if name in old and _says_the_same(name, old[name], slide, parts)
    }
    made = {end for name in slides for end in _cylinder_links(name, old[name])}
    return links | slides | made | {"ground"}
