"""Documents: mechanisms and machines as JSON, in the words of files.

A document is the tree of a TOML file of assur (docs/reference/files.md) without ``format`` and
without the results that a file may ask for; its dimensions have dotted names, ``"coupler.length"``.
"""

from __future__ import annotations

import json
from collections import OrderedDict
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from assur.files.contents import FORMAT, Contents, contents_of
from assur.files.node import Node
from assur.files.read_machine import SECTIONS
from assur.files.tree import Tree
from assur.files.write import text_of, tree_of
from assur.studio.limits import MOST_JOINTS, MOST_LINKS

if TYPE_CHECKING:
    from assur.dynamics.machine import Machine
    from assur.kinematics.mechanism import Mechanism

# Mechanisms of the documents that were read last: a page asks much of each.
MOST_KNOWN = 8
_KNOWN: OrderedDict[str, Mechanism] = OrderedDict()

# What a document has beside its geometry.
BESIDE = ("input_speed", *SECTIONS)
KEYS = ("driver", "joints", "links", "slides", "assembly", "dimensions", "drawn", *BESIDE)
COUNTED = {"joints": MOST_JOINTS, **dict.fromkeys(("links", "slides", "loads"), MOST_LINKS)}


def read(data: Any) -> Contents:
    """Return the mechanism of a document, and its machine if it has one.

    Raises
    ------
    FileError
        The fault, with its key in the document.
    """
    node = checked(data)
    contents = contents_of(Tree({"format": FORMAT, **node.value}))
    if contents.mechanism.shape:
        raise node.error("dimensions: the studio shows one design, not a list of them")
    return contents


def read_mechanism(data: Any) -> Mechanism:
    """Return the mechanism of a document; its masses and loads are not looked at."""
    geometry = _geometry(data)
    text = json.dumps(geometry)
    known = _KNOWN.get(text)
    if known is None:
        known = read(geometry).mechanism
        _remember(text, known)
    return known


def remember(data: dict[str, Any], mechanism: Mechanism) -> None:
    """Keep the mechanism of a document made from it: the page asks for it next."""
    _remember(json.dumps(_geometry(data)), mechanism)


def _geometry(data: Any) -> dict[str, Any]:
    return {key: value for key, value in checked(data).value.items() if key not in BESIDE}


def _remember(text: str, mechanism: Mechanism) -> None:
    _KNOWN[text] = mechanism
    while len(_KNOWN) > MOST_KNOWN:
        # Another thread may have been here between.
        with suppress(KeyError):
            _KNOWN.popitem(last=False)


def read_machine(data: Any) -> Machine:
    """Return the machine of a document."""
    contents = read(data)
    if contents.machine is None:
        message = "it has no masses or loads yet: give bodies, loads or a motor"
        raise Node(Tree({}), (), data).error(message, kind="no_machine")
    return contents.machine


def checked(data: Any) -> Node:
    """Return a document as a node: a table with known keys and not too many entries."""
    node = Node(Tree(data if isinstance(data, dict) else {}), (), data)
    entries = node.keys(KEYS)
    for key, most in COUNTED.items():
        value = entries[key].value if key in entries else ()
        if isinstance(value, dict | list) and len(value) > most:
            message = f"has {len(value)} entries: the studio takes {most}"
            raise entries[key].error(message, kind="too_many")
    return node


def document_of(what: Mechanism | Machine | Contents) -> dict[str, Any]:
    """Return the document of a mechanism, a machine, or of what a file holds."""
    data = tree_of(what)
    return {key: data[key] for key in KEYS if key in data}


def toml_of(data: Any) -> str:
    """Return a document as the text of a file."""
    return text_of(read(data))


def flat(table: dict[str, Any], prefix: str = "") -> list[tuple[str, Any]]:
    """Return the entries of nested tables with dotted names."""
    entries: list[tuple[str, Any]] = []
    for key, value in table.items():
        name = f"{prefix}.{key}" if prefix else key
        entries += flat(value, name) if isinstance(value, dict) else [(name, value)]
    return entries
