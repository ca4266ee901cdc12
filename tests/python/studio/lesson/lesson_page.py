"""The lesson in a real browser, on a server of its own, with a clock that tests wind."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.studio.bundle import joined
from support.browsers import wait_until

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator, Page, Route

# In place of the studio's own beginning: the lesson alone, with a clock of its own if wanted.
BEGINNING = """{
history.replaceState(null, "", "/");
const root = document.getElementById("assur");
root.className = "assur";
let now = 1000;
let waiting = null;
window.tick = (milliseconds) => {
  now += milliseconds;
  const frame = waiting;
  waiting = null;
  frame?.(now);
};
const wound = {
  request: (frame) => ((waiting = frame), 1),
  cancel: () => (waiting = null),
  now: () => now,
};
window.renew = async (isWound, language) => {
  speak(language);
  window.lesson?.close();
  const host = document.createElement("div");
  host.className = "lesson";
  root.replaceChildren(host);
  const ask = async (kind, fields) => {
    if (window.isLost) throw Object.assign(new Error("disconnected"), { kind: "disconnected" });
    const held = window.held;
    window.held = null;
    const answer = await link.ask(kind, 0, fields);
    await held;
    return answer;
  };
  window.lesson = isWound ? new Lesson(host, ask, wound) : new Lesson(host, ask);
  await window.lesson.ready;
};
const link = connect((isOpen) => {
  if (isOpen) window.isConnected = true;
});
}"""
DEGREE = np.pi / 180.0
LENGTHS = ("l1", "l2", "l3", "l4")


class LessonPage:
    """A window with the lesson, and everything that it complained about."""

    def __init__(self, browser: Browser, address: str) -> None:
        self.context = browser.new_context(viewport={"width": 1440, "height": 900})
        self.page: Page = self.context.new_page()
        self.complaints: list[str] = []
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("console", lambda message: self.complaints.append(message.text))
        self.page.route("**/studio.js", begin)
        self.page.goto(address)
        self.until("window.isConnected === true")

    def until(self, condition: str) -> None:
        """Wait for a condition."""
        wait_until(self.page, condition, self.complaints)

    def renew(self, *, is_wound: bool = True, language: str = "en") -> None:
        """Begin the lesson anew."""
        self.page.evaluate(
            "([isWound, language]) => renew(isWound, language)", [is_wound, language]
        )

    def close(self) -> None:
        self.context.close()
        assert self.complaints == []

    def wind(self, seconds: float, step: float = 0.01) -> None:
        """Let time pass, in frames; the first frame of a run takes none."""
        self.page.evaluate(
            "([count, step]) => { tick(0); for (let i = 0; i < count; i++) tick(step); }",
            [round(seconds / step), 1e3 * step],
        )

    def settle(self) -> None:
        """Wait for the answers to what was dragged, and show them."""
        self.page.evaluate("async () => { await lesson.drags.settled(); tick(0); }")

    def control(self, role: Any, name: str) -> Locator:
        if role == "diagram":
            return self.page.locator(".lesson-diagram").filter(has_text=name).locator(".plot")
        if role == "picture":
            return self.page.locator(".lesson-picture")
        return self.page.get_by_role(role, name=name, exact=True)

    def apply(self, name: str, text: str) -> None:
        """Type a value and apply it."""
        self.control("textbox", name).fill(text)
        self.control("textbox", name).press("Enter")
        self.until("!lesson.fields.isDirty")

    @property
    def figures(self) -> dict[str, Any]:
        found: dict[str, Any] = self.page.evaluate("lesson.figures")
        return found

    def side(self) -> str | None:
        """Return on which side C is jammed, and D slides."""
        found: str | None = self.figures["side"]
        return found

    @property
    def design(self) -> dict[str, Any]:
        found: dict[str, Any] = self.page.evaluate("lesson.design")
        return found

    @property
    def phi1(self) -> float:
        """Return the crank angle, degrees."""
        return float(self.page.evaluate("lesson.phi1")) / DEGREE

    def drag(self, at: Locator, dx: float, dy: float, steps: int, seconds: float) -> None:
        """Drag in even steps, each of which takes a time."""
        box = at.bounding_box()
        assert box is not None
        x, y = box["x"] + box["width"] / 2.0, box["y"] + 0.55 * box["height"]
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        for i in range(1, steps + 1):
            if seconds:
                self.page.evaluate("(ms) => tick(ms)", 1e3 * seconds)
            mouse.move(x + dx * i / steps, y + dy * i / steps)
        self.settle()

    def compare(self) -> None:
        """Compare all figures with the package, at the crank angle, l4 and its speed."""
        self.settle()
        found, design = self.figures, self.design
        l1, l2, l3 = (float(design[name]) for name in ("l1", "l2", "l3"))
        phi1, speed, least = found["phi1"], design["speed"], design["least"]
        ground, moving = design["l4"], found["groundSpeed"]
        blocked = assur.crank_rocker.blocked(l1, l2, l3, ground, least)
        turn = 2.0 * np.pi
        is_within = any((phi1 - low) % turn < high - low for low, high in blocked)
        assert (found["side"] is not None) == is_within

        def at(t: float) -> tuple[Any, np.ndarray[Any, Any]]:
            angle, l4 = phi1 + speed * t, ground + moving * t
            if is_within:
                l4 = slid((l1, l2, l3), least, angle, found["side"])
            exact = assur.crank_rocker.solve(angle, l1, l2, l3, l4)
            place = [np.cos(exact.phi3) * l3 - l4, np.sin(exact.phi3) * l3]
            return exact, np.array([*place, l4])

        exact, place = at(0.0)
        assert found["l4"] == pytest.approx(place[2], rel=1e-6)
        assert found["gamma"] == pytest.approx(float(exact.gamma), abs=2e-6)
        assert np.cos(found["phi3"]) == pytest.approx(float(np.cos(exact.phi3)), abs=2e-6)
        assert found["places"]["C"] == pytest.approx(place[:2], abs=2e-6)
        assert found["places"]["D"] == pytest.approx([-place[2], 0.0], abs=2e-6)
        assert np.hypot(*found["speeds"]["B"]) == pytest.approx(abs(speed) * l1)
        # By differences in time, the support moving too.
        step = 1e-4 / abs(speed)
        before, after = at(-step)[1], at(step)[1]
        rate = (after - before) / (2.0 * step)
        growth = (after - 2.0 * place + before) / step**2
        if is_within:
            assert found["gamma"] == pytest.approx(least)
        else:
            moved = assur.crank_rocker.solve(
                phi1, l1, l2, l3, ground, speed=speed, ground_speed=moving
            )
            assert np.hypot(*found["speeds"]["C"]) == pytest.approx(float(moved.v_C), rel=1e-3)
        assert found["speeds"]["C"] == pytest.approx(rate[:2], rel=1e-3, abs=1e-3)
        assert found["speeds"]["D"] == pytest.approx([-rate[2], 0.0], rel=1e-3, abs=1e-4)
        scale = float(np.hypot(*growth[:2]))
        assert found["accelerations"]["C"] == pytest.approx(growth[:2], abs=0.02 * scale + 1e-3)


def slid(lengths: tuple[float, float, float], least: float, phi1: float, side: str) -> float:
    """Return l4 while D slides: BD keeps the length at which C jammed."""
    l1, l2, l3 = lengths
    sign = 1.0 if side == "outer" else -1.0
    rod = np.sqrt(l2**2 + l3**2 + sign * 2.0 * l2 * l3 * np.cos(least))
    return float(-l1 * np.cos(phi1) + np.sqrt(rod**2 - (l1 * np.sin(phi1)) ** 2))


def begin(route: Route) -> None:
    """Answer with the lesson's modules in place of the studio's."""
    script = joined("studio/page/lesson/lesson.js")
    route.fulfill(body=script + BEGINNING, content_type="text/javascript")
