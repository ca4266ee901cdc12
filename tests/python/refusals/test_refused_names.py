"""Names that are not Unicode text and unknown words are refused by name."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Body, Damper, Drive, Force, Machine, Slide, Spring, Torque, flywheel
from models.errors.refusals import BORE, JOINTS, LINKS, M, build, engine, link

if TYPE_CHECKING:
    from collections.abc import Callable

HALF = "A\ud800"  # half of a surrogate pair: no encoding has it
PHI = np.linspace(0.0, 2.0 * np.pi, 9)
ARRAY: Any = np.array(["raise", "nan"])

NAMES: dict[str, Callable[[Any], object]] = {
    "joint": lambda x: build(joints={**JOINTS, x: (1.0, 2.0)}),
    "member of a link": lambda x: build(**link(coupler=["B", "C", x])),
    "link": lambda x: build(links={**LINKS, x: ["P"]}),
    "driver": lambda x: build(driver=x),
    "drivers": lambda x: build(driver=["crank", x]),
    "drive": lambda x: build(driver=Drive(x)),
    "drive against": lambda x: build(driver=Drive("crank", relative_to=x)),
    "slide": lambda x: assur.Mechanism(**{**engine(), "slides": {x: BORE}}),
    "sliding link": lambda x: assur.Mechanism(
        **engine(bore=Slide(x, "ground", angle=0.0, origin="O"))
    ),
    "guide's link": lambda x: assur.Mechanism(
        **engine(bore=Slide("piston", x, angle=0.0, origin="O"))
    ),
    "origin": lambda x: assur.Mechanism(
        **engine(bore=Slide("piston", "ground", angle=0.0, origin=x))
    ),
    "assembly": lambda x: build(assembly={x: 1}),
    "assembly of a motion": lambda x: M.solve(1.0, assembly={x: 1}),
    "body": lambda x: Machine(M, bodies={x: Body()}),
    "centre of mass": lambda x: Machine(M, bodies={"crank": Body(mass=1.0, at=x)}),
    "force": lambda x: Machine(M, loads=[Force(x, (1.0, 0.0))]),
    "place of a force": lambda x: Machine(M, loads=[Force((x, (0.0, 0.0)), (1.0, 0.0))]),
    "axes": lambda x: Machine(M, loads=[Force("C", (1.0, 0.0), axes=x)]),
    "torque": lambda x: Machine(M, loads=[Torque(x, 1.0)]),
    "counterpart": lambda x: Machine(M, loads=[Torque("crank", 1.0, on=x)]),
    "spring": lambda x: Machine(M, loads=[Spring("C", x, 1.0, 1.0)]),
    "damper": lambda x: Machine(M, loads=[Damper(x, "C", 1.0)]),
    "event": lambda x: Machine(M, bodies={"crank": Body(inertia=1.0)}).run(
        1.0, events=[assur.events.TransmissionAngle(x, 0.5)]
    ),
    "between": lambda x: M.solve(1.0).transmission_angle("C", between=("B", x)),
}


PLACES = ("force", "spring", "damper")


@pytest.mark.parametrize("name", list(NAMES))
@pytest.mark.parametrize("wrong", [HALF, 7, ("A", "B"), b"A"], ids=["half", "7", "pair", "bytes"])
def test_non_names_are_refused(name: str, wrong: Any) -> None:
    # A pair is a sequence of drivers, the first of them a joint; a place of a load on a link.
    is_drivers = name == "driver" and isinstance(wrong, tuple)
    with pytest.raises(assur.StructureError if is_drivers else assur.InputError) as caught:
        NAMES[name](wrong)
    # The message itself can be printed, and shows the name.
    message = str(caught.value)
    message.encode()
    last = wrong[-1] if isinstance(wrong, tuple) and name in PLACES else wrong
    assert (caught.value.link == "A") if is_drivers else (ascii(last) in message)


@pytest.mark.parametrize("origin", [0, 0.0, False, b"", [], np.array("O")])
def test_an_origin_that_is_not_a_name_is_refused(origin: Any) -> None:
    with pytest.raises(assur.InputError, match="origin") as caught:
        assur.Mechanism(**engine(bore=Slide("piston", "ground", angle=0.0, origin=origin)))
    assert caught.value.slide == "bore"


def test_words_are_those_known_and_not_arrays() -> None:
    machine = Machine(M, bodies={"crank": Body(inertia=1.0)})
    asks: list[Callable[[], object]] = [
        lambda: machine.reduced_inertia(1.0, on_error=ARRAY),
        lambda: machine.flywheel(0.1, mean_speed=5.0, on_error=ARRAY),
        lambda: machine.flywheel(0.1, mean_speed=5.0, mean=ARRAY),
        lambda: machine.steady_state(5.0, mean=ARRAY),
        lambda: machine.run(1.0, method=ARRAY),
        lambda: assur.FourBar(1, 3, 3, 3, mode=ARRAY),
        lambda: assur.Table([0, 1], [1, 1], spline=ARRAY),
        lambda: Machine.from_table(PHI, 0 * PHI, 1.0, spline=ARRAY),
        lambda: flywheel.from_table(
            PHI, np.sin(PHI), 1.0, fluctuation=0.1, mean_speed=9.0, spline=ARRAY
        ),
        lambda: assur.slider_crank.stroke(1.0, 1.0, 3.0, method=ARRAY),
        lambda: assur.slider_crank.greatest_speed(3.0, method=ARRAY),
        lambda: assur.slider_crank.deviation(0.25, 2, quantity=ARRAY),
        lambda: assur.crank_rocker.solve(1.0, 1.0, 9.0, 6.0, 10.0, assembly=ARRAY),
    ]
    for ask in asks:
        with pytest.raises(assur.InputError, match="one of"):
            ask()


@pytest.mark.parametrize("sign", [np.array([1, -1]), np.array([]), "1", None, 2**70, [1]])
def test_a_sign_that_is_not_one_number_is_refused(sign: Any) -> None:
    for ask in (lambda: M.solve(1.0, assembly={"C": sign}), lambda: build(assembly={"C": sign})):
        with pytest.raises(assur.InputError, match=r"assembly\['C'\]"):
            ask()


def test_ends_of_springs_that_are_arrays_are_refused_or_read() -> None:
    place: Any = ("ground", np.array([1.0, 2.0]))
    spring = Spring("C", place, 1.0, 1.0)
    assert spring.second == ("ground", (1.0, 2.0))
    for wrong in (np.array(["A", "B"]), np.zeros(2), ("ground", np.zeros(3)), ("ground", "12")):
        ends: Any = wrong
        for make, end in (
            (lambda e=ends: Spring("C", e, 1.0, 1.0), "Spring second"),
            (lambda e=ends: Damper(e, "C", 1.0), "Damper first"),
        ):
            with pytest.raises(assur.InputError, match=f"^{end}"):
                make()


def test_a_diagram_has_a_number_of_points() -> None:
    f = flywheel.evaluate(PHI, 0.0 * PHI, 2.0, speed0=5.0)
    for points in (-1, 0, 1, 2.5, "9", None):
        with pytest.raises(assur.InputError, match="points"):
            f.energy_mass(points=points)  # type: ignore[arg-type]
    assert f.energy_mass(points=5)[0].shape == (5,)


def test_the_parts_used_here_are_mechanisms() -> None:
    """Else they would be refused for another reason."""
    assert M.structure.mobility == assur.Mechanism(**engine()).structure.mobility == 1
