"""What is asked of a part of the mechanisms and machines: rows and text of the campaigns' pages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from campaigns.checks import campaign_cylinders as of_cylinders
from campaigns.checks import campaign_ends as of_ends
from campaigns.checks import campaign_turned as of_turned
from campaigns.checks import campaign_units as of_units
from campaigns.checks.campaign_cylinders import Cylinders
from campaigns.checks.campaign_ends import Ends
from campaigns.checks.campaign_flat import Flat
from campaigns.checks.campaign_further import ASKED, DRAWN
from campaigns.checks.campaign_resting import Resting
from campaigns.checks.campaign_sweeps import Covered, Swept
from campaigns.checks.campaign_turned import Turned
from campaigns.checks.campaign_variants import Variants
from models.mechanisms import flat_models

if TYPE_CHECKING:
    from campaigns.campaign_report import Report

Rows = list[tuple[str, str]]


def number(report: Report, name: str) -> str:
    return f"{report.counts.get(name, 0):,}".replace(",", " ")


def of_mechanisms(report: Report) -> Rows:
    """Other descriptions, limits, extremes and sweeps."""
    names = (
        ("mechanisms saved and loaded", "mechanisms loaded"),
        ("mechanisms described otherwise", "described again"),
        ("of these drawn at another position", "described redrawn"),
        ("of these renamed", "described renamed"),
        ("of these in another frame", "described framed"),
        ("limits compared between descriptions", "described limits"),
        ("extremes compared between descriptions", "described extremes"),
        ("configuration curves compared between descriptions", "described curve"),
        ("mechanisms whose limits were scanned", "limits scanned"),
        ("extremes scanned", "extremes scanned"),
        ("sweeps whose designs were solved again", "sweeps"),
    )
    return [(what, number(report, name)) for what, name in names]


def of_edges(report: Report) -> Rows:
    """Nearly flat drawings, and cylinders."""
    return [
        ("drawings with a dyad that is nearly flat", number(report, "drawings with a flat dyad")),
        ("greatest condition of a drawing", f"{report.worst.get('condition', 0.0):.3g}"),
        ("mechanisms with cylinders", number(report, "mechanisms with cylinders")),
    ]


def of_machines(report: Report) -> Rows:
    """Other units, frames, files, tables that end, pairs at rest."""
    names = (
        ("machines in other units", "in other units"),
        ("of these with friction", "with friction"),
        ("runs in other units", "runs in other units"),
        ("runs given up, each evaluation beside a lock being slow", "runs that took too long"),
        (
            "of these with numbers of steps that differ as much in nearly the same units",
            "numbers of steps as different in nearly the same units",
        ),
        ("forces compared in other units", "forces in other units"),
        ("of these the same bits", "of these the same bits"),
        ("results asked for all that they have", "results asked for all"),
        ("machines saved and loaded", "loaded"),
        ("machines turned, shifted, shuffled", "turned"),
        ("of these with friction", "turned with friction"),
        ("positions whose forces were compared", "positions turned"),
        ("runs compared", "runs turned"),
        ("tables that end before the motion", "tables that end"),
        ("machines of which a part turns as one body", "machines with pairs at rest"),
        ("positions of pairs at rest, with friction", "positions of pairs at rest"),
    )
    return [(what, number(report, name)) for what, name in names]


def _one_in(kind: str, check: type) -> int:
    return ASKED[kind][check] if check in ASKED[kind] else DRAWN[kind][check][1]


def described(kind: str) -> str:
    """What is asked of a part of the mechanisms."""
    return f"""
- **Descriptions.** One mechanism in {_one_in(kind, Variants)} is described otherwise: its lists of
  joints, links, joints of links and slides in another order, with other names, drawn at another
  position of the same motion, turned, shifted, mirrored. Structure, positions, analogues, limits,
  extremes (and, of some, all assemblies, coordinates found for a value, the configuration curve)
  are the same: an angle or a slide is counted from another direction or place, which the drawings
  give.
- **Limits and extremes** of one in {_one_in(kind, Ends)} against {of_ends.SCANNED} positions: they
  are inside the intervals where `solve` has positions, {of_ends.BESIDE:g} to either side of an end
  too; an interval holds the drawing; no position has less or more than the extremes of order 0 to 2
  by {of_ends.BEATEN:g} of their size.
- **Files.** Read back from its file a mechanism is equal to itself.
- **Sweeps** of one in {_one_in(kind, Swept)} in any assembly: the designs handed back reproduce the
  metrics that were measured.
"""


EDGES = f"""
Beside one in {_one_in("random", Flat)} a drawing has a dyad that is nearly flat, or guides that are
nearly parallel (a sine of {flat_models.LEAST:g} to {flat_models.MOST:g}): it is taken, every joint
is at its place, and an interval of its limits holds the drawing. Beside one in
{_one_in("random", Cylinders)} a mechanism has cylinders, which drive or are driven: at
{of_cylinders.POSITIONS} positions in up to
{of_cylinders.ASSEMBLIES} assemblies their lengths are the distances of their
joints.
"""

MACHINES = f"""
- **Units.** Every machine (one in {of_units.RUBBING} with friction) is computed in other units of
  length, time and mass. In even powers of two runs have the same steps and bits, in any others as
  many steps to {100 * of_units.STEPS:g} % (or as they differ in units that hardly differ), and the
  same end.
- **All that there is.** Of its results every property and every method without arguments is asked,
  and raises nothing but the library's own errors; a run from rest has reactions; from its file it
  is equal, and its results have the same bits.
- **Frames.** One in {_one_in("machine", Turned)}, mostly with friction, is turned, shifted, renamed
  and its lists shuffled: forces agree to {of_turned.CLOSE:g} κ² of the largest.
- **Tables that end** before the motion, over q, a slide or a link, in one in
  {_one_in("machine", Covered)}: what has no number has a status that says so.

Beside one in {_one_in("machine", Resting)} there is a crank with dyads that turn with it as one
body, then others: pairs that do not move have no friction.
"""
