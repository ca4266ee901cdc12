"""Centres of mass in the drawing's coordinates, as CAD programs give them."""

from __future__ import annotations

import math
import pickle
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from assur import Body, Gravity, Machine
from assur.dynamics.forces.joint_places import mass_centre

if TYPE_CHECKING:
    from pathlib import Path

JOINTS = {"A": (0.3, -0.2), "B": (1.1, 0.4), "C": (4.1, 3.2), "D": (4.8, 0.1), "P": (3.0, 4.0)}
LINKS = {"ground": "AD", "crank": "BA", "coupler": "BCP", "rocker": "DC"}
PLACES = {"crank": (0.9, 0.1), "coupler": (2.5, 2.2), "rocker": (4.0, 1.5)}


def four_bar() -> assur.Mechanism:
    return assur.Mechanism(JOINTS, LINKS, "crank")


def local(link: str, at: tuple[float, float]) -> complex:
    """A point in the frame of a link's first two joints."""
    first, second = (complex(*JOINTS[name]) for name in LINKS[link][:2])
    axis = (second - first) / abs(second - first)
    return (complex(*at) - first) * axis.conjugate()


@pytest.mark.parametrize("link", PLACES)
def test_the_place_in_the_frame(link: str) -> None:
    machine = Machine(four_bar(), bodies={link: Body(mass=2.0, inertia=0.1, drawn=PLACES[link])})
    body = machine.bodies[link]
    assert (body.mass, body.inertia, body.drawn) == (2.0, 0.1, None)
    assert body.at == pytest.approx(
        (local(link, PLACES[link]).real, local(link, PLACES[link]).imag)
    )
    assert mass_centre(four_bar(), link, body) == pytest.approx(local(link, PLACES[link]))


def test_its_weight_acts_there() -> None:
    """By the work of the weights, for a small turn."""
    bodies = {link: Body(mass=3.0, drawn=at) for link, at in PLACES.items()}
    machine = Machine(four_bar(), bodies=bodies, loads=[Gravity()])
    own = four_bar()
    assert own.q0 == pytest.approx(math.atan2(-0.6, -0.8))
    heights = sum(at[1] for at in PLACES.values())
    assert machine.potential(own.q0) == pytest.approx(3.0 * 9.81 * heights, rel=1e-12)


def test_a_link_of_no_joints_and_the_ground() -> None:
    own = assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 1), "D": (3, 0)},
        links={"ground": "AD", "crank": "AB", "block": "B", "bar": []},
        driver="crank",
        slides={
            "across": assur.Slide("block", on="bar", angle=0.5 * math.pi),
            "along": assur.Slide("bar", on="ground", angle=0.0, origin="D"),
        },
    )
    bodies = {
        link: Body(mass=1.0, drawn=(1.5, 2.5)) for link in ("ground", "crank", "block", "bar")
    }
    machine = Machine(own, bodies=bodies, loads=[Gravity()])
    assert machine.bodies["ground"].at == (1.5, 2.5)
    assert machine.potential(own.q0) == pytest.approx(4.0 * 9.81 * 2.5)


def test_the_drawing_is_that_of_the_design() -> None:
    """At its own q0, in its own assembly; for other designs the place in the link stays."""
    own = four_bar().with_dimensions({"coupler.length": 4.5})
    other = own.with_assembly(-own.assembly)
    for mechanism in (own, other):
        joints = mechanism.joints
        middle = tuple(np.mean([joints["B"], joints["C"]], axis=0))
        machine = Machine(mechanism, bodies={"coupler": Body(mass=1.0, drawn=middle)})
        assert machine.bodies["coupler"].at == pytest.approx((2.25, 0.0), abs=1e-14)
    batch = machine.of(other.with_dimensions({"coupler.length": [4.4, 4.6]}))
    assert batch.bodies == machine.bodies


def test_copies_and_files(tmp_path: Path) -> None:
    machine = Machine(
        four_bar(), bodies={link: Body(mass=3.0, drawn=at) for link, at in PLACES.items()}
    )
    assert pickle.loads(pickle.dumps(machine)) == machine
    path = tmp_path / "machine.toml"
    machine.save(path)
    assert assur.load(path) == machine
    text = path.read_text(encoding="utf-8")
    start = text.index("[bodies]")
    lines = [f"{link} = {{ mass = 3.0, drawn = {list(at)} }}" for link, at in PLACES.items()]
    path.write_text(text[:start] + "[bodies]\n" + "\n".join(lines) + "\n", encoding="utf-8")
    assert assur.load(path) == machine


def test_equality_and_repr() -> None:
    one = Body(mass=1.0, drawn=(0.5, 0.25))
    assert one == Body(mass=1.0, drawn=[0.5, 0.25])  # type: ignore[arg-type]
    assert one != Body(mass=1.0, drawn=(0.5, 0.3))
    assert one != Body(mass=1.0, at=(0.5, 0.25))
    assert repr(one) == "Body(mass=1.0, inertia=0.0, at=None, drawn=(0.5, 0.25))"
    assert eval(repr(one), {"Body": Body}) == one


def test_refused() -> None:
    with pytest.raises(assur.InputError, match="both at and drawn are given"):
        Body(mass=1.0, at="A", drawn=(0.0, 1.0))
    with pytest.raises(assur.InputError, match="Body drawn is 'A': real numbers are"):
        Body(mass=1.0, drawn="A")  # type: ignore[arg-type]
    batch = four_bar().with_dimensions({"coupler.length": [4.4, 4.6]})
    body = {"coupler": Body(mass=1.0, drawn=(0.0, 1.0))}
    with pytest.raises(assur.InputError, match=r"this is a batch \(2,\): make the machine of one"):
        Machine(batch, bodies=body)
    with pytest.raises(assur.InputError, match="cannot be assembled at its q0: give at"):
        Machine(four_bar().with_dimensions({"coupler.length": 40.0}), bodies=body)
    with pytest.raises(assur.InputError, match="couplr"):
        Machine(four_bar(), bodies={"couplr": Body(mass=1.0, drawn=(0.0, 1.0))})
