"""Remedies, which errors offer: what would make a mechanism of a description that is refused."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    # For types alone (`FOR_TYPES` of tools/check_floors).
    from assur.description.words import Cylinder, DriverLike, Slide

__all__ = ["Remedy"]


class Arguments(TypedDict):
    """What `Mechanism` takes."""

    joints: dict[str, tuple[float, float]]
    links: dict[str, tuple[str, ...]]
    slides: dict[str, Slide | Cylinder]
    driver: DriverLike | list[DriverLike]
    assembly: dict[str, int]


@dataclass(frozen=True, repr=False)
class Remedy:
    """A change of a linkage that is refused, after which it is a mechanism.

    ``StructureError.remedies`` has up to three. Each was built before it is offered: it has as many
    drivers as degrees of freedom, and is not drawn at a dead point.

    Attributes
    ----------
    text : str
        What to do, ``"Let F slide on the ground"``.
    detail : str
        What becomes of the rest, ``"brace stays, its foot follows"``.
    kind : str
        ``"let_slide"``, ``"take_out"``, ``"part"`` (a link in two), ``"join"`` (by a new link),
        ``"hold"`` (on the ground), ``"unite"`` (two links), ``"drive"``, ``"leave_undriven"`` or
        ``"place"`` (a joint on a link, or a guide).
    names : tuple of str
        The joints, links and slides concerned.

    Examples
    --------
    A four-bar that a brace holds:

    >>> import assur
    >>> joints = {"A": (0, 0), "B": (1, 3), "C": (9, 6), "D": (10, 0), "E": (5, 3), "F": (6, 0)}
    >>> links = {"crank": "AB", "coupler": "BCE", "rocker": "CD", "brace": "EF", "ground": "ADF"}
    >>> try:
    ...     assur.Mechanism(joints, links, driver="crank")
    ... except assur.StructureError as error:
    ...     remedies = error.remedies
    >>> for remedy in remedies:
    ...     print(remedy)
    Let F slide on the ground: brace stays, its foot follows
    Take out brace: crank, coupler and rocker remain
    Add a link between E and brace: two links in place of one
    >>> assur.Mechanism(**remedies[1].arguments)
    <assur.Mechanism I(crank) → II(coupler, rocker)>
    """

    text: str
    detail: str
    kind: str
    names: tuple[str, ...]
    # Slides and drivers as `Mechanism` takes them.
    _joints: tuple[tuple[str, float, float], ...]
    _links: tuple[tuple[str, tuple[str, ...]], ...]
    _slides: tuple[tuple[str, Slide | Cylinder], ...]
    _drivers: tuple[DriverLike, ...]
    _assembly: tuple[tuple[str, int], ...]

    def __repr__(self) -> str:
        return f"<assur.Remedy {self.text}>"

    def __str__(self) -> str:
        return f"{self.text}: {self.detail}"

    @property
    def arguments(self) -> Arguments:
        """Arguments of `Mechanism` with the change made, from joints to assembly."""
        return {
            "joints": {name: (x, y) for name, x, y in self._joints},
            "links": dict(self._links),
            "slides": dict(self._slides),
            "driver": self._drivers[0] if len(self._drivers) == 1 else list(self._drivers),
            "assembly": dict(self._assembly),
        }
