"""A request that raises each kind of error: the call, the class of the error and its fields."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

# In the order of docs/reference/errors.md.
FIELDS = ("joint", "link", "slide", "driver", "dimension", "group", "design", "q", "t", "value")


@dataclass(frozen=True)
class Case:
    """A call that raises; fields that are not named must be None."""

    error: type[assur.AssurError]
    ask: Callable[[], object]
    fields: dict[str, Any] = field(default_factory=dict)

    def raised(self) -> assur.AssurError:
        """The error."""
        try:
            self.ask()
        except assur.AssurError as error:
            # Without the frames, which keep whatever the call made.
            return error.with_traceback(None)
        message = "no error was raised"
        raise AssertionError(message)
