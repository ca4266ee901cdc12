"""Three tasks of a new user, each from an empty page, done as a person does them.

Only what a person has is used: the mouse, keys, names that are seen or read aloud. The number found
is compared with what Python computes of the document.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from studio.browser.browsing import window

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator

    from studio.browser.browsing import Window

DEGREE = np.pi / 180.0
TURN = 2.0 * np.pi


def field(one: Window, name: str) -> Locator:
    return one.page.get_by_role("textbox", name=name, exact=True).first


def put(one: Window, name: str, text: str) -> None:
    """Click into a field and type, as a person does."""
    own = field(one, name)
    own.click()
    one.page.keyboard.press("Control+a")
    one.page.keyboard.type(text)
    one.page.keyboard.press("Enter")
    one.settle()


def unfold(one: Window, title: str) -> None:
    one.page.locator("summary").filter(has_text=title).click()


def number(text: str) -> float:
    found = re.search(r"[−-]?\d+(\.\d+)?", text)
    assert found, text
    return float(found[0].replace("−", "-"))


def draw(one: Window, *chains: list[tuple[float, float]]) -> None:
    """Draw links from joint to joint; places are from the middle of the picture, px."""
    box = one.page.get_by_role("img").first.bounding_box()
    assert box is not None
    one.button("Draw a link").click()
    for chain in chains:
        for x, y in chain:
            one.page.mouse.click(box["x"] + x, box["y"] + y)
            one.settle()
        one.page.keyboard.press("Escape")
    one.page.get_by_role("button", name="Do it: Hold").click()
    one.settle()
    assert one.state == "moves"


def test_a_crank_rocker_for_a_given_swing(browser: Browser) -> None:
    with window(browser) as one:
        one.button("New").click()
        draw(one, [(350, 450), (350, 350), (630, 250), (580, 450)])
        put(one, "A x", "0")
        put(one, "D x", "100")
        unfold(one, "Find a dimension")
        assert "swing of link3" in one.page.get_by_label("wanted").inner_text()
        put(one, "is to be", "60")
        one.button("Find it").click()
        one.wait_until("document.querySelector('.find-told').textContent.includes('60.00°')")
        one.settle()
        motion = one.mechanism.solve(np.linspace(0.0, TURN, 3601), order=0)
        angle = np.unwrap(motion.link("link3").value)
        assert np.ptp(angle) == pytest.approx(60.0 * DEGREE, abs=1e-5)
        # The least transmission angle is told, and one click leads to where it is.
        least = float(motion.transmission_angle("C").min()) / DEGREE
        caution = one.page.locator(".caution").inner_text()
        assert number(caution.split("falls to")[1]) == pytest.approx(least, abs=0.06)
        one.page.get_by_role("button", name="Go there").click()
        one.settle()
        here = float(one.mechanism.solve(one.q, order=0).transmission_angle("C")) / DEGREE
        assert here == pytest.approx(least, abs=0.01)


def test_why_does_this_six_bar_jam(browser: Browser) -> None:
    with window(browser) as one:
        one.button("New").click()
        draw(
            one,
            [(250, 440), (250, 340), (460, 250), (440, 440)],
            [(460, 250), (650, 210), (650, 440)],
        )
        assert one.mechanism.limits().full_rotation
        # The support of the last link is moved away.
        one.drag(one.joint_px("F"), tuple(np.add(one.joint_px("F"), (75.0, 0.0))))
        one.settle()
        limits = one.mechanism.limits()
        assert not limits.full_rotation
        caution = one.page.locator(".caution")
        text = caution.inner_text()
        assert "link1 stops at" in text
        assert "link4 and link5 are in line at E" in text
        # In another language too.
        one.button("Language").click()
        one.page.get_by_role("menuitem", name="Deutsch").click()
        assert "link4 und link5 liegen bei E gestreckt" in caution.inner_text()
        one.button("Sprache").click()
        one.page.get_by_role("menuitem", name="English").click()
        places = caution.get_by_role("button").all_inner_texts()
        dead = sorted(point.q / DEGREE for point in limits.dead_points)
        assert sorted(number(place) for place in places) == pytest.approx(dead, abs=0.06)
        caution.get_by_role("button").last.click()
        one.settle()
        assert one.q / DEGREE == pytest.approx(number(places[-1]), abs=0.06)
        # Together they are too short, so one is made longer.
        put(one, "link5", "130")
        assert one.mechanism.limits().full_rotation
        assert not caution.is_visible() or "stops at" not in caution.inner_text()
        assert "full turn" in one.page.get_by_role("region", name="Assembly").inner_text()


def test_what_torque_does_this_press_need(browser: Browser) -> None:
    with window(browser) as one:
        one.button("New").click()
        one.page.get_by_role("button", name="engine").click()
        one.wait_until("window.assurStudio.model.title === 'engine'")
        one.settle()
        put(one, "crank", "50")
        put(one, "rod", "200")
        unfold(one, "Masses and loads")
        one.page.get_by_role("combobox").filter(has_text="Add a load").select_option(label="Force")
        one.settle()
        # A new force on the piston is against its slide already.
        put(one, "along x", "-5 kN")
        one.page.get_by_label("acts", exact=True).select_option(label="only forward")
        one.settle()
        one.page.get_by_role("button", name="The drive needs up to").click()
        put(one, "mean ω", "10")
        one.wait_until("document.querySelector('[data-fact=inertia]').textContent.includes('kg')")
        one.settle()
        # T = F dx/dφ of the piston while it goes forward.
        phi = np.linspace(0.0, TURN, 36001)
        x = 0.05 * np.cos(phi) + np.sqrt(0.2**2 - (0.05 * np.sin(phi)) ** 2)
        torque = np.maximum(5000.0 * np.gradient(x, phi), 0.0)
        told = one.page.locator("[data-fact=driveGreatest]")
        assert number(told.inner_text()) == pytest.approx(torque.max(), rel=2e-3)
        place = told.locator("xpath=preceding-sibling::dd[1]").inner_text()
        assert number(place) == pytest.approx(phi[torque.argmax()] / DEGREE, abs=1.0)
        # J = greatest change of the surplus work / (δ ω²); the links have no masses.
        surplus = np.cumsum(torque - torque.mean()) * (phi[1] - phi[0])
        inertia = np.ptp(surplus) / (0.05 * 10.0**2)
        own = one.page.locator("[data-fact=inertia]").inner_text()
        assert number(own) == pytest.approx(inertia, rel=2e-3)
        machine: Any = one.document["loads"]
        assert machine == [
            {"type": "Force", "at": "B", "force": [-5000, 0], "while_": "forward", "over": "bore"}
        ]
