"""Scenes: symbols stand where the motion has them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from assur.examples import ALL
from assur.pictures.scene.build import scene_of
from assur.pictures.scene.course import course
from assur.pictures.scene.frames import Frames, frames_of, nearby
from assur.pictures.scene.geometry import hull
from assur.pictures.scene.labels import along, chosen, placed
from assur.pictures.scene.shapes import Hatching, Scene, Stroke
from pictures.drawn_examples import mechanism

ONE_DRIVER = [name for name in ALL if not isinstance(mechanism(name).driver, tuple)]


def scene(name: str) -> tuple[Scene, Frames, Any]:
    own = mechanism(name)
    motion = course(own)
    frames = frames_of(motion)
    return scene_of(own, frames), frames, motion


@pytest.mark.parametrize("name", ONE_DRIVER)
def test_every_joint_of_every_link_is_where_the_motion_has_it(name: str) -> None:
    _, frames, motion = scene(name)
    known = frames.is_known
    scale = np.abs(
        np.stack([motion.joint(name).value[known] for name in motion.mechanism.joints])
    ).max()
    assert frames.local.keys() == motion.mechanism.links.keys()
    assert {one for joints in frames.local.values() for one in joints} == {*motion.mechanism.joints}
    for link, joints in frames.local.items():
        for joint, local in joints.items():
            expected = motion.joint(joint).value
            placed_ = frames.world(link, local)
            assert np.abs(placed_ - expected)[known].max() <= 1e-9 * scale


@pytest.mark.parametrize(
    "name", ["engine", "scotch_yoke", "whitworth", "shaper", "trammel", "oldham"]
)
def test_blocks_stay_on_their_guides(name: str) -> None:
    """The middle of a block keeps its distance from the line drawn as its guide, and within it."""
    own, frames, _ = scene(name)
    size = float(np.ptp(np.concatenate(list(frames.joints().values())), axis=0).max())
    slides = mechanism(name).slides
    for slide in slides:
        parts = [part for part in own.parts if part.name == f"slide {slide}"]
        blocks = [part for part in parts if isinstance(part, Stroke) and part.fill == "canvas"]
        for block in blocks:
            pair = {slides[slide].link, slides[slide].on}
            (guide,) = pair - {block.link}
            lines = [
                part
                for part in own.parts
                if isinstance(part, Stroke) and part.link == guide and len(part.vertices) == 2
                if part.vertices[0][:2] != part.vertices[1][:2]
            ]
            centre = frames.world(block.link, block.vertices[0][:2])
            gaps = []
            for line in lines:
                a, b = (frames.world(guide, vertex[:2]) for vertex in line.vertices)
                along_ = (b - a) / np.linalg.norm(b - a, axis=1)[:, None]
                off = along_[:, 0] * (centre - a)[:, 1] - along_[:, 1] * (centre - a)[:, 0]
                inside = ((centre - a) * along_).sum(axis=1)
                length = np.linalg.norm(b - a, axis=1)
                within = (inside > -1e-9 * size) & (inside < length + 1e-9 * size)
                gaps.append(float(np.abs(off).max()) if within.all() else np.inf)
            assert min(gaps) <= 1e-9 * size


def test_the_guide_of_an_engine_is_its_stroke() -> None:
    """Stroke 2 r, from l - r to l + r (closed form); beyond that only px."""
    own, _, _ = scene("engine")
    engine = mechanism("engine")
    r, rod = engine.dimensions["crank.length"], engine.dimensions["rod.length"]
    (line,) = (p for p in own.parts if isinstance(p, Hatching) and p.name == "slide bore")
    assert {round(line.start.x, 9), round(line.end.x, 9)} == {round(rod - r, 9), round(rod + r, 9)}


def test_pistons_stay_in_their_barrels() -> None:
    """Over the stroke of a boom the piston is between the barrel's ends."""
    boom = assur.Mechanism(
        joints={"foot": (0, 0), "eye": (2, 1), "base": (1, -1)},
        links={"ground": ["foot", "base"], "boom": ["foot", "eye"]},
        slides={"lift": assur.Cylinder("base", "eye")},
        driver="lift",
    )
    motion = boom.solve(np.linspace(1.9, 2.8, 21), order=0)
    frames = frames_of(motion)
    parts = [p for p in scene_of(boom, frames).parts if isinstance(p, Stroke)]
    barrel = next(p for p in parts if p.link == "lift_barrel" and p.closed)
    rod = next(p for p in parts if p.link == "lift_rod")
    base, end = (frames.world("lift_barrel", v[:2]) for v in barrel.vertices[:2])
    piston = frames.world("lift_rod", rod.vertices[0][:2])
    tip = frames.world("lift_rod", rod.vertices[1][:2])
    assert np.allclose(base, (1, -1))
    assert np.abs(tip - motion.joint("eye").value).max() < 1e-12
    length = np.linalg.norm(end - base, axis=1)
    reach = np.linalg.norm(piston - base, axis=1)
    assert (reach > 0.0).all()
    assert (reach < length).all()
    # Barrel and rod are in line.
    cross = np.cross(np.pad(end - base, ((0, 0), (0, 1))), np.pad(piston - base, ((0, 0), (0, 1))))
    assert np.abs(cross).max() < 1e-12


def test_the_course_of_a_rocker_ends_at_its_dead_points() -> None:
    """A double rocker 3, 2.5, 2, 4 reaches ± 1.371564 (law of cosines)."""
    motion = course(assur.FourBar(3.0, 2.5, 2.0, 4.0))
    limit = np.arccos((3.0**2 + 4.0**2 - (2.5 + 2.0) ** 2) / (2 * 3.0 * 4.0))
    assert motion.q[[0, -1]] == pytest.approx([-limit, limit], rel=1e-5)
    assert (motion.status < 3).all()


def test_a_free_slide_moves_by_half_the_size() -> None:
    slider = assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 1), "C": (2, 0)},
        links={"ground": [], "block": ["A"], "rod": ["A", "B"], "other": ["B", "C"], "end": ["C"]},
        slides={
            "x": assur.Slide("block", "ground", angle=0.0),
            "y": assur.Slide("end", "ground", angle=0.0),
        },
        driver=("x", "y"),
    )
    assert course(slider).shape == ()


def test_joints_that_go_to_infinity_do_not_fix_the_frame() -> None:
    """A tangent generator's cursor goes to infinity; the picture stays near the drawing."""
    own = mechanism("tangent_generator")
    whole = frames_of(course(own))
    at = frames_of(own.solve(0.5, order=0))
    assert np.abs(np.concatenate(list(whole.joints().values()))).max() > 1e3
    near = nearby(whole, at, np.array(list(own.joints.values())))
    assert np.abs(np.concatenate(list(near.joints().values()))).max() < 1.0


def test_hulls_turn_left_and_leave_out_what_is_inside() -> None:
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5], [0.5, 0.0]], dtype=float)
    assert [square[i].tolist() for i in hull(square)] == [[0, 0], [1, 0], [1, 1], [0, 1]]
    line = np.array([[0, 0], [2, 2], [1, 1]], dtype=float)
    assert sorted(hull(line)) == [0, 1]


def test_random_hulls_agree_with_qhull() -> None:
    from scipy.spatial import ConvexHull

    random = np.random.default_rng(7)
    for _ in range(200):
        points = random.normal(size=(random.integers(3, 9), 2))
        assert sorted(hull(points)) == sorted(ConvexHull(points).vertices)


def test_names_stand_clear_of_each_other_and_of_lines() -> None:
    """Four joints on a line: every name is off the line and off the others."""
    points = np.array([[0, 0], [30, 0], [60, 0], [62, 0]], dtype=float)
    sizes = np.full((4, 2), (8.0, 9.0))
    line = along([points[[0, -1]]], 2.0)
    bounds = (np.array([-100.0, -100.0]), np.array([200.0, 100.0]))
    middles = placed(points, sizes, np.full(4, 4.0), line, bounds)
    assert (np.abs(middles[:, 1]) > 4.5).all()
    for i in range(4):
        for j in range(i):
            assert (np.abs(middles[i] - middles[j]) >= sizes[0] - 1e-9).any()


def test_a_name_stays_until_another_place_is_clearly_better() -> None:
    point, size = np.zeros((1, 2)), np.array([[8.0, 8.0]])
    bounds = (np.full(2, -100.0), np.full(2, 100.0))
    radius, nothing = np.array([4.0]), np.zeros((0, 2))
    for place in range(16):
        kept = np.array([place])
        assert chosen(point, size, radius, nothing, bounds, kept=kept)[1] == place
    # Covered by a line, it moves.
    middle = chosen(point, size, radius, nothing, bounds)[0]
    line = along([np.array([middle[0] - (9, 0), middle[0] + (9, 0)])], 1.0)
    moved = chosen(point, size, radius, line, bounds, kept=np.array([0]))[0]
    assert np.abs(moved - middle).max() > 4.0
