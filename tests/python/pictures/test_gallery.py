"""The gallery's pages: code that runs, numbers that are those of the mechanisms."""

from __future__ import annotations

import re
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest

import assur

TOOL = Path(__file__).resolve().parents[3] / "tools" / "gallery"


@pytest.fixture(scope="module")
def gallery() -> Any:
    if not TOOL.exists():
        pytest.skip("the tools of the repository are not here")
    backend = mpl.get_backend()
    loader = SourceFileLoader("gallery", str(TOOL))
    spec = spec_from_loader("gallery", loader)
    assert spec is not None
    module = module_from_spec(spec)
    loader.exec_module(module)
    mpl.use(backend)
    return module


@pytest.mark.parametrize("name", list(assur.examples.ALL))
def test_the_code_shown_makes_the_example(gallery: Any, name: str) -> None:
    space: dict[str, Any] = {}
    exec(gallery.code(name), space)
    made = space[name]()
    own = assur.examples.ALL[name]()
    if isinstance(own, assur.Machine):
        assert own.mechanism is not None
        made, own = made.mechanism, own.mechanism
    if "np" not in space:
        assert made == own
    else:  # NumPy's sines, where the package has its own
        assert made.links == own.links
        shown, kept = (list(mechanism.dimensions.values()) for mechanism in (made, own))
        assert np.allclose(shown, kept, rtol=1e-13)


@pytest.mark.parametrize("name", list(assur.examples.ALL))
def test_the_code_shown_has_public_names_alone(gallery: Any, name: str) -> None:
    code = gallery.code(name)
    assert "import assur\n" in code
    assert "from assur" not in code


def test_a_page_has_picture_code_numbers_and_source(gallery: Any) -> None:
    shaper = assur.examples.shaper()
    page = gallery.page("shaper", shaper)
    assert re.findall(r"^#+ (.+)$", page, re.MULTILINE) == [
        "Shaper",
        "Moving",
        "Code",
        "Numbers",
        "Source",
    ]
    assert "shaper-light.svg" in page
    assert "shaper-dark.svg" in page
    # Crank 100 mm, OD 200 mm: the lever swings by 30 degrees to either side (asin 1/2).
    assert "| lever | from 60° to 120° |" in page
    assert f"| structure | {shaper.structure.formula} |" in page


def test_paths_worth_seeing_are_those_of_points_on_no_circle(gallery: Any) -> None:
    assert gallery.points(assur.examples.crank_rocker()) == ["P"]
    assert gallery.points(assur.examples.klann_leg()) == ["F"]
    assert gallery.points(assur.examples.engine()) == ["B"]


@pytest.mark.parametrize("name", ["klann_leg", "scotch_yoke", "engine"])
def test_thumbnails_have_one_size_and_no_words(gallery: Any, name: str, tmp_path: Path) -> None:
    example = gallery.mechanism(name)
    path = tmp_path / "small.svg"
    gallery.thumbnail(gallery.motion(name, example), gallery.points(example), False, path)
    text = path.read_text(encoding="utf-8")
    width, height = (72.0 * side for side in gallery.BOX)
    assert f'viewBox="0 0 {width:g} {height:g}"' in text
    assert "<text" not in text
    assert 'id="scale' not in text
    assert 'id="link crank"' in text


def test_a_thumbnail_fills_its_box(gallery: Any) -> None:
    figure = gallery.plt.figure(figsize=gallery.BOX)
    ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    ax.set_aspect("equal", adjustable="box")
    (line,) = ax.plot([5.0, 9.0], [1.0, 1.5])
    gallery.fit(ax)
    figure.canvas.draw()
    drawn, box = line.get_window_extent(), ax.get_window_extent()
    assert drawn.width / box.width == pytest.approx(1.0 - 2.0 * gallery.MARGIN, abs=0.01)
    assert (drawn.y0 + drawn.y1) / 2.0 == pytest.approx((box.y0 + box.y1) / 2.0, abs=0.5)


def test_pictures_are_those_of_the_code_above_them(
    gallery: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gallery, "FOLDER", tmp_path)
    (tmp_path / "shown").mkdir()
    here = Path.cwd()
    block = """```python
>>> import assur
>>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
>>> m.solve("x")
Traceback (most recent call last):
...
TypeError
>>> axes = m.plot(1.0)
>>> print("nothing")
nothing

```

```{image} ../gallery/shown/one.svg
```
"""
    gallery.draw_page(block)
    assert Path.cwd() == here
    assert [path.name for path in (tmp_path / "shown").iterdir()] == ["one.svg"]
    assert 'id="link coupler"' in (tmp_path / "shown" / "one.svg").read_text(encoding="utf-8")


def test_every_picture_of_a_page_stands_below_code(gallery: Any) -> None:
    for part in gallery.PARTS:
        for page in (gallery.FOLDER.parent / part).glob("*.md"):
            text = page.read_text(encoding="utf-8")
            shown = re.findall(r"```\n\n```\{image\} \.\./gallery/shown/(\w+)\.svg", text)
            assert len(shown) == text.count(gallery.SHOWN), page
