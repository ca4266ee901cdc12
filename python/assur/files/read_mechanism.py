"""The mechanism of a file: joints, links, slides, driver, assembly, dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from assur.description.words import Cylinder, Drive, Slide
from assur.files.limits import MOST_ITEMS
from assur.files.locate import key_of
from assur.files.read_drawn import drawn_at
from assur.kinematics.mechanism import Mechanism

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.description.words import DriverLike
    from assur.errors import AssurError
    from assur.files.node import Node
    from assur.files.positions import KeyPath

InputSpeed: TypeAlias = "float | tuple[float, ...] | None"
SLIDE = ("link", "on", "angle", "origin", "along", "length")
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
    with root.refusing(lambda error: key_of(error, root.value)):
        mechanism = Mechanism(joints, links, driver, slides=slides, assembly=assembly)
    sized = mechanism
    if "dimensions" in sections:
        sized = with_dimensions(mechanism, sections["dimensions"])
    if "drawn" in sections:
        return drawn_at(sized, sections["drawn"], lambda node: with_dimensions(mechanism, node))
    return sized


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
    entries = node.keys(SLIDE, required=SLIDE[:2])
    if "angle" not in entries and "along" not in entries:
        raise node.missing("angle", ": a number, rad, or along, two joints, is needed")
    if "angle" in entries and "along" in entries:
        raise node.error("has both angle and along: give one")
    texts = ("link", "on", "origin")
    arguments: dict[str, Any] = {key: entries[key].text() for key in texts if key in entries}
    if "length" in entries:
        arguments["length"] = entries["length"].flag()
    if "angle" in entries:
        return Slide(angle=entries["angle"].number(), **arguments)
    ends = entries["along"].names()
    if len(ends) != 2:
        raise entries["along"].error('needs two joints, ["A", "B"]')
    return Slide(along=(ends[0], ends[1]), **arguments)


def read_driver(node: Node) -> DriverLike | list[DriverLike]:
    """Return the driver, or several."""
    return [_one_driver(entry) for entry in node.entries()] if _is_list(node) else _one_driver(node)


def _one_driver(node: Node) -> DriverLike:
    if isinstance(node.value, dict):
        entries = node.keys(("link", "relative_to"), required=("link",))
        return Drive(**{key: entry.text() for key, entry in entries.items()})
    if not isinstance(node.value, str):
        raise node.wrong('the name of a link or slide, or { link = "…", relative_to = "…" },')
    return node.text()


def read_input_speed(root: Node, mechanism: Mechanism) -> InputSpeed:
    """Return the speed of the driver that a file gives, or of all drivers; None without one."""
    node = root.table().get("input_speed")
    if node is None:
        return None
    count = mechanism.driver_count
    if count == 1:
        return node.number()
    speeds = tuple(entry.number() for entry in node.entries(f"a list of {count} numbers"))
    if len(speeds) != count:
        message = f"has {len(speeds)} entries: a number for each of the {count} drivers is needed"
        raise node.error(message)
    return speeds


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
    for key, child in node.table().items():
        name = f"{prefix}.{key}" if prefix else key
        if isinstance(child.value, dict):
            _flatten(name, child, into)
        elif name in into:
            raise child.error(f"dimension {name!r} is given twice")
        else:
            into[name] = child
