"""Hypothesis profiles: `fast` (the same cases every time), `slow` (HYPOTHESIS_PROFILE=slow)."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, settings

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser

    from studio.lesson.lesson_page import LessonPage

settings.register_profile("fast", deadline=None, derandomize=True, max_examples=100)
settings.register_profile(
    "slow",
    deadline=None,
    max_examples=10_000,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "fast"))


def pytest_sessionstart() -> None:
    """`make wheel` names the environment that the tested package must lie in."""
    import assur

    wanted = os.environ.get("ASSUR_INSTALLED_IN")
    found = Path(assur.__file__).resolve()
    if wanted and not (found.is_relative_to(wanted) and "site-packages" in found.parts):
        message = f"{found} would be tested, not the package installed in {wanted}"
        raise pytest.UsageError(message)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Run one Chromium; without one its tests are skipped, and say so.

    Its driver keeps the loop of this thread: tests run their own with `asyncio` in another thread.
    """
    from support.browsers import chromium

    with chromium() as running:
        yield running


@pytest.fixture(scope="session")
def lesson_page(browser: Browser) -> Iterator[LessonPage]:
    """Open the lesson on a server of its own."""
    from studio.browser.browsing import Server
    from studio.lesson.lesson_page import LessonPage

    server = Server()
    page = LessonPage(browser, server.address)
    yield page
    page.close()
    server.stop()


@pytest.fixture
def lesson(lesson_page: LessonPage) -> Iterator[LessonPage]:
    """Begin the lesson anew; it must not complain."""
    lesson_page.page.set_viewport_size({"width": 1440, "height": 900})
    lesson_page.renew()
    yield lesson_page
    assert lesson_page.complaints == []


@pytest.fixture
def threads_at_once() -> Iterator[None]:
    """Threads start for small work too. Releases have no such hook: there one thread does it."""
    from assur import _core

    if hasattr(_core, "start_threads_at_once"):
        _core.start_threads_at_once(True)
        yield
        _core.start_threads_at_once(False)
    else:
        yield


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Which vector instructions ran."""
    from assur import _core

    terminalreporter.write_line(f"assur computed with {_core.simd_level()}")


@pytest.fixture(autouse=True)
def _figures_closed() -> Iterator[None]:
    yield
    # Where nothing is drawn matplotlib need not be there.
    if pyplot := sys.modules.get("matplotlib.pyplot"):
        pyplot.close("all")
