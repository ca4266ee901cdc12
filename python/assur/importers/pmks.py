"""PMKS: lines of text, addresses of its page with such lines, and ``.pmks`` files (JSON)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.importers.build import finish
from assur.importers.pmks_json import read_json
from assur.importers.pmks_text import read_text
from assur.importers.sketch import Sketch
from assur.importers.source import open_source

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur.importers.build import Imported
    from assur.importers.source import SourceLike

__all__ = ["read"]


def read(
    source: SourceLike, *, scale: float = 1.0, assembly: Mapping[str, int] | None = None
) -> Imported:
    """Read a linkage of PMKS.

    Parameters
    ----------
    source : str or path-like
        A file, or its text; an address of PMKS with ``mech=``.
    scale : float
        The file's unit of length, m.
    assembly : mapping of str to int, optional
        For dyads drawn with their links collinear: see `Mechanism`.

    Returns
    -------
    Imported
        Joints are J1, J2 and so on, in the order of the file.

    Raises
    ------
    InputError
        Text that is not in this format, with its line; gears.
    StructureError
        A linkage that is not a mechanism.

    Examples
    --------
    >>> from assur import importers
    >>> found = importers.pmks.read('''
    ... ground crank R 0 0 0 ffft
    ... crank rod R 0 1
    ... rod block R 3 0
    ... ground block P 3 0 0
    ... ''')
    >>> found.mechanism.structure.formula
    'I(crank) → II(rod, block)'
    """
    opened = open_source(source)
    sketch = Sketch()
    is_json = opened.text.lstrip().startswith("{")
    read_json(opened, sketch) if is_json else read_text(opened, sketch)
    return finish(opened, sketch, "pmks", scale, assembly)
