"""The structure of a mechanism: mobility and Assur groups."""

from __future__ import annotations

from dataclasses import dataclass
from textwrap import fill

from assur._summary import FORMULA, shortened, summary

__all__ = ["Group", "Structure"]


@dataclass(frozen=True)
class Group:
    """An Assur group.

    Attributes
    ----------
    cls : int
        Its class by Artobolevsky: 2 for a dyad, 3, 4 … for higher groups.
    order : int
        Number of external pairs.
    kind : str or None
        ``"RRR"``, ``"RRP"``, ``"RPR"``, ``"PRP"`` or ``"RPP"`` for a dyad.
    artobolevsky_kind : int or None
        The same kinds, numbered 1 to 5.
    links : tuple of str
        Its links.
    joints, slides : tuple of str
        The joints and slides of its pairs, inner and outer.

    Examples
    --------
    >>> import assur
    >>> group = assur.SliderCrank(1.0, 3.0).structure.groups[0]
    >>> group.cls, group.order, group.kind, group.links
    (2, 2, 'RRP', ('rod', 'piston'))
    """

    __repr__ = summary

    cls: int
    order: int
    kind: str | None
    artobolevsky_kind: int | None
    links: tuple[str, ...]
    joints: tuple[str, ...]
    slides: tuple[str, ...]


@dataclass(frozen=True)
class Structure:
    """The structure of a mechanism with its drivers.

    Attributes
    ----------
    mobility : int
        Degrees of freedom, by the rank of the closure equations at a regular
        position.
    mobility_at_drawing : int
        The same at the drawing; greater if the drawing is singular.
    mobility_counted : int
        ``3 n - 2 p``, the formula of Chebyshev and Grübler.
    cls : int
        Class of the mechanism: the highest class of its groups.
    formula : str
        The structural formula.
    groups : tuple of Group
        Assur groups in solving order.
    redundant : tuple of str
        Links and slides without which it moves the same; their closure is
        checked at every position.
    moving_links, turning_pairs, sliding_pairs : int
        The counts in that formula: n, and p = turning + sliding. A joint of k links counts as k − 1
        turning pairs.
    adjustment : float
        The most by which a coordinate of a joint in the drawing was moved to make the redundant
        links fit, m; 0 if they fit as drawn.

    Examples
    --------
    >>> import assur
    >>> print(assur.SliderCrank(1.0, 3.0).structure)
    I(crank) → II(rod, piston), class II
    mobility 3n − 2p = 3·3 − 2·4 = 1  (n = 3 moving links, p = 3 turning + 1 sliding pairs)
    group            class  order  kind  links        pairs
    II(rod, piston)  II     2      RRP   rod, piston  A, B, bore
    """

    mobility: int
    mobility_at_drawing: int
    mobility_counted: int
    cls: int
    formula: str
    groups: tuple[Group, ...]
    redundant: tuple[str, ...]
    moving_links: int
    turning_pairs: int
    sliding_pairs: int
    adjustment: float = 0.0

    def __repr__(self) -> str:
        formula = shortened(self.formula, FORMULA)
        return f"<assur.Structure {formula}, class {roman(self.cls)}, mobility {self.mobility}>"

    def __str__(self) -> str:
        n, turning, sliding = self.moving_links, self.turning_pairs, self.sliding_pairs
        p = turning + sliding
        pairs = f"p = {turning} turning + {sliding} sliding pairs"
        counted = f"3n − 2p = 3·{n} − 2·{p} = {self.mobility_counted}"
        lines = [
            fill(f"{self.formula}, class {roman(self.cls)}", 120, subsequent_indent="  "),
            f"mobility {counted}  (n = {n} moving links, {pairs})",
        ]
        if self.mobility != self.mobility_counted:
            lines.append(f"by the rank of the closures it is {self.mobility}")
        if self.mobility_at_drawing != self.mobility:
            lines.append(f"at the drawing, which is singular, {self.mobility_at_drawing}")
        if self.redundant:
            lines.append(f"redundant: {', '.join(self.redundant)}")
        if self.adjustment:
            lines.append(f"for them joints are moved by up to {self.adjustment:.2g} m")
        rows = [("group", "class", "order", "kind", "links", "pairs")]
        for group in self.groups:
            links = ", ".join(group.links)
            pairs = ", ".join((*group.joints, *group.slides))
            cls, kind = roman(group.cls), group.kind or ""
            rows.append((f"{cls}({links})", cls, str(group.order), kind, links, pairs))
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        for row in rows if self.groups else ():
            cells = [cell.ljust(width) for cell, width in zip(row, widths, strict=True)]
            lines.append("  ".join(cells).rstrip())
        return "\n".join(lines)


def roman(number: int) -> str:
    """Return a class as a Roman numeral."""
    text = ""
    for value, letters in ((10, "X"), (9, "IX"), (5, "V"), (4, "IV"), (1, "I")):
        count, number = divmod(number, value)
        text += letters * count
    return text
