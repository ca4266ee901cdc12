"""Every key of a text has the place where it stands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from assur.files.lexer import line_and_column, tokens
from assur.files.parser import loads
from assur.files.positions import key_positions
from assur.files.toml import key_text, value_text
from files.sample_files import BY_HAND, WANTED, saved

if TYPE_CHECKING:
    from assur.files.positions import KeyPath

ALL_FORMS = '''# [comment] = 1
bare = 1979-05-27 07:32:00   # a date
"quoted \\" key" = "a # string"
'literal' = 'C:\\'
a.b . "c" = 1.5
list = [ 1, [2, 3], { x = 1, y.z = [4] }, # comment ]
  """many
lines = "1" """, \'\'\'x = ]\'\'\', ]
[table]
x = {}
[[array]]
k = 1
[[array]]
k = 2
[array.inner]
deep = true
[[array.more]]
m = 1
[ table . "sub" ]
y = -inf
'''


def paths(value: Any, path: KeyPath = ()) -> set[KeyPath]:
    """The path of everything in what the parser gives."""
    found = {path} if path else set()
    if isinstance(value, dict | list):
        for key, one in value.items() if isinstance(value, dict) else enumerate(value):
            found |= paths(one, (*path, key))
    return found


def stands(text: str, path: KeyPath, at: int) -> bool:
    """Whether a key, in one of its spellings, stands at an offset."""
    name = path[-1] if isinstance(path[-1], str) else next(p for p in path[::-1] if type(p) is str)
    return isinstance(path[-1], int) or any(
        text.startswith(form, at)
        for form in (str(name), key_text(str(name)), f"'{name}'", f'"{name}"')
    )


@pytest.mark.parametrize("text", [ALL_FORMS, *BY_HAND.values(), *saved().values(), WANTED])
def test_keys_of_files(text: str) -> None:
    found = key_positions(text)
    assert set(found) == paths(loads(text))
    assert all(stands(text, path, at) for path, at in found.items())


@pytest.mark.parametrize(
    ("path", "line", "column"),
    [
        (("bare",), 2, 1),
        (('quoted " key',), 3, 1),
        (("a", "b"), 5, 3),
        (("a", "b", "c"), 5, 7),
        (("list", 1, 1), 6, 17),
        (("list", 2, "y", "z", 0), 6, 37),
        (("list", 4), 8, 18),
        (("array", 1, "k"), 14, 1),
        (("array", 1, "inner", "deep"), 16, 1),
        (("array", 1, "more", 0, "m"), 18, 1),
        (("table", "sub"), 19, 11),
    ],
)
def test_places(path: KeyPath, line: int, column: int) -> None:
    assert line_and_column(ALL_FORMS, key_positions(ALL_FORMS)[path]) == (line, column)


names = st.text(st.characters(exclude_categories=["Cs"]), max_size=5)
values = st.recursive(
    st.integers(-9, 9) | st.floats(allow_nan=False) | names | st.booleans(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(names, inner, max_size=4),
    max_leaves=12,
)


@settings(max_examples=50, deadline=None)
@given(st.dictionaries(names, values, max_size=5), st.dictionaries(names, values, max_size=5))
def test_any_text(first: dict[str, Any], second: dict[str, Any]) -> None:
    lines = [f"{key_text(key)} = {value_text(value)}" for key, value in first.items()]
    own = "\n".join(f"{key_text(key)} = {value_text(value)}" for key, value in second.items())
    text = "\n".join([*lines, f'[["{"x" * 9}"]]', own])
    found = key_positions(text)
    assert set(found) == paths(loads(text))
    assert all(stands(text, path, at) for path, at in found.items())


@settings(max_examples=150, deadline=None)
@given(st.text(st.sampled_from("a1.=,[]{}\"'\\#\n \t_é"), max_size=60))
def test_any_letters_are_read_in_order(text: str) -> None:
    """Of a text that is not TOML too: tokens do not overlap, and only blanks are left out."""
    at = 0
    for token in tokens(text):
        assert text[at : token.start].strip(" \t") == ""
        assert token.start < token.end <= len(text)
        at = token.end
    rest = text[at:].lstrip(" \t")
    assert rest == "" or rest[0] in "\"'"  # a string that does not end


def test_numbers_may_be_skipped() -> None:
    text = "a = [1.5, -2e-3,\n 3, 4.0]\nb.c.d = 1"
    kinds = [text[t.start : t.end] for t in tokens(text, skip_numbers=True)]
    assert kinds[:3] == ["a", "=", "["]
    assert "-2e-3" not in kinds
    assert kinds[-7:] == ["b", ".", "c", ".", "d", "=", "1"]
