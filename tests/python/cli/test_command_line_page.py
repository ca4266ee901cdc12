"""The page about the command line: its commands print what it shows, it lists all there is."""

from __future__ import annotations

import doctest
import re
import shlex
from pathlib import Path
from typing import TYPE_CHECKING

from assur.cli.formats import NEEDS, WRITERS
from assur.cli.main import COMMANDS
from assur.cli.units import UNITS
from cli.command_line import assur_command

if TYPE_CHECKING:
    import pytest

DOCS = Path(__file__).parents[3] / "docs" / "reference"
PAGE = (DOCS / "command_line.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^```console\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def test_commands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = (DOCS / "files.md").read_text("utf-8").partition("```toml\n")[2].partition("```")[0]
    Path("press.toml").write_text(text, encoding="utf-8")
    checker, count = doctest.OutputChecker(), 0
    for block in BLOCK.findall(PAGE):
        for step in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            line, _, shown = step.partition("\n")
            name, *words = shlex.split(line)
            assert name == "assur"
            done = assur_command(*words)
            said = done.err + done.out
            assert checker.check_output(shown, said, doctest.ELLIPSIS), f"{line}\n{said}"
            count += 1
    assert count > 8
    assert {path.name for path in Path().iterdir()} >= {"turn.npz", "forces.csv", "long.toml"}


def column(heading: str) -> list[str]:
    """Return the first column of the table under a heading of its columns."""
    rows = PAGE.partition(f"| {heading} |")[2].partition("\n\n")[0].splitlines()[2:]
    return [row.split("|")[1].strip().strip("`") for row in rows]


def test_what_it_lists() -> None:
    assert column("command") == list(COMMANDS)
    assert column("ending") == [".csv", ".npz", ".json", ".parquet", ".xlsx"]
    assert set(column("ending")) == set(WRITERS)
    assert column("status") == ["0", "1", "2", "3", "130"]
    for ending, needs in NEEDS.items():
        assert re.search(rf"`{ending}` .*`assur\[{needs[0][1]}\]` \|", PAGE)
    for unit in UNITS:
        assert f"`{unit}`" in PAGE
