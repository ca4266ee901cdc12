"""Linkage (by David Rector): ``.linkage2`` files (XML).

connector
    id, name, x, y, anchor, input with rpm, slider with two ``slidelimit``, slideradius, fasten
Link
    id, name, its connectors, actuator with throw and cpm, gear, fasten
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from assur._arrays import short
from assur._trig import arctan2
from assur._validate import real_number
from assur.importers.build import finish
from assur.importers.names import listed
from assur.importers.sketch import GROUND, Input, Sketch
from assur.importers.source import open_source
from assur.importers.xml_text import Element, parse_xml

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur.importers.build import Imported
    from assur.importers.source import Source, SourceLike

__all__ = ["read"]

# The layer of mechanisms; others hold labels and lines.
MECHANISM = 16
RPM = math.tau / 60.0
# Its unit of length, m: 96 of them are an inch, in which it can show lengths as in millimetres.
UNIT = 0.0254 / 96.0


def read(
    source: SourceLike, *, scale: float | None = None, assembly: Mapping[str, int] | None = None
) -> Imported:
    """Read a linkage of Linkage.

    Parameters
    ----------
    source : str or path-like
        A file, or its text.
    scale : float, optional
        The file's unit of length, m: by default 1/96 inch, the same for all units that the program
        shows.
    assembly : mapping of str to int, optional
        For dyads drawn with their links collinear: see `Mechanism`.

    Returns
    -------
    Imported
        Joints and links have their names, or c and L with their number. An actuator is a cylinder.
        Positive rpm is clockwise in Linkage, so the speed is negative.

    Raises
    ------
    InputError
        Text that is not in this format, with its line; gears, curved slots.
    StructureError
        A linkage that is not a mechanism.

    Examples
    --------
    >>> from assur import importers
    >>> found = importers.linkage2.read('''<linkage2>
    ... <connector id="0" x="0" y="0" anchor="true" input="true" rpm="15"/>
    ... <connector id="1" x="0" y="10"/>
    ... <connector id="2" x="30" y="20"/>
    ... <connector id="3" x="40" y="0" anchor="true"/>
    ... <Link id="0"><connector id="0"/><connector id="1"/></Link>
    ... <Link id="1"><connector id="1"/><connector id="2"/></Link>
    ... <Link id="2"><connector id="2"/><connector id="3"/></Link>
    ... </linkage2>''')
    >>> found.mechanism.structure.formula
    'I(L0) → II(L1, L2)'
    """
    opened = open_source(source)
    root = parse_xml(opened)
    if root.tag != "linkage2":
        raise opened.error(root.place, f"<{root.tag[:40]}> is not <linkage2>")
    return _Reader(opened, root).read(scale, assembly)


class _Reader:
    """One file."""

    def __init__(self, source: Source, root: Element) -> None:
        self._source, self._root = source, root
        self._scale = 1.0
        self._sketch = Sketch()
        self._connectors: dict[str, Element] = {}
        # Joints by the ids of connectors, links by those of links.
        self._joints: dict[str, str] = {}
        self._links: dict[str, str] = {}

    def read(self, scale: float | None, assembly: Mapping[str, int] | None) -> Imported:
        """Make the mechanism."""
        self._scale = UNIT if scale is None else real_number(scale, "scale")
        connectors = [element for element in self._root.children if element.tag == "connector"]
        links = [element for element in self._root.children if element.tag in ("Link", "element")]
        self._source.require_few(len(connectors))
        self._source.require_few(len(links), "links")
        for connector in connectors:
            self._add_connector(connector)
        decoration = [self._add_link(link) for link in links]
        drawn = [name for name in decoration if name]
        if drawn:
            self._sketch.omitted.append(f"Drawing {listed(drawn)} is left out.")
        for element in (*connectors, *links):
            self._fasten(element)
        for identifier, connector in self._connectors.items():
            if connector.is_true("slider"):
                self._add_slider(identifier, connector)
        for identifier, connector in self._connectors.items():
            if connector.is_true("input"):
                self._add_input(identifier, connector)
        self._refuse_gears()
        if scale is None:
            self._say_scale_factor()
        return finish(self._source, self._sketch, "linkage2", self._scale, assembly)

    def _add_connector(self, connector: Element) -> None:
        identifier = self._id(connector)
        if not _is_mechanism(connector):
            return
        if identifier in self._connectors:
            raise self._source.error(connector.place, f"a second connector {identifier}")
        self._connectors[identifier] = connector
        name = self._name(connector, f"c{identifier}", self._sketch.joints)
        self._joints[identifier] = name
        x, y = (
            self._source.number(connector.attributes.get(what), connector.place, what)
            for what in "xy"
        )
        self._sketch.joints[name] = (x, y)
        if connector.is_true("anchor"):
            self._sketch.connect(name, GROUND)

    def _add_link(self, element: Element) -> str:
        """Add a link; return its name if it only decorates."""
        identifier = self._id(element)
        members = [c for c in map(self._id, element.named("connector")) if c in self._joints]
        name = self._name(
            element, f"L{identifier}", {**self._sketch.links, **self._sketch.cylinders}
        )
        if not _is_mechanism(element) or element.is_true("measurementelement"):
            return name
        self._links.setdefault(identifier, name)
        joints = list(dict.fromkeys(self._joints[member] for member in members))
        if not element.is_true("actuator"):
            self._sketch.links[name] = joints
            return ""
        if len(joints) != 2:
            problem = f"actuator {name} has {len(joints)} connectors: two are needed"
            raise self._source.error(element.place, problem, link=name)
        self._sketch.cylinders[name] = (joints[0], joints[1])
        stroke, cycles = (
            self._source.number(element.attributes.get(what, "0"), element.place, what)
            for what in ("throw", "cpm")
        )
        # Forth and back a cycle.
        speed = 2.0 * stroke * cycles / 60.0 or None
        self._sketch.inputs.append(Input(element.place, slide=name, speed=speed))
        throw = f"{stroke * self._scale:g} m"
        self._sketch.omitted.append(f"The throw {throw} of actuator {name} is not a limit here.")
        return ""

    def _fasten(self, element: Element) -> None:
        """Weld what is fastened: a connector or a link to a link."""
        attributes = element.attributes
        to = attributes.get("fastenlink") or attributes.get("fasten")
        identifier = element.attributes.get("id", "").strip()
        is_link = element.tag != "connector"
        if to and to.strip() in self._links:
            link = self._links[to.strip()]
            mine = self._links.get(identifier) if is_link else self._joints.get(identifier)
            if mine is None or link not in self._sketch.links:
                return
            if is_link and mine in self._sketch.links:
                self._sketch.welds.append(("", [link, mine]))
            elif not is_link:
                self._sketch.connect(mine, link)
        elif attributes.get("fastenconnector") and is_link and identifier in self._links:
            problem = (
                f"link {self._links[identifier]} is fastened to a connector: fasten it to a link"
            )
            raise self._source.error(element.place, problem, link=self._links[identifier])

    def _add_slider(self, identifier: str, connector: Element) -> None:
        name = self._joints[identifier]
        text = connector.attributes.get("slideradius", "0")
        radius = self._source.number(text, connector.place, "slideradius")
        if radius != 0.0:
            problem = f"joint {name} slides in a curved slot: only straight ones can be described"
            raise self._source.error(connector.place, problem, joint=name, value=radius)
        ends = [self._joints.get(self._id(limit), "") for limit in connector.named("slidelimit")][
            :2
        ]
        if len(ends) < 2 or "" in ends or ends[0] == ends[1]:
            self._sketch.omitted.append(f"Slider {name} has no two limits: it is a pin.")
            return
        links = self._sketch.links
        both = [link for link in links if set(ends) <= set(links[link])]
        if not both:
            problem = f"joint {name} slides between {listed(ends)}, which are on different links"
            raise self._source.error(connector.place, problem, joint=name)
        carrier = GROUND if GROUND in both else both[0]
        (x, y), (u, v) = (self._sketch.joints[end] for end in ends)
        if (x, y) == (u, v) or name in links[carrier]:
            problem = f"joint {name} cannot slide between {listed(ends)}"
            raise self._source.error(connector.place, problem, joint=name)
        self._sketch.omitted.append(
            f"The ends {listed(ends)} of the slot of {name} are not limits here."
        )
        riders = self._sketch.links_at(name)
        self._sketch.add_slot(name, carrier, riders, float(arctan2(v - y, u - x)), turns=True)

    def _add_input(self, identifier: str, connector: Element) -> None:
        name = self._joints[identifier]
        links = [link for link in self._sketch.links_at(name) if link != GROUND]
        if not links:
            self._sketch.omitted.append(f"Input {name} has no link: left out.")
            return
        if not connector.is_true("anchor"):
            problem = f"input {name} is not an anchor: Linkage turns links about anchors only"
            raise self._source.error(connector.place, problem, joint=name)
        rpm = self._source.number(connector.attributes.get("rpm", "15"), connector.place, "rpm")
        # Clockwise; 0 stays +0.
        speed = 0.0 - rpm * RPM
        self._sketch.inputs.append(Input(connector.place, joint=name, base=GROUND, speed=speed))
        if connector.attributes.get("limitangle", "0").strip("0. "):
            self._sketch.omitted.append(f"Input {name} turns to and fro: its limit is left out.")

    def _refuse_gears(self) -> None:
        for ratios in self._root.named("ratios"):
            for ratio in ratios.named("ratio"):
                pair = [self._links.get(self._id(link), "") for link in ratio.named("link")]
                if len(pair) > 1 and all(pair):
                    kind = ratio.attributes.get("type", "gears")[:20]
                    problem = f"links {listed(pair)} are joined by {kind}: they cannot be described"
                    raise self._source.error(ratio.place, problem, link=pair[0])

    def _say_scale_factor(self) -> None:
        """Say that lengths are those of the drawing, not of a model to another scale."""
        for program in self._root.named("program"):
            text = program.attributes.get("scalefactor", "1")
            factor = self._source.number(text, program.place, "scalefactor")
            if factor != 1.0:
                self._sketch.omitted.append(f"The scale factor {factor:g} is left out.")

    def _name(self, element: Element, plain: str, taken: object) -> str:
        """Return the given name, or the letter and number, once."""
        wanted_name = element.attributes.get("name", "").strip()
        names = set(taken) if isinstance(taken, dict) else set()
        unique, count = wanted_name or plain, 1
        while unique in names:
            count += 1
            unique = f"{wanted_name or plain}_{count}"
        return unique

    def _id(self, element: Element) -> str:
        identifier = element.attributes.get("id", "").strip()
        if not identifier.isascii() or not identifier.isdigit() or len(identifier) > 9:
            problem = (
                f"<{element.tag[:40]}> has the id {short(identifier)}: a whole number is needed"
            )
            raise self._source.error(element.place, problem)
        return str(int(identifier))


def _is_mechanism(element: Element) -> bool:
    layer = element.attributes.get("layer", "0").strip()
    if not layer.isascii() or not layer.isdigit() or len(layer) > 12:
        return True
    return int(layer) == 0 or bool(int(layer) & MECHANISM)
