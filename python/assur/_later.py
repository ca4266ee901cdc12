"""What a method shows by a package of a higher floor, imported when it is called."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from assur.errors import InputError

if TYPE_CHECKING:
    from assur.studio.notebook import Explorer


def explorer(what: Any, height: int) -> Explorer:
    """Return the widget of a mechanism or a machine."""
    try:
        notebook = import_module("assur.studio.notebook")
    except ImportError as error:
        message = f"explore needs {error.name}: pip install assur[notebook]"
        raise InputError(message) from error
    widget: Explorer = notebook.Explorer(what, height)
    return widget
