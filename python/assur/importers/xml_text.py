"""XML within limits, by the parser of the standard library (expat).

A document type is refused where it begins, before any entity: without one there is nothing that
could be expanded, neither a file from elsewhere nor a text of many times the size.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING
from xml.parsers import expat

if TYPE_CHECKING:
    from assur.importers.source import Source

# A file of Linkage nests four elements.
DEEPEST = 16
MOST_ELEMENTS = 20_000
# Some files lack the blank between attributes, or have a bare &.
NO_BLANK = re.compile(r'(="[^"<>]*")(?=[A-Za-z])')
BARE_AND = re.compile(r"&(?!(?:amp|lt|gt|quot|apos|#[0-9]{1,7}|#x[0-9A-Fa-f]{1,6});)")


@dataclass
class Element:
    """An element with its line."""

    tag: str
    attributes: dict[str, str]
    line: int
    children: list[Element] = field(default_factory=list)

    @property
    def place(self) -> str:
        """The line, for messages."""
        return f"line {self.line}"

    def named(self, tag: str) -> list[Element]:
        """Return the children of one tag."""
        return [child for child in self.children if child.tag == tag]

    def is_true(self, key: str) -> bool:
        """Whether an attribute is "true"."""
        return self.attributes.get(key) == "true"


def parse_xml(source: Source) -> Element:
    """Return the root of a document."""
    text = BARE_AND.sub("&amp;", NO_BLANK.sub(r"\1 ", source.text))
    # The text is decoded: what it says of its encoding no longer holds.
    declared = re.match(r"\s*<\?xml[^>]{0,200}\?>", text)
    if declared:
        text = "\n" * declared[0].count("\n") + text[declared.end() :]
    root = Element("", {}, 0)
    open_elements = [root]
    parser = expat.ParserCreate("utf-8")
    count = 0

    def place() -> str:
        return f"line {parser.CurrentLineNumber}"

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal count
        count += 1
        if len(open_elements) > DEEPEST:
            raise source.error(place(), f"elements are nested more than {DEEPEST} deep")
        if count > MOST_ELEMENTS:
            raise source.error(place(), f"more than {MOST_ELEMENTS} elements")
        element = Element(tag, attributes, parser.CurrentLineNumber)
        open_elements[-1].children.append(element)
        open_elements.append(element)

    def end(_tag: str) -> None:
        open_elements.pop()

    def doctype(*_: object) -> None:
        raise source.error(place(), "a document type (<!DOCTYPE) is not read")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.StartDoctypeDeclHandler = doctype
    parser.EntityDeclHandler = doctype
    try:
        parser.Parse(text.encode("utf-8", "replace"), True)
    except expat.ExpatError as error:
        problem = f"this is not XML: {expat.ErrorString(error.code)}"
        raise source.error(f"line {error.lineno}", problem) from error
    return root.children[0]
