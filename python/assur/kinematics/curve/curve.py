"""The configuration curve, and motion along it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from assur._arrays import counted
from assur._summary import FORMULA, shortened
from assur._trig import sin_cos
from assur._validate import MAX_POINTS, checked_index, whole_number
from assur.description.words import is_reached
from assur.kinematics.configuration import size_of
from assur.kinematics.curve.defects import defects_of
from assur.kinematics.curve.elements import ends_of, has_driven_angle
from assur.kinematics.solve import solve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._later import Mechanism
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.curve.defects import Defects
    from assur.kinematics.curve.elements import Branch, Circuit, Fold
    from assur.kinematics.model import MechanismModel
    from assur.kinematics.motion import Motion

__all__ = ["CircuitMotion", "ConfigurationCurve"]

# Distance (rad, or in sizes) kept from dead points, about the accuracy to which they are known.
MARGINS = (1e-13, 1e-12, 1e-11, 1e-10, 1e-9)


@dataclass(frozen=True, slots=True, eq=False)
class CircuitMotion:
    """Positions along a circuit, also past dead points of the driver.

    Attributes
    ----------
    q : ndarray
        Coordinate of the driver, shape (N,); it turns back at folds.
    branch : ndarray of int
        The branch of each position.
    joints : mapping of str to ndarray
        Positions of the joints, m, shape (N, 2).
    links : mapping of str to ndarray
        Angles of the links, rad, continuous.
    slides : mapping of str to ndarray
        Values of the slides, m.

    Examples
    --------
    >>> import assur
    >>> motion = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve().motion(samples=90)
    >>> motion.joints["C"].shape, sorted({int(branch) for branch in motion.branch})
    ((179, 2), [0, 1])
    """

    q: Float
    branch: Float
    joints: dict[str, Float]
    links: dict[str, Float]
    slides: dict[str, Float]

    def __repr__(self) -> str:
        positions, count = counted(len(self.q), "position"), len(np.unique(self.branch))
        branches = "1 branch" if count == 1 else f"{count} branches"
        ends = f", q = {self.q.min():.6g} … {self.q.max():.6g}" if len(self.q) else ""
        return f"<assur.CircuitMotion of {positions}, {branches}{ends}>"


@dataclass(frozen=True, slots=True, eq=False)
class ConfigurationCurve:
    """All positions of a design, as a curve.

    Attributes
    ----------
    branches : tuple of Branch
        Stretches between dead points.
    folds : tuple of Fold
        Dead points.
    circuits : tuple of Circuit
        What is connected.
    fan : ndarray
        Coordinates at which all assemblies were found, rad or m. With a group above class II, or
        more than nine signs, a circuit that turns back between two neighbours at both of its ends
        may have been missed.

    Examples
    --------
    A double rocker swings between its dead points in either assembly, in one circuit:

    >>> import assur
    >>> curve = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve()
    >>> len(curve.branches), len(curve.folds), len(curve.circuits)
    (2, 2, 1)
    """

    branches: tuple[Branch, ...]
    folds: tuple[Fold, ...]
    circuits: tuple[Circuit, ...]
    fan: Float
    # A `Mechanism`, whose file stands above.
    mechanism: Mechanism

    def __repr__(self) -> str:
        folds, circuits = counted(len(self.folds), "fold"), counted(len(self.circuits), "circuit")
        of = shortened(self.mechanism.core.formula, FORMULA)
        return f"<assur.ConfigurationCurve of {of}, {circuits}, {folds}>"

    def defects(self, places: Sequence[tuple[float, Assembly]]) -> Defects:
        """Return what keeps a design from going through given positions one after another.

        Parameters
        ----------
        places : sequence of (q, Assembly)
            The positions in the wanted order, as `Mechanism.find` gives them.

        Returns
        -------
        Defects
            Of circuit, branch and order.

        Examples
        --------
        >>> import assur
        >>> four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.2)
        >>> curve = four_bar.configuration_curve()
        >>> one, other = four_bar.assemblies(1.0)
        >>> curve.defects([(0.5, one), (1.0, other)]).circuit
        True
        >>> curve.defects([(0.5, one), (1.0, one), (2.0, one)])
        Defects(circuit=False, branch=False, order=False, branches=(0, 0, 0))
        """
        return defects_of(self, places)

    def plot(self, name: str | None = None, *, ax: Axes | None = None, dark: bool = False) -> Axes:
        """Draw a coordinate over q along every circuit (needs matplotlib).

        Circuits differ in colour, dead points of the driver are diamonds.

        Parameters
        ----------
        name : str, optional
            A coordinate: a link (its angle), a slide, ``"P.x"`` or ``"P.y"`` of a joint. By
            default the first slide on the ground, or the last link that turns about it.
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        dark : bool
            For dark backgrounds.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on. Data are in rad and m; the ticks are written in the units that suit.

        Raises
        ------
        InputError
            No such coordinate.

        Examples
        --------
        >>> import assur
        >>> axes = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve().plot("rocker")
        >>> [line.get_gid() for line in axes.lines]
        ['circuit 0', 'dead points']
        """
        from assur.pictures.maps.curve import curve_picture

        return curve_picture(self, name, ax, dark)

    def motion(self, circuit: int = 0, *, samples: int = 180) -> CircuitMotion:
        """Return positions along a circuit.

        Parameters
        ----------
        circuit : int
            Index of the circuit.
        samples : int
            Positions of each branch, closer together toward dead points.

        Returns
        -------
        CircuitMotion
            Positions in the order of the motion.

        Examples
        --------
        >>> import assur
        >>> curve = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve()
        >>> curve.motion(samples=3).q.round(6) + 0.0
        array([-1.371564,  0.      ,  1.371564,  0.      , -1.371564])
        """
        (index,) = checked_index(circuit, (len(self.circuits),), "circuit")
        samples = whole_number(samples, "samples", 2, MAX_POINTS)
        parts = []
        for number, direction in self.circuits[index].branches:
            branch = self.branches[number]
            low, high = ends_of(branch, self.mechanism)
            part = 0.5 - 0.5 * sin_cos(np.linspace(0.0, np.pi, samples))[1]
            if branch.period is not None:
                part = np.linspace(0.0, 1.0, samples)
            q = low + (high - low) * part
            parts.append((number, q if direction > 0 else q[::-1]))
        return _along(self.mechanism, self.branches, parts)


def _beside_dead_points(mechanism: MechanismModel, branch: Branch, q: Float) -> Motion:
    """Solve a branch, beside a dead point instead of on it, where rounding decides."""
    unit = 1.0 if has_driven_angle(mechanism) else size_of(mechanism)
    finite = [abs(end) for end in (branch.low, branch.high) if np.isfinite(end)]
    motion = solve(mechanism, q, order=0, assembly=branch.assembly, on_error="nan")
    for margin in MARGINS if branch.period is None else ():
        beside = margin * max([unit, *finite])
        inside = np.clip(q, branch.low + beside, branch.high - beside)
        motion = solve(mechanism, inside, order=0, assembly=branch.assembly, on_error="nan")
        if is_reached(motion.status[[0, -1]]).all():
            break
    return motion


def _along(
    mechanism: MechanismModel, branches: tuple[Branch, ...], parts: list[tuple[int, Float]]
) -> CircuitMotion:
    names = mechanism.joint_names, tuple(mechanism.links), tuple(mechanism.slides)
    rows: list[tuple[Float, Float, list[list[Float]]]] = []
    for index, (number, part) in enumerate(parts):
        # The end of one branch is the beginning of the next.
        q = part if index == 0 else part[1:]
        branch = branches[number]
        motion = _beside_dead_points(mechanism, branch, q)
        values = [
            [motion.joint(name).value for name in names[0]],
            [motion.link(name).value for name in names[1]],
            [motion.slide(name).value for name in names[2]],
        ]
        rows.append((q, np.full(len(q), number), values))

    def joined(kind: int) -> dict[str, Float]:
        columns = names[kind]
        return {
            name: np.concatenate([values[kind][i] for _, _, values in rows])
            for i, name in enumerate(columns)
        }

    return CircuitMotion(
        np.concatenate([q for q, _, _ in rows]),
        np.concatenate([number for _, number, _ in rows]),
        joined(0),
        {name: np.unwrap(angle) for name, angle in joined(1).items()},
        joined(2),
    )
