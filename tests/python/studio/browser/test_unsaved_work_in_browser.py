"""What a window has not saved comes back in it, whatever others have done to the file meanwhile."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from assur.studio import document
from assur.studio.session import Given
from studio.asking import FOUR_BAR
from studio.browser.browsing import Server, Window, window

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser, Page

LENGTH = "rocker.length"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "four_bar.toml"
    path.write_text(document.toml_of(FOUR_BAR), encoding="utf-8")
    return path


def edit(one: Window, page: Page, value: float) -> None:
    """Change a dimension, as a step; it is kept a little later."""
    page.evaluate(
        """async ([name, value]) => {
             const { model } = window.assurStudio;
             const dimensions = { ...model.document.dimensions, [name]: value };
             await model.edit({ ...model.document, dimensions });
           }""",
        [LENGTH, value],
    )
    one.wait_until_kept(page)


def length(page: Page) -> Any:
    return page.evaluate(f"window.assurStudio.model.document.dimensions?.['{LENGTH}']")


def restarted(one: Window, given: Given) -> None:
    """Start the server again, as another command at the same port does."""
    one.server.stop()
    one.server = Server(given, one.server.port)


def opened_again(one: Window, page: Page) -> None:
    page.goto(one.server.address)
    one.ready(page)


def save(one: Window, page: Page) -> None:
    page.keyboard.press("Control+s")
    one.wait_until(
        "window.assurStudio.model.savedDocument === window.assurStudio.model.document", page
    )


def test_another_window_saved_and_the_server_was_started_again(
    browser: Browser, file: Path
) -> None:
    with window(browser, file) as one:
        second = one.another()
        edit(one, second, 3.1)
        edit(one, one.page, 2.9)
        save(one, one.page)
        restarted(one, Given(file))
        opened_again(one, second)
        assert length(second) == 3.1
        second.get_by_text("Save asks").wait_for()
        # And once more: nothing of it is in the file yet.
        second.reload()
        one.ready(second)
        assert length(second) == 3.1
        # Undo shows what the other window saved.
        second.get_by_role("button", name="Undo", exact=True).click()
        one.wait_until(f"window.assurStudio.model.document.dimensions['{LENGTH}'] === 2.9", second)
        second.get_by_role("button", name="Redo", exact=True).click()
        one.wait_until(f"window.assurStudio.model.document.dimensions['{LENGTH}'] === 3.1", second)
        # Saving asks, and then writes.
        second.keyboard.press("Control+s")
        second.get_by_text("The file has changed since it was opened").wait_for()
        assert "2.9" in file.read_text("utf-8")
        second.get_by_role("button", name="Save over it").click()
        one.wait_until(
            "window.assurStudio.model.savedDocument === window.assurStudio.model.document", second
        )
        assert "3.1" in file.read_text("utf-8")
        second.reload()
        one.ready(second)
        assert length(second) == 3.1
        assert second.get_by_text("has come back").count() == 0
        # The window that had saved shows the file.
        opened_again(one, one.page)
        assert length(one.page) == 3.1


def test_a_window_without_changes_shows_the_file(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        second = one.another()
        edit(one, one.page, 2.9)
        save(one, one.page)
        # Leaving, a window writes down what it shows.
        second.reload()
        one.ready(second)
        assert length(second) == 2.9
        assert second.get_by_text("has come back").count() == 0


def test_the_work_on_a_file_is_not_anothers(browser: Browser, file: Path, tmp_path: Path) -> None:
    other = tmp_path / "other" / file.name
    other.parent.mkdir()
    other.write_text(document.toml_of({**FOUR_BAR, "dimensions": {LENGTH: 2.7}}), encoding="utf-8")
    with window(browser, file) as one:
        edit(one, one.page, 3.1)
        restarted(one, Given(other))
        opened_again(one, one.page)
        assert length(one.page) == 2.7
        edit(one, one.page, 2.8)
        restarted(one, Given(file))
        opened_again(one, one.page)
        assert length(one.page) == 3.1
        restarted(one, Given(other))
        opened_again(one, one.page)
        assert length(one.page) == 2.8


def test_a_file_that_broke(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        edit(one, one.page, 3.1)
        file.write_text("format = 1\ndriver = ", encoding="utf-8")
        one.page.reload()
        one.ready()
        one.page.get_by_text("is not a mechanism").wait_for()
        assert length(one.page) == 3.1
        one.page.keyboard.press("Control+s")
        one.page.get_by_role("button", name="Save over it").click()
        one.wait_until(
            "window.assurStudio.model.savedDocument === window.assurStudio.model.document"
        )
        assert "3.1" in file.read_text("utf-8")


def test_an_example_of_the_command(browser: Browser) -> None:
    with window(browser, example="crank_rocker") as one:
        edit(one, one.page, 0.09)
        one.page.reload()
        one.ready()
        assert length(one.page) == 0.09


def test_a_copy_leaves_the_file(browser: Browser, file: Path) -> None:
    with window(browser, file) as one:
        second = one.another()
        edit(one, second, 3.1)
        second.get_by_role("button", name="Work on a copy").click()
        one.wait_until_kept(second)
        second.reload()
        one.ready(second)
        assert length(second) is None
