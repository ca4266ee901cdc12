"""A real browser for tests of pages: Debian's Chromium, driven by playwright."""

from __future__ import annotations

import os
import shutil
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

pytest.importorskip("playwright.sync_api", reason="playwright is not installed: no browser tests")
from playwright.sync_api import sync_playwright

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from playwright.sync_api import Browser, Page

LONGEST_WAIT = 15.0
BETWEEN_LOOKS = 10.0  # ms
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


def wait_until(
    page: Page, condition: str | Callable[[], object], complaints: Sequence[str] = ()
) -> None:
    """Wait until an expression of the page, or a function, is true.

    Playwright's own waiting evaluates texts, which the pages forbid.
    """
    end = time.monotonic() + LONGEST_WAIT
    while time.monotonic() < end:
        if page.evaluate(condition) if isinstance(condition, str) else condition():
            return
        page.wait_for_timeout(BETWEEN_LOOKS)
    pytest.fail(f"{condition} did not come true; {complaints}")
