"""The self-contained page: its numbers, its modules, what it lets in, its static picture."""

from __future__ import annotations

import base64
import hashlib
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assur
from assur.pictures.page.bundle import MODULES as NAMES
from assur.pictures.page.bundle import module, script
from assur.pictures.page.html import css
from assur.pictures.page.payload import payload, played_of
from assur.pictures.page.turn import passing_turn, turn_of, turn_of_rows
from support.node import MODULES, run_node

EVIL = "</script><img/src=x/onerror=alert(1)>"


def example(name: str) -> assur.Mechanism:
    made = assur.examples.ALL[name]()
    if isinstance(made, assur.Mechanism):
        return made
    assert made.mechanism is not None
    return made.mechanism


def data_of(mechanism: assur.Mechanism) -> dict[str, Any]:
    return payload(played_of(turn_of(mechanism)), "", 1.0)


def dig(rows: int = 41) -> assur.Motion:
    """Return the excavator's motion from low to high and back."""
    low, high = np.array(assur.examples.RANGES["excavator"])
    parts = (1.0 - np.cos(np.linspace(0.0, 2.0 * np.pi, rows)[:, None])) / 2.0
    return example("excavator").solve(low + parts * (high - low))


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("page") / "watt.html"
    example("watt_1").to_html(path, speed=10.0)
    return path.read_text(encoding="utf-8")


# -- numbers -----------------------------------------------------------------


def values_in_motion(motion: assur.Motion, name: str, speed: float) -> Any:
    """Return what the page calls `name`, from the motion."""
    own, _, what = name.partition(".")
    if not what:
        return motion[own].value
    quantity = motion[own]
    rate = {"v": quantity.velocity, "omega": quantity.velocity, "a": quantity.acceleration,
            "alpha": quantity.acceleration}  # fmt: skip
    if own in motion.mechanism.joints:
        if what in "xy":
            return quantity.value[:, "xy".index(what)]
        arrays = rate[what[0]](speed)
        return arrays[:, "xy".index(what[1])] if len(what) > 1 else np.hypot(*arrays.T)
    return rate[what](speed)


CASES: dict[str, tuple[str, ...]] = {
    "crank_rocker": ("P.x", "P.v", "P.a", "C.ax", "rocker", "rocker.omega", "rocker.alpha"),
    "shaper": ("bed", "bed.v", "bed.a", "E.y", "lever.omega"),
    "oldham": ("shaft2", "shaft2.omega", "shaft2.alpha"),
    "scotch_yoke": ("bed", "bed.v", "bed.a"),
    "trammel": ("P.x", "P.vy", "y", "y.a"),
    "klann_leg": ("F.x", "F.y", "F.v", "F.a"),
    "loom": ("l107", "l107.omega", "l107.alpha", "7.v"),
    "tangent_generator": ("rail", "rail.v", "rail.a"),
}


def test_the_page_computes_what_the_motion_has() -> None:
    # Away from dead points, between the rows.
    speed = 7.0
    cases, motions = [], []
    for name, ids in CASES.items():
        mechanism = example(name)
        low, high = (-1.1, 1.1) if name == "tangent_generator" else (0.0, 6.27)
        q = np.linspace(low, high, 23) + 0.0041
        motions.append(mechanism.solve(q, order=2))
        cases.append({"data": data_of(mechanism), "q": q.tolist(), "ids": ids, "speed": speed})
    answers = json.loads(run_node(str(MODULES / "values.mjs"), stdin=json.dumps(cases)))
    for (name, ids), motion, answer in zip(CASES.items(), motions, answers, strict=True):
        for quantity, values in zip(ids, answer, strict=True):
            expected = values_in_motion(motion, quantity, speed)
            size = np.abs(expected).max()
            error = np.abs(np.array(values) - expected).max()
            tolerance = {"a": 3e-4, "v": 2e-6}.get(quantity.rpartition(".")[2][0], 2e-6)
            tolerance = 3e-4 if quantity.endswith("alpha") else tolerance
            assert error <= tolerance * max(size, 0.01), (name, quantity, error, size)


def test_near_dead_points_the_page_is_as_true_as_its_rows() -> None:
    mechanism = example("peaucellier")
    dead = mechanism.limits().dead_points[-1].q
    q = dead - np.array([1e-4, 1e-3, 1e-2, 0.1])
    case = {"data": data_of(mechanism), "q": q.tolist(), "speed": 1.0,
            "ids": ("P.y", "arm2", "arm2.omega")}  # fmt: skip
    answer = json.loads(run_node(str(MODULES / "values.mjs"), stdin=json.dumps([case])))[0]
    motion = mechanism.solve(q)
    assert np.abs(np.array(answer[0]) - motion.joint("P").value[:, 1]).max() < 1e-6
    assert np.abs(np.array(answer[1]) - motion.link("arm2").value).max() < 1e-5
    assert np.array(answer[2]) == pytest.approx(motion.link("arm2").d1, rel=2e-3)


def test_rows_of_several_drivers_have_velocities_in_time() -> None:
    motion = dig(81)
    turn = turn_of_rows(motion, 8.0)
    assert (turn.unit, turn.closes, turn.grid["high"]) == ("time", True, 8.0)
    t = np.linspace(0.0, 8.0, 81)
    tip = turn.frames.joints()["tip"]
    assert tip == pytest.approx(motion.joint("tip").value, abs=1e-12)
    # q = (1 − cos ωt)/2 has the speed ω/2 · sin ωt; central differences are true to (ω·dt)²/6.
    span = motion.q[40] - motion.q[0]
    omega = 2.0 * np.pi / 8.0
    speed = span * omega / 2.0 * np.sin(omega * t)[:, None]
    exact = np.einsum("ncd,nd->nc", motion.joint("tip").arrays[1].reshape(81, 2, 3), speed)
    i = turn.frames.links.index("bucket")
    angle, spin = turn.frames.values[0][:, i, 2], turn.frames.values[1][:, i]
    x, y = turn.frames.local["bucket"]["tip"]
    arm = np.stack([np.cos(angle) * x - np.sin(angle) * y, np.sin(angle) * x + np.cos(angle) * y])
    own = spin[:, :2] + spin[:, 2:] * np.stack([-arm[1], arm[0]], axis=1)
    assert np.abs(own - exact).max() < 2e-3 * np.abs(exact).max()


def test_turns_begin_at_zero_and_periods_of_two_turns_are_whole() -> None:
    turn = turn_of(example("andrews_squeezer"))
    assert (turn.grid["low"], turn.closes) == (0.0, True)
    assert turn.at == pytest.approx(example("andrews_squeezer").q0 % (2.0 * np.pi))
    limited = turn_of(example("peaucellier"))
    dead = example("peaucellier").limits().dead_points
    assert [q for q, _ in limited.dead_points] == pytest.approx([point.q for point in dead])
    assert [group for _, group in limited.dead_points] == ["II(arm1, side1)"] * 2


def test_a_slide_that_drives_is_played_over_its_reach() -> None:
    mechanism = assur.SliderCrank(0.05, 0.2).with_driver("bore", q=1.0)
    turn = turn_of(mechanism)
    ends = turn.grid["middle"] + turn.grid["half"] * np.array([-1.0, 1.0])
    assert turn.unit == "length"
    assert ends == pytest.approx([0.15, 0.25])


# -- the file ----------------------------------------------------------------


def test_a_six_bar_is_small(page: str) -> None:
    assert len(page.encode()) < 130_000


def test_nothing_comes_from_elsewhere(page: str) -> None:
    outside = set(re.findall(r"https?://[^\"'\s<>]+", page))
    assert outside == {"http://www.w3.org/2000/svg"}
    assert not re.search(r"@import|url\(|\bfetch\(|XMLHttpRequest|WebSocket|import\(", page)


def test_the_policy_names_script_and_style_alone(page: str) -> None:
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', page)
    assert policy is not None
    rules = dict(rule.strip().split(" ", 1) for rule in policy[1].split(";"))
    assert rules["default-src"] == "'none'"
    for tag, rule in (("style", "style-src"), ('script type="module"', "script-src")):
        text = re.search(f"<{tag}>(.*?)</{tag.split()[0]}>", page, re.DOTALL)
        assert text is not None
        digest = base64.b64encode(hashlib.sha256(text[1].encode()).digest()).decode()
        assert rules[rule] == f"'sha256-{digest}'"


class Tags(HTMLParser):
    """Counts tags."""

    def __init__(self) -> None:
        super().__init__()
        self.seen: list[str] = []

    def handle_starttag(self, tag: str, attrs: object) -> None:  # noqa: ARG002
        self.seen.append(tag)


def evil_mechanism() -> assur.Mechanism:
    # Names may have no brackets, quotes, slashes and blanks.
    return assur.Mechanism(
        joints={"A": (0, 0), "&lt;b": (1, 0), "&amp;": (4, 3), "D": (5, 0)},
        links={"ground": ["A", "D"], "&#60;": ["A", "&lt;b"], "&lt;img": ["&lt;b", "&amp;"],
               "--": ["D", "&amp;"]},
        driver="&#60;",
    )  # fmt: skip


def test_names_and_titles_do_no_harm(tmp_path: Path) -> None:
    path = tmp_path / "evil.html"
    evil_mechanism().to_html(path, title=EVIL)
    tags = Tags()
    tags.feed(path.read_text(encoding="utf-8"))
    assert "img" not in tags.seen
    assert "b" not in tags.seen
    assert tags.seen.count("script") == 2
    data = re.search(r'type="application/json">(.*?)</script>', path.read_text("utf-8"), re.DOTALL)
    assert data is not None
    assert json.loads(data[1])["title"] == EVIL
    assert data[1].count("<") == 0
    picture = evil_mechanism()._repr_svg_() or ""
    names = [text.text for text in ET.fromstring(picture).iter("{http://www.w3.org/2000/svg}text")]
    assert "&lt;b" in names
    shown = Tags()
    shown.feed(evil_mechanism()._repr_html_() or "")
    assert set(shown.seen) <= {"div", "svg", "style", "rect", "path", "circle", "text", "script"}


def test_arguments_reach_the_page(tmp_path: Path) -> None:
    path = tmp_path / "press.html"
    example("crank_rocker").to_html(
        path, q=0.5, speed=12.5, joint=["C"], diagrams=["C.x", "rocker.omega"], dark=True
    )
    text = path.read_text(encoding="utf-8")
    data = json.loads(text.split('application/json">')[1].split("</script>")[0])
    assert (data["title"], data["speed"], data["turn"]["at"]) == ("press", 12.5, 0.5)
    assert (data["paths"], data["diagrams"]) == (["C"], ["C.x", "rocker.omega"])
    assert 'class="assur" data-theme="dark"' in text
    example("crank_rocker").to_html(str(path), q=[0.0, 0.5, 1.5])
    grid = json.loads(path.read_text("utf-8").split('application/json">')[1].split("</script>")[0])
    assert grid["turn"]["grid"] == {"kind": "rows", "q": [0.0, 0.5, 1.5]}


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"path": "no/such/folder/x.html"}, "no/such/folder/x.html: cannot be written: No such"),
        ({"path": 3}, "path is 3"),
        ({"speed": float("nan")}, "speed is nan"),
        ({"joint": ["Q"]}, "no joint 'Q'"),
        ({"diagrams": ["rocker.omga"]}, "did you mean 'rocker.omega'"),
        ({"diagrams": ["C.x"] * 2 + ["C.y", "P.x", "P.y"]}, "up to 3"),
        ({"diagrams": 4}, "diagrams is 4"),
        ({"title": 4}, "title is 4"),
        ({"dark": "yes"}, "dark is 'yes'"),
        ({"q": [[0.0, 1.0]]}, "shape"),
        ({"q": [1.0]}, "at least 2"),
    ],
)
def test_what_cannot_be_shown_is_refused(
    tmp_path: Path, arguments: dict[str, Any], words: str
) -> None:
    given = {"path": tmp_path / "x.html", **arguments}
    with pytest.raises(assur.InputError, match=re.escape(words)):
        example("crank_rocker").to_html(**given)


def test_batches_several_drivers_and_far_coordinates_are_refused(tmp_path: Path) -> None:
    batch = assur.FourBar(1.0, [2.9, 3.0], 2.5, 3.0)
    with pytest.raises(assur.InputError, match=r"a batch \(2,\).*design\(i\)"):
        batch.to_html(tmp_path / "x.html")
    with pytest.raises(assur.InputError, match=r"3 drivers.*motion.to_html"):
        example("excavator").to_html(tmp_path / "x.html")
    with pytest.raises(assur.InputError, match=r"q is 3, beyond what can be reached: \[-1\.68"):
        example("peaucellier").to_html(tmp_path / "x.html", q=3.0)
    with pytest.raises(assur.InputError, match="duration is -1 s"):
        dig().to_html(tmp_path / "x.html", duration=-1.0)
    with pytest.raises(assur.InputError, match=r"shape \(\)"):
        example("crank_rocker").solve(1.0).to_html(tmp_path / "x.html")


def test_positions_that_do_not_exist_leave_gaps(tmp_path: Path) -> None:
    m = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    motion = m.solve(np.linspace(-2.0, 2.0, 41), on_error="nan")
    motion.to_html(tmp_path / "x.html")
    turn = turn_of_rows(motion)
    assert turn.frames.is_known.sum() == 27
    lost = m.solve(np.linspace(3.0, 3.2, 5), on_error="nan")
    with pytest.raises(assur.InputError, match="no position to draw"):
        lost.to_html(tmp_path / "x.html")


@pytest.mark.parametrize("name", sorted(assur.examples.ALL))
def test_every_example_has_a_page(name: str, tmp_path: Path) -> None:
    mechanism = example(name)
    if mechanism.driver_count > 1:
        low, high = np.array(assur.examples.RANGES[name])
        mechanism.solve(np.linspace(low, high, 21)).to_html(tmp_path / "x.html")
        assert mechanism._repr_html_() is None
    else:
        mechanism.to_html(tmp_path / "x.html")
    assert (tmp_path / "x.html").stat().st_size < 170_000


# -- modules -----------------------------------------------------------------


def test_names_at_the_top_of_modules_differ() -> None:
    found = [
        name
        for one in NAMES
        for name in re.findall(
            r"^(?:export )?(?:async )?(?:function|class|const|let) (\w+)", module(one), re.MULTILINE
        )
    ]
    assert sorted(found) == sorted(set(found))


def test_modules_import_plainly_and_only_what_comes_before() -> None:
    before: set[str] = set()
    folder = Path(assur.__file__).parent / "pictures" / "page"
    assert sorted(NAMES) == sorted(path.stem for path in folder.glob("*.js"))
    for name in NAMES:
        source = module(name)
        imports = re.findall(r"^import .*$", source, re.MULTILINE)
        plain = re.findall(r'^import \{([^}]*)\} from "\./(\w+)\.js";$', source, re.MULTILINE)
        assert len(imports) == len(plain), name
        for names, of in plain:
            assert of in before, (name, of)
            assert " as " not in names
            exported = re.findall(
                r"^export (?:function|class|const) (\w+)", module(of), re.MULTILINE
            )
            assert {one.strip() for one in names.split(",")} <= set(exported), (name, of)
        # Blanks at the beginning of lines are removed: no text runs over lines.
        lines = re.sub(r"/\*.*?\*/|//.*", "", source, flags=re.DOTALL if "/*" in source else 0)
        assert all(line.count("`") % 2 == 0 for line in source.splitlines()), name
        assert "export default" not in lines
        before.add(name)


def test_the_bundle_is_a_script(tmp_path: Path) -> None:
    text = script()
    assert "import " not in text
    assert "export " not in text
    assert "</script" not in text
    path = tmp_path / "bundle.mjs"
    path.write_text(text, encoding="utf-8")
    run_node("--check", str(path))


def test_the_modules_pass_their_own_tests() -> None:
    report = run_node("--test", *sorted(str(path) for path in MODULES.glob("*.test.js")))
    assert re.search(r"^# fail 0$", report, re.MULTILINE) or "fail 0" in report
    passed = re.search(r"pass (\d+)", report)
    assert passed is not None
    assert int(passed[1]) >= 30


def test_all_colours_come_from_the_palette() -> None:
    from assur.pictures.page import bundle

    source = bundle.stylesheet()
    used = set(re.findall(r"var\(--([\w-]+)\)", source + script())) - {"own"}
    known = set(re.findall(r"--([\w-]+):", css()))
    assert {name for name in used if not name.startswith("group")} <= known
    # Nothing but shadows has a colour of its own.
    assert set(re.findall(r"#[0-9A-Fa-f]{3,8}\b", source)) == {"#0003"}


# -- static pictures and notebooks -------------------------------------------


def test_the_static_picture_is_well_formed_and_has_every_joint() -> None:
    picture = example("crank_rocker")._repr_svg_()
    assert picture is not None
    root = ET.fromstring(picture)
    space = "{http://www.w3.org/2000/svg}"
    assert sorted(text.text or "" for text in root.iter(f"{space}text")) == [
        "A",
        "B",
        "C",
        "D",
        "P",
    ]
    assert len(list(root.iter(f"{space}circle"))) == 5
    assert root.get("aria-label") == "I(crank) → II(coupler, rocker)"


def test_the_static_picture_has_true_proportions() -> None:
    picture = assur.FourBar(1.0, 3.0, 2.5, 3.0)._repr_svg_()
    assert picture is not None
    circles = re.findall(r'<circle cx="([\d.]+)" cy="([\d.]+)"', picture)
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    drawn = np.array(circles, dtype=float)
    exact = np.array(list(m.solve(m.q0).joint(list(m.joints)).value))
    apart = np.linalg.norm(drawn[:, None] - drawn, axis=-1)
    true = np.linalg.norm(exact[:, None] - exact, axis=-1)
    known = {name: i for i, name in enumerate(m.joints)}
    order = [known[name] for name in ("A", "D", "B", "C")]
    ratio = np.sort(apart[np.triu_indices(4, 1)]) / np.sort(true[np.triu_indices(4, 1)])
    assert ratio == pytest.approx(ratio.mean(), rel=2e-3)
    assert len(order) == 4


def test_a_notebook_has_pictures_that_do_not_know_each_other() -> None:
    m = example("crank_rocker")
    one, other = m._repr_html_(), m._repr_html_()
    assert one is not None
    assert other is not None
    assert re.findall(r'id="([^"]+)"', one) != re.findall(r'id="([^"]+)"', other)
    assert one.count("<svg") == 1
    motion = m.solve(np.linspace(0.0, 6.0, 31))
    assert "<svg" in (motion._repr_html_() or "")


def test_pages_need_no_library() -> None:
    code = (
        "import sys, assur; assur.examples.engine()._repr_html_(); "
        "assert 'matplotlib' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_what_cannot_be_played_has_a_repr_alone() -> None:
    batch = assur.FourBar(1.0, [2.9, 3.0], 2.5, 3.0)
    assert batch._repr_html_() is None
    assert batch._repr_svg_() is None
    assert batch.solve([0.0, 1.0])._repr_html_() is None
    assert example("crank_rocker").solve(1.0)._repr_html_() is None


@pytest.mark.parametrize("name", sorted(assur.examples.ALL))
def test_a_turn_that_passes_is_the_whole_one_or_none(name: str) -> None:
    """Where the driver is seen to go round, its limits need not be looked for."""
    made = example(name)
    if made.driver_count > 1:
        assert passing_turn(made, 0.0, 61) is None
        return
    passing, whole = (f(made, float(made.q0), 61) for f in (passing_turn, turn_of))
    assert whole is not None
    assert (passing is not None) == (whole.closes and whole.grid["high"] == 2.0 * np.pi)
    if passing is None:
        return
    assert (passing.closes, passing.grid, passing.at) == (whole.closes, whole.grid, whole.at)
    for own, wanted in zip(passing.frames.values, whole.frames.values, strict=False):
        assert own == pytest.approx(wanted, rel=1e-13, abs=1e-13)


def test_no_turn_of_a_driven_slide_passes() -> None:
    guide = assur.Slide(link="block", on="ground", angle=0.0, origin="A")
    joints = {"A": (0.0, 0.0), "B": (0.6, 0.8), "C": (3.0, 0.0)}
    links = {"ground": ["A"], "crank": ["A", "B"], "rod": ["B", "C"], "block": ["C"]}
    sliding = assur.Mechanism(joints, links, driver="guide", slides={"guide": guide})
    assert passing_turn(sliding, float(sliding.q0), 61) is None
