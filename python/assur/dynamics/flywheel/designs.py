"""The flywheels of designs that each have their own coordinates where loads are not smooth."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import as_number, real_array
from assur._extreme import Extreme
from assur.errors import AssurError, InputError
from assur.flywheel.result import Flywheel, curve_of, problem_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from typing_extensions import Self

    from assur._arrays import Float, Number
    from assur.dynamics.model import MachineModel
    from assur.flywheel.result import Curve


class FlywheelOfDesigns(Flywheel):
    """The flywheels of a batch, one after another."""

    def __init__(self, each: Sequence[Flywheel], shape: tuple[int, ...]) -> None:
        self._each = tuple(each)

        def stacked(values: list[Any]) -> Any:
            numbers = np.array(values, np.float64).reshape(shape)
            numbers.flags.writeable = False
            return numbers

        def extreme(all_: list[Extreme]) -> Extreme:
            return Extreme(
                stacked([peak.value for peak in all_]),
                stacked([peak.q for peak in all_]),
            )

        super().__init__(
            inertia=stacked([flywheel.inertia for flywheel in each]),
            speed0=stacked([flywheel.speed0 for flywheel in each]),
            motor_moment=stacked([flywheel.motor_moment for flywheel in each]),
            extremes=(
                extreme([flywheel.max for flywheel in each]),
                extreme([flywheel.min for flywheel in each]),
            ),
            period=stacked([flywheel.period for flywheel in each]),
            mean=each[0].mean,
            turn=each[0].turn,
            shape=shape,
        )

    @classmethod
    def of(
        cls,
        machine: MachineModel,
        asked: tuple[Any, Any, Any, int, str],
        size_one: Callable[[MachineModel, Any, Any, Any, int, str], Flywheel],
    ) -> Self:
        """Size the flywheel of each design for a fluctuation, mean speed and mean."""
        fluctuation, speed, mean, turns, on_error = asked
        try:
            fluctuations, speeds = (
                np.broadcast_to(real_array(value, name), machine.shape)
                for value, name in ((fluctuation, "fluctuation"), (speed, "mean_speed"))
            )
        except ValueError as error:
            message = f"fluctuation and mean_speed do not fit the designs, {machine.shape}"
            raise InputError(message) from error
        each = []
        for index in np.ndindex(machine.shape):
            demand = float(fluctuations[index]), float(speeds[index])
            try:
                each.append(size_one(machine.design(index), *demand, mean, turns, on_error))
            except AssurError as error:
                error.design = index
                raise
        return cls(each, machine.shape)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._each, self.shape)

    def _problem(self, entry: tuple[int, ...]) -> str | None:
        flywheel = self._each[int(np.ravel_multi_index(entry, self.shape))]
        return problem_of(flywheel, ())

    def _curve(self, what: Curve, x: Float) -> Number:
        curves = np.array([curve_of(flywheel, what, x) for flywheel in self._each], np.float64)
        curves = curves.reshape(self.shape + x.shape)
        curves.flags.writeable = False
        return as_number(curves)
