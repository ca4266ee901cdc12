"""Faults once found, with their smallest examples."""

from __future__ import annotations

from math import atan2, pi

import numpy as np
import pytest

import assur
from assur import Slide, Status


def chain(loops: int, third: bool = True) -> assur.Mechanism:
    """Parallelograms in a row at 30°, a third bar in the first."""
    crank, rod = np.array([np.cos(pi / 6), np.sin(pi / 6)]), np.array([1.0, 0.0])
    joints = {f"O{i}": tuple(i * rod) for i in range(loops + 1)}
    joints |= {f"A{i}": tuple(i * rod + crank) for i in range(loops + 1)}
    links = {"ground": [f"O{i}" for i in range(loops + 1)]}
    links |= {f"crank{i}": [f"O{i}", f"A{i}"] for i in range(loops + 1)}
    links |= {f"rod{i}": [f"A{i - 1}", f"A{i}"] for i in range(1, loops + 1)}
    if third:
        joints |= {"F": (0.5, 0.0), "E": tuple(crank + rod / 2)}
        links["ground"].append("F")
        links["rod1"].append("E")
        links["third"] = ["F", "E"]
    return assur.Mechanism(joints=joints, links=links, driver="crank0")


@pytest.mark.parametrize("loops", [1, 3, 26])
def test_a_bad_condition_excuses_no_misfit(loops: int) -> None:
    m = chain(loops)
    assert m.solve(m.q0).status <= Status.NEAR_SINGULAR
    for length in (1.05, 1.0 + 1e-7):
        misfit = m.with_dimensions({"third.length": length}).solve(m.q0, on_error="nan")
        assert misfit.status == Status.UNREACHABLE
        assert "third" in misfit.explain()


def test_a_ground_without_joints_is_where_it_was_drawn() -> None:
    m = assur.Mechanism(
        joints={"A": (5, 3), "B": (2, 7)},
        links={"ground": [], "a": ["A"], "b": ["B"], "c": ["A", "B"]},
        slides={
            "s1": Slide("a", on="ground", angle=0.0),
            "s2": Slide("ground", on="b", angle=pi / 2, origin="B"),
        },
        driver="s1",
    )
    np.testing.assert_allclose(m.solve(m.q0).joint("B").value, (2, 7), atol=1e-14)


@pytest.mark.parametrize("count", [1, 2])
def test_excavators_with_two_drivers_each(count: int) -> None:
    """The arm's angle is driven from afar; the dyad's loop begins and ends at the boom."""
    joints: dict[str, tuple[float, float]] = {"O": (0, 0)}
    links: dict[str, list[str]] = {"ground": ["O"]}
    slides, drivers = dict[str, Slide](), list[str]()
    for i in range(count):
        a, b, c = f"A{i}", f"B{i}", f"C{i}"
        joints |= {a: (2, 1), b: (1, 0.8), c: (2.5, 1.8)}
        links |= {f"boom{i}": ["O", a, b], f"arm{i}": [a, c], f"cyl{i}": [b], f"rod{i}": [c]}
        slides[f"s{i}"] = Slide(f"rod{i}", on=f"cyl{i}", angle=atan2(1, 1.5), origin=b)
        drivers += [f"s{i}", f"arm{i}"]
    m = assur.Mechanism(joints=joints, links=links, slides=slides, driver=drivers)
    assert set(m.assembly) == {f"B{i}" for i in range(count)}
    assert {g.kind for g in m.structure.groups} == {"RRR"}
    np.testing.assert_allclose(m.solve(m.q0).joint("C0").value, (2.5, 1.8), atol=1e-14)


def test_a_locked_angle_makes_a_group_of_class_three() -> None:
    places = {"A": (0, 0), "B": (1, 0.4), "C": (3, 1.6), "D": (4, 0), "F": (1.5, 3.3)}
    m = assur.Mechanism(
        joints=places | {"G": (5, 2.5), "H": (5.6, 0), "M": (-0.3, 4)},
        links={
            "ground": "ADHM",
            "crank": "AB",
            "b": "BC",
            "r": "DC",
            "p": "CG",
            "h": "HG",
            "q": "CF",
            "m": "MF",
        },
        driver=assur.Drive("q", relative_to="h"),
    )
    assert m.structure.cls == 3
    # Solved at the drawing, and beside it.
    motion = m.solve(float(m.q0) + np.array([-0.001, 0.0, 0.001]), order=1)
    for name, place in places.items():
        np.testing.assert_allclose(motion.joint(name).value[1], place, atol=1e-14)
    assert motion.residual.max() < 1e-14
    assert np.abs(motion.joint("B").d1).max() > 0.0


def test_a_leg_without_length_has_no_position() -> None:
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0), "E": (3, 4)},
        links={"ground": "AD", "crank": "AB", "coupler": "BEC", "rocker": "DC"},
        driver="crank",
    ).with_dimensions({"coupler.C.x": 0.0, "coupler.C.y": 0.0, "rocker.length": 3.8})
    motion = m.solve(0.0, on_error="nan")
    assert motion.status == Status.UNREACHABLE
    assert "length zero" in motion.explain()


def test_a_translation_has_its_centre_at_infinity() -> None:
    motion = assur.SliderCrank(1.0, 3.0, 0.2).solve(1.0)
    centre = motion.instant_centre("piston", "ground")
    assert centre[0] == 0.0
    assert np.isinf(centre[1])


def test_a_doubled_guide_turned_round_does_not_fit() -> None:
    m = assur.Mechanism(
        joints={"O": (0, 0), "A": (0.3, 0.4), "B": (2.3, 0), "E": (2.6, 0)},
        links={"ground": "O", "crank": "OA", "rod": "AB", "piston": "BE"},
        slides={
            "bore": Slide("piston", on="ground", angle=0.0, origin="O"),
            "tail": Slide("piston", on="ground", angle=0.0, origin="O"),
        },
        driver="crank",
    )
    assert m.structure.redundant == ("tail",)
    turned = m.with_dimensions({"tail.link_angle": pi})
    assert m.solve(1.0).status == Status.OK
    assert turned.solve(1.0, on_error="nan").status == Status.UNREACHABLE


def test_every_assembly_of_a_chain_is_found_at_once() -> None:
    m = chain(8, third=False)
    found = m.assemblies(m.q0)
    assert len(set(found)) == 256
    assert (m.solve(m.q0, order=0, assembly=found[100]).status) <= Status.SINGULAR


def test_assemblies_beyond_a_change_point_lead_there() -> None:
    m = assur.FourBar(1.0, 3.0, 1.0, 3.0)
    places = {
        tuple(m.solve(4.0, order=0, assembly=a).joint("C").value.round(9))
        for a in m.assemblies(4.0)
    }
    assert len(places) == 2


def test_transmission_in_a_slot_of_an_arm_with_two_joints() -> None:
    """A Whitworth: the guide passes through the arm's pivot, so all force is passed on."""
    m = assur.Mechanism(
        joints={"O": (0, 0), "A": (0.1, 0), "D": (0, -0.25), "E": (0.26, 0.4), "F": (-0.3, 0.5)},
        links={
            "ground": "OD",
            "crank": "OA",
            "arm": "DE",
            "block": "A",
            "rod": "EF",
            "ram": "F",
        },
        slides={
            "slot": Slide("block", on="arm", angle=atan2(0.25, 0.1), origin="D"),
            "way": Slide("ram", on="ground", angle=0.0),
        },
        driver="crank",
    )
    motion = m.solve(np.linspace(0, 2 * pi, 9))
    np.testing.assert_allclose(motion.transmission_angle("slot"), pi / 2, atol=1e-14)
    rod = motion.link("rod").value
    np.testing.assert_allclose(
        motion.transmission_angle("F"), np.arcsin(np.abs(np.cos(rod))), atol=1e-14
    )


def test_change_point_before_a_dyad_that_does_not_close() -> None:
    """Beyond the kite's change point its other sign is what the second dyad closes with."""
    kite = assur.FourBar(1, 2, 2, 1)
    at = kite.solve(1.0).joint("C").value
    span = np.array([2.6, 1.2]) - at
    half = np.hypot(*span) / 2
    f = at + span / 2 + np.array([-span[1], span[0]]) / (2 * half) * np.sqrt(1 - half**2)
    m = assur.Mechanism(
        joints={
            "A": (0, 0),
            "B": (np.cos(1.0), np.sin(1.0)),
            "C": (at[0], at[1]),
            "D": (1, 0),
            "E": (2.6, 1.2),
            "F": (f[0], f[1]),
        },
        links={
            "ground": "ADE",
            "crank": "AB",
            "coupler": "BC",
            "rocker": "DC",
            "f": "CF",
            "g": "EF",
        },
        driver="crank",
    )
    q = np.array([-0.2, -0.1, 0.1, 0.2])
    found = m.solve(q).joint("C").value
    assert np.allclose(found, kite.with_driver("crank").solve(q).joint("C").value, atol=1e-12)


@pytest.mark.parametrize("ground", [1.01, 1.003, 1.001, 1.0004, 1.0001])
def test_rocker_that_swings_round_beside_a_change_point(ground: float) -> None:
    """B passes D so near that the rocker turns about within a hundredth of a degree."""
    m = assur.FourBar(1, ground, 1, ground, mode="crossed")
    motion = m.solve(0.1 + np.linspace(0, 2 * np.pi, 20001), order=0)
    rocker = motion.link("rocker").value
    assert abs(rocker[-1] - rocker[0] + 2 * np.pi) < 1e-12
    assert np.abs(np.diff(rocker)).max() < np.pi * 1.25


def test_signs_that_return_through_a_gap() -> None:
    """A change point beside the end of a gap is found however small its cells are."""
    m = assur.Mechanism(
        joints={
            "J0": (1.4455748336062872, -1.2644110393420958),
            "J1": (2.4219556791997072, -1.8796148366885346),
            "J2": (1.838128368257336, -1.2644110393420958),
            "J3": (1.2752699970754844, -1.2122461669631308),
            "J4": (4.444317514564184, 1.1469000339059041),
            "J5": (3.1368568805835633, -0.06254900038556199),
        },
        links={
            "ground": ["J0", "J4", "J2"],
            "L1": ["J1", "J0"],
            "L2": ["J3", "J1"],
            "L3": ["J2", "J3"],
            "L4": ["J5", "J4"],
            "L5": ["J5"],
        },
        slides={"s0": assur.Slide("L3", on="L5", angle=2.003239141778433, origin="J5")},
        driver="L1",
    )
    q = m.q0 + np.linspace(-4 * np.pi, 4 * np.pi, 101)
    assert (m.solve(q, on_error="nan").status != assur.Status.LOST).all()


def test_flat_dyad_is_named_at_a_change_point() -> None:
    m = assur.FourBar(40, 120, 40, 120)
    assert 'dyad "C" is flat: a change point' in m.solve(np.pi + 1e-9).explain()


def test_more_than_there_is_room_for() -> None:
    m = assur.FourBar(1, np.full(10**6, 3.0), 2.5, 3)
    with pytest.raises(MemoryError):
        m.solve(np.zeros(10**7))


def test_assemblies_far_away_are_refused() -> None:
    with pytest.raises(assur.InputError, match="whole turns"):
        assur.FourBar(1, 3, 2.5, 3).assemblies(1e9)
