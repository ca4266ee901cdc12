"""Linkages of other programs: PMKS, PMKS+, pylinkage, pyslvs, Linkage.

>>> from assur import importers
>>> found = importers.read('''
... ground crank R 0 0 0 ffft
... crank rod R 0 1
... rod block R 3 0
... ground block P 3 0 0
... ''')
>>> found.format, found.mechanism.structure.formula
('pmks', 'I(crank) → II(rod, block)')
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from assur._arrays import short
from assur._files import checked_path
from assur._validate import one_of
from assur.errors import InputError
from assur.importers import (
    linkage2,
    pmks,
    pmks_plus,
    pmks_plus_older,
    pmks_plus_records,
    pmks_text,
    pylinkage,
    pyslvs,
    pyslvs_expression,
)
from assur.importers.build import Imported
from assur.importers.json_text import has_numbers_as_ids
from assur.importers.source import ENDINGS, open_source

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence

    from assur.importers.source import SourceLike

__all__ = [
    "FORMATS",
    "Imported",
    "detect",
    "linkage2",
    "pmks",
    "pmks_plus",
    "pylinkage",
    "pyslvs",
    "read",
]

FORMATS = ("pmks", "pmks_plus", "pylinkage", "pyslvs", "linkage2")


def read(
    source: SourceLike,
    *,
    format: str | None = None,  # noqa: A002
    scale: float | None = None,
    drivers: Sequence[tuple[int, int]] | None = None,
    assembly: Mapping[str, int] | None = None,
) -> Imported:
    """Read a linkage of another program.

    Parameters
    ----------
    source : str or path-like
        A file, a text or an address.
    format : str, optional
        One of ``FORMATS``; by default found from the text.
    scale : float, optional
        The file's unit of length, m. By default coordinates are read as they stand, and those of
        Linkage in its unit, 1/96 inch.
    drivers : sequence of (int, int), optional
        The drivers of an expression of pyslvs: see ``pyslvs.read``.
    assembly : mapping of str to int, optional
        For dyads drawn with their links collinear: see `Mechanism`.

    Returns
    -------
    Imported
        The mechanism, and what does not carry over.

    Raises
    ------
    InputError
        A file that cannot be read, with its line or part; what cannot be described.
    StructureError
        A linkage that is not a mechanism.

    Examples
    --------
    >>> from assur import importers
    >>> found = importers.read(
    ...     "M[J[R, P[0, 0], L[ground, crank]], J[R, P[0, 1], L[crank, rod]], "
    ...     "J[RP, A[0], P[3, 0], L[ground, rod]]]", drivers=[(0, 1)])
    >>> found.format, found.mechanism.driver
    ('pyslvs', 'crank')
    """
    opened = open_source(source)
    kind = detect(opened.name, opened.text) if format is None else format
    if kind is None:
        known = ", ".join(FORMATS)
        raise opened.error("", f"the text is of no known format: {known} are read")
    one_of(kind, FORMATS, "format")
    if kind == "linkage2" and drivers is None:
        return linkage2.read(opened, scale=scale, assembly=assembly)
    unit = 1.0 if scale is None else scale
    if kind == "pyslvs":
        pairs = () if drivers is None else drivers
        return pyslvs.read(opened, drivers=pairs, scale=unit, assembly=assembly)
    if drivers is not None:
        raise opened.error("", f"drivers are for pyslvs: a file of {kind} names its own")
    readers = {
        "pmks": pmks.read,
        "pmks_plus": pmks_plus.read,
        "pylinkage": pylinkage.read,
    }
    return readers[kind](opened, scale=unit, assembly=assembly)


def detect(path: str | os.PathLike[str] | None, text: str) -> str | None:
    """Return the format of a text, or None.

    Parameters
    ----------
    path : str, path-like or None
        The file it is from; an ending of one program decides.
    text : str
        The text.

    Returns
    -------
    str or None
        One of ``FORMATS``.

    Examples
    --------
    >>> from assur import importers
    >>> importers.detect("press.linkage2", ""), importers.detect(None, "Hello")
    ('linkage2', None)
    """
    ending = "" if path is None else checked_path(path).suffix.lower()
    content: object = text
    if not isinstance(content, str):
        message = f"text is {short(text)}: the text of a file is needed"
        raise InputError(message)
    if ENDINGS.get(ending):
        return ENDINGS[ending]
    start = text.lstrip("\ufeff \t\r\n")
    if start.startswith("{"):
        if '"Joints"' in text:
            return "pmks"
        return "pylinkage" if '"joints"' in text and not has_numbers_as_ids(text) else None
    if re.search(r"<linkage2\b", start[:10_000]):
        return "linkage2"
    if pyslvs_expression.is_text(start):
        return "pyslvs"
    if pmks_plus_older.is_text(start) or pmks_plus_records.is_text(start):
        return "pmks_plus"
    return "pmks" if pmks_text.is_text(start) else None
