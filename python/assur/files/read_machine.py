"""The machine of a file: bodies, loads, motor, friction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur.dynamics.loads.friction import JointFriction, SlideFriction
from assur.dynamics.loads.loads import Body
from assur.dynamics.machine import Machine
from assur.errors import AssurError
from assur.files.limits import MOST_ITEMS
from assur.files.parts import BODY, FRICTIONS, LOADS, MOTORS, build

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur.files.node import Node
    from assur.files.parts import Words
    from assur.files.positions import KeyPath
    from assur.kinematics.mechanism import Mechanism

SECTIONS = ("bodies", "loads", "motor", "friction")
# The type of a motor where one of several drivers has none.
NO_MOTOR = "None"


def read_machine(root: Node, mechanism: Mechanism) -> Machine | None:
    """Return the machine of a file, if it has any of a machine's sections."""
    sections = {key: node for key, node in root.table().items() if key in SECTIONS}
    if not sections:
        return None
    parts: dict[str, Any] = {}
    if "bodies" in sections:
        bodies = sections["bodies"].table()
        parts["bodies"] = {link: build(Body, BODY, node) for link, node in bodies.items()}
    if "loads" in sections:
        loads = sections["loads"].entries("a list, [[loads]],")
        if len(loads) > MOST_ITEMS:
            message = f"has {len(loads)} entries: a file may have {MOST_ITEMS}"
            raise sections["loads"].error(message)
        parts["loads"] = [_typed(node, LOADS) for node in loads]
    if "motor" in sections:
        parts["motor"] = _motors(sections["motor"])
    if "friction" in sections:
        pairs = sections["friction"].table()
        parts["friction"] = {name: _friction(node, mechanism) for name, node in pairs.items()}
    with root.refusing(lambda error: _culprit(mechanism, parts, error)):
        return Machine(mechanism, **parts)


def _typed(node: Node, known: dict[type, Words]) -> Any:
    """Return an object of the class that its type names."""
    entries = node.table()
    classes = {cls.__name__: cls for cls in known}
    if "type" not in entries:
        raise node.missing("type", f": one of {', '.join(classes)} is needed")
    cls = classes[entries["type"].word(classes)]
    return build(cls, known[cls], node, besides=("type",))


def _motors(node: Node) -> Any:
    """Return a motor, or those of several drivers."""
    if not isinstance(node.value, list):
        return _typed(node, MOTORS)
    return [
        None if entry.value == {"type": NO_MOTOR} else _typed(entry, MOTORS)
        for entry in node.entries()
    ]


def _friction(node: Node, mechanism: Mechanism) -> JointFriction | SlideFriction:
    cls = SlideFriction if node.path[-1] in mechanism.slides else JointFriction
    made: JointFriction | SlideFriction = build(cls, FRICTIONS[cls], node)
    return made


def _culprit(mechanism: Mechanism, parts: dict[str, Any], error: AssurError) -> KeyPath:
    """Return the key of the part that is refused even without the others."""
    for path, part in _single(parts):
        if _refusal(mechanism, part) == str(error):
            return path
    return (next(iter(parts)),)


def _refusal(mechanism: Mechanism, part: dict[str, Any]) -> str | None:
    try:
        Machine(mechanism, **part)
    except AssurError as error:
        return str(error)
    return None


def _single(parts: dict[str, Any]) -> Iterator[tuple[KeyPath, dict[str, Any]]]:
    for section in ("bodies", "friction"):
        for name, part in parts.get(section, {}).items():
            yield (section, name), {section: {name: part}}
    for i, load in enumerate(parts.get("loads", [])):
        yield ("loads", i), {"loads": [load]}
    if "motor" in parts:
        yield ("motor",), {"motor": parts["motor"]}
