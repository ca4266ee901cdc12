"""Induction motors from their rating plates, and speeds in revolutions a minute."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur

PLATE: Any = {"power": 7500.0, "rpm": 1450.0, "poles": 4, "breakdown": 2.5}


def torque(motor: assur.InductionMotor, speed: float) -> float:
    """Kloss's formula, written anew."""
    slip = 1.0 - speed / motor.synchronous
    return 2.0 * motor.breakdown / (slip / motor.slip + motor.slip / slip)


@pytest.mark.parametrize("frequency", [50.0, 60.0])
@pytest.mark.parametrize("poles", [2, 4, 6, 8])
@pytest.mark.parametrize("times", [1.01, 1.6, 2.5, 4.0])
def test_the_plate_is_a_point_of_the_curve(frequency: float, poles: int, times: float) -> None:
    """At the rated speed it gives the rated torque; the greatest torque is `times` that."""
    field = 2.0 * 60.0 * frequency / poles
    rated = 0.96 * field
    motor = assur.InductionMotor.from_plate(
        power=5000.0, rpm=rated, poles=poles, breakdown=times, frequency=frequency, ratio=3.0
    )
    speed = rated * 2.0 * math.pi / 60.0
    assert torque(motor, speed) == pytest.approx(5000.0 / speed, rel=1e-12)
    assert motor.breakdown == pytest.approx(times * 5000.0 / speed, rel=1e-12)
    assert motor.synchronous == pytest.approx(field * 2.0 * math.pi / 60.0, rel=1e-12)
    speeds = np.linspace(0.0, 0.999 * motor.synchronous, 20001)
    greatest = max(torque(motor, speed) for speed in speeds)
    assert greatest == pytest.approx(motor.breakdown, rel=1e-5)
    # On the stable branch: between the greatest torque and the speed of the field.
    assert 1.0 - speed / motor.synchronous < motor.slip
    assert motor.ratio == 3.0


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"rpm": 1500.0}, r"below that of the field, 1500 rpm with 4 poles at 50 Hz"),
        ({"poles": 3}, "poles is 3: an even number is needed"),
        ({"breakdown": 1.0}, r"breakdown is 1 times the rated torque: more than 1"),
        ({"power": 0.0}, "power is 0: a positive number is needed"),
        ({"frequency": math.inf}, "frequency is inf: a finite number is needed"),
        ({"rpm": "fast"}, "rpm"),
        ({"rpm": 100.0, "breakdown": 4.0}, "slip is"),
    ],
)
def test_plates_that_no_motor_has(changed: Any, message: str) -> None:
    with pytest.raises(assur.InputError, match=message):
        assur.InductionMotor.from_plate(**(PLATE | changed))


def test_revolutions_a_minute() -> None:
    assert assur.rpm(60) == pytest.approx(2.0 * math.pi, rel=1e-15)
    assert isinstance(assur.rpm(60), float)
    assert assur.rpm([[30.0], [-60.0]]).tolist() == [[math.pi], [-2.0 * math.pi]]
    wrong: Any = "fast"
    with pytest.raises(assur.InputError, match="rpm"):
        assur.rpm(wrong)
