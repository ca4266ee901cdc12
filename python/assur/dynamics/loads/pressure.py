"""Pressures in the cylinders of slides.

The core reads the fields of these classes by name (rust/py/src/convert).
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import Any

from assur._arrays import Float, not_negative, real_number
from assur._summary import typed
from assur._validate import checked_name, one_of
from assur.dynamics.loads.load_values import Value, checked_value
from assur.dynamics.loads.numbers import OfMachines, not_negative_numbers
from assur.dynamics.loads.one_way import DIRECTIONS, Way, check_way
from assur.dynamics.loads.table import replace_fields
from assur.errors import InputError

__all__ = ["ATMOSPHERE", "Gas", "Pressure"]

# The standard atmosphere, Pa (ISO 2533).
ATMOSPHERE: Any = 101325.0


@dataclass(frozen=True)
class Gas:
    """A closed gas in a cylinder: p Vⁿ = p₀ V₀ⁿ.

    Parameters
    ----------
    pressure : float
        Absolute pressure p₀ where the slide's value is `at`, Pa.
    volume : float
        Volume V₀ there, m³, that of the clearance included.
    at : float
        Value of the slide, m.
    exponent : float
        n: 1 at constant temperature, 1.4 for air that exchanges no heat.

    Notes
    -----
    A gas that acts in both directions (without ``while_``) is a spring: its energy
    −∫ (p − p_ambient) dV counts in `Machine.potential`, 0 at `at`, not as work. See Y. A. Çengel &
    M. A. Boles, *Thermodynamics*, 8th ed. (2015), 4.1.

    Examples
    --------
    >>> import assur
    >>> air = assur.Gas(pressure=1e5, volume=5e-4, at=0.5, exponent=1.3)
    """

    pressure: float
    volume: float
    at: float
    _: KW_ONLY
    exponent: float = 1.4

    def __post_init__(self) -> None:
        numbers = {
            name: real_number(getattr(self, name), f"Gas {name}")
            for name in ("pressure", "volume", "at", "exponent")
        }
        for name in ("pressure", "volume", "exponent"):
            if numbers[name] <= 0.0:
                message = f"Gas: {name} is {numbers[name]:g}, it must be positive"
                raise InputError(message, value=numbers[name])
        replace_fields(self, **numbers)


@dataclass(frozen=True, eq=False)
class Pressure(OfMachines):
    """A pressure in the cylinder of a slide.

    A force area × (pressure − ambient) along the guide on the sliding link, at its sliding point;
    its reaction acts on the link that carries the guide. Pressures are absolute: for one that a
    gauge shows, above the atmosphere's, pass ``ambient=0``.

    Parameters
    ----------
    slide : str
        The slide.
    area : float
        Area of the piston, m².
    pressure : Gas, float, array_like, Table or callable
        Absolute pressure, Pa: a closed `Gas`, a number (an array: see `Body`), a `Table` over q or
        (``over=``) over the value of a slide, or a function of (t, q, speed). A four-stroke engine
        has a table over q with the period 4π; a compressor, whose lines of compression and
        expansion differ, has two pressures over its slide, each with its ``while_``.
    expands : {"forward", "backward"}
        The direction of the slide in which the volume grows: the pressure drives it there.
    ambient : float or array_like
        Pressure on the other side of the piston, Pa: the atmosphere's by default, 0 for a vacuum or
        a `pressure` that is already a difference.
    while_ : {"forward", "backward"}, optional
        See `Force`.
    over : str, optional
        The coordinate of `while_`: the slide itself by default.

    Examples
    --------
    The head of an engine is beyond the outer dead centre of its piston, where a tenth of the
    volume at the inner one (0.105 m) is left:

    >>> import assur
    >>> engine = assur.SliderCrank(crank=0.045, rod=0.15)
    >>> air = assur.Gas(pressure=1e5, volume=0.005 * 0.1, at=0.105, exponent=1.3)
    >>> pressure = assur.Pressure("bore", 0.005, air, expands="backward")
    >>> machine = assur.Machine(engine, loads=[pressure])
    >>> machine.reduced_moment([1.0, 6.283185307179586 - 1.0]).round(6)
    array([ 62.418733, -62.418733])
    """

    __repr__ = typed

    slide: str
    area: float
    pressure: Gas | Value
    expands: Way
    _: KW_ONLY
    ambient: float | Float = ATMOSPHERE
    while_: Way | None = None
    over: str | None = None

    def __post_init__(self) -> None:
        pressure: Any = self.pressure
        is_gas = isinstance(pressure, Gas)
        area = not_negative(self.area, "Pressure: area")
        if area == 0.0:
            message = "Pressure: area is 0: that of the piston is needed, m²"
            raise InputError(message, value=0.0)
        one_of(self.expands, DIRECTIONS, "Pressure expands")
        check_way(self)
        replace_fields(
            self,
            slide=checked_name(self.slide, "Pressure slide"),
            area=area,
            pressure=pressure if is_gas else checked_value(pressure, "Pressure pressure"),
            ambient=not_negative_numbers(self.ambient, "Pressure: ambient"),
        )
