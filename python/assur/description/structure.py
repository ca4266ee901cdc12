"""The structure of a mechanism: mobility and Assur groups."""

from __future__ import annotations

from dataclasses import dataclass

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
    """

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
    adjustment : float
        Greatest distance by which joints of the drawing were moved to make the
        redundant links fit, m; 0 if they fit as drawn.
    """

    mobility: int
    mobility_at_drawing: int
    mobility_counted: int
    cls: int
    formula: str
    groups: tuple[Group, ...]
    redundant: tuple[str, ...]
    adjustment: float = 0.0
