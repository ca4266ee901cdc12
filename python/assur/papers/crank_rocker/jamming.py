"""The crank-rocker that becomes a slider-crank while friction jams it; see `crank_rocker.run`.

The paper does not say what locks. Assumption: joint C jams when the transmission angle falls to
its least value; coupler and rocker then move as one rigid rod BD of the length S* at that instant,
and the support D slides along the line of centres. Without friction this is the paper's collinear
rod. The transmission angle depends on BD alone, so it stays at its least value while D slides; the
rocker moves again when D has returned.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from assur import _core
from assur._arrays import Float, finite_array, flag, real_number
from assur._summary import summary
from assur._trig import sin_cos
from assur._validate import one_of
from assur.errors import DimensionError, InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["JammingEvent", "JammingRun", "run"]

Kind: TypeAlias = Literal["jam", "return", "dead point", "no return"]
Side: TypeAlias = Literal["outer", "inner"]
Ground: TypeAlias = float | Callable[[float], float]

# A turn has 720 positions: more turns would fill the memory.
MAX_TURNS = 10_000


@dataclass(frozen=True)
class JammingEvent:
    """A change of structure, or the end, of a run.

    Attributes
    ----------
    kind : {"jam", "return", "dead point", "no return"}
        C jams and D begins to slide; D has returned and the rocker swings again; the run ends
        because the slide reaches a dead point, or because D has not returned within a turn.
    t, phi1, l4 : float
        Time, s, crank angle, rad, and ground, m.
    side : {"outer", "inner"}
        Whether γ₂₃ is near π (D slides inward) or near 0 (D slides outward).
    ground_speed, rod_speed : (float, float)
        dl₄/dt, m/s, and the angular speed of rocker or rod, rad/s, before and after.
    text : str
        The event as a sentence.

    Examples
    --------
    >>> import assur
    >>> run = assur.crank_rocker.run(1.0, 4.5, 1.5, ground=4.995, gamma_min=0.2)
    >>> event = run.events[0]
    >>> event.kind, event.side, round(event.phi1, 6)  # rad
    ('jam', 'outer', 6.078212)
    """

    __repr__ = summary

    kind: Kind
    t: float
    phi1: float
    l4: float
    side: Side
    ground_speed: tuple[float, float]
    rod_speed: tuple[float, float]
    text: str


@dataclass(frozen=True, eq=False, repr=False)
class JammingRun:
    """A motion in time; made by `run`. A is the origin, D on the negative x-axis.

    Attributes
    ----------
    t, phi1, l4, gamma : numpy.ndarray
        Time, s, crank angle, rad, distance AD, m, transmission angle, rad; shape (n,).
    sliding : numpy.ndarray of bool
        Whether D slides.
    B, C, D : numpy.ndarray
        Positions of the joints, m, shape (n, 2).
    events : tuple of JammingEvent
        In order; their times are among `t`.

    Examples
    --------
    >>> import assur
    >>> run = assur.crank_rocker.run(1.0, 4.5, 1.5, ground=4.995, gamma_min=0.2)
    >>> [event.kind for event in run.events], run.C.shape == (len(run.t), 2)
    (['jam', 'return'], True)
    """

    t: Float
    phi1: Float
    l4: Float
    gamma: Float
    sliding: npt.NDArray[np.bool_]
    B: Float
    C: Float
    D: Float
    events: tuple[JammingEvent, ...]

    def __repr__(self) -> str:
        kinds = ", ".join(event.kind for event in self.events) or "no events"
        return f"<assur.crank_rocker.JammingRun of {len(self.t)} positions: {kinds}>"

    def plot(
        self,
        what: Literal["positions", "ground", "angle"] = "positions",
        *,
        ax: Axes | None = None,
        degrees: bool = True,
        dark: bool = False,
    ) -> Axes:
        """Draw successive positions, or a diagram over the crank's angle (needs matplotlib).

        Parameters
        ----------
        what : {"positions", "ground", "angle"}
            Positions of the first turn, those of the slider-crank in colour, with the path of C;
            l₄ or the transmission angle over φ₁, with the events.
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        degrees : bool
            Whether φ₁ is in degrees.
        dark : bool
            Colours for a dark canvas.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on.

        References
        ----------
        Manzhosov and Petrova, figure 8.

        Examples
        --------
        >>> import assur
        >>> run = assur.crank_rocker.run(1.0, 4.5, 1.5, ground=4.995, gamma_min=0.2)
        >>> [text.get_text() for text in run.plot("ground").texts]
        ['4.9775 at 360°', 'C jams at 348.3°', 'D is back at 371.7°']
        """
        from assur.papers.crank_rocker.jamming_picture import jamming_picture

        one_of(what, ("positions", "ground", "angle"), "what")
        return jamming_picture(self, what, ax, flag(degrees, "degrees"), dark)


def run(
    l1: float,
    l2: float,
    l3: float,
    ground: Ground,
    gamma_min: float | tuple[float, float],
    *,
    speed: float = 1.0,
    phi0: float = math.pi / 2,
    turns: float = 1.0,
) -> JammingRun:
    """Simulate a crank-rocker that moves as a slider-crank while friction jams it.

    Parameters
    ----------
    l1, l2, l3 : float
        Crank, coupler and rocker, m.
    ground : float or callable
        l₄, m: a number, or a function of time, s.
    gamma_min : float or (float, float)
        Transmission angle below which the rocker does not move, rad: on both sides, or on the outer
        and on the inner one. `crank_rocker.least_transmission_angle` gives the paper's, and the
        exact ones.
    speed : float
        Speed of the crank, rad/s, of either sign.
    phi0 : float
        Crank angle at time 0, rad; 0 where its pin is farthest from D.
    turns : float
        Number of turns to simulate.

    Returns
    -------
    JammingRun
        Positions are continuous, also at events; speeds jump there and are stored in the events.

    Raises
    ------
    PositionError
        A start at which friction blocks the motion, or that the coupler does not reach.
    DimensionError, InputError
        Lengths that are not positive, arguments that are not numbers.

    Notes
    -----
    The paper does not say what locks. Assumption: joint C locks and D slides along the line of
    centres, from the instant γ = γ_min until D has returned.

    References
    ----------
    Manzhosov and Petrova, section 3 and figure 8.

    Examples
    --------
    >>> import assur, math
    >>> result = assur.crank_rocker.run(1, 4.5, 1.5, 4.995, gamma_min=0.2)
    >>> [(event.kind, round(math.degrees(event.phi1), 6)) for event in result.events]
    [('jam', 348.255903), ('return', 371.744097)]
    """
    numbers = {"l1": l1, "l2": l2, "l3": l3, "speed": speed}
    values = {n: real_number(v, n) for n, v in {**numbers, "phi0": phi0, "turns": turns}.items()}
    for name in ("l1", "l2", "l3"):
        if values[name] <= 0.0:
            message = f"{name} is {values[name]!r}: a length must be positive"
            raise DimensionError(message, dimension=name, value=values[name])
    both = finite_array(gamma_min, "gamma_min")
    if both.shape not in ((), (2,)) or not ((both > 0.0) & (both < math.pi / 2)).all():
        message = f"gamma_min is {gamma_min!r}: an angle above 0 and below π/2 rad is needed"
        raise InputError(message)
    outer, inner = np.broadcast_to(both, (2,)).tolist()
    case: dict[str, Any] = {**values, "gamma_min": (outer, inner)}
    if values["speed"] == 0.0 or not 0.0 < values["turns"] <= MAX_TURNS:
        message = (
            f"speed is {speed!r} and turns {turns!r}: the crank must turn, "
            f"at most {MAX_TURNS} turns"
        )
        raise InputError(message)
    if not math.isfinite(math.tau * values["turns"] / values["speed"]):
        message = f"speed is {speed!r}: the time of {turns!r} turns is beyond the greatest number"
        raise InputError(message, value=values["speed"])

    def ground_at(t: float) -> float:
        what = f"ground at t = {t!r}" if callable(ground) else "ground"
        number = real_number(ground(t) if callable(ground) else ground, what)
        if number <= 0.0:
            message = f"{what} is {number!r}: a length must be positive"
            raise DimensionError(message, dimension="l4", value=number)
        return number

    fixed = None if callable(ground) else ground_at(0.0)
    ground_of = ground_at if fixed is None else lambda _: fixed
    made = _core.crank_rocker_run(case, ground_of)
    t, l4 = made["t"], made["l4"]
    return JammingRun(
        t,
        values["phi0"] + values["speed"] * t,
        l4,
        made["gamma"],
        made["sliding"],
        made["b"].reshape(-1, 2),
        made["c"].reshape(-1, 2),
        np.stack([-l4, np.zeros_like(l4)], axis=-1),
        tuple(_event(case, **event) for event in made["events"]),
    )


def _event(
    case: dict[str, Any], kind: Kind, side: Side, ground: float, **numbers: Any
) -> JammingEvent:
    """Return an event with its sentence."""
    sign = 1.0 if side == "outer" else -1.0
    l2, l3 = case["l2"], case["l3"]
    cosine = sin_cos(case["gamma_min"][0 if side == "outer" else 1])[1]
    rod = math.sqrt(l2 * l2 + l3 * l3 + sign * 2.0 * l2 * l3 * cosine)
    texts = {
        "jam": f"C jams at γ = γ_min ({side}): D slides, BD stays {rod:.9g} m",
        "return": "D is back in its place: the rocker swings",
        "dead point": f"the rod of {rod:.9g} m just reaches the line of centres: dead point",
        "no return": (
            f"D does not come back: the ground is {ground:.9g} m, the slide goes from "
            f"{rod - case['l1']:.9g} to {rod + case['l1']:.9g} m"
        ),
    }
    at = f"t = {numbers['t']:.9g} s, φ₁ = {math.degrees(numbers['phi1']):.9g}°"
    return JammingEvent(kind=kind, side=side, **numbers, text=f"{at}: {texts[kind]}")
