"""The FILE of a command: a TOML file, one of another program, an example, the standard input."""

from __future__ import annotations

import math
import sys
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from assur.cli.terminal import note
from assur.cli.units import ANGLE, LENGTH, argument, numbers
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse

    from assur.cli.units import Numbers
    from assur.dynamics.machine import Machine
    from assur.files import Contents
    from assur.importers import Imported
    from assur.kinematics.mechanism import Mechanism

EXAMPLE = "example:"
STDIN = "-"
# Of an example with several drivers, along the line between the ends of its range.
POSITIONS_OF_SEVERAL = 91
FULL_TURN = (0.0, math.tau)


def add_source(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that `read` takes."""
    parser.add_argument(
        "file",
        metavar="FILE",
        help="a TOML file, a file of another program, example:NAME, or - for the standard input",
    )
    parser.add_argument(
        "--set",
        metavar="NAME=VALUE",
        type=argument(_setting),
        action="append",
        default=[],
        help="change a dimension, coupler.length=120mm; m and rad without a unit",
    )
    parser.add_argument(
        "--design", type=int, metavar="I", help="one design of a file of several, from 0"
    )
    other = parser.add_argument_group("files of other programs")
    other.add_argument(
        "--format", metavar="NAME", help="pmks, pmks_plus, pylinkage, pyslvs or linkage2"
    )
    other.add_argument(
        "--scale",
        metavar="LENGTH",
        type=argument(numbers),
        help="the file's unit of length, such as 1mm; 1m by default",
    )
    other.add_argument(
        "--drivers",
        metavar="I-J",
        type=argument(_pairs),
        help="of a pyslvs expression: the drivers, each by its two points, 0-1",
    )


def read(given: argparse.Namespace) -> Contents:
    """Return what FILE holds; what does not carry over is said on the standard error."""
    contents = _changed(_found(given), given.set)
    if given.design is None:
        return contents
    if not contents.mechanism.shape:
        message = f"--design {given.design}: {given.file} has one design"
        raise InputError(message)
    return _with_mechanism(contents, contents.mechanism.design(given.design))


def _found(given: argparse.Namespace) -> Contents:
    from assur.files.contents import contents_of, read
    from assur.files.source import Source
    from assur.importers.source import Source as Text

    word = given.file
    if word.startswith(EXAMPLE):
        _refuse_import(given)
        return example(word.removeprefix(EXAMPLE))
    if word == STDIN:
        raw, name = standard_input(), "the standard input"
        text = Text(raw.decode("utf-8", errors="replace").removeprefix("\ufeff"), name)
        if not _is_foreign(given, text):
            return contents_of(Source(name, raw))
        return _imported(given, text)
    if "://" in word:
        return _imported(given, word)
    if PurePath(word).suffix.lower() == ".toml" and given.format is None:
        _refuse_import(given)
        return read(word)
    opened = _opened(word)
    return _imported(given, opened) if _is_foreign(given, opened) else read(word)


def _is_foreign(given: argparse.Namespace, text: Any) -> bool:
    from assur.importers import detect

    if given.format is not None or detect(text.name, text.text) is not None:
        return True
    _refuse_import(given)
    return False


def _opened(word: str) -> Any:
    from assur.importers.source import open_source

    return open_source(PurePath(word))


def _refuse_import(given: argparse.Namespace) -> None:
    for name in ("format", "scale", "drivers"):
        if getattr(given, name) is not None:
            message = f"--{name} is for files of other programs; {given.file} is a file of assur"
            raise InputError(message)


def _imported(given: argparse.Namespace, source: Any) -> Contents:
    from assur import importers
    from assur.files import Contents

    scale = 1.0 if given.scale is None else given.scale.one(LENGTH, "--scale")
    found: Imported = importers.read(source, given.format, scale=scale, drivers=given.drivers)
    for sentence in found.omitted:
        note(f"note: {sentence}")
    return Contents(found.mechanism)


def standard_input() -> bytes:
    """Return what the standard input holds."""
    from assur.files.limits import MOST_BYTES

    if sys.stdin is None:
        message = "there is no standard input"
        raise InputError(message)
    stream = getattr(sys.stdin, "buffer", None)
    raw: bytes = sys.stdin.read().encode() if stream is None else stream.read(MOST_BYTES + 1)
    if not raw.strip():
        message = "the standard input is empty"
        raise InputError(message)
    return raw


def example(name: str) -> Contents:
    """Return an example with its motion over the range in which it is used."""
    from assur import examples
    from assur.files import Contents, Range
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.table import driven_angles

    if name not in examples.ALL:
        from difflib import get_close_matches

        near = get_close_matches(name, examples.ALL, n=3)
        rest = f"did you mean {' or '.join(near)}?" if near else "assur examples lists them"
        message = f"there is no example {name[:60]!r}; {rest}"
        raise InputError(message)
    made: Any = examples.ALL[name]()
    machine = None if isinstance(made, Mechanism) else made
    mechanism: Mechanism = made if machine is None else machine.mechanism
    first, last = examples.RANGES[name]
    if isinstance(first, tuple):
        over = {"q": Range(first, last, count=POSITIONS_OF_SEVERAL)}
    elif (first, last) == FULL_TURN and driven_angles(mechanism)[0]:
        over = {"deg": Range(0.0, 360.0, step=1.0)}
    else:
        over = {"q": Range(first, last, count=361)}
    return Contents(mechanism, machine, {"solve": over})


def require_machine(contents: Contents, file: str) -> Machine:
    """Return the machine of a file."""
    if contents.machine is None:
        message = f"{file} has no machine: give bodies, loads or a motor ([bodies] in the file)"
        raise InputError(message)
    return contents.machine


def require_one(mechanism: Mechanism, file: str) -> None:
    """Refuse a batch."""
    if mechanism.shape:
        message = f"{file} has {mechanism.shape} designs: choose one by --design"
        raise InputError(message)


def _changed(contents: Contents, settings: list[tuple[str, Numbers]]) -> Contents:
    if not settings:
        return contents
    values = {name: given.one(kind_of(name), f"--set {name}") for name, given in settings}
    return _with_mechanism(contents, contents.mechanism.with_dimensions(values))


def _with_mechanism(contents: Contents, mechanism: Mechanism) -> Contents:
    from assur.files import Contents

    machine = None if contents.machine is None else contents.machine.of(mechanism)
    return Contents(mechanism, machine, contents.wanted)


def kind_of(dimension: str) -> str:
    """Return whether a dimension is a length or an angle."""
    return ANGLE if dimension.endswith(".angle") else LENGTH


def _setting(text: str) -> tuple[str, Numbers]:
    name, equals, value = text.partition("=")
    if not equals or not name.strip():
        message = f"{text[:60]!r}: NAME=VALUE is needed, such as coupler.length=120mm"
        raise InputError(message)
    return name.strip(), numbers(value)


def _pairs(text: str) -> list[tuple[int, int]]:
    try:
        pairs = [tuple(int(end) for end in pair.split("-")) for pair in text.split(",")]
        return [(first, second) for first, second in pairs]
    except ValueError as error:
        message = f"{text[:60]!r}: pairs of points are needed, such as 0-1 or 0-1,2-3"
        raise InputError(message) from error
