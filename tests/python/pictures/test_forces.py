"""Forces in their places, force polygons, polar bearing loads."""

from __future__ import annotations

import pickle
from typing import Any, cast

import matplotlib.pyplot as plt
import numpy as np
import pytest

import assur
from assur.dynamics.forces.force_system import force_system
from assur.pictures.forces.polygon import polygon_sides
from assur.pictures.style import DARK
from pictures.picture_reading import gids, named, one, overlapping, texts, vector


def _engine(**more: Any) -> assur.Machine:
    bodies = {
        "rod": assur.Body(mass=1.2, inertia=0.015, at=(0.12, 0.01)),
        "piston": assur.Body(mass=2.0),
    }
    loads: list[Any] = [assur.Force("B", (-800.0, 0.0), on="piston"), assur.Gravity()]
    return assur.Machine(assur.SliderCrank(0.1, 0.35), bodies=bodies, loads=loads, **more)


def _loaded() -> assur.Machine:
    """Return a four-bar with a load of every kind."""
    bodies = {
        "crank": assur.Body(mass=0.5, inertia=2e-4, at=(0.02, 0.005)),
        "coupler": assur.Body(mass=1.2, inertia=3e-3, at=(0.08, 0.012)),
        "rocker": assur.Body(mass=0.8, inertia=1.5e-3, at=(0.06, -0.01)),
    }
    loads: list[Any] = [
        assur.Gravity(),
        assur.Force(("coupler", (0.05, 0.03)), (30.0, -12.0), axes="coupler"),
        assur.Torque("rocker", lambda _t, _q, speed: -5.0 + 0.1 * speed, on="coupler"),
        assur.TorsionSpring("rocker", 20.0, angle=1.9, preload=0.7),
        assur.TorsionDamper("crank", 0.02, on="coupler"),
        assur.Spring("A", "C", 400.0, 0.1),
        assur.Damper("B", ("rocker", (0.02, 0.0)), 3.0),
    ]
    return assur.Machine(assur.FourBar(0.05, 0.15, 0.12, 0.16), bodies=bodies, loads=loads)


MACHINES: dict[str, Any] = {
    "engine": lambda: _engine().reactions([0.4, 1.1], speed=60.0, acceleration=20.0),
    "loads of every kind": lambda: _loaded().reactions([0.4, 1.1], 20.0, 30.0),
    "friction": lambda: _engine(
        friction={"A": assur.JointFriction(0.1, 0.02), "bore": assur.SlideFriction(0.1, 0.06)}
    ).reactions([0.4, 1.1], speed=60.0),
    "shaper": lambda: assur.Machine(
        assur.examples.shaper(),
        bodies={
            "lever": assur.Body(mass=4.0, inertia=0.05, at=(0.1, 0.0)),
            "ram": assur.Body(mass=6.0),
        },
        loads=[assur.Force("F", (-900.0, 0.0)), assur.Gravity()],
    ).reactions([0.4, 1.1], speed=8.0),
    "class III": lambda: assur.Machine(
        assur.examples.triad(),
        bodies={"plate": assur.Body(mass=2.0, inertia=0.01, at=(0.02, 0.01))},
        loads=[assur.Gravity()],
    ).reactions([0.4, 1.1], speed=8.0),
    "class IV": lambda: assur.Machine(
        assur.examples.loom(),
        bodies={"l234": assur.Body(mass=2.0, inertia=0.01)},
        loads=[assur.Gravity()],
    ).reactions([0.4, 1.1], speed=8.0),
    "three cylinders": lambda: assur.Machine(
        assur.examples.platform_on_cylinders(),
        bodies={"platform": assur.Body(mass=20.0, inertia=1.0, at=(0.1, 0.1))},
        loads=[assur.Gravity()],
    ).reactions([[1.2, 1.1, 0.8]] * 2, speed=[0.1, -0.2, 0.1]),
}


@pytest.mark.parametrize("name", MACHINES)
def test_polygons_close(name: str) -> None:
    """Of every link, every group and all links; the moments about any point balance too."""
    found = MACHINES[name]()
    mechanism = found.mechanism
    sets = [(link,) for link in mechanism.links if link != "ground"]
    sets += [group.links for group in mechanism.structure.groups]
    for links in [*sets, tuple(link for link in mechanism.links if link != "ground")]:
        system = force_system(found, links, 1)
        if not any(np.hypot(*force.force) for force in system.forces):
            continue
        sides = [force.force for force in polygon_sides(system)]
        greatest = max(np.hypot(*side) for side in sides)
        assert np.hypot(*np.sum(sides, axis=0)) < 1e-9 * greatest
        about = [
            force.couple
            + (force.place[0] - 0.3) * force.force[1]
            - (force.place[1] - 0.7) * force.force[0]
            for force in system.forces
            if not force.inner
        ]
        assert abs(np.sum(about)) < 1e-9 * max(np.abs(about).max(), greatest)
        ax = found.polygon(links, at=1)
        first = force_system(found, links, 1)
        drawn = [artist for artist in ax.lines if str(artist.get_gid()).split()[0] in KINDS]
        assert len(drawn) <= len(first.forces)
        plt.close("all")


KINDS = {"load", "weight", "inertia", "drive", "reaction"}


def test_polygon_of_a_group() -> None:
    """Its sides follow each other; the last ends where the first begins."""
    found = _engine().reactions(1.1, speed=60.0)
    group = found.mechanism.structure.groups[0]
    ax = found.polygon(group)
    order = [str(line.get_gid()) for line in ax.lines if str(line.get_gid()).split()[0] in KINDS]
    assert order == [
        "load B on piston",
        "weight rod",
        "weight piston",
        "inertia rod",
        "inertia piston",
        "reaction A on rod",
        "reaction bore on piston",
    ]
    sides = [vector(ax, gid) for gid in order]
    for before, after in zip(sides, [*sides[1:], sides[0]], strict=True):
        np.testing.assert_allclose(before[1], after[0], atol=1e-9)
    np.testing.assert_allclose(sides[5][1] - sides[5][0], found.joint("A", on="rod"), atol=1e-9)
    assert one(ax, "load B on piston text").get_text() == "$F_{B}$ = 800 N"
    assert one(ax, "title").get_text() == "Force polygon of rod, piston"
    bad, count = overlapping(ax, KINDS)
    assert bad == 0
    assert count >= 4


def test_forces_in_their_places() -> None:
    found = _engine().reactions([0.4, 1.1], speed=60.0)
    ax = found.plot(at=1)
    motion = found.mechanism.solve(1.1)
    forces = {
        "reaction O on crank": (motion["O"].value, found.joint("O", on="crank")[1]),
        "reaction A on crank": (motion["A"].value, found.joint("A", on="crank")[1]),
        "load B on piston": (motion["B"].value, np.array([-800.0, 0.0])),
        "weight rod": (motion.point("rod", (0.12, 0.01)).value, np.array([0.0, -1.2 * 9.81])),
        "inertia rod": (
            motion.point("rod", (0.12, 0.01)).value,
            -1.2 * motion.point("rod", (0.12, 0.01)).acceleration(60.0),
        ),
    }
    scales = []
    for gid, (place, force) in forces.items():
        start, tip = vector(ax, gid)
        np.testing.assert_allclose(start, place, atol=1e-12)
        along = (tip - start) / np.hypot(*(tip - start))
        np.testing.assert_allclose(along, force / np.hypot(*force), atol=1e-9)
        scales.append((tip - start) @ force / (force @ force))
    np.testing.assert_allclose(scales, scales[0], rtol=1e-9)
    # Its centre of mass is where the weight acts.
    (circle,) = (
        a
        for a in ax.patches
        if a.get_gid() == "mass centre rod" and hasattr(a, "center") and hasattr(a, "get_width")
    )
    np.testing.assert_allclose(circle.center, forces["weight rod"][0], atol=1e-12)
    value = abs(found.driver[1])
    assert one(ax, "moment drive crank text").get_text() == f"$M_{{crank}}$ = {value:#.3g} N·m"
    # A force between two links is drawn once.
    assert "reaction A on rod" not in gids(ax)


def test_forces_on_chosen_links() -> None:
    found = _engine().reactions(0.8, speed=60.0)
    ax = found.plot("rod", dark=True)
    drawn = {gid for gid in gids(ax) if gid.startswith("reaction") and gid.split()[-1] == "rod"}
    assert drawn == {"reaction A on rod", "reaction B on rod"}
    start, tip = vector(ax, "reaction B on rod")
    force = found.joint("B", on="rod")
    np.testing.assert_allclose((tip - start) / np.hypot(*(tip - start)), force / np.hypot(*force))
    assert one(ax, "reaction B on rod").get_color() == DARK.ink
    assert one(ax, "title").get_text() == "Forces on rod"
    # The other links are drawn still fainter.
    (rod,) = named(ax, "link rod")
    (crank,) = named(ax, "link crank")
    assert rod.get_alpha() > crank.get_alpha()


def test_forces_of_one_design_of_a_batch() -> None:
    batch = _engine().of(assur.SliderCrank(0.1, 0.35).with_dimensions({"rod.length": [0.3, 0.4]}))
    found = batch.reactions([0.4, 1.1], speed=60.0)
    with pytest.raises(assur.InputError, match="at"):
        found.plot()
    start, _ = vector(found.plot(at=(1, 0)), "load B on piston")
    np.testing.assert_allclose(start, batch.mechanism.solve([0.4, 1.1])["B"].value[1, 0])  # type: ignore[union-attr]


def test_reactions_that_friction_chose_are_drawn() -> None:
    """The second solution has its own forces."""
    crank = assur.Mechanism(
        {"O": (0, 0), "A": (0, 0.1), "B": (0.15, -0.2)},
        {"ground": ["O"], "crank": ["O", "A"], "rod": ["A", "B"], "piston": ["B"]},
        slides={"bore": assur.Slide("piston", on="ground", angle=0.0)},
        driver="crank",
    )
    machine = assur.Machine(
        crank,
        loads=[assur.Force("B", (-100.0, 300.0), on="piston")],
        friction={"bore": assur.SlideFriction(0.6, 0.05)},
    )
    found = machine.reactions(crank.q0, speed=-1.0)
    for solution in found.solutions:
        sides = {
            f.name: f.force for f in force_system(solution, "piston", ()).forces if f.name == "bore"
        }
        assert sides["bore"][1] == pytest.approx(float(solution.slide("bore").normal))


def test_forces_refused() -> None:
    found = _engine().reactions(0.8)
    for draw in (found.plot, found.polygon):
        with pytest.raises(assur.InputError, match='no link "tower"'):
            draw("tower")
        with pytest.raises(assur.InputError, match="moving links"):
            draw("ground")
    light = assur.Machine(assur.SliderCrank(0.1, 0.35)).reactions(0.8)
    with pytest.raises(assur.InputError, match="no force acts on rod"):
        light.polygon("rod")
    lost = assur.Machine(assur.FourBar(40, 120, 80, 300)).reactions([0.0, 3.0], on_error="nan")
    with pytest.raises(assur.InputError, match="cannot be assembled"):
        lost.plot(at=1)


def test_copies_of_reactions() -> None:
    """They are drawn alike; only functions of the user cannot be copied."""
    found = _engine().reactions(0.8, speed=60.0)
    again = pickle.loads(pickle.dumps(found))
    assert gids(again.plot()) == gids(found.plot())
    twin = pickle.loads(pickle.dumps(_loaded().reactions(0.8, speed=20.0)))
    with pytest.raises(assur.InputError, match="draw the original"):
        twin.plot()


def test_bearing_loads() -> None:
    """The curve in each frame, with the greatest force."""
    q = np.linspace(0.0, 2.0 * np.pi, 73)
    found = _engine().reactions(q, speed=200.0)
    pin = found.bearing("A", on="crank")
    fixed, turning = np.ravel(cast("Any", pin.plot()))
    np.testing.assert_allclose(
        one(fixed, "force").get_xydata(), found.joint("A", on="crank"), atol=1e-9 * pin.size.max()
    )
    np.testing.assert_array_equal(one(turning, "force").get_xydata(), pin.force)
    greatest = pin.max
    for ax in (fixed, turning):
        assert np.hypot(*vector(ax, "greatest")[1]) == pytest.approx(greatest.value)
        seen, greatest_text = [text.get_text() for text in named(ax, "heading")]
        value = f"{greatest.value / 1e3:#.3g} kN"
        assert greatest_text == f"greatest {value} at q = {np.degrees(greatest.q):.4g}°"
        assert seen == ("seen from crank, x along it" if ax is turning else "seen from ground")
    rings = [ring.get_radius() for ring in named(fixed, "ring")]
    assert len(rings) >= 2
    np.testing.assert_allclose(np.diff(rings), rings[0])


def test_bearing_on_given_axes() -> None:
    _, ax = plt.subplots()
    found = _engine().reactions([0.0, 1.0, 2.0], speed=200.0)
    pin = found.bearing("O", on="crank", frame="ground")
    assert pin.plot(ax=ax) is ax
    other = found.bearing("A", on="crank")
    _, one_ax = plt.subplots()
    other.plot(ax=one_ax)
    np.testing.assert_array_equal(one(one_ax, "force").get_xydata(), other.force)
    _, axes = plt.subplots(1, 3)
    with pytest.raises(assur.InputError, match="ax has 3 axes"):
        other.plot(ax=axes)
    assert texts(ax)


def test_bearing_refused() -> None:
    batch = _engine().of(assur.SliderCrank(0.1, 0.35).with_dimensions({"rod.length": [0.3, 0.4]}))
    with pytest.raises(assur.InputError, match=r"batch \(2,\)"):
        batch.reactions([0.4, 1.1]).bearing("A", on="rod").plot()
    light = assur.Machine(assur.SliderCrank(0.1, 0.35)).reactions([0.8, 1.0])
    with pytest.raises(assur.InputError, match="no force on 'rod'"):
        light.bearing("A", on="rod").plot()
