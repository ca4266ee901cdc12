"""The kinds of requests: each is a function of its fields and the session.

They are pure: what they answer depends on the request alone (`open` and `save` also on the file
given), so requests can be computed in any order and dropped at will.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.studio.kinds.assemblies import assemblies
from assur.studio.kinds.check import check
from assur.studio.kinds.drag import drag
from assur.studio.kinds.export import export
from assur.studio.kinds.find import find
from assur.studio.kinds.forces import flywheel, reactions, steady
from assur.studio.kinds.lesson import lesson
from assur.studio.kinds.maps import map_of
from assur.studio.kinds.numbers import position, sensitivity
from assur.studio.kinds.opening import open_document, start
from assur.studio.kinds.run import run
from assur.studio.kinds.save import save
from assur.studio.kinds.turn import turn

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from assur.studio.session import Answer, Session

KINDS: dict[str, Callable[[dict[str, Any], Session], Answer]] = {
    "start": start,
    "open": open_document,
    "check": check,
    "turn": turn,
    "drag": drag,
    "assemblies": assemblies,
    "sensitivity": sensitivity,
    "position": position,
    "run": run,
    "reactions": reactions,
    "flywheel": flywheel,
    "steady": steady,
    "map": map_of,
    "find": find,
    "lesson": lesson,
    "save": save,
    "export": export,
}
# Slow kinds are computed beside the others; some of them warn.
LONG = ("assemblies", "run", "flywheel", "steady", "map", "find", "export")
# Only the newest of these that waits is computed; kinds of one place replace each other.
LIVE = {
    "turn": "picture",
    "drag": "picture",
    **{kind: kind for kind in ("check", "assemblies", "sensitivity", "position")},
    **{kind: kind for kind in ("reactions", "map", "find", "lesson")},
}
