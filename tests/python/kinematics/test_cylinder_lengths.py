"""The value of a cylinder is the distance of its joints, which is never negative."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest

import assur
from models.errors.refusals import refused


def door(driver: str = "lift", foot: tuple[float, float] = (0.0, -1.0)) -> assur.Mechanism:
    """A door on a hinge, and a cylinder that holds it; the eye passes by the foot."""
    return assur.Mechanism(
        {"H": (0, 0), "foot": foot, "eye": (1.0, 0)},
        {"ground": ["H", "foot"], "door": ["H", "eye"]},
        driver,
        slides={"lift": assur.Cylinder("foot", "eye")},
    )


def crane(driver: str | list[str], rng: np.random.Generator) -> assur.Mechanism:
    """A four-bar with a cylinder between two points of links that move, and one on the ground."""
    at = {"A": (0, 0), "B": (0, 1), "C": (3, 2), "D": (3, 0), "P": (2, 3), "Q": (3.5, 1.2)}
    shaken = {name: tuple(np.array(xy) + rng.uniform(-0.2, 0.2, 2)) for name, xy in at.items()}
    return assur.Mechanism(
        {**shaken, "F": tuple(rng.uniform(-1, 4, 2))},
        {"ground": "ADF", "crank": "AB", "coupler": "BCP", "rocker": "DCQ"},
        driver,
        slides={"brace": assur.Cylinder("P", "Q"), "lift": assur.Cylinder("F", "P")},
    )


def distance(motion: assur.Motion, one: str, other: str) -> np.ndarray:
    gap = motion.joint(one).value - motion.joint(other).value
    return np.asarray(np.hypot(gap[..., 0], gap[..., 1]))


def is_distance(motion: assur.Motion, name: str, base: str, end: str) -> int:
    """Compare a cylinder's values with the distance of its joints; return how many there are."""
    value = motion.slide(name).value
    known = np.isfinite(value)
    assert (known == (motion.status <= assur.Status.SINGULAR)).all()
    assert (value[known] >= 0.0).all()
    np.testing.assert_allclose(value[known], distance(motion, base, end)[known], atol=1e-12)
    # The rod points from base to end.
    gap = motion.joint(end).value - motion.joint(base).value
    way = np.exp(1j * motion.link(f"{name}_rod").value)
    ok = motion.status == assur.Status.OK
    along = (gap[..., 0] + 1j * gap[..., 1]) * np.conj(way)
    np.testing.assert_allclose(along[ok], value[ok], atol=1e-9)
    return int(known.sum())


def test_a_driven_cylinder_begins_at_length_0() -> None:
    driven = door()
    assert driven.limits().intervals.tolist() == [[0.0, 2.0]]
    assert [point.q for point in driven.limits().dead_points] == [2.0]
    refused(
        assur.PositionError,
        "lift -1 m long negative",
        partial(driven.solve, [1.0, -1.0]),
        slide="lift",
        value=-1.0,
    )
    status = driven.solve([1.0, -1e-9, -1.0, -3.0], on_error="nan").status
    assert status.tolist() == [0, 3, 3, 3]
    assert list(driven.assemblies(-1.0)) == []
    assert len(list(driven.assemblies(1.0))) == 2


def test_the_length_that_opens_a_door_is_found_once() -> None:
    ((lift, _),) = door().find("door", np.pi / 3)
    assert abs(lift - 2.0 * np.sin(np.pi / 4 + np.pi / 6)) < 1e-12


def test_a_length_grows_again_beyond_0() -> None:
    motion = door("door").solve([0.0, -2.0, -np.pi / 2])
    expected = 2.0 * np.abs(np.sin(np.pi / 4 + np.array([0.0, -1.0, -np.pi / 4])))
    np.testing.assert_allclose(motion.slide("lift").value, expected, atol=1e-15)
    assert motion.status.tolist() == [0, 0, assur.Status.SINGULAR]
    # There the direction alone is not determined: everything else has its analogues.
    assert np.isnan(motion.slide("lift").d1[2])
    np.testing.assert_allclose(motion.joint("eye").d1[2], [1.0, 0.0], atol=1e-15)


def test_it_points_from_base_to_end_before_and_behind_the_foot() -> None:
    opened = door("door")
    q = np.linspace(-9.0, 9.0, 500)
    motion = opened.solve(q)
    assert is_distance(motion, "lift", "foot", "eye") == len(q)
    speed = np.gradient(motion.slide("lift").value, q)
    smooth = motion.slide("lift").value > 0.05
    smooth[[0, -1]] = False
    np.testing.assert_allclose(motion.slide("lift").d1[smooth], speed[smooth], atol=2e-3)
    # At the foot it turns by half a turn at once, counter-clockwise as q grows.
    beside = -np.pi / 2 + np.array([-1e-6, 1e-6])
    step = float(np.diff(opened.solve(beside).link("lift_rod").value)[0])
    assert abs(step - np.pi) < 1e-5
    assert opened.limits().period == 1
    assert [len(list(opened.assemblies(at))) for at in (0.5, -2.0)] == [1, 1]


def test_where_it_has_no_length_at_all_no_direction_is_made_up() -> None:
    slider = assur.Mechanism(
        {"A": (0, 0), "B": (1, 0)},
        {"ground": ["A"], "cart": ["B"]},
        "way",
        slides={
            "way": assur.Slide("cart", "ground", angle=0.0, origin="A"),
            "lift": assur.Cylinder("A", "B"),
        },
    )
    motion = slider.solve([-1.0, 0.0, 1.0])
    assert motion.slide("lift").value.tolist() == [1.0, 0.0, 1.0]
    assert motion.status.tolist() == [0, assur.Status.SINGULAR, 0]
    angle = motion.link("lift_rod").value
    assert np.isnan(angle[1])
    np.testing.assert_allclose(np.cos(angle[[0, 2]]), [-1.0, 1.0])
    assert motion.slide("lift").d1[[0, 2]].tolist() == [-1.0, 1.0]


def test_its_sign_cannot_be_chosen() -> None:
    opened = door("door")
    refused(
        assur.InputError, "lift never negative", partial(opened.solve, 0.3, assembly={"lift": -1})
    )
    drawn = partial(
        assur.Mechanism,
        {"H": (0, 0), "foot": (0, -1.0), "eye": (1.0, 0)},
        {"ground": ["H", "foot"], "door": ["H", "eye"]},
        "door",
        slides={"lift": assur.Cylinder("foot", "eye")},
        assembly={"lift": -1},
    )
    refused(assur.StructureError, "lift length", drawn)
    assert opened.solve(0.3, assembly={"lift": 1}).slide("lift").value > 0.0


@pytest.mark.parametrize("seed", range(6))
def test_passive_cylinders_of_random_linkages(seed: int) -> None:
    rng = np.random.default_rng(seed)
    m = crane("crank", rng)
    spread = rng.uniform(0.9, 1.1, 40)
    batch = m.with_dimensions({"coupler.length": m.dimensions["coupler.length"] * spread})
    q = float(m.q0) + rng.uniform(-7.0, 7.0, 40)
    for design in (m, batch):
        motion = design.solve(q, on_error="nan")
        assert is_distance(motion, "brace", "P", "Q") > 20
        assert is_distance(motion, "lift", "F", "P") > 20
    for assembly in m.assemblies(q[0]):
        motion = m.solve(q, assembly=assembly, on_error="nan")
        is_distance(motion, "brace", "P", "Q")
    again = m.solve(q[::-1], on_error="nan").slide("lift").value[::-1]
    np.testing.assert_array_equal(again, m.solve(q, on_error="nan").slide("lift").value)


@pytest.mark.parametrize("driver", ["brace", "lift"])
@pytest.mark.parametrize("seed", range(6))
def test_driven_cylinders_of_random_linkages(driver: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    m = crane(driver, rng)
    q = np.concatenate([rng.uniform(-6.0, 6.0, 60), float(m.q0) * rng.uniform(0.98, 1.02, 10)])
    motion = m.solve(q, on_error="nan")
    assert is_distance(motion, "brace", "P", "Q") > 0
    is_distance(motion, "lift", "F", "P")
    assert (motion.status[q < 0.0] == assur.Status.UNREACHABLE).all()
    assert (m.limits().intervals >= 0.0).all()
    assert m.extremes(driver).min.value >= 0.0
    assert list(m.assemblies(-0.5)) == []


@pytest.mark.parametrize("seed", range(4))
def test_two_drivers(seed: int) -> None:
    rng = np.random.default_rng(seed)
    arm = assur.Mechanism(
        {
            "O": (0, 0),
            "E": (1, 1),
            "T": (2, 0.5),
            "F": tuple(rng.uniform(0.2, 0.9, 2)),
            "G": (0.4, 0.7),
        },
        {"ground": "OF", "upper": "OEG", "fore": "ET"},
        ["lift", "bend"],
        slides={
            "lift": assur.Cylinder("F", "E"),
            "bend": assur.Cylinder("G", "T"),
            "rope": assur.Cylinder("F", "T"),
        },
    )
    q = np.array(arm.q0) + rng.uniform(-2.0, 1.0, (80, 2))
    motion = arm.solve(q, on_error="nan")
    for name, ends in (("lift", "FE"), ("bend", "GT"), ("rope", "FT")):
        is_distance(motion, name, ends[0], ends[1])
    assert (motion.status[(q < 0.0).any(axis=1)] == assur.Status.UNREACHABLE).all()
    assert (motion.status == 0).any()


def test_platforms_of_class_iii() -> None:
    platform = assur.examples.platform_on_cylinders()
    slides = platform.slides
    legs = {name: slides[name] for name in ("leg1", "leg2", "leg3")}
    assert all(leg.length for leg in legs.values())
    q = np.array(platform.q0)
    for sign in ([-1, 1, 1], [1, -1, 1], [-1, -1, -1]):
        assert platform.solve(q * sign, on_error="nan").status == assur.Status.UNREACHABLE
        assert list(platform.assemblies(q * sign)) == []
    assert len(list(platform.assemblies(q))) >= 2
    rng = np.random.default_rng(0)
    near = q + rng.uniform(-0.05, 0.05, (30, 3))
    motion = platform.solve(near, on_error="nan")
    for name, base, end in zip(legs, "ABC", "DEF", strict=True):
        gap = distance(motion, base, end)
        known = np.isfinite(gap)
        assert known.any()
        np.testing.assert_allclose(motion.slide(name).value[known], gap[known], atol=1e-12)


def coupler_over_a_foot(foot: tuple[float, float], driver: str) -> assur.Mechanism:
    at = {"B": (2.2, 0.1), "C": (1.0, 1.9), "D": (0.8, 0.7), "E": (1.5, 0.75), "F": (1.1, 1.25)}
    links = {"ground": "ABC", "r2": "BE", "r3": "CF", "platform": "DEF"}
    return assur.Mechanism(
        {"A": foot, **at}, links, driver, slides={"leg": assur.Cylinder("A", "D")}
    )


def test_a_group_of_class_iii_is_followed_to_length_0() -> None:
    four_bar = coupler_over_a_foot((0.0, 0.0), "r2")
    x, y = four_bar.solve(float(four_bar.q0) - 0.15).joint("D").value
    driven = coupler_over_a_foot((float(x), float(y)), "leg")
    assert driven.structure.cls == 3
    ((low, high),) = driven.limits().intervals.tolist()
    assert (low, [point.q for point in driven.limits().dead_points]) == (0.0, [high])
    q = np.array([-0.05, -1e-9, 0.004, 0.07, 0.14])
    motion = driven.solve(q, on_error="nan")
    assert motion.status.tolist() == [3, 3, 0, 0, 0]
    is_distance(motion, "leg", "A", "D")
    assert tuple(driven.extremes("leg").min) == (0.0, 0.0)
    passive = coupler_over_a_foot((float(x), float(y)), "r2")
    over = passive.solve(float(four_bar.q0) + np.linspace(-0.3, 0.08, 13))
    assert is_distance(over, "leg", "A", "D") == 13
    assert passive.extremes("leg").min.value == 0.0


def test_a_passive_cylinder_on_a_group_of_class_iii() -> None:
    cranks = assur.examples.platform_on_cranks()
    links = dict(cranks.links)
    base, end = links["ground"][0], links["platform"][1]
    m = assur.Mechanism(
        dict(cranks.joints), links, cranks.driver, slides={"strut": assur.Cylinder(base, end)}
    )
    q = np.array(m.q0) + np.random.default_rng(0).uniform(-0.4, 0.4, (40, 3))
    motion = m.solve(q, on_error="nan")
    assert is_distance(motion, "strut", base, end) > 10
    for assembly in m.assemblies(m.q0):
        is_distance(m.solve(q, assembly=assembly, on_error="nan"), "strut", base, end)
    assert len(list(m.assemblies(m.q0))) == len(list(cranks.assemblies(cranks.q0)))


def test_a_cylinder_whose_barrel_is_driven() -> None:
    # The eye is where the barrel's ray meets the door's circle; behind the foot it is none.
    foot = (2.0, 0.0)
    m = door("lift_barrel", foot)
    q = np.linspace(-np.pi, np.pi, 101)
    found = {assembly["eye"]: assembly for assembly in m.assemblies(m.q0)}
    for assembly in found.values():
        motion = m.solve(q, assembly=assembly, on_error="nan")
        is_distance(motion, "lift", "foot", "eye")
        reached = motion.status <= assur.Status.SINGULAR
        # Tangents from the foot are at 30°; the ray must point back to the hinge.
        np.testing.assert_array_equal(reached, np.abs(np.abs(q) - np.pi) < np.pi / 6)
    inside = door("lift_barrel", (0.3, 0.2))
    motion = inside.solve(q)
    assert is_distance(motion, "lift", "foot", "eye") == len(q)
    assert [len(list(inside.assemblies(at))) for at in q[::10]] == [1] * 11


def test_a_barrel_that_something_slides_on() -> None:
    # The link `arm` turns with the barrel, so the cylinder is not a dyad of its own.
    m = assur.Mechanism(
        {"H": (0, 0), "foot": (0, -1.0), "eye": (1.0, 0.2), "K": (0.3, -1.6)},
        {"ground": ["H", "foot"], "crank": ["H", "eye"], "sleeve": ["K"]},
        ["crank", "move"],
        slides={
            "lift": assur.Cylinder("foot", "eye"),
            "move": assur.Slide("sleeve", "lift_barrel", angle=0.4, origin="foot"),
        },
    )
    rng = np.random.default_rng(1)
    q = np.array(m.q0) + rng.uniform(-3.0, 3.0, (50, 2))
    assert is_distance(m.solve(q, on_error="nan"), "lift", "foot", "eye") == 50


def test_extremes_begin_where_the_length_does() -> None:
    lift, opened = door(), door("door")
    ends = lift.extremes("lift")
    assert (ends.min.value, ends.min.q) == (0.0, 0.0)
    assert abs(ends.max.value - 2.0) < 1e-12
    angle = lift.extremes("door")
    assert abs(angle.min.value + np.pi / 2) < 1e-9
    assert angle.min.q == 0.0
    stroke = opened.extremes("lift")
    assert stroke.min.value == 0.0
    assert abs(stroke.min.q + np.pi / 2) < 1e-9
    assert abs(stroke.max.value - 2.0) < 1e-12
    speed = opened.extremes("lift", order=1)
    np.testing.assert_allclose([speed.min.value, speed.max.value], [-1.0, 1.0], atol=1e-9)


def test_beside_an_offset_the_value_is_the_part_along_the_guide() -> None:
    aside = door("door").with_dimensions({"lift.offset": 0.3})
    q = np.linspace(-1.2, 4.4, 57)
    motion = aside.solve(q)
    eye = motion.joint("eye").value - [0.0, -1.0]
    along = np.sqrt((eye**2).sum(axis=1) - 0.09)
    np.testing.assert_allclose(motion.slide("lift").value, along, atol=1e-12)
    assert aside.solve(-np.pi / 2, on_error="nan").status == assur.Status.UNREACHABLE
    assert 0.0 <= aside.extremes("lift").min.value < 1e-12


def test_what_a_length_may_not_be_is_found_nowhere() -> None:
    opened = door("door")
    assert [round(q, 9) for q, _ in opened.find("lift", 0.05)] == [-1.620801537, -1.520791117]
    assert opened.find("lift", -0.5) == []
    assert len(door().configuration_curve().circuits) == 1


def test_a_run_ends_where_the_length_does() -> None:
    driven = door()
    machine = assur.Machine(
        driven, bodies={"door": assur.Body(mass=2.0, at=(0.5, 0.0), inertia=0.2)}
    )
    run = machine.run(t_end=10.0, speed0=-0.3)
    assert run.end == "zero length"
    assert "lift" in run.message
    assert 0.0 <= run.q[-1] < 1e-2
    assert (run.q >= 0.0).all()
    over = machine.run(q_end=-1.0, speed0=-0.3)
    assert over.end == "zero length"
    assert over.q[-1] >= 0.0


def test_a_run_past_a_cylinder_without_mass_goes_on() -> None:
    body = {"door": assur.Body(mass=2.0, at=(0.5, 0.0), inertia=0.2)}
    run = assur.Machine(door("door"), bodies=body).run(t_end=10.0, speed0=-1.0)
    assert run.end == "reached"
    assert abs(run.q[-1] + 10.0) < 1e-9


def test_metrics_of_sweeps_never_see_a_negative_length() -> None:
    opened = door("door")
    q = np.linspace(-3.0, 3.0, 241)
    lengths = np.linspace(0.5, 1.5, 21)
    asked = {"least": assur.metric.min("lift"), "most": assur.metric.max("lift")}
    sweep = assur.sweep(opened, {"door.length": lengths}, q, metrics=asked)
    gap = np.hypot(lengths[:, None] * np.cos(q), lengths[:, None] * np.sin(q) + 1.0)
    np.testing.assert_allclose(sweep["least"], gap.min(axis=1), atol=1e-12)
    np.testing.assert_allclose(sweep["most"], gap.max(axis=1), atol=1e-12)


def test_a_slide_keeps_its_sign() -> None:
    plain = assur.Mechanism(
        {"H": (0, 0), "foot": (0, -1.0), "eye": (1.0, 0)},
        {"ground": ["H", "foot"], "door": ["H", "eye"], "tube": ["foot"], "ram": ["eye"]},
        "door",
        slides={"lift": assur.Slide("ram", "tube", angle=np.pi / 4, origin="foot")},
    )
    assert plain.solve(-2.0).slide("lift").value < -0.4
    assert plain.with_driver("lift").limits().intervals.tolist() == [[-2.0, 2.0]]


def test_a_length_that_is_drawn_backward_is_refused() -> None:
    backward = partial(
        assur.Mechanism,
        {"H": (0, 0), "foot": (0, -1.0), "eye": (1.0, 0)},
        {"ground": ["H", "foot"], "door": ["H", "eye"], "tube": ["foot"], "ram": ["eye"]},
        "door",
        slides={
            "lift": assur.Slide("ram", "tube", angle=-3 * np.pi / 4, origin="foot", length=True)
        },
    )
    refused(assur.StructureError, "lift -1.414 length", backward)
