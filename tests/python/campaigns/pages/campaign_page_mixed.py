"""Pages of the campaigns of mixed mechanisms and of machines."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from campaigns.checks import campaign_checks as checks
from campaigns.checks import campaign_machines as of_machines
from campaigns.checks import campaign_mixed as of_mixed
from campaigns.checks import campaign_redundant as of_redundant
from campaigns.pages import campaign_page_further as of_further
from campaigns.pages.campaign_page import greatest, motions, page, statuses
from campaigns.pages.campaign_page_further import number
from models.machines import machine_models
from models.mechanisms import redundant_models

if TYPE_CHECKING:
    from campaigns.campaign_report import Report

LEAST, MOST = (f"{100 * part:g}" for part in of_mixed.CHANGES)


def mixed(report: Report) -> str:
    """Mechanisms of dyads and higher groups in any order."""
    classes = [(f"of class {roman}", f"class {k}") for k, roman in ((2, "II"), (3, "III"))]
    classes += [("of class IV", "class 4"), ("of class V and above", "class 5")]
    rows = [
        ("mechanisms", number(report, "mechanisms")),
        *((what, number(report, name)) for what, name in classes),
        ("with dyads and higher groups", number(report, "mixed")),
        ("Assur groups in all", number(report, "groups")),
        ("mechanisms with sliding pairs", number(report, "sliding")),
        ("with two drivers", number(report, "two drivers")),
        ("with the driver moved to another pair or link", number(report, "driver moved")),
        ("positions solved", number(report, "positions")),
        *statuses(report, "grids of the batches"),
        ("positions compared to the bit", number(report, "shared")),
        ("sentences of `explain` read", number(report, "explained")),
        (
            f"greatest distance from the drawing at q0 (allowed: {checks.TERMS:g})",
            greatest(report, "drawing"),
        ),
        *motions(report),
        ("further ends where two branches of a group cross", number(report, "crossings")),
        ("overconstrained mechanisms with rounded data", number(report, "overconstrained")),
        ("of these refused, with the misfit named", number(report, "refused")),
        (
            "positions the others had to reach, as the exact ones do",
            number(report, "rounded positions"),
        ),
        (
            f"greatest effect of the rounding, in κ times it (allowed: {of_redundant.MOVED:g})",
            greatest(report, "moved"),
        ),
        *of_further.of_mechanisms(report),
    ]
    return page(report, MIXED, rows, "")


def machines(report: Report) -> str:
    """Machines and their balance of energy."""
    loads = [kind for kind in machine_models.DRAWN if kind != "Gravity"]
    ends = sorted(name for name in report.counts if name.startswith("end "))
    rows = [
        ("machines", number(report, "machines")),
        ("of class II", number(report, "of class II")),
        ("with two drivers", number(report, "two drivers")),
        ("with motors", number(report, "with motors")),
        *((f"loads: `{name}`", number(report, name)) for name in loads),
        ("positions with reductions compared", number(report, "reductions")),
        *(
            (f"greatest error of the reduced {name}, in what is allowed", greatest(report, key, 3))
            for name, key in (("inertia", "inertia"), ("moment", "moment"))
        ),
        ("greatest error of the potential, in what is allowed", greatest(report, "potential", 3)),
        *((f"runs that ended: {name[4:]}", number(report, name)) for name in ends),
        ("steps of all runs", number(report, "steps")),
        ("steps compared", number(report, "compared")),
        ("runs not compared up to their end", number(report, "cut")),
        ("runs with nothing to compare", number(report, "nothing compared")),
        ("runs whose own balance warned", number(report, "warned of energy")),
        (
            f"runs within {of_machines.BALANCE:g} rtol of the greatest energy",
            number(report, "within the greatest energy"),
        ),
        ("greatest imbalance, in what is allowed", greatest(report, "balance")),
        *of_further.of_machines(report),
    ]
    return page(report, MACHINES, rows, "")


MIXED = f"""# Campaign: dyads and higher groups in any order

`make campaign` draws random mechanisms of one to five Assur groups: dyads of all five kinds and
groups of class III, IV and V, each hung on any links and joints already there. The driver is a
crank, a slide, a cylinder between moving links, an elbow, a coupler, or any other pair or link of
the finished mechanism; one in ten has two drivers. Every mechanism is solved as a batch of
{of_mixed.DESIGNS + 1} designs: the drawing, and designs whose dimensions are changed by up to
{LEAST} to {MOST} %, some of which cannot be assembled. This page is written by it; there are
others on [class II](class_ii.md), on [classes III and IV](higher.md) and on
[machines](machines.md).

What is checked of every mechanism:

- **The drawing.** It is regular (the least singular value of its Jacobian says so), so it must be
  accepted, and at its own coordinate every joint is where it was drawn.
- **The same bits.** The drawing and another design, each alone and at some of the positions in any
  order, have the bits that they have in the batch.
- **No false OK.** Every position with values satisfies every pin, guide and driver to the law's
  8 u κ of the size. The equations follow from the table of dimensions in
  [the conventions](../../reference/conventions.md) and share no code with `assur`.
- **No jump.** Between neighbouring positions of the drawing (and of one in
  {of_mixed.DESIGN_MOTIONS} of the other designs) nothing moves farther than its first analogues
  carry it to {checks.JUMP:g} of the drawing (or rad). With two drivers the path is straight.
- **Every gap is real.** In one mechanism in {of_mixed.GAPS} (of two drivers, in
  {of_mixed.GAPS_OF_TWO}) one end of a motion is bisected to neighbouring numbers: the Jacobian is
  singular there, and its square falls linearly. (Or a point goes to infinity there or right behind;
  or two branches of a group cross, where the determinant itself falls linearly and first analogues
  stay.)
- **Analogues** are the central differences of positions, at four positions each.
- **Statuses** fit the values, and `explain` names a joint, link or slide for what has none.
- **Nothing raises or panics.**
{of_further.described("mixed")}
One mechanism in twenty is overconstrained: parallel cranks on one rod, several rods between two
wheels, or a crosshead with a second guide, with up to two groups hung on it. It is turned by a
random angle and its numbers are rounded to {redundant_models.DIGITS[0]} to
{redundant_models.DIGITS[1]} digits. Construction either refuses it and says by how much it misfits
(never with {of_redundant.FITTING} digits or more), or it must move wherever the exact one does,
within {of_redundant.MOVED:g} κ times the rounding of it. So must designs of the exact one that are
scaled as a whole, or whose dimensions are off by up to {of_redundant.OFF:g} of themselves.

| | |
| --- | --- |
{{table}}
{{failed}}"""

MACHINES = f"""# Campaign: machines

`make campaign` draws random mechanisms (class II and above, one or two drivers) with bodies on
random links, two to six random loads at random places of random links, the ground among them, and
motors on half of them. Values are numbers, tables over q, or functions of (t, q, speed). This page
is written by it; there are others on mechanisms of [class II](class_ii.md), of
[classes III and IV](higher.md) and of [mixed groups](mixed.md).

Both sides of each comparison start from `Mechanism.solve`: places of joints, angles of links and
their first derivatives. All else is written anew from
[the conventions](../../reference/conventions.md): poses of links, kinetic energy, weights,
springs, and the power of every other load and motor (tables by SciPy's splines).

- **Reductions.** At {of_machines.PLACES} random positions within {of_machines.REACH:g} rad (or m)
  of the drawing: reduced inertia is twice the kinetic energy by the square of the speed, reduced
  moment the sum of generalised forces, potential the sum of all parts; to
  {of_machines.MOMENT:g} (potential {of_machines.POTENTIAL:g}) of the sum of absolute values, and
  the law's 64 u κ² (8 u κ).
- **Energy.** In a run with rtol = {of_machines.RTOL:g} the kinetic and potential energy change by
  the work of all other loads and motors, which is integrated by Gauss and Legendre's rule with
  {of_machines.NODES} nodes on the dense output between steps. A run is granted rtol of a radian in
  its coordinate too, which changes its energy E by rtol ∂E/∂q: beside a dead point that is more
  than rtol of E. The imbalance at every step is at most {of_machines.BALANCE:g} rtol of the
  greatest energy, or of the greatest ∂E/∂q (J/rad; for a slide, by the size of the drawing) so far
  if that is greater; the table says how many runs keep to the greatest energy alone.
- **Nothing raises or panics**, and a run warns only by `AssurWarning`.
{of_further.MACHINES}
A run is compared up to its first position that is not `OK`, mostly beside the dead point that ends
it; the table says how many runs have such an end. Drawings with a condition above
{math.floor(machine_models.CONDITION):d} are drawn again; a run tries at most
{of_machines.MAX_STEPS} steps, and its first {of_machines.COMPARED} are compared.

| | |
| --- | --- |
{{table}}
{{failed}}"""
