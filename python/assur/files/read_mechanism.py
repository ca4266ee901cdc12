"""The mechanism of a file: joints, links, slides, driver, assembly, dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur.description.words import Cylinder, Drive, Slide
from assur.files.limits import MOST_ITEMS
from assur.files.read_drawn import drawn_at
from assur.kinematics.mechanism import Mechanism

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.description.encode import DriverLike
    from assur.errors import AssurError
    from assur.files.node import Node
    from assur.files.positions import KeyPath

SLIDE = ("link", "on", "angle", "origin")
CYLINDER = ("base", "end", "barrel", "rod")


def read_mechanism(root: Node) -> Mechanism:
    """Return the mechanism of a file."""
    sections = root.table()
    for name in ("joints", "links", "driver"):
        if name not in sections:
            raise root.missing(name, ": joints, links and a driver are needed")
    joints = {name: node.pair() for name, node in _items(sections["joints"])}
    links = {name: node.names() for name, node in _items(sections["links"])}
    slides = {}
    if "slides" in sections:
        slides = {name: read_slide(node) for name, node in _items(sections["slides"])}
    assembly = None
    if "assembly" in sections:
        assembly = {name: _sign(node) for name, node in sections["assembly"].table().items()}
    driver = read_driver(sections["driver"])
    with root.refusing(lambda error: key_of(error, root, sections)):
        mechanism = Mechanism(joints, links, driver, slides, assembly)
    if "dimensions" in sections:
        mechanism = with_dimensions(mechanism, sections["dimensions"])
    if "drawn" in sections:
        mechanism = drawn_at(mechanism, sections["drawn"], with_dimensions)
    return mechanism


def _items(section: Node) -> list[tuple[str, Node]]:
    """Return the entries of a section, unless they are too many."""
    entries = section.table()
    if len(entries) > MOST_ITEMS:
        raise section.error(f"has {len(entries)} entries: a file may have {MOST_ITEMS}")
    return list(entries.items())


def _sign(node: Node) -> int:
    sign = node.whole()
    if sign not in (1, -1):
        raise node.error(f"is {node.value}: it must be 1 or -1")
    return sign


def read_slide(node: Node) -> Slide | Cylinder:
    """Return a slide, or a cylinder if it has a base or an end."""
    entries = node.table()
    if "base" in entries or "end" in entries:
        entries = node.keys(CYLINDER, required=CYLINDER[:2])
        return Cylinder(**{key: entry.text() for key, entry in entries.items()})
    entries = node.keys(SLIDE, required=SLIDE[:3])
    given: dict[str, Any] = {key: one.text() for key, one in entries.items() if key != "angle"}
    return Slide(angle=entries["angle"].number(), **given)


def read_driver(node: Node) -> DriverLike | list[DriverLike]:
    """Return the driver, or several."""
    return [_one_driver(one) for one in node.entries()] if _is_list(node) else _one_driver(node)


def _one_driver(node: Node) -> DriverLike:
    if isinstance(node.value, dict):
        entries = node.keys(("link", "relative_to"), required=("link",))
        return Drive(**{key: entry.text() for key, entry in entries.items()})
    if not isinstance(node.value, str):
        raise node.wrong('the name of a link or slide, or { link = "…", relative_to = "…" },')
    return node.text()


def _is_list(node: Node) -> bool:
    return isinstance(node.value, list)


def with_dimensions(mechanism: Mechanism, section: Node) -> Mechanism:
    """Return the mechanism with the dimensions of a file; lists make a batch of designs."""
    nodes: dict[str, Node] = {}
    _flatten("", section, nodes)
    values: dict[str, Float] = {name: node.array(finite=False) for name, node in nodes.items()}

    def locate(error: AssurError) -> KeyPath:
        return nodes[error.dimension].path if error.dimension in nodes else section.path

    with section.refusing(locate):
        return mechanism.with_dimensions(values)


def _flatten(prefix: str, node: Node, into: dict[str, Node]) -> None:
    """Collect dimensions: coupler.length is a table within a table."""
    for key, one in node.table().items():
        name = f"{prefix}.{key}" if prefix else key
        if isinstance(one.value, dict):
            _flatten(name, one, into)
        elif name in into:
            raise one.error(f"dimension {name!r} is given twice")
        else:
            into[name] = one


# -- where an error of the constructor belongs ---------------------------------------------------


def key_of(error: AssurError, root: Node, sections: dict[str, Node]) -> KeyPath:
    """Return the key that an error of the constructor is about."""
    names = [n for n in (error.joint, error.link, error.slide, error.driver) if n is not None]
    tables = {
        what: sections[what].value
        for what in ("joints", "links", "slides", "assembly")
        if what in sections
    }
    if error.kind == "bad_sign" and error.joint in tables.get("assembly", {}):
        return ("assembly", str(error.joint))
    for path, name, kinds in references(root.value):
        if name in names and not any(name in tables.get(kind, {}) for kind in kinds):
            return path
    order = (
        ("slides", error.slide),
        ("links", error.link),
        ("joints", error.joint),
        ("slides", error.link),
        *((what, name) for name in names for what in ("links", "slides", "joints", "assembly")),
    )
    for what, name in order:
        if name is not None and name in tables.get(what, {}):
            return (what, name)
    for cylinder, slide in tables.get("slides", {}).items():
        own = {slide.get("barrel", f"{cylinder}_barrel"), slide.get("rod", f"{cylinder}_rod")}
        if own & set(names):
            return ("slides", cylinder)
    return ("driver",) if error.driver is not None else ("links",)


def references(data: dict[str, Any]) -> list[tuple[KeyPath, str, tuple[str, ...]]]:
    """Return every name that refers to something: its key, and in which sections it should be."""
    found: list[tuple[KeyPath, str, tuple[str, ...]]] = []
    for link, joints in data["links"].items():
        found += [(("links", link, i), joint, ("joints",)) for i, joint in enumerate(joints)]
    made: set[str] = set()
    for name, slide in data.get("slides", {}).items():
        kinds = {"origin": "joints", "base": "joints", "end": "joints"}
        made |= (
            {slide.get(p, f"{name}_{p}") for p in ("barrel", "rod")} if "base" in slide else set()
        )
        for key, value in slide.items():
            if key not in ("angle", "barrel", "rod"):
                found.append((("slides", name, key), value, (kinds.get(key, "links"),)))
    drivers = data["driver"] if isinstance(data["driver"], list) else [data["driver"]]
    for i, driver in enumerate(drivers):
        path: KeyPath = ("driver", i) if isinstance(data["driver"], list) else ("driver",)
        if isinstance(driver, dict):
            found += [((*path, key), value, ("links",)) for key, value in driver.items()]
        else:
            found.append((path, driver, ("links", "slides")))
    # The links of cylinders are in no section.
    return [one for one in found if one[1] not in made]
