"""A description as a tree of tables, lists and values, from a file or elsewhere.

A file adds where each key is (`Source`); what arrives otherwise, as JSON, has keys alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur.files.errors import FileError

if TYPE_CHECKING:
    from assur.errors import AssurError
    from assur.files.positions import KeyPath

__all__ = ["Tree", "shown"]

# How messages of the package begin; in a file the key says it.
SUBJECTS = ("joint", "link", "slide", "cylinder", "driver", "dimension")


class Tree:
    """The data of a description; errors name the key.

    Parameters
    ----------
    data : dict
        The tables.
    """

    def __init__(self, data: dict[str, Any]) -> None:
        self.data = data

    def error(
        self, path: KeyPath, message: str, cause: AssurError | None = None, **fields: Any
    ) -> FileError:
        """Return the error of a key, with the fields of its cause."""
        key = shown(path)
        error = FileError(f"{key}: {message}" if key else message, key=key or None)
        return with_fields(error, cause, fields)

    def error_of(self, path: KeyPath, cause: AssurError) -> FileError:
        """Return an error of the package as that of a key."""
        message = str(cause)
        name = path[-1] if path else None
        starts = [
            f"{noun} {quote}{name}{quote}{colon} "
            for noun in SUBJECTS
            for quote in ('"', "'")
            for colon in ("", ":")
        ]
        start = next(filter(message.startswith, starts), "")
        return self.error(path, message.removeprefix(start), cause)


def with_fields(error: FileError, cause: AssurError | None, fields: dict[str, Any]) -> FileError:
    """Return the error with the fields of its cause, and with others."""
    for name, value in {**(cause.__dict__ if cause else {}), **fields}.items():
        setattr(error, name, value)
    return error


def shown(path: KeyPath) -> str:
    """Return a key as messages show it: links.crank, loads[0].at."""
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
            continue
        is_plain = part.isprintable() and part and not set(part) & set(" .[]\"'")
        text += ("." if text else "") + (part if is_plain else ascii(part))
    return text
