"""The FILE of a command: a TOML file, one of another program, an example, the standard input."""

from __future__ import annotations

import sys
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

from assur.cli.named import EXAMPLE, example
from assur.cli.terminal import note
from assur.cli.units import LENGTH, kind_of
from assur.errors import InputError

if TYPE_CHECKING:
    import argparse

    from assur.cli.units import Numbers
    from assur.dynamics.machine import Machine
    from assur.files import Contents
    from assur.importers import Imported
    from assur.importers.source import Source as Text
    from assur.kinematics.mechanism import Mechanism

STDIN, STDIN_NAME = "-", "the standard input"


def read(arguments: argparse.Namespace) -> Contents:
    """Return the contents of FILE; report on the standard error what does not carry over."""
    contents = _changed(_found(arguments), arguments.set)
    if arguments.design is None:
        return contents
    if not contents.mechanism.shape:
        message = f"--design {arguments.design}: {arguments.file} has one design"
        raise InputError(message)
    return _with_mechanism(contents, contents.mechanism.design(arguments.design))


def _found(arguments: argparse.Namespace) -> Contents:
    from assur.files.contents import contents_of, read
    from assur.files.source import Source
    from assur.importers import detect
    from assur.importers.source import LARGEST_FILE

    word = arguments.file
    if word.startswith(EXAMPLE):
        _refuse_import(arguments)
        return example(word.removeprefix(EXAMPLE))
    if "://" in word:
        return _imported(arguments, word)
    is_toml = PurePath(word).suffix.lower() == ".toml"
    if is_toml and arguments.format is None:
        _refuse_import(arguments)
        return read(word)
    raw, name = (standard_input(), STDIN_NAME) if word == STDIN else (_bytes(word), word)
    text = _text(raw, name)
    if arguments.format is None and detect(text.name, text.text) is None:
        _refuse_import(arguments)
        return contents_of(Source(name, raw))
    if len(text.text) > LARGEST_FILE:
        raise text.error("", f"more than {LARGEST_FILE} letters: this is not the file of a linkage")
    return _imported(arguments, text)


def _bytes(word: str) -> bytes:
    """Return what a file holds, read once: it may be a pipe."""
    from assur.files.limits import MOST_BYTES

    try:
        with Path(word).open("rb") as file:
            return file.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:
        message = f"{word}: cannot be read: {getattr(error, 'strerror', None) or error}"
        from assur.examples import ALL

        if word in ALL:
            message = f"{message}; the example is {EXAMPLE}{word}"
        raise InputError(message) from error


def _text(raw: bytes, name: str) -> Text:
    """Return the text of another program; Linkage writes the code page of Windows."""
    from assur.importers.source import Source as Text

    try:
        text = raw.decode("utf-8")
    except UnicodeDecodeError:
        text = raw.decode("cp1252", errors="replace")
    return Text(text.removeprefix("\ufeff"), PurePath(name).name)


def _refuse_import(arguments: argparse.Namespace) -> None:
    for name in ("format", "scale", "drivers"):
        if getattr(arguments, name) is not None:
            message = (
                f"--{name} is for files of other programs; {arguments.file} is a file of assur"
            )
            raise InputError(message)


def _imported(arguments: argparse.Namespace, source: Any) -> Contents:
    from assur import importers
    from assur.files import Contents
    from assur.files.contents import known_speed

    scale = None if arguments.scale is None else arguments.scale.one(LENGTH, "--scale")
    imported: Imported = importers.read(
        source, format=arguments.format, scale=scale, drivers=arguments.drivers
    )
    for sentence in imported.omitted:
        note(f"note: {sentence}")
    return Contents(imported.mechanism, input_speed=known_speed(imported.input_speed))


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
    values = {name: value.one(kind_of(name), f"--set {name}") for name, value in settings}
    return _with_mechanism(contents, contents.mechanism.with_dimensions(values))


def _with_mechanism(contents: Contents, mechanism: Mechanism) -> Contents:
    from assur.files import Contents

    machine = None if contents.machine is None else contents.machine.of(mechanism)
    return Contents(mechanism, machine, contents.wanted, contents.input_speed)
