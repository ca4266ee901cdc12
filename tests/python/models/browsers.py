"""A real browser for tests of pages: Debian's Chromium, driven by playwright."""

from __future__ import annotations

import os
import shutil
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

pytest.importorskip("playwright.sync_api", reason="playwright is not installed: no browser tests")
from playwright.sync_api import sync_playwright

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


@contextmanager
def chromium() -> Iterator[Browser]:
    """Run a Chromium; without one the tests are skipped, and say so."""
    found = (os.environ.get("CHROMIUM"), *(shutil.which(name) for name in NAMES))
    path = next((one for one in found if one), None)
    if path is None:
        pytest.skip("no Chromium is found: the page is not tested in a browser")
    with sync_playwright() as playwright:
        # Containers run as root, where Chromium's own sandbox does not work.
        running = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield running
        running.close()
