"""Write mechanisms and machines: as a tree of plain values, and that to files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur._files import reason, shown_path
from assur.errors import InputError
from assur.files.contents import FORMAT, Contents
from assur.files.errors import FileError, file_name
from assur.files.limits import MOST_BYTES, MOST_ITEMS
from assur.files.toml import tree_text
from assur.files.write_machine import machine_tree, wanted_tree
from assur.files.write_mechanism import driver_value, mechanism_tree
from assur.kinematics.mechanism import Mechanism

if TYPE_CHECKING:
    from os import PathLike

    from assur.dynamics.model import MachineModel

__all__ = ["save"]

# Keys of a file that stand before its sections.
HEAD = ("format", "driver", "input_speed")


def save(what: Mechanism | MachineModel | Contents, path: str | PathLike[str]) -> None:
    """Write a mechanism, a machine, or both with the requested results, to a TOML file.

    Parameters
    ----------
    what : Mechanism, Machine or Contents
        What to save; `Mechanism.save` and `Machine.save` call this.
    path : path-like
        The file; one that exists is replaced.

    Raises
    ------
    InputError
        A load or motor that is a function, a machine of a table, a batch without designs, more
        designs than a file holds.
    FileError
        A file that cannot be written.

    Examples
    --------
    >>> import assur, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "engine.toml"
    >>> turn = {"deg": assur.files.Range(0.0, 360.0, step=1.0), "outputs": ["B"]}
    >>> contents = assur.files.Contents(assur.SliderCrank(0.05, 0.2), wanted={"solve": turn})
    >>> assur.files.save(contents, path)
    >>> assur.files.read(path).result("solve").joint("B").value.shape
    (361, 2)
    """
    raw = text_of(what).encode()
    if len(raw) > MOST_BYTES:
        message = (
            f"the file would have {len(raw) / 2**20:.1f} MiB, of {MOST_BYTES // 2**20} that a file "
            "may have: save fewer designs, or keep them with numpy.savez"
        )
        raise InputError(message)
    name = file_name(path)
    try:
        Path(name).write_bytes(raw)
    except (OSError, ValueError) as error:
        message = f"{shown_path(name)}: cannot be written: {reason(error)}"
        raise FileError(message, path=name) from error


def text_of(what: Any) -> str:
    """Return the text of a file."""
    return tree_text(tree_of(what), HEAD)


def tree_of(what: Any) -> dict[str, Any]:
    """Return tables, lists and values of a file; dimensions have dotted names."""
    wanted: Any = {}
    speed = None
    if isinstance(what, Contents):
        speed, wanted = what.input_speed, what.wanted
        what = what.machine or what.mechanism
    machine: dict[str, Any] = {}
    if not isinstance(what, Mechanism):
        if not hasattr(what, "bodies"):
            message = f"{short(what)} is not a Mechanism, Machine or Contents"
            raise InputError(message)
        if what.mechanism is None:
            message = "a machine of a table cannot be saved: keep its table in a file of its own"
            raise InputError(message)
        machine = machine_tree(what)
        what = what.mechanism
    description = what.description
    for name, count in zip(("joints", "links", "slides"), map(len, description[:3]), strict=True):
        if count > MOST_ITEMS:
            message = f"the mechanism has {count} {name}: a file may have {MOST_ITEMS}"
            raise InputError(message)
    tree = {"format": FORMAT, "driver": driver_value(what)}
    if speed is not None:
        tree["input_speed"] = list(speed) if isinstance(speed, tuple) else speed
    return {**tree, **mechanism_tree(what), **machine, **wanted_tree(wanted)}
