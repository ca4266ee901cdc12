"""Drawing a mechanism from nothing, in a real browser: by mouse, by touch, by keys."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from studio.asking import FOUR_BAR
from studio.browser.browsing import Window, window

if TYPE_CHECKING:
    from playwright.sync_api import Browser

Place = tuple[float, float]
# Nothing is asked, changed or dragged.
QUIET = (
    "assurStudio.model.link.isQuiet && !assurStudio.builder.isBusy && !assurStudio.model.isDragging"
)
EMPTY: dict[str, Any] = {"joints": {}, "links": {"ground": []}}
# On the grid of the empty canvas, m.
SIX_BAR: dict[str, Place] = {
    "A": (0.0, 0.05), "B": (0.01, 0.09), "C": (0.09, 0.13), "D": (0.1, 0.05), "E": (0.13, 0.11),
    "F": (0.19, 0.12), "G": (0.18, 0.05),
}  # fmt: skip


class Hand:
    """What a person does with the tools."""

    def __init__(self, one: Window, *, is_empty: bool = True) -> None:
        self.one = one
        self.mouse = one.page.mouse
        if is_empty:
            if one.button("New").is_visible():
                one.button("New").click()
            else:
                one.page.evaluate("assurStudio.begin()")
            self.settle()
            assert one.state == "empty"

    def settle(self) -> None:
        self.one.wait_until(QUIET)

    def take(self, tool: str) -> None:
        button = self.one.page.locator(f".tool[data-tool={tool}]")
        button.click()
        assert button.get_attribute("aria-pressed") == "true"

    def click(self, *places: Place) -> None:
        for place in places:
            self.mouse.click(*self.one.px(*place))
            self.settle()

    def drag(self, start: Place, end: Place) -> None:
        self.one.drag(self.one.px(*start), self.one.px(*end))
        self.settle()

    def say(self) -> str:
        """Return what is missing, as it is said."""
        return " ".join((self.one.page.locator(".mend .why").text_content() or "").split())

    def checks(self) -> dict[str, bool]:
        items = self.one.page.locator(".checklist li").all()
        own = ((i.get_attribute("data-check"), i.get_attribute("data-done")) for i in items)
        return {str(key): done == "true" for key, done in own}


def draw_six_bar(hand: Hand) -> None:
    at = SIX_BAR
    hand.take("link")
    # A chain, which ends at its last joint.
    hand.click(at["A"], at["B"], at["C"], at["C"])
    hand.take("plate")
    hand.click(at["D"], at["C"], at["E"], at["D"])
    hand.take("link")
    hand.click(at["F"], at["E"], at["E"])
    hand.drag(at["F"], at["G"])


def middle(a: Place, b: Place) -> Place:
    return (a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0


def assert_same_motion(one: Window, expected: assur.Mechanism, names: dict[str, str]) -> None:
    """The page shows what Python computes of the same places, over the whole turn."""
    assert one.state == "moves"
    low, high = one.page.evaluate("[assurStudio.playback.turn.low, assurStudio.playback.turn.high]")
    for q in np.linspace(low, high, 9)[:-1] + 0.03 * (high - low):
        one.seek(float(q))
        motion = expected.solve(one.q)
        for drawn, joint in names.items():
            place = tuple(motion.joint(joint).value)
            assert one.place(drawn) == pytest.approx(place, abs=1e-7)


def test_a_six_bar_from_nothing_by_mouse_alone(browser: Browser) -> None:
    with window(browser) as one:
        hand = Hand(one)
        assert one.button("Draw a link").is_visible()
        view = one.page.evaluate("JSON.stringify(assurStudio.canvas.stage.view)")
        draw_six_bar(hand)
        assert one.button("Draw a link").is_hidden()
        drawn = one.document["joints"]
        by_place = {at: name for name, at in SIX_BAR.items()}
        names = {joint: by_place[tuple(at)] for joint, at in drawn.items()}
        assert sorted(names.values()) == sorted(SIX_BAR)
        assert one.state == "no_driver"
        assert hand.say() == "Nothing is fixed yet. Click a joint with the ground tool."
        assert hand.checks() == dict.fromkeys(
            ("checkGround", "checkDriver", "checkJoined", "checkMobility"), False
        )
        hand.take("ground")
        hand.click(SIX_BAR["A"], SIX_BAR["D"])
        assert one.state == "loose"
        assert "drivers are needed" in hand.say()
        hand.click(SIX_BAR["G"])
        assert one.state == "no_driver"
        assert hand.say().startswith("Nothing drives it yet. Click the link that is driven: link1")
        hand.take("driver")
        assert one.page.locator(".build-halo.candidate").count() >= 2
        hand.click(middle(SIX_BAR["A"], SIX_BAR["B"]))
        assert one.page.locator(".mend").is_hidden()
        # Nothing has jumped.
        assert one.page.evaluate("JSON.stringify(assurStudio.canvas.stage.view)") == view
        expected = assur.Mechanism(
            joints=SIX_BAR,
            links={
                "ground": ["A", "D", "G"], "crank": ["A", "B"], "coupler": ["B", "C"],
                "rocker": ["D", "C", "E"], "rod": ["E", "F"], "arm": ["F", "G"],
            },
            driver="crank",
        )  # fmt: skip
        assert_same_motion(one, expected, names)

        last = one.document
        undo, redo = one.button("Undo"), one.button("Redo")
        steps = []
        while one.state != "empty":
            undo.click()
            hand.settle()
            steps.append(one.state)
        # Two links, a plate, two links, three joints of the ground, the driver.
        assert len(steps) == 9
        assert one.document == EMPTY
        for _ in steps:
            redo.click()
            hand.settle()
        assert redo.is_disabled()
        assert one.document == last
        assert_same_motion(one, expected, names)


def test_the_first_press_after_new_lands_in_the_new_picture(browser: Browser) -> None:
    # The server's answers are late: the picture before must not stand, or the first joint is
    # where that one would have it.
    late = """() => {
        const { link } = assurStudio.model;
        const take = link.take.bind(link);
        link.take = (frame) => setTimeout(() => take(frame), 400);
    }"""
    with window(browser) as one:
        one.page.evaluate(late)
        before = one.px(0.0, 0.0)
        one.button("New").click()
        assert one.px(0.0, 0.0) != before
        one.button("Draw a link").click()
        places = SIX_BAR["A"], SIX_BAR["B"]
        for place in places:
            one.page.mouse.click(*one.px(*place))
        one.settle()
        assert one.document["joints"] == {"A": list(places[0]), "B": list(places[1])}


def test_a_slider_crank_by_the_slide_tool(browser: Browser) -> None:
    with window(browser) as one:
        hand = Hand(one)
        hand.take("ground")
        hand.click((0.0, 0.1))
        hand.take("link")
        hand.drag((0.0, 0.1), (0.02, 0.14))
        hand.drag((0.02, 0.14), (0.15, 0.1))
        hand.take("slide")
        # As good as level is level.
        hand.drag((0.15, 0.1), (0.19, 0.1005))
        hand.take("driver")
        hand.click((0.01, 0.12))
        expected = assur.Mechanism(
            joints={"A": (0.0, 0.1), "B": (0.02, 0.14), "C": (0.15, 0.1)},
            links={"ground": ["A"], "crank": ["A", "B"], "rod": ["B", "C"], "ram": ["C"]},
            slides={"guide": assur.Slide("ram", "ground", angle=0.0, origin="A")},
            driver="crank",
        )
        assert_same_motion(one, expected, {name: name for name in "ABC"})
        # The slide goes with its block, by a click on it.
        place = one.place("C")
        x, y = one.px(*place)
        hand.take("remove")
        one.page.mouse.click(x + 13.0, y + 7.0)
        hand.settle()
        assert "slides" not in one.document
        assert sorted(one.document["links"]) == ["crank", "ground", "link1"]


def test_a_boom_on_a_cylinder(browser: Browser) -> None:
    with window(browser) as one:
        hand = Hand(one)
        hand.take("ground")
        hand.click((0.0, 0.1), (0.05, 0.03))
        hand.take("link")
        hand.drag((0.0, 0.1), (0.1, 0.15))
        hand.take("cylinder")
        hand.click((0.05, 0.03), (0.1, 0.15))
        hand.take("driver")
        hand.click(middle((0.05, 0.03), (0.1, 0.15)))
        assert one.document["driver"] == "cylinder1"
        expected = assur.Mechanism(
            joints={"A": (0.0, 0.1), "B": (0.05, 0.03), "C": (0.1, 0.15)},
            links={"ground": ["A", "B"], "boom": ["A", "C"]},
            slides={"lift": assur.Cylinder("B", "C")},
            driver="lift",
        )
        assert_same_motion(one, expected, {name: name for name in "ABC"})


def test_why_a_braced_four_bar_is_stuck_and_what_mends_it(browser: Browser) -> None:
    with window(browser) as one:
        one.open(FOUR_BAR)
        hand = Hand(one, is_empty=False)
        one.seek(1.0)
        a, b = (one.place(name) for name in "AC")
        hand.take("link")
        hand.click(a)
        hand.click(b)
        assert one.state == "stuck"
        # The drawing is where the mechanism was seen.
        assert one.place("C") == pytest.approx(b, abs=1e-6)
        assert one.place("C") != pytest.approx(tuple(FOUR_BAR["joints"]["C"]), abs=0.1)
        assert hand.say() == (
            "crank, coupler, rocker and link1 hold each other. Take one out, or let a joint slide."
        )
        assert one.page.locator(".mend .why b").all_text_contents() == [
            "crank", "coupler", "rocker", "link1",
        ]  # fmt: skip
        counts = [int(text) for text in one.page.locator(".count dd").all_text_contents()]
        assert counts == [4, 6, 0]
        held = "[...document.querySelectorAll('.links g.holds')].map((g) => g.dataset.link)"
        assert set(one.page.evaluate(held)) == {"crank", "coupler", "rocker", "link1"}
        last = one.page.locator(".links g.holds.last").first
        assert last.get_attribute("data-link") == "link1"
        assert one.page.locator(".dock .play").is_disabled()
        # The page shows what the core offers; here a remedy of our own.
        one.page.evaluate(
            """(own) => {
                 const { model } = assurStudio;
                 const remedies = [{ text: "Take out link1", document: own }];
                 model.checked = { ...model.checked, remedies };
                 model.emit("checked");
               }""",
            {**one.document, "links": FOUR_BAR["links"]},
        )
        remedy = one.page.locator(".remedy").first
        remedy.hover()
        assert one.page.locator(".remedy-ghost path").count() > 3
        one.page.mouse.move(500.0, 500.0)
        assert one.page.locator(".remedy-ghost path").count() == 0
        one.button("Do it: Take out link1").click()
        hand.settle()
        assert one.state == "moves"
        one.button("Undo").click()
        hand.settle()
        assert one.state == "stuck"
        hand.take("remove")
        hand.click(middle(a, b))
        assert one.state == "moves"
        assert one.document["links"] == FOUR_BAR["links"]


def test_a_joint_dropped_on_another_is_joined_if_it_was_offered(browser: Browser) -> None:
    with window(browser) as one:
        hand = Hand(one)
        hand.take("link")
        hand.drag((0.02, 0.05), (0.05, 0.1))
        hand.drag((0.12, 0.1), (0.15, 0.05))
        hand.take("select")
        drawn = one.document
        start, end = one.px(0.12, 0.1), one.px(0.05, 0.1)
        ring, text = one.page.locator(".building .ring"), one.page.locator(".ring-text")

        def hold(x: float, y: float) -> None:
            one.page.mouse.move(*start)
            one.page.mouse.down()
            one.page.mouse.move(x, y, steps=6)
            one.page.wait_for_timeout(30)

        # As if it had not begun.
        hold(end[0] + 6.0, end[1] + 5.0)
        assert text.text_content() == "join C and B"
        one.page.keyboard.press("Escape")
        one.page.mouse.up()
        hand.settle()
        assert one.document == drawn
        assert ring.count() == 0
        # With Alt nothing catches.
        one.page.keyboard.down("Alt")
        hold(end[0] + 6.0, end[1] + 5.0)
        assert ring.count() == 0
        one.page.mouse.up()
        one.page.keyboard.up("Alt")
        hand.settle()
        assert sorted(one.document["joints"]) == ["A", "B", "C", "D"]
        one.button("Undo").click()
        hand.settle()
        hold(end[0] + 6.0, end[1] + 5.0)
        one.page.mouse.up()
        hand.settle()
        assert one.document["links"] == {"ground": [], "link1": ["A", "B"], "link2": ["B", "D"]}
        one.button("Undo").click()
        hand.settle()
        assert one.document == drawn
        # A joint on a link becomes one of it.
        hold(*one.px(0.035, 0.075))
        assert text.text_content() == "join C and link1"
        one.page.mouse.up()
        hand.settle()
        assert one.document["links"]["link1"] == ["A", "B", "C"]


def test_what_moves_is_joined_where_it_is_dropped(browser: Browser) -> None:
    with window(browser) as one:
        one.open(FOUR_BAR)
        one.seek(2.0)
        b, p = one.place("B"), one.place("P")
        x, y = one.joint_px("A")
        one.page.mouse.move(*one.joint_px("P"))
        one.page.mouse.down()
        one.page.mouse.move(x + 5.0, y - 4.0, steps=6)
        assert one.page.locator(".ring-text").text_content() == "join P and A"
        one.page.mouse.up()
        one.settle()
        assert one.document["links"]["coupler"] == ["B", "C", "A"]
        assert "P" not in one.document["joints"]
        assert one.state == "stuck"
        # All else is where it was seen, and one step goes back.
        assert one.place("B") == pytest.approx(b, abs=1e-6)
        one.button("Undo").click()
        one.settle()
        assert one.document == FOUR_BAR
        assert one.q == pytest.approx(2.0, abs=1e-9)
        assert one.place("P") == pytest.approx(p, abs=1e-6)


def test_escape_leaves_no_trace(browser: Browser) -> None:
    with window(browser) as one:
        hand = Hand(one)
        undo = one.page.evaluate("assurStudio.model.history.canUndo")
        hand.take("link")
        hand.click((0.05, 0.05))
        one.page.mouse.move(*one.px(0.1, 0.1))
        assert one.page.locator(".building .begun").count() == 1
        one.page.keyboard.press("Escape")
        assert one.page.locator(".building .begun").count() == 0
        one.page.mouse.move(*one.px(0.05, 0.05))
        one.page.mouse.down()
        one.page.mouse.move(*one.px(0.12, 0.12), steps=4)
        one.page.keyboard.press("Escape")
        one.page.mouse.up()
        hand.settle()
        assert one.document == EMPTY
        assert one.page.evaluate("assurStudio.model.history.canUndo") == undo
        # Nothing is begun: now it lays the tool down.
        one.page.keyboard.press("Escape")
        assert one.page.locator(".tool[data-tool=select]").get_attribute("aria-pressed") == "true"


def test_what_an_undo_takes_away_while_it_is_dragged_leaves_no_trace(browser: Browser) -> None:
    with window(browser) as one:
        hand = Hand(one)
        for tool in ("slide", "link", "cylinder"):
            hand.take("joint")
            hand.click((0.05, 0.05))
            hand.take(tool)
            one.page.mouse.move(*one.px(0.05, 0.05))
            one.page.mouse.down()
            one.page.mouse.move(*one.px(0.12, 0.12), steps=4)
            one.page.evaluate("assurStudio.model.undo()")
            hand.settle()
            assert one.document == EMPTY
            one.page.mouse.move(*one.px(0.15, 0.1), steps=4)
            one.page.mouse.up()
            hand.settle()
            assert one.document == EMPTY, tool


def test_keys_alone_draw_and_edit(browser: Browser) -> None:
    with window(browser) as one:
        hand = Hand(one)
        keys = one.page.keyboard
        told = one.page.locator(".canvas > .status")

        def press(*names: str) -> None:
            for name in names:
                keys.press(name)
                hand.settle()

        one.button("Draw a link").focus()
        press("Enter")
        press(
            "ArrowLeft",
            "ArrowLeft",
            "Enter",
            "ArrowUp",
            "ArrowUp",
            "Enter",
            "Shift+ArrowRight",
            "Enter",
            "Escape",
            "Escape",
        )
        assert one.document["links"] == {"ground": [], "link1": ["A", "B"], "link2": ["B", "C"]}
        a, b, c = (one.document["joints"][name] for name in "ABC")
        assert (a[0], c[1]) == pytest.approx((b[0], b[1]), abs=1e-9)
        press("Tab", "g")
        assert told.text_content() == "Joint A of ground, link1"
        assert one.document["links"]["ground"] == ["A"]
        press("Tab", "Tab")
        # Presses that follow each other are one step.
        keys.press("Shift+ArrowUp")
        keys.press("ArrowUp")
        hand.settle()
        step = 11.0 / one.page.evaluate("assurStudio.canvas.stage.view.scale")
        assert one.document["joints"]["C"] == pytest.approx([c[0], c[1] + step], abs=1e-9)
        press("Control+z")
        assert one.document["joints"]["C"] == c
        press("Control+y")
        press("Control+z", "Control+Shift+z")
        assert one.document["joints"]["C"] != c
        press("Enter")
        field = one.page.get_by_label("x, mm")
        assert field.evaluate("(e) => e === document.activeElement")
        keys.type("abc")
        press("Enter")
        assert (
            one.page.locator(".item-field .field-error").text_content() == "“abc” is not a length."
        )
        before = one.document
        field.fill("12 cm")
        one.page.get_by_role("textbox", name="Name").fill("P")
        press("Enter")
        assert one.document["joints"]["P"] == pytest.approx(
            [0.12, before["joints"]["C"][1]], abs=1e-9
        )
        assert one.document["links"]["link2"] == ["B", "P"]
        press("Control+z")
        assert one.document == before
        # Joints A, B, C, then links.
        press("Tab", "Tab", "Tab", "Tab")
        assert told.text_content() == "Link link1, joints A, B"
        press("d")
        assert one.document["driver"] == "link1"
        press("Tab", "Delete")
        assert sorted(one.document["links"]) == ["ground", "link1"]
        assert one.state == "moves"


def test_fingers(browser: Browser) -> None:
    with window(browser, width="narrow") as one:
        hand = Hand(one)
        box = one.page.locator("svg.picture").first.bounding_box()
        assert box is not None
        link = one.page.locator(".tool[data-tool=link]")
        size = link.bounding_box()
        assert size is not None
        assert min(size["width"], size["height"]) >= 44.0
        link.click()
        tap = """([x, y, dx]) => {
          const { picture } = assurStudio.canvas;
          picture.setPointerCapture = () => {};
          const at = (type, px, id) => picture.dispatchEvent(new PointerEvent(type, {
            clientX: px, clientY: y, pointerId: id, bubbles: true, button: 0, pointerType: "touch",
          }));
          at("pointerdown", x, 1);
          if (dx) at("pointerdown", x + dx, 2);
          if (dx) at("pointerup", x + dx, 2);
          at("pointerup", x, 1);
        }"""
        x, y = box["x"] + 100.0, box["y"] + 200.0
        for place in ([x, y, 0], [x + 80.0, y, 0], [x + 80.0, y, 0]):
            one.page.evaluate(tap, place)
            hand.settle()
        assert one.document["links"]["link1"] == ["A", "B"]
        # Within 22 px a finger is on the joint; two fingers zoom, and draw nothing.
        ax, ay = one.joint_px("A")
        one.page.evaluate(tap, [ax - 14.0, ay - 14.0, 0])
        one.page.evaluate(tap, [ax + 40.0, ay - 90.0, 60])
        assert one.document["links"] == {"ground": [], "link1": ["A", "B"]}
        one.page.evaluate(tap, [ax + 40.0, ay - 90.0, 0])
        hand.settle()
        assert one.document["links"]["link2"] == ["A", "C"]


def test_a_double_click_opens_the_fields_of_a_joint(browser: Browser) -> None:
    with window(browser) as one:
        one.page.mouse.dblclick(*one.joint_px("C"))
        field = one.page.locator(".item-field")
        field.get_by_role("textbox", name="Name").fill("K")
        field.get_by_role("button", name="Apply").click()
        one.settle()
        assert "K" in one.document["joints"]
        assert "C" not in one.document["joints"]
