"""The public interface: every callable that a user names, with its arguments.

``python -m interface.public_interface --write``, with ``tests/python`` on the path, writes the
table anew.
"""

from __future__ import annotations

import enum
import importlib
import inspect
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import assur

if TYPE_CHECKING:
    from collections.abc import Iterator

TABLE = Path(__file__).with_name("interface.txt")
# The manual's index names what the package exports, and the classes of results.
INDEX = Path(__file__).parents[3] / "docs" / "reference" / "api"


def callables() -> dict[str, inspect.Signature]:
    """Every public function, class and method by the name that a user types."""
    found: dict[str, inspect.Signature] = {}
    for name in sorted(assur.__all__):
        found.update(_of(name, getattr(assur, name)))
    for name in _results():
        if name not in found:
            module, _, own = f"assur.{name}".rpartition(".")
            of_result = dict(_of(name, getattr(importlib.import_module(module), own)))
            # Users do not make results.
            del of_result[name]
            found.update(of_result)
    return dict(sorted(found.items()))


def _results() -> list[str]:
    """Names with a module, which the index has and ``assur.__all__`` has not."""
    pages = [page.read_text(encoding="utf-8") for page in sorted(INDEX.glob("*.rst"))]
    named = [name for page in pages for name in re.findall(r"^   ([\w.]+)$", page, re.MULTILINE)]
    # A widget has the methods of its library.
    known = {*assur.__all__, "studio"}
    return [name for name in named if name.partition(".")[0] not in known]


def _of(name: str, what: Any) -> Iterator[tuple[str, inspect.Signature]]:
    if inspect.ismodule(what):
        for part in getattr(what, "__all__", ()):
            yield from _of(f"{name}.{part}", getattr(what, part))
    elif inspect.isclass(what) and not issubclass(what, enum.Enum):
        if not issubclass(what, Exception):
            yield from _signature(name, what)
        for method, own in inspect.getmembers(what):
            is_own = not method.startswith("_") and callable(own) and _is_ours(own)
            if is_own and not _is_of_a_public_base(what, method):
                yield from _signature(f"{name}.{method}", own)
    elif inspect.isfunction(what):
        yield from _signature(name, what)


def _is_of_a_public_base(what: type, method: str) -> bool:
    bases = [base for base in what.__mro__[1:] if base.__name__ in assur.__all__]
    return any(getattr(base, method, None) is getattr(what, method) for base in bases)


def _is_ours(own: Any) -> bool:
    return (getattr(inspect.unwrap(own), "__module__", None) or "").startswith("assur")


def _signature(name: str, what: Any) -> Iterator[tuple[str, inspect.Signature]]:
    try:
        yield name, inspect.signature(what)
    except (TypeError, ValueError):
        return


def line(name: str, signature: inspect.Signature) -> str:
    """One line of the table: names, order and defaults, without types."""
    plain = [
        parameter.replace(annotation=inspect.Parameter.empty)
        for parameter in signature.parameters.values()
        if parameter.name != "self"
    ]
    return f"{name}{signature.replace(parameters=plain, return_annotation=inspect.Signature.empty)}"


def table() -> str:
    """All lines."""
    return "".join(f"{line(name, signature)}\n" for name, signature in callables().items())


if __name__ == "__main__" and "--write" in sys.argv:
    TABLE.write_text(table(), encoding="utf-8")
