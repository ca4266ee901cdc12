"""The page of a front in a real browser: a point opens its design, which plays."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import assur
from assur import metric
from support.browsers import wait_until

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser


# The crank from O to A as the page has it.
CRANK = """() => {
  const { stage, pointAt } = assurPage;
  const joint = (name) => stage.data.joints.find((one) => one.name === name);
  const [o, a] = [pointAt(joint("O")), pointAt(joint("A"))];
  return Math.hypot(a.x - o.x, a.y - o.y);
}"""
CURRENT = """() => {
  const links = document.querySelectorAll("[aria-current]");
  return [...links].map((link) => link.getAttribute("href"));
}"""


def test_a_point_and_a_row_open_their_design(tmp_path: Path, browser: Browser) -> None:
    front = assur.pareto(
        assur.SliderCrank(0.1, 0.4),
        np.linspace(0.0, 2.0 * np.pi, 36, endpoint=False),
        maximize={"stroke": metric.span("bore"), "angle": metric.min_transmission_angle("B")},
        bounds={"crank.length": (0.05, 0.2)},
        population=8,
        generations=3,
    )
    file = tmp_path / "front.html"
    front.to_html(file, degrees=True)
    complaints: list[str] = []
    page = browser.new_page(viewport={"width": 1280, "height": 800})
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("requestfailed", lambda request: complaints.append(request.url))
    page.goto(file.as_uri())
    for index, what in ((0, None), (4, "svg a[href='#4'] circle"), (2, "td a[href='#2']")):
        if what is not None:
            page.click(f"nav {what}")
        # The page is loaded anew: its context cannot be asked meanwhile.
        page.wait_for_selector(f"main h1:text-is('design {index}')")
        # Numbers of a page are float32.
        crank = page.evaluate(CRANK)
        assert abs(crank - front[index].dimensions["crank.length"]) < 1e-6
        # The point and the row.
        assert page.evaluate(CURRENT) == [f"#{index}"] * 2
    page.keyboard.press("Space")
    wait_until(page, "assurPage.player.isPlaying", complaints)
    page.close()
    assert complaints == []
