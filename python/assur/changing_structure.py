"""The crank-rocker that becomes a slider-crank where friction jams it; see `crank_rocker.run`.

What locks is not in the paper. The reading here, an assumption: joint C jams where the
transmission angle falls to its least; coupler and rocker then move as one rigid rod BD of the
length S* of that moment, and the support D slides along the line of centres. With no friction this
is the paper's collinear rod. The transmission angle depends on BD alone, so it stays at its least
during the slide; the rocker goes on when D is back at its place.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._checks import real_array
from assur.errors import DimensionError, InputError, PositionError

__all__ = ["Event", "Run", "run"]

Float: TypeAlias = npt.NDArray[np.float64]
Ground: TypeAlias = float | Callable[[float], float]

# Between two looks at the crank, rad: a jam that begins and ends within that shows by its summit.
LOOK = math.pi / 360
# Step of the differences for a moving ground's speed, of a look: errors of its third power.
GROUND_STEP = 1e-3
GOLDEN = (math.sqrt(5) - 1) / 2


@dataclass(frozen=True)
class Event:
    """What happens at a moment of a run.

    Attributes
    ----------
    kind : {"jam", "return", "dead point", "no return"}
        C jams, so that D slides; D is back, so that the rocker swings again; the slide comes to
        a dead point and the run ends; the run ends in a slide that has not returned within a turn.
    t, phi1, l4 : float
        Time, s, crank angle, rad, and ground, m.
    side : {"outer", "inner"}
        γ₂₃ near π (D slides inward), or near 0 (outward).
    ground_speed, rod_speed : (float, float)
        dl₄/dt, m/s, and the speed of rocker or rod, rad/s, before and after.
    text : str
        The same in words.
    """

    kind: Literal["jam", "return", "dead point", "no return"]
    t: float
    phi1: float
    l4: float
    side: Literal["outer", "inner"]
    ground_speed: tuple[float, float]
    rod_speed: tuple[float, float]
    text: str


@dataclass(frozen=True, eq=False)
class Run:
    """A motion in time; made by `run`. A is the origin, D on the negative x-axis.

    Attributes
    ----------
    t, phi1, l4, gamma : numpy.ndarray
        Time, crank angle, place of D (its distance from A), transmission angle; shape (n,).
    sliding : numpy.ndarray of bool
        Whether D slides.
    B, C, D : numpy.ndarray
        Places of the joints, m, shape (n, 2).
    events : tuple of Event
        In order; their moments are among `t`.
    """

    t: Float
    phi1: Float
    l4: Float
    gamma: Float
    sliding: npt.NDArray[np.bool_]
    B: Float
    C: Float
    D: Float
    events: tuple[Event, ...]


def run(
    l1: float,
    l2: float,
    l3: float,
    ground: Ground,
    gamma_min: float,
    speed: float = 1.0,
    phi0: float = math.pi / 2,
    turns: float = 1.0,
) -> Run:
    """Follow a crank-rocker that goes on as a slider-crank where friction jams it.

    Parameters
    ----------
    l1, l2, l3 : float
        Crank, coupler and rocker, m.
    ground : float or callable
        l₄, m: a number, or a function of the time, s, that gives one.
    gamma_min : float
        Transmission angle below which the rocker does not move, rad.
    speed : float
        Speed of the crank, rad/s, of either sign.
    phi0 : float
        Crank angle at the time 0, rad, from where its pin is farthest from D.
    turns : float
        Turns to be followed.

    Returns
    -------
    Run
        Positions are continuous, also at events; speeds jump there and are given with them.

    Raises
    ------
    PositionError
        A start where motion is not passed on, or that the coupler does not reach.
    DimensionError, InputError
        Lengths that are not positive, numbers that are none.

    Notes
    -----
    What locks is an assumption: joint C, with D free to slide along the line of centres, from the
    moment γ = γ_min until D is back at its place.

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
    return _Follower(l1, l2, l3, ground, gamma_min, speed, phi0, turns).run()


class _Follower:
    def __init__(
        self,
        l1: Any,
        l2: Any,
        l3: Any,
        ground: Ground,
        gamma_min: Any,
        speed: Any,
        phi0: Any,
        turns: Any,
    ) -> None:
        numbers = {"l1": l1, "l2": l2, "l3": l3, "gamma_min": gamma_min, "speed": speed}
        numbers |= {"phi0": phi0, "turns": turns}
        values = {name: _number(value, name) for name, value in numbers.items()}
        for name in ("l1", "l2", "l3"):
            if values[name] <= 0.0:
                message = f"{name} is {values[name]!r}: a length must be positive"
                raise DimensionError(message, dimension=name, value=values[name])
        if not 0.0 < values["gamma_min"] < math.pi / 2:
            message = f"gamma_min is {gamma_min!r}: an angle above 0 and below π/2 rad is needed"
            raise InputError(message)
        if values["speed"] == 0.0 or values["turns"] <= 0.0:
            message = f"speed is {speed!r} and turns {turns!r}: the crank must turn"
            raise InputError(message)
        self.l1, self.l2, self.l3 = values["l1"], values["l2"], values["l3"]
        self.speed, self.phi0 = values["speed"], values["phi0"]
        self.end = math.tau * values["turns"] / abs(self.speed)
        self.given = ground
        cosine = 2.0 * self.l2 * self.l3 * math.cos(values["gamma_min"])
        squares = self.l2**2 + self.l3**2
        # BD where C jams, by the side.
        self.limit = {"outer": math.sqrt(squares + cosine), "inner": math.sqrt(squares - cosine)}
        self.events: list[Event] = []

    # -- geometry -----------------------------------------------------------------------------

    def ground(self, t: float) -> float:
        value = self.given(t) if callable(self.given) else self.given
        number = _number(value, f"ground at t = {t!r}" if callable(self.given) else "ground")
        if number <= 0.0:
            message = f"ground is {number!r} at t = {t!r}: a length must be positive"
            raise DimensionError(message, dimension="l4", value=number)
        return number

    def ground_speed(self, t: float) -> float:
        if not callable(self.given):
            return 0.0
        h = GROUND_STEP * LOOK / abs(self.speed)
        low = max(t - h, 0.0)
        return (self.ground(t + h) - self.ground(low)) / (t + h - low)

    def phi(self, t: float) -> float:
        return self.phi0 + self.speed * t

    def distance(self, t: float) -> float:
        """BD with the rocker's support in its place."""
        return abs(self.ground(t) + self.l1 * _unit(self.phi(t)))

    def over(self, t: float) -> tuple[float, str]:
        """How far BD is beyond the nearer limit, and which one."""
        s = self.distance(t)
        outer, inner = s - self.limit["outer"], self.limit["inner"] - s
        return (outer, "outer") if outer > inner else (inner, "inner")

    def slide(self, t: float, side: str) -> float:
        """Place of D while it slides; at a dead point, and where the rod is too short, its last."""
        sine, cosine = math.sin(self.phi(t)), math.cos(self.phi(t))
        under = self.limit[side] ** 2 - (self.l1 * sine) ** 2
        return -self.l1 * cosine + math.sqrt(max(under, 0.0))

    def away(self, t: float, side: str) -> float:
        """How far D is from its place, positive while it slides; negative where it cannot."""
        if abs(self.l1 * math.sin(self.phi(t))) > self.limit[side]:
            return -math.inf
        gap = self.ground(t) - self.slide(t, side)
        return gap if side == "outer" else -gap

    # -- the run ------------------------------------------------------------------------------

    def run(self) -> Run:
        first, side = self.over(0.0)
        if not first < 0.0:
            self.refuse(side)
        looks = max(2, math.ceil(self.end * abs(self.speed) / LOOK))
        times = [self.end * i / looks for i in range(looks + 1)]
        rows: list[tuple[float, str]] = [(0.0, "")]
        mode = ""
        for before, after in itertools.pairwise(times):
            at = before
            # More than one thing may happen between two looks.
            while (moment := self.next_event(at, after, mode)) is not None:
                at = moment
                rows.append((at, mode))
                mode, ended = self.pass_event(at, mode)
                rows.append((at, mode))
                if ended:
                    return self.finish(rows[:-1])
            rows.append((after, mode))
        if mode and self.end - self.events[-1].t > math.tau / abs(self.speed):
            self.note("no return", self.end, mode, (math.nan, math.nan), (math.nan, math.nan))
        return self.finish(rows)

    def refuse(self, side: str) -> None:
        s, low, high = self.distance(0.0), abs(self.l2 - self.l3), self.l2 + self.l3
        if not low <= s <= high:
            message = (
                f"the coupler does not reach at the start: BD is {s:.9g}, not in {low} … {high}"
            )
        else:
            gamma23 = math.acos((self.l2**2 + self.l3**2 - s * s) / (2 * self.l2 * self.l3))
            gamma = min(gamma23, math.pi - gamma23)
            message = (
                f"the start at phi0 = {self.phi0!r} is blocked ({side}): its transmission angle "
                f"{gamma:.6g} is not above gamma_min; begin outside the blocked zone"
            )
        raise PositionError(message, q=self.phi0)

    def next_event(self, low: float, high: float, mode: str) -> float | None:
        """The first time in an interval at which the mode ends."""

        def ends(t: float) -> float:
            return -self.away(t, mode) if mode else self.over(t)[0]

        # Armed after entry: there the function is 0 itself.
        start = low + 1e-9 * (high - low) if self.events and self.events[-1].t == low else low
        if start >= high:
            return None
        if start > low and ends(start) > 0.0:
            # It was entered for no more than that.
            return start
        top = high
        if not ends(high) > 0.0:
            step = 1e-6 * (high - start)
            if not (ends(start + step) > ends(start) and ends(high) < ends(high - step)):
                return None
            top = _summit(ends, start, high)
        return _root(ends, start, top) if ends(top) > 0.0 else None

    def pass_event(self, t: float, mode: str) -> tuple[str, bool]:
        """Goes through an event: the mode after it, and whether the run ends."""
        if not mode:
            side = self.over(t)[1]
            self.note("jam", t, side, *self.speeds(t, side))
            return side, False
        dead = abs(self.l1 * math.sin(self.phi(t))) >= self.limit[mode] * (1.0 - 1e-12)
        if dead:
            self.note("dead point", t, mode, (math.nan, math.nan), (math.nan, math.nan))
            return mode, True
        grounds, rods = self.speeds(t, mode)
        self.note("return", t, mode, grounds[::-1], rods[::-1])
        return "", False

    def speeds(self, t: float, side: str) -> tuple[tuple[float, float], tuple[float, float]]:
        """Of ground and rocker or rod: as a crank-rocker, as a slider-crank."""
        from assur.crank_rocker import solve

        phi, l4, moving = self.phi(t), self.ground(t), self.ground_speed(t)
        sine, cosine = math.sin(phi), math.cos(phi)
        rod = math.sqrt(self.limit[side] ** 2 - (self.l1 * sine) ** 2)
        sliding = self.l1 * sine * self.speed * (1.0 - self.l1 * cosine / rod)
        lengths = (self.l1, self.l2, self.l3, l4)
        as_rocker = solve(phi, *lengths, speed=self.speed, ground_speed=moving).dphi3
        as_rod = solve(phi, *lengths, speed=self.speed, ground_speed=sliding).dphi3_first
        return (moving, sliding), (float(as_rocker), float(as_rod))

    def note(
        self,
        kind: Any,
        t: float,
        side: Any,
        grounds: tuple[float, float],
        rods: tuple[float, float],
    ) -> None:
        phi, limit = self.phi(t), self.limit[side]
        l4 = self.ground(t) if kind == "jam" else self.slide(t, side)
        low, high = limit - self.l1, limit + self.l1
        texts = {
            "jam": f"C jams at γ = γ_min ({side}): D slides, BD stays {limit:.9g} m",
            "return": "D is back in its place: the rocker swings",
            "dead point": f"the rod of {limit:.9g} m just reaches the line of centres: dead point",
            "no return": (
                f"D does not come back: the ground is {self.ground(t):.9g} m, the slide goes from "
                f"{low:.9g} to {high:.9g} m"
            ),
        }
        text = f"t = {t:.9g} s, φ₁ = {math.degrees(phi):.9g}°: {texts[kind]}"
        self.events.append(Event(kind, t, phi, l4, side, grounds, rods, text))

    def finish(self, rows: list[tuple[float, str]]) -> Run:
        t = np.array([time for time, _ in rows])
        sliding = np.array([bool(mode) for _, mode in rows])
        phi = self.phi0 + self.speed * t
        l4 = np.array(
            [self.slide(time, mode) if mode else self.ground(time) for time, mode in rows]
        )
        b = self.l1 * np.exp(1j * phi)
        d = -l4 + 0j
        s = np.abs(b - d)
        for side, limit in self.limit.items():
            s = np.where([mode == side for _, mode in rows], limit, s)
        product = 2.0 * s * self.l3
        turn = np.arccos(np.clip((s**2 + self.l3**2 - self.l2**2) / product, -1.0, 1.0))
        c = d + self.l3 * (b - d) / s * np.exp(1j * turn)
        cosine = (self.l2**2 + self.l3**2 - s**2) / (2.0 * self.l2 * self.l3)
        gamma23 = np.arccos(np.clip(cosine, -1.0, 1.0))
        gamma = np.minimum(gamma23, math.pi - gamma23)
        events = tuple(self.events)
        return Run(t, phi, l4, gamma, sliding, _places(b), _places(c), _places(d), events)


def _places(z: npt.NDArray[np.complex128]) -> Float:
    return np.stack([z.real, z.imag], axis=-1)


def _unit(angle: float) -> complex:
    return complex(math.cos(angle), math.sin(angle))


def _number(value: Any, name: str) -> float:
    array = real_array(value, name)
    if array.ndim or not np.isfinite(array):
        message = f"{name} is {value!r}: a finite number is needed"
        raise InputError(message)
    return float(array)


def _summit(of: Callable[[float], float], low: float, high: float) -> float:
    """Where a function is greatest between two times, if it rises and falls there."""
    a, b = low, high
    c, d = b - GOLDEN * (b - a), a + GOLDEN * (b - a)
    at_c, at_d = of(c), of(d)
    for _ in range(40):
        if at_c > 0.0 or at_d > 0.0:
            break
        if at_c > at_d:
            b, d, at_d = d, c, at_c
            c = b - GOLDEN * (b - a)
            at_c = of(c)
        else:
            a, c, at_c = c, d, at_d
            d = a + GOLDEN * (b - a)
            at_d = of(d)
    return c if at_c > at_d else d


def _root(of: Callable[[float], float], low: float, high: float) -> float:
    """Where a function becomes positive, to the last bit: below it is not, above it is."""
    while low < (middle := 0.5 * (low + high)) < high:
        if of(middle) > 0.0:
            high = middle
        else:
            low = middle
    return high
