"""A monkey with a seed at the studio: the page answers, tells the truth and loses nothing."""

from __future__ import annotations

import random
import time
from typing import TYPE_CHECKING, Any

import pytest

from assur.studio import document
from studio.asking import ask
from studio.browser.browsing import Window, window

if TYPE_CHECKING:
    from playwright.sync_api import Browser

SECONDS = 4.5
BATCH = 12
STUDIO = "window.assurStudio"
TYPED = (
    *("NaN", "Infinity", "", "abc", "1e308", "-0", "0", "1/0", "12 cm", "1/3", "-3", "9" * 400),
    *("🙂", "<img src=x onerror=alert(1)>", "__proto__", "ground", "a.b", '"', "שלום", "é" * 200),
)
KEYS = (
    *(" ", "Escape", "Enter", "Tab", "Home", "Delete", "ArrowLeft", "ArrowUp", "f", "?", "0"),
    *("j", "l", "p", "s", "g", "d", "c", "Shift+ArrowUp", "Control+z", "Control+y", "Shift+Tab"),
)
TOOLS = ("select", "joint", "link", "plate", "slide", "cylinder", "ground", "driver", "remove")
EXAMPLES = ("watt_1", "excavator", "engine", "andrews_squeezer", "platform_on_cranks")
# Where controls are that can be clicked.
CONTROLS = """(wanted) => [...document.querySelectorAll(wanted)].map((one) => {
  const { left, top, width, height } = one.getBoundingClientRect();
  const [x, y] = [left + width / 2, top + height / 2];
  const seen = width && height && x >= 0 && y >= 0 && document.elementFromPoint(x, y);
  const isOver = seen && (one.contains(seen) || seen.contains(one));
  return isOver && !/gif/i.test(one.textContent) ? [x, y] : null;
}).filter(Boolean)"""

# Where joints are seen.
JOINTS = """() => [...document.querySelectorAll(".picture circle.joint")]
  .map((one) => one.getBoundingClientRect())
  .map(({ left, top, width, height }) => [left + width / 2, top + height / 2])
  .filter(([x, y]) => x > 0 && y > 0 && x < 1440 && y < 900)"""


class Monkey:
    """Acts at random, but the same for the same seed as far as answers come at the same time."""

    def __init__(self, one: Window, seed: int) -> None:
        self.one, self.page, self.rng = one, one.page, random.Random(seed)
        self.acts: list[Any] = []

    def act(self) -> None:
        """Do something."""
        own = (self.click, self.click, self.type, self.drag, self.drag, self.key, self.key)
        more = (self.wheel, self.undo, self.tool, self.tool)
        chosen = self.rng.choice(
            (*own, *more, self.example if self.rng.random() < 0.3 else self.key)
        )
        self.acts.append((chosen.__name__, chosen()))

    def _control(self, wanted: str) -> Any:
        places = self.page.evaluate(CONTROLS, wanted)
        return self.rng.choice(places) if places else None

    def click(self) -> Any:
        place = self._control("button, input, summary, [role=tab], [role=slider], svg.picture")
        if place:
            self.page.mouse.click(*place, click_count=self.rng.choice((1, 1, 2)))
        return place

    def type(self) -> Any:
        place = self._control("input:not([type=checkbox], [type=range])")
        text = self.rng.choice(TYPED)
        if place:
            self.page.mouse.click(*place, click_count=3)
            self.page.keyboard.insert_text(text)
            self.page.keyboard.press(self.rng.choice(("Enter", "Tab", "Escape")))
        return text

    def _place(self) -> tuple[float, float]:
        seen = self.page.evaluate(JOINTS)
        if seen and self.rng.random() < 0.6:
            x, y = self.rng.choice(seen)
            return float(x), float(y)
        return 60.0 + 1000.0 * self.rng.random(), 60.0 + 580.0 * self.rng.random()

    def drag(self) -> Any:
        (x, y), key = self._place(), self.rng.choice((None, None, "Escape", "Control+z", " ", "f"))
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + self.rng.gauss(0, 50), y + self.rng.gauss(0, 50), steps=3)
        if key:
            self.page.keyboard.press(key)
        elif self.rng.random() < 0.2:
            self.example()
        self.page.mouse.move(x + self.rng.gauss(0, 50), y + self.rng.gauss(0, 50), steps=3)
        self.page.mouse.up()
        return x, y, key

    def key(self) -> str:
        key = self.rng.choice(KEYS)
        self.page.keyboard.press(key)
        return key

    def wheel(self) -> None:
        self.page.mouse.move(*self._place())
        for _ in range(self.rng.choice((1, 10))):
            self.page.mouse.wheel(0, self.rng.choice((-300, 300)))

    def undo(self) -> None:
        for _ in range(self.rng.choice((1, 4))):
            self.page.keyboard.press(self.rng.choice(("Control+z", "Control+y")))

    def tool(self) -> str:
        tool = self.rng.choice(TOOLS)
        self.page.evaluate(f"(tool) => {STUDIO}.builder.take(tool)", tool)
        return tool

    def example(self) -> str:
        name = self.rng.choice(EXAMPLES)
        self.page.evaluate(f"(example) => {{ {STUDIO}.model.open({{ example }}) }}", name)
        return name


@pytest.mark.parametrize("seed", [1])
def test_a_monkey(browser: Browser, seed: int) -> None:
    with window(browser) as one:
        one.page.on("dialog", lambda dialog: one.complaints.append(dialog.message))
        start, monkey = one.document, Monkey(one, seed)
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            for _ in range(BATCH):
                monkey.act()
            one.settle()
            last = monkey.acts[-BATCH:]
            assert one.complaints == [], last
            own = one.document
            document.checked(own)
            assert one.state == ask("check", document=own)["state"], last
            assert one.page.evaluate(f"{STUDIO}.model.moves && {STUDIO}.model.isSketch") is False
        one.page.evaluate(f"{STUDIO}.lessonScreen.close()")
        for _ in range(200):
            one.page.evaluate(f"{STUDIO}.model.undo()")
        one.settle()
        assert not one.page.evaluate(f"{STUDIO}.model.history.canUndo")
        assert one.document == start
        assert len(monkey.acts) > BATCH
