"""Verbs of higher floors, which methods of lower ones call: each registered by `assur/__init__.py`.

That file alone knows every floor. What it registers is imported when it is called. For type
checkers this file names the classes of higher floors that users meet on results of lower ones.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from assur.errors import InputError

if TYPE_CHECKING:
    # For types alone (`FOR_TYPES` of tools/check_floors): a result has the mechanism whose method
    # made it, and editors complete what that can do.
    from assur.dynamics.motion.steady import SteadyState as SteadyState  # noqa: PLC0414
    from assur.kinematics.mechanism import Mechanism as Mechanism  # noqa: PLC0414
    from assur.studio.notebook import Explorer as Explorer  # noqa: PLC0414

__all__ = ["explorer", "register", "save"]

# Where a verb is: its module and its name there.
_VERBS: dict[str, tuple[str, str]] = {}


def register(verb: str, module: str, name: str) -> None:
    """Say where a verb is."""
    _VERBS[verb] = module, name


def save(what: Any, path: Any) -> None:
    """Write a mechanism or a machine to a file: see `assur.files`."""
    _verb("save")(what, path)


def explorer(what: Any, height: int) -> Explorer:
    """Return the widget of a mechanism or a machine."""
    try:
        widget = _verb("explore")
    except ImportError as error:
        message = f"explore needs {error.name}: pip install assur[notebook]"
        raise InputError(message) from error
    shown: Explorer = widget(what, height)
    return shown


def _verb(name: str) -> Any:
    module, attribute = _VERBS[name]
    return getattr(import_module(module), attribute)
