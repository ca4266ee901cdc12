"""tools/check_floors: the package keeps its floors, and what is planted is seen."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import pytest

TOOL: dict[str, Any] = runpy.run_path(
    str(Path(__file__).resolve().parents[3] / "tools" / "check_floors")
)

# By what is wrong: files of a package, and what is said of it.
PLANTED = {
    "a type of a floor above": (
        {
            "pictures/film.py": "if TYPE_CHECKING:\n    from assur.kinematics import motion\n",
            "kinematics/motion.py": "",
        },
        "assur.pictures.film:2 imports assur.kinematics.motion, which is not below it",
    ),
    "an import in a function": (
        {"errors.py": "def late():\n    from assur import laws\n", "laws.py": ""},
        "assur.errors:2 imports assur.laws, which is not below it",
    ),
    "the roof": (
        {"laws.py": "def late():\n    import assur\n    assur.files\n"},
        "assur.laws:2 imports assur, which is the roof",
    ),
    "an import by name": (
        {"laws.py": 'import_module("assur.studio")\n', "studio/__init__.py": ""},
        "assur.laws:1 imports assur.studio, which is not below it",
    ),
    "an import by a variable": (
        {"laws.py": "def late(name):\n    import_module(name)\n"},
        "assur.laws:2 imports what no constant names",
    ),
    "a neighbour on the same floor": (
        {"laws.py": "from assur.description import words\n", "description/words.py": ""},
        "assur.laws:1 imports assur.description.words, which is not below it",
    ),
    "a part without a floor": (
        {"laws.py": "from assur import novel\n", "novel.py": ""},
        "assur.laws:1: novel or laws has no floor in tools/check_floors",
    ),
    "a circle of types": (
        {
            "kinematics/one.py": "from assur.kinematics.two import B\n",
            "kinematics/two.py": "if TYPE_CHECKING:\n    from .one import A\n",
        },
        "assur.kinematics: a circle: one -> two -> one",
    ),
    "a private attribute of another part": (
        {
            "kinematics/model.py": "class M:\n    def f(self):\n        self._n = 1\n",
            "sweeps/sweep.py": "def n_of(mechanism):\n    return mechanism._n\n",
        },
        "assur.sweeps.sweep:2 reads mechanism._n",
    ),
}


def test_the_package_keeps_its_floors() -> None:
    assert TOOL["faults"]() == []


@pytest.mark.parametrize("what", PLANTED)
def test_a_planted_fault_is_seen(what: str, tmp_path: Path) -> None:
    files, expected = PLANTED[what]
    for name, text in {"__init__.py": "", **files}.items():
        file = tmp_path / "assur" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        (file.parent / "__init__.py").touch()
    found = TOOL["faults"](tmp_path)
    assert len(found) == 1, found
    circle = {*expected.split(": a circle: ")[-1].split(" -> ")}
    assert found[0] == expected or circle == {*found[0].split(": a circle: ")[-1].split(" -> ")}
