"""What tests of several folders share: a browser."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Run a Chromium for the tests of one file; without one they are skipped, and say so."""
    from browsers import chromium

    with chromium() as running:
        yield running
