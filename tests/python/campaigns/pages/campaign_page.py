"""The campaign's figures as a page."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from campaigns import campaign_cases as cases
from campaigns.checks import campaign_checks as checks
from campaigns.pages import campaign_page_further as of_further
from campaigns.pages.campaign_page_further import number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from campaigns.campaign_report import Report

STATUSES = ("OK", "NEAR_SINGULAR", "SINGULAR", "UNREACHABLE", "LOST")
SHOWN = 50  # failures on the page


def page(report: Report, head: str, rows: Sequence[tuple[str, str]], text: str) -> str:
    """Markdown: a heading, what is checked with a table of figures, and the failures."""
    rows = [*rows, ("**failures**", f"**{len(report.failures)}**")]
    table = "\n".join(f"| {what} | {figure} |" for what, figure in rows)
    return (head + text).format(table=table, failed=failed(report.failures))


def greatest(report: Report, name: str, digits: int = 2) -> str:
    return f"{report.worst.get(name, 0.0):.{digits}f}"


def statuses(report: Report, where: str) -> list[tuple[str, str]]:
    names = [name for name in STATUSES if report.counts.get(name)]
    return [(f"status {name} on the {where}", number(report, name)) for name in names]


def motions(report: Report) -> list[tuple[str, str]]:
    """Figures that all campaigns of mechanisms have."""
    allowed = f"allowed: {checks.TERMS:g}"
    return [
        ("positions whose every length, offset and guide was checked", number(report, "closures")),
        (f"greatest misfit, in 8 u κ of the size ({allowed})", greatest(report, "misfit")),
        ("pairs of neighbours looked at for jumps", number(report, "cells")),
        ("of these halved further", number(report, "halved")),
        ("points that went through infinity", number(report, "poles")),
        ("ends of gaps shown to be dead points", number(report, "gaps")),
        ("further ends where a point goes to infinity", number(report, "infinite")),
        (f"farthest from a fold's 1 (allowed: {checks.FOLD_RATIO:g})", greatest(report, "fold")),
        ("positions with analogues against differences", number(report, "differences")),
        ("greatest error there, in what is allowed", greatest(report, "difference")),
    ]


def one_kind(report: Report, higher: bool) -> str:
    """The page of the campaign on class II, or of that on classes III and IV."""
    changing = [("of these built to have change points", number(report, "changing"))]
    of_higher = [
        ("of these of class III", number(report, "class 3")),
        ("of class IV", number(report, "class 4")),
        ("with sliding pairs", number(report, "sliding")),
        (
            "signs of the closures' determinant, the same between ends",
            number(report, "determinants"),
        ),
    ]
    steps = [("gaps across which every angle goes the shorter way", number(report, "steps"))]
    rows = [
        ("mechanisms", number(report, "mechanisms")),
        *(of_higher if higher else changing),
        ("positions solved", number(report, "positions")),
        *statuses(report, "fine grids"),
        ("positions compared to the bit between grids", number(report, "shared")),
        *motions(report),
        *([] if higher else steps),
        *of_further.of_mechanisms(report),
        *([] if higher else of_further.of_edges(report)),
    ]
    text = TEXT_HIGHER if higher else TEXT_CLASS_II
    return page(report, HIGHER if higher else CLASS_II, rows, text)


def failed(failures: Sequence[str]) -> str:
    if not failures:
        return ""
    kinds = Counter(" ".join((text.split()[0], text.split(": ")[1])) for text in failures)
    summary = ", ".join(f"{kind}: {count}" for kind, count in sorted(kinds.items()))
    more = len(failures) - SHOWN
    rest = f"\n- and {more} more" if more > 0 else ""
    return (
        f"\n## Failures\n\n{summary}\n\n"
        + "\n".join(f"- {text}" for text in failures[:SHOWN])
        + rest
        + "\n"
    )


CLASS_II = f"""# Campaign: class II

`make campaign` draws random class II mechanisms (any driver, one to four dyads of any kind; one
in ten with a dyad that has change points), moves each over {cases.TURNS} turns of its crank, or a
range of its slide, and asks what no example can: that nothing goes wrong anywhere. This page is
written by it; there are others on [classes III and IV](higher.md), on
[dyads and higher groups in any order](mixed.md) and on [machines](machines.md).
Besides what is said below, every angle must step across every gap by at most half a turn.

"""

HIGHER = f"""# Campaign: classes III and IV

`make campaign` draws random mechanisms with a group of class III or IV behind a crank (triads, both
kinds of quadrilaterals, among them P4's; a quarter of the inner pairs slide) and moves each over
{cases.TURNS} turns, or as far as it goes between dead points. This page is written by it;
there are others on [class II](class_ii.md), on [mixed groups](mixed.md) and on
[machines](machines.md). Besides what is said below, the sign of the Jacobian's
determinant must be the same at all positions of a mechanism: where two assemblies meet, the other
one has the other sign. Ends with a point beyond {checks.POLE_OF_GROUPS:g} sizes of the drawing
are counted apart: the condition has grown with the square of that, and following it is given up.

"""

TEXT = f"""What is checked of every mechanism:

- **The same bits.** At a user's steps (3° to 6°, or 0.03 to 0.06 m), over one turn and over all,
  and at steps {cases.FINER} times finer: values, analogues and statuses of shared positions agree
  to the bit.
- **No jump.** Between neighbours no joint, slide or angle goes farther than its first analogues at
  both ends predict; where they do not predict it to {checks.JUMP:g} of the drawing (or rad), the
  step is halved until they do. With change points the second analogues predict the first in
  the same way: the motion stays smooth.
- **No false OK.** Every position with values satisfies every pin, guide and driver of the
  description to the law's 8 u κ of the size; the equations share no code with `assur`.
- **Every gap is real.** Where a motion ends, the end is bisected to neighbouring numbers. There
  the Jacobian of the bodies, which shares no code either, is singular, and its square falls
  linearly: a dead point, beyond which this assembly does not exist; where two dyads fold together
  it falls faster, and then no assembly beyond is beside the last one. `explain` names the dyad.
  (Or a point has gone to infinity, where guides become parallel.)
- **Analogues** are the central differences of positions, at four positions each.
- **Nothing raises or panics.**
"""

TABLE = """
| | |
| --- | --- |
{table}
{failed}"""
TEXT_CLASS_II = TEXT + of_further.described("random") + of_further.EDGES + TABLE
TEXT_HIGHER = TEXT + of_further.described("higher") + TABLE
