"""Where the driver stops: the dyad that is flat there, and whether it is stretched or folded."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur.description.structure import roman

if TYPE_CHECKING:
    from assur._faces import Mechanism, Motion
    from assur.pictures.page.turn import Turn

# Sine of the angle at the inner joint: the legs of a dyad are in line at a dead point, and nearly
# so at the first and last rows of a turn, which are 1e-6 of its length before it. The angle grows
# as the root of that, and with the ratio of the driver's lengths to the legs': here to 50.
IN_LINE = 0.1


def dead_ends(turn: Turn) -> list[dict[str, Any]]:
    """Return the dead points at the ends of a turn.

    Each has `q`, `group`, `inner` (the joint or slide between the two links of a dyad, else None)
    and `shape`: ``"stretched"`` or ``"folded"`` of a dyad of three turning pairs, else None.
    """
    if not turn.dead_points or turn.limits is None:
        return []
    inner = {point.group: point.inner for point in turn.limits.dead_points}
    # The first and last rows stand for the ends, where rounding decides whether it closes.
    coordinates = turn.coordinates()
    rows = coordinates[[0, -1]]
    motion = turn.mechanism.solve(rows, order=0, on_error="nan")
    ends = []
    for q, group in turn.dead_points:
        row = 0 if abs(q - rows[0]) < abs(q - rows[-1]) else -1
        shape = _shape(motion, row, group, inner.get(group))
        ends.append({"q": q, "group": group, "inner": inner.get(group), "shape": shape})
    return ends


def _shape(motion: Motion, row: int, name: str, inner: str | None) -> str | None:
    """Say how a dyad of three turning pairs lies at a row: there are no words for others."""
    outer = _outer_joints(motion.mechanism, name, inner)
    if inner is None or outer is None:
        return None
    first, second = (motion.joint(end).value - motion.joint(inner).value for end in outer)
    a, b = first[row], second[row]
    along, across = float(a @ b), float(a[0] * b[1] - a[1] * b[0])
    if not across**2 <= IN_LINE**2 * (along**2 + across**2):
        return None
    return "stretched" if along < 0.0 else "folded"


def _outer_joints(mechanism: Mechanism, name: str, inner: str | None) -> list[str] | None:
    """Return the two outer joints of a dyad of three turning pairs."""
    for group in mechanism.structure.groups:
        if group.kind == "RRR" and f"{roman(group.cls)}({', '.join(group.links)})" == name:
            outer = [joint for joint in group.joints if joint != inner]
            # Both on one link: a driven angle leaves the dyad other legs than its links.
            is_one = any({*outer} <= {*mechanism.links[link]} for link in group.links)
            return outer if len(outer) == 2 and not is_one else None
    return None
