"""From a request to its frame: every request has exactly one answer."""

from __future__ import annotations

import logging
import threading
import warnings
from typing import TYPE_CHECKING, Any

from assur.errors import AssurError, AssurWarning, InputError
from assur.studio.frame import encode
from assur.studio.kinds import KINDS, LONG
from assur.studio.limits import MOST_LETTERS
from assur.studio.session import Answer

if TYPE_CHECKING:
    from assur.studio.request import Request
    from assur.studio.session import Session

LOG = logging.getLogger("assur.studio")
FIELDS = ("kind", "joint", "link", "slide", "driver", "dimension", "group", "q", "t", "value")
PLACES = ("key", "line", "column")
# Seconds to wait for the record of warnings.
LONGEST_WAIT = 0.02
_RECORD = threading.Lock()


def answered(request: Request, session: Session) -> bytes:
    """Return the frame that answers a request."""
    head = {"id": request.id, "rev": request.rev, "kind": request.kind}
    try:
        answer = _computed(request, session)
        return encode({**head, **answer.header}, answer.arrays)
    except Exception as error:  # noqa: BLE001 - the server goes on, whatever fails
        return failed(head, error)


def failed(head: dict[str, Any], error: BaseException) -> bytes:
    """Return the frame of an error."""
    return encode({**head, "error": described(error)}, {})


def _computed(request: Request, session: Session) -> Answer:
    if request.kind not in KINDS:
        message = f"there is no kind {request.kind[:40]!r}; there are {', '.join(KINDS)}"
        raise InputError(message, kind="malformed")
    compute = KINDS[request.kind]
    if request.kind not in LONG:
        return compute(request.fields, session)
    # Python has one record of warnings for all threads: a page that is second goes without.
    if not _RECORD.acquire(timeout=LONGEST_WAIT):
        return compute(request.fields, session)
    try:
        with warnings.catch_warnings(record=True) as record:
            warnings.simplefilter("always", AssurWarning)
            answer = compute(request.fields, session)
    finally:
        _RECORD.release()
    messages = [
        str(warning.message) for warning in record if issubclass(warning.category, AssurWarning)
    ]
    return Answer({**answer.header, "warnings": messages}, answer.arrays) if messages else answer


def described(error: BaseException) -> dict[str, Any]:
    """Return an error in plain words, with what it is about."""
    if isinstance(error, AssurError):
        fields = {name: getattr(error, name, None) for name in (*FIELDS, *PLACES)}
        fields["what_to_do"] = error.hint
        fields["message"] = str(error)[:MOST_LETTERS]
        return {name: value for name, value in fields.items() if value is not None}
    if isinstance(error, ImportError):
        return {"message": str(error)[:MOST_LETTERS], "kind": "missing_package"}
    if isinstance(error, MemoryError):
        return {"message": "there is not enough memory for so much: ask for less", "kind": "memory"}
    if isinstance(error, RecursionError):
        return {"message": "the document is nested too deeply", "kind": "malformed"}
    if isinstance(error, UnicodeError):
        return {"message": "a text is not valid Unicode", "kind": "malformed"}
    LOG.error("a request failed", exc_info=error)
    message = f"the studio failed at this ({type(error).__name__}); the document is not changed"
    return {"message": message, "kind": "internal"}
