"""Paths of joints, and moving pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.animation import FFMpegWriter
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from PIL import Image

import assur

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

CRANK_ROCKER = assur.examples.crank_rocker()
TURN = np.linspace(0.0, 2.0 * np.pi, 49)


@pytest.fixture(autouse=True)
def _closed() -> Iterator[None]:
    yield
    assert len(plt.get_fignums()) <= 1
    plt.close("all")


def pictures(film: Any) -> int:
    count: int = film.n_frames
    return count


def artist(ax: Any, gid: str) -> Any:
    (found,) = (own for own in ax.get_children() if own.get_gid() == gid)
    return found


def test_a_path_is_that_of_the_joint() -> None:
    motion = CRANK_ROCKER.solve(TURN)
    ax = motion.plot("P", at=7)
    path = motion.joint("P").value
    assert np.array_equal(artist(ax, "path P").get_xydata(), path)
    assert np.array_equal(artist(ax, "dots P").get_xydata(), path[::2])
    assert np.array_equal(artist(ax, "now P").get_xydata()[0], path[7])


def test_a_motion_of_some_outputs_is_drawn_whole() -> None:
    motion = CRANK_ROCKER.solve(TURN, outputs=["P"])
    ax = motion.plot("P")
    assert artist(ax, "link rocker")
    with pytest.raises(assur.InputError, match="'C' was not among the outputs"):
        motion.plot("C")


def test_paths_have_gaps_where_there_is_no_position() -> None:
    rocker = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    motion = rocker.solve(TURN, on_error="nan")
    line = artist(motion.plot("C"), "path C").get_xydata()
    assert np.isnan(line[24]).all()
    assert np.isfinite(line[0]).all()
    with pytest.raises(assur.InputError, match="cannot be assembled"):
        motion.plot("C", at=24)


def test_a_motion_of_another_assembly_is_drawn_in_it() -> None:
    motion = CRANK_ROCKER.solve(TURN, assembly={"C": -1})
    ax = motion.plot("C", at=3)
    drawn = artist(ax, "now C").get_xydata()[0]
    (rocker,) = (a for a in ax.get_children() if a.get_gid() == "link rocker")
    assert isinstance(rocker, Patch)
    ends = (rocker.get_transform() - ax.transData).transform(rocker.get_path().vertices)
    assert min(np.abs(ends - drawn).max(axis=1)) < 1e-12


def test_several_paths_and_none() -> None:
    motion = CRANK_ROCKER.solve(TURN)
    gids = [str(line.get_gid()) for line in motion.plot(["P", "C"]).lines]
    assert [gid for gid in gids if gid.startswith("path")] == ["path P", "path C"]
    plt.close("all")
    assert not [line for line in motion.plot().lines if str(line.get_gid()).startswith("path")]


def test_a_film_shows_every_position_where_it_is(tmp_path: Path) -> None:
    """In each picture the pixels beside the crank's pin are its blue, elsewhere the canvas."""
    motion = CRANK_ROCKER.solve(np.linspace(0.0, 2.0 * np.pi, 13))
    out = tmp_path / "film.gif"
    motion.animate(out, joint="P", seconds=2.4)
    with Image.open(out) as film:
        assert pictures(film) == 12
        assert film.info["duration"] == 200
        assert film.info["loop"] == 0
        ax = CRANK_ROCKER.plot()
        for row in range(12):
            film.seek(row)
            pixels = np.asarray(film.convert("RGB"))
            height = pixels.shape[0]
            middle = motion.joint("B").value[row] / 2.0 + motion.joint("A").value[row] / 2.0
            x, y = ax.transData.transform(middle) / ax.figure.dpi * 100.0
            red, green, blue = pixels[round(height - y), round(x)].astype(int)
            assert (abs(red - 0x1D), abs(green - 0x5F), abs(blue - 0xB8)) < (30, 30, 30)
            assert tuple(pixels[0, 0]) == (255, 255, 255)


def test_what_does_not_close_goes_to_and_fro(tmp_path: Path) -> None:
    motion = assur.FourBar(3.0, 2.5, 2.0, 4.0).solve(np.linspace(-1.2, 1.2, 7))
    out = tmp_path / "rocker.webp"
    motion.animate(out, frames=72, groups=True, dark=True)
    with Image.open(out) as film:
        assert pictures(film) == 12


def test_films_have_no_more_pictures_than_asked_for(tmp_path: Path) -> None:
    motion = CRANK_ROCKER.solve(np.linspace(0.0, 2.0 * np.pi, 361))
    motion.animate(tmp_path / "a.gif", frames=8)
    with Image.open(tmp_path / "a.gif") as film:
        assert pictures(film) == 8


def test_what_cannot_be_filmed_is_refused(tmp_path: Path) -> None:
    motion = CRANK_ROCKER.solve(TURN)
    with pytest.raises(assur.InputError, match=r"must end in \.gif, \.webp, \.mp4"):
        motion.animate(tmp_path / "film.avi")
    with pytest.raises(assur.InputError, match="cannot be written"):
        motion.animate(tmp_path / "missing" / "film.gif", frames=2)
    with pytest.raises(assur.InputError, match="seconds is 0"):
        motion.animate(tmp_path / "film.gif", seconds=0.0)
    with pytest.raises(assur.InputError, match="frames is 1"):
        motion.animate(tmp_path / "film.gif", frames=1)
    with pytest.raises(assur.InputError, match=r"shape \(\)"):
        CRANK_ROCKER.solve(1.0).animate(tmp_path / "film.gif")
    with pytest.raises(assur.InputError, match="1 position"):
        CRANK_ROCKER.solve([1.0]).animate(tmp_path / "film.gif")
    if not FFMpegWriter.isAvailable():
        with pytest.raises(assur.InputError, match="needs the program ffmpeg"):
            motion.animate(tmp_path / "film.mp4", frames=2)
    assert not list(tmp_path.iterdir())


def test_arrows_along_a_path_are_velocities_and_accelerations() -> None:
    """All to one scale; the value stands at the position that is drawn."""
    motion = CRANK_ROCKER.solve(TURN)
    ax = motion.plot("P", at=6, vectors=["velocity", "acceleration"], speed=10.0)
    for kind, exact in (
        ("velocity", motion.joint("P").velocity(10.0)),
        ("acceleration", motion.joint("P").acceleration(10.0)),
    ):
        shafts = [a for a in ax.get_children() if (a.get_gid() or "").startswith(f"{kind} P")]
        shafts = [a for a in shafts if not str(a.get_gid()).endswith(("head", "text"))]
        assert len(shafts) == 14 - (6 % 4 == 0)
        ratios = []
        for shaft in shafts:
            assert isinstance(shaft, Line2D | Patch)
            vertices = np.asarray(shaft.get_path().vertices)
            start = vertices[0]
            row = int(np.argmin(np.abs(motion.joint("P").value - start).max(axis=1)))
            arrow = vertices[-1] - start
            cross = arrow[0] * exact[row][1] - arrow[1] * exact[row][0]
            assert abs(cross) <= 1e-9 * np.hypot(*arrow) * np.hypot(*exact[row])
            ratios.append(np.hypot(*arrow) / np.hypot(*exact[row]))
        (text,) = (t for t in ax.texts if t.get_gid() == f"{kind} P here text")
        assert f"{np.hypot(*exact[6]):.3g}"[:4] in text.get_text()


def test_arrows_need_a_joint_and_their_order() -> None:
    motion = CRANK_ROCKER.solve(TURN, order=1)
    with pytest.raises(assur.InputError, match="solved to 1"):
        motion.plot("P", vectors="acceleration")
    with pytest.raises(assur.InputError, match="name a joint"):
        motion.plot(vectors="velocity")
    with pytest.raises(assur.InputError, match="'force'"):
        motion.plot("P", vectors="force")


def test_speeds_of_any_kind_of_array_are_taken_and_what_is_none_refused() -> None:
    """Pictures hand arrays on; the fuzzed entries of arrays leave them out."""
    motion = CRANK_ROCKER.solve(TURN)
    for omega in (10, np.float32(10.0), np.full(len(TURN), 10.0), [10.0] * len(TURN)):
        ax = motion.plot("P", vectors="velocity", speed=omega)
        plt.close(ax.get_figure(root=True))
    bad: list[Any] = ["fast", None, [1.0, 2.0], np.ma.array(TURN, mask=True), 1j]
    for omega in bad:
        with pytest.raises(assur.InputError):
            motion.plot("P", vectors="velocity", speed=omega)
        with pytest.raises(assur.InputError):
            motion.polygon("velocity", at=3, speed=omega)
        if omega is not None:
            with pytest.raises(assur.InputError):
                motion.diagram("rocker", speed=omega)
    places: list[Any] = ["x", [None], 1j, [[np.nan]]]
    for q in places:
        with pytest.raises(assur.AssurError):
            CRANK_ROCKER.plot(q)
        with pytest.raises(assur.AssurError):
            CRANK_ROCKER.to_drawing("never.svg", q=q)
        with pytest.raises(assur.AssurError):
            CRANK_ROCKER.to_html("never.html", q=q)
