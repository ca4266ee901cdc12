"""The README's picture is what its Python block draws, and small."""

from __future__ import annotations

from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from typing import Any

import matplotlib as mpl
import pytest

TOOL = Path(__file__).resolve().parents[3] / "tools" / "front_picture"
MOST_BYTES = 60_000


@pytest.fixture(scope="module")
def tool() -> Any:
    if not TOOL.exists():
        pytest.skip("the tools of the repository are not here")
    backend = mpl.get_backend()
    loader = SourceFileLoader("front_picture", str(TOOL))
    spec = spec_from_loader("front_picture", loader)
    assert spec is not None
    module = module_from_spec(spec)
    loader.exec_module(module)
    mpl.use(backend)
    return module


def test_pictures_are_small_and_named_in_the_readme(tool: Any) -> None:
    readme = (tool.ROOT / "README.md").read_text(encoding="utf-8")
    for theme in tool.THEMES:
        path = tool.FOLDER / f"loom-{theme}.svg"
        assert path.stat().st_size < MOST_BYTES
        assert path.relative_to(tool.ROOT).as_posix() in readme
    assert f"motion.plot({tool.JOINTS}, groups=True)".replace("'", '"') in readme


def test_a_moved_joint_is_seen(tool: Any) -> None:
    text = (tool.FOLDER / "loom-light.svg").read_text(encoding="utf-8")
    first = tool.NUMBER.search(text.partition('id="path')[2])
    assert tool.same(text, text)
    assert not tool.same(text, text.replace(first[0], f"{float(first[0]) + 3.0:.2f}"))
    assert not tool.same(text, text.replace('id="link crank"', 'id="link other"'))
