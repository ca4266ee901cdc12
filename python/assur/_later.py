"""Verbs of higher floors, which methods of lower ones call: each registered by `assur/__init__.py`.

That file alone knows every floor. What it registers is imported when it is called.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from assur.errors import InputError

__all__ = ["explorer", "register", "save"]

# Where a verb is: its module and its name there.
_VERBS: dict[str, tuple[str, str]] = {}


def register(verb: str, module: str, name: str) -> None:
    """Say where a verb is."""
    _VERBS[verb] = module, name


def save(what: Any, path: Any) -> None:
    """Write a mechanism or a machine to a file: see `assur.files`."""
    _verb("save")(what, path)


def explorer(what: Any, height: int) -> Any:
    """Return the widget of a mechanism or a machine."""
    try:
        widget = _verb("explore")
    except ImportError as error:
        message = f"explore needs {error.name}: pip install assur[notebook]"
        raise InputError(message) from error
    return widget(what, height)


def _verb(name: str) -> Any:
    module, attribute = _VERBS[name]
    return getattr(import_module(module), attribute)
