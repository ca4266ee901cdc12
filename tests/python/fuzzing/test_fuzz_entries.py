"""Whatever its arguments, a public function returns a result or raises an error of this package."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fuzzing import fuzz_entries

if TYPE_CHECKING:
    from collections.abc import Callable

    from fuzzing.fuzz_values import Choices

EXAMPLES = 500


@pytest.mark.parametrize("entry", fuzz_entries.ENTRIES, ids=lambda entry: entry.__name__)
def test_any_arguments_give_a_result_or_an_error_of_the_package(
    entry: Callable[[Choices], object],
) -> None:
    first = bytes([fuzz_entries.ENTRIES.index(entry)])

    @settings(max_examples=EXAMPLES)
    @given(st.binary(min_size=8, max_size=100))
    def one(data: bytes) -> None:
        fuzz_entries.one_input(first + data)

    one()
