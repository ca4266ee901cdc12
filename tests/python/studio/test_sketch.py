"""What the page draws of a document by itself is what the server draws of it in the drawing."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.pictures import sizes
from assur.pictures.page.payload import _part
from assur.pictures.scene.build import scene_of
from assur.pictures.scene.frames import frames_of
from assur.studio.document import document_of
from support.node import MODULES, run_node

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism
    from assur.pictures.scene.frames import Frames

Part = dict[str, Any]


@pytest.fixture(scope="module")
def drawn() -> dict[str, Any]:
    """Return the page's scene of each example that is as it is drawn."""
    documents = {name: document_of(make()) for name, make in assur.examples.ALL.items()}
    documents = {name: one for name, one in documents.items() if "dimensions" not in one}
    text = run_node(str(MODULES / "sketch.mjs"), stdin=json.dumps([*documents.values()]))
    answer = json.loads(text)
    assert len(documents) == 29
    return {
        **answer,
        "documents": documents,
        "scenes": dict(zip(documents, answer["scenes"], strict=True)),
    }


def test_sizes_are_those_of_pictures(drawn: dict[str, Any]) -> None:
    assert len(drawn["sizes"]) > 20
    for name, size in drawn["sizes"].items():
        assert size == getattr(sizes, name), name


def test_joints_are_where_they_are_drawn(drawn: dict[str, Any]) -> None:
    for name, document in drawn["documents"].items():
        found = {one["name"]: one["at"] for one in drawn["scenes"][name]["joints"]}
        assert found == document["joints"]


def in_drawing(part: Part, link: str, frames: Frames) -> Float:
    """Return the vertices of a part in the drawing's axes: x, y in m, dx, dy in px."""
    angle = float(frames.angle(link)[0])
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    rows: Float = np.array(part["at"], dtype=float).reshape(-1, 4)
    places = np.array([frames.world(link, (x, y))[0] for x, y in rows[:, :2]])
    return np.hstack([places, rows[:, 2:] @ turn.T])


def alike(ours: Part, theirs: Part, frames: Frames, links: list[str]) -> bool:
    """Whether two parts are the same but for where their lines begin."""
    keys = (
        "name",
        "colour",
        "width",
        "closed",
        "fill",
        "hatched",
        "dashes",
        "floor",
        "disc",
        "hatching",
    )
    if any((ours.get(key) or None) != (theirs.get(key) or None) for key in keys):
        return False
    own = np.array(ours["at"], dtype=float).reshape(-1, 4)
    other = in_drawing(theirs, links[theirs["link"]], frames)
    if own.shape != other.shape:
        return False
    near = [1e-6 * float(np.ptp(other[:, :2])) + 1e-6] * 2 + [1e-4] * 2
    turns = [np.roll(other, k, axis=0) for k in range(len(other) if ours.get("closed") else 1)]
    return any(bool((np.abs(own - one) <= near).all()) for one in [*turns, other[::-1]])


def test_parts_are_those_of_the_server(drawn: dict[str, Any]) -> None:
    counted = 0
    for name, make in assur.examples.ALL.items():
        if name not in drawn["documents"]:
            continue
        what: Any = make()
        mechanism: Mechanism = getattr(what, "mechanism", what)
        frames = frames_of(mechanism.solve(mechanism.q0_array, order=0))
        scene = scene_of(mechanism, frames)
        links = ["ground", *(link for link in scene.links if link != "ground")]
        index = {link: i for i, link in enumerate(links)}
        theirs = [_part(part, index) for part in scene.parts]
        ours = drawn["scenes"][name]["parts"]
        assert drawn["scenes"][name]["links"] == links
        assert drawn["scenes"][name]["driven"] == [
            index[one] for one in links if one in scene.driven
        ]
        slid = {link for slide in mechanism.slides.values() for link in (slide.link, slide.on)}
        # Guides and cylinders depend on the stroke, which a drawing has not.
        exact = [f"link {link}" for link in links if link not in slid]
        # A fixed joint on which nothing turns is a dot there; while it is drawn it is a pivot.
        origins = {slide.origin for slide in mechanism.slides.values()}
        moving = {joint for link, on in mechanism.links.items() if link != "ground" for joint in on}
        joints = [joint for joint in mechanism.joints if joint in moving | origins]
        exact += [f"{kind} {joint}" for kind in ("joint", "pivot") for joint in joints]
        for one in ["driver", *exact]:
            own = [part for part in ours if part["name"] == one]
            other = [part for part in theirs if part["name"] == one]
            assert len(own) == len(other), (name, one)
            for a, b in zip(own, other, strict=True):
                assert alike(a, b, frames, links), (
                    name,
                    a,
                    b,
                    in_drawing(b, links[b["link"]], frames),
                )
                counted += 1
        for slide in mechanism.slides:
            kinds = [
                sorted(
                    (p.get("fill", ""), p.get("hatching", 0), p.get("width", 0), p["link"])
                    for p in parts
                    if p["name"] == f"slide {slide}"
                )
                for parts in (ours, theirs)
            ]
            assert kinds[0] == kinds[1], (name, slide)
    assert counted > 500
