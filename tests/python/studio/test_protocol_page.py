"""The page of the protocol: its examples are answered, its tables list every field."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from assur.studio import limits
from assur.studio.kinds import KINDS, LIVE
from assur.studio.session import Given, stamp_of
from studio.asking import Reply, ask, refused

PAGE = (Path(__file__).parents[3] / "docs" / "developers" / "studio_protocol.md").read_text(
    encoding="utf-8"
)
SECTIONS = dict(re.findall(r"^### `(\w+)`\n(.*?)(?=^##|\Z)", PAGE, re.MULTILINE | re.DOTALL))
BLOCK = re.compile(r"^```javascript\n(.*?)^```$", re.MULTILINE | re.DOTALL)
ENVELOPE = {"id", "rev", "kind", "arrays"}


def documents() -> dict[str, str]:
    first, second = BLOCK.findall(PAGE.partition("## Kinds")[0])
    return {"DOCUMENT": first, "MACHINE": second}


def examples(kind: str, stamp: str) -> list[dict[str, Any]]:
    found = []
    for block in BLOCK.findall(SECTIONS[kind]):
        text = block.replace("STAMP", json.dumps(stamp))
        for name, document in documents().items():
            text = text.replace(name, document)
        found.append(json.loads(text))
    return found


def listed(kind: str, heading: str) -> set[str]:
    """Return the names in the first column of a table."""
    table = SECTIONS[kind].partition(f"| {heading} |")[2].partition("\n\n")[0]
    rows = [row.split("|")[1] for row in table.splitlines()[2:]]
    return {name for row in rows for name in re.findall(r"`(\w+)`", row)}


def test_every_kind_has_its_section() -> None:
    assert set(SECTIONS) == set(KINDS)
    assert set(LIVE) < set(KINDS)


@pytest.mark.parametrize("kind", list(KINDS))
def test_examples_and_fields(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "press.toml"
    path.write_text("# as opened\n", encoding="utf-8")
    given = Given(path=path)
    replies: list[Reply] = []
    for example in examples(kind, stamp_of(path.read_bytes())):
        assert example.pop("kind") == kind
        fields = {key: value for key, value in example.items() if key not in ENVELOPE}
        assert set(fields) <= listed(kind, "asked")
        replies.append(ask(kind, given, **fields))
    assert replies
    said = set().union(*(reply.header for reply in replies))
    assert said - ENVELOPE == listed(kind, "answered")
    assert set().union(*(reply.arrays for reply in replies)) == listed(kind, "array")


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind != "start"])
def test_no_other_fields(kind: str) -> None:
    error = refused(kind, zzz=1)
    assert error["key"] == "zzz"
    known = error["message"].partition("known are ")[2]
    assert set(known.split(", ")) == listed(kind, "asked")


def test_limits() -> None:
    for number, unit in ((limits.MOST_UP // limits.KIB, "KiB"), (limits.MOST_DOWN // 2**20, "MiB")):
        assert f"at most {number} {unit}" in PAGE
    assert f"more than {limits.MOST_WAITING}\n" in PAGE or f"than {limits.MOST_WAITING} " in PAGE
    assert (
        f"more than {limits.MOST_LINKS} links, slides or loads, {limits.MOST_JOINTS} joints" in PAGE
    )
    assert f"after {limits.SECONDS:g} s (`export`: {limits.EXPORT_SECONDS:g} s)" in PAGE
    assert f"3 to {limits.MOST_ROWS}" in PAGE
    assert f"2 to {limits.MOST_CELLS}" in PAGE
    assert re.search(rf"At most {limits.MOST_CONNECTIONS}\s+connections", PAGE)
