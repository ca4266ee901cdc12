"""Results that a file asks for are those of the methods."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import pytest

import assur
from assur.files import Contents, Range
from assur.files.wanted import WANTED
from files.sample_files import BY_HAND, EXAMPLES
from files.sample_files import WANTED as ALL_WANTED
from models.machines.file_machines import MOTORS
from models.machines.machines import four_bar, press

if TYPE_CHECKING:
    from pathlib import Path


def test_the_samples() -> None:
    turn = assur.files.read(EXAMPLES / "crank_rocker.toml")
    assert turn.machine is None
    motion = turn.result("solve")
    q = np.radians(np.arange(361.0))
    assert motion.joint("P").value == pytest.approx(turn.mechanism.solve(q).joint("P").value)
    assert [motion.shape, motion.order] == [(361,), 2]
    with pytest.raises(assur.InputError, match="outputs"):
        motion.joint("B")

    sized = assur.files.read(EXAMPLES / "press.toml")
    assert sized.machine is not None
    wheel, own = sized.result("flywheel"), sized.machine.flywheel(fluctuation=0.02)
    assert (wheel.inertia, wheel.delta) == (own.inertia, own.delta)
    assert sized.mechanism.dimensions["rod.length"] == 0.4

    arm = assur.files.read(EXAMPLES / "excavator.toml")
    assert arm.machine is not None
    q = np.linspace([2.6, 2.2], [3.2, 2.8], 25)
    forces = arm.machine.reactions(q, sense=(1, 1)).driver
    assert arm.result("reactions").driver.tobytes() == forces.tobytes()


def machine() -> assur.Machine:
    return press(assur.LinearMotor(900.0, 15.0))


RESULTS: dict[str, tuple[dict[str, Any], Any]] = {
    "solve": ({"q": Range(0.0, 2.0, count=5), "order": 1}, lambda r: r.slide("bore").d1),
    "reactions": ({"deg": [10.0, 20.0], "speed": 3.0}, lambda r: r.driver),
    "run": ({"t_end": 0.05, "q0": 0.1, "rtol": 1e-8}, lambda r: r.q),
    "steady_state": ({"mean": "period"}, lambda r: np.array([r.mean_speed, r.delta])),
    "flywheel": ({"fluctuation": 0.02}, lambda r: np.array(r.inertia)),
}


def test_results_after_a_round_trip(tmp_path: Path) -> None:
    wanted = {name: arguments for name, (arguments, _) in RESULTS.items()}
    before = Contents(machine().mechanism, machine(), wanted)  # type: ignore[arg-type]
    assur.files.save(before, tmp_path / "m.toml")
    after = assur.files.read(tmp_path / "m.toml")
    assert list(after.wanted) == list(wanted)
    for name, (_, number) in RESULTS.items():
        assert number(before.result(name)).tobytes() == number(after.result(name)).tobytes()
    expected = machine().reactions(np.radians([10.0, 20.0]), 3.0).driver
    assert after.result("reactions").driver == pytest.approx(expected)


def test_every_argument_is_one_of_the_method(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    four_bar().save(path)
    path.write_text(path.read_text() + "[bodies]\ncrank = { inertia = 1 }\n" + ALL_WANTED)
    contents = assur.files.read(path)
    assert contents.machine is not None
    either = {"solve": {"deg"}, "reactions": {"deg"}, "run": {"q_end"}}
    for name, words in WANTED.items():
        assert set(contents.wanted[name]) == set(words) - either.get(name, set())
    # Methods take them all.
    assert contents.result("run").t[-1] == 0.1
    assert contents.result("reactions").driver.shape == (2,)
    assert contents.result("solve").order == 3


def test_arguments_that_a_method_refuses(tmp_path: Path) -> None:
    path = tmp_path / "m.toml"
    text = BY_HAND["press"] + "\n[run]\nt_end = 1.0\nrtol = -1\n"
    path.write_text(text, encoding="utf-8")
    contents = assur.files.read(path)
    with pytest.raises(assur.files.FileError, match="rtol") as caught:
        contents.result("run")
    assert (caught.value.key, caught.value.line) == ("run", text.count("\n") - 2)
    with pytest.raises(assur.InputError, match="does not ask for 'solve'; it asks for: flywheel"):
        contents.result("solve")
    # What happens to the mechanism is no fault of the file.
    path.write_text(BY_HAND["excavator"].replace("stop = [3.2", "stop = [9.2"), encoding="utf-8")
    with pytest.raises(assur.PositionError):
        assur.files.read(path).result("reactions")


@pytest.mark.parametrize(
    ("given", "values"),
    [
        (Range(0.0, 1.0, step=0.1), np.arange(11) * 0.1),
        (Range(0.0, 0.95, step=0.1), np.arange(10) * 0.1),
        (Range(1.0, 0.0, step=-0.5), [1.0, 0.5, 0.0]),
        (Range(2.0, 2.0, step=1.0), [2.0]),
        (Range(0.0, math.tau, count=5), np.arange(5) * math.pi / 2),
        (Range(0.0, 1.0, count=4, endpoint=False), [0.0, 0.25, 0.5, 0.75]),
        (Range((0.0, 1.0), (1.0, 5.0), count=3), [[0.0, 1.0], [0.5, 3.0], [1.0, 5.0]]),
    ],
    ids=str,
)
def test_ranges(given: Range, values: Any) -> None:
    assert given.values() == pytest.approx(np.array(values), abs=1e-15)
    assert np.asarray(given).tobytes() == given.values().tobytes()


@pytest.mark.parametrize(
    "given",
    [
        {"start": 0.0, "stop": 1.0},
        {"start": 0.0, "stop": 1.0, "step": 0.1, "count": 3},
        {"start": 0.0, "stop": 1.0, "step": 0.0},
        {"start": 0.0, "stop": 1.0, "step": -0.1},
        {"start": 0.0, "stop": 1e300, "step": 1e-300},
        {"start": 0.0, "stop": 1.0, "count": 0},
        {"start": 0.0, "stop": 1.0, "count": 10**8},
        {"start": 0.0, "stop": (1.0, 2.0), "count": 3},
        {"start": (0.0, 1.0), "stop": (1.0, 2.0), "step": 0.1},
        {"start": 0.0, "stop": 1.0, "step": 0.1, "endpoint": False},
        {"start": math.nan, "stop": 1.0, "count": 3},
        {"start": 0.0, "stop": [[1.0]], "count": 3},
        {"start": 0.0, "stop": 1.0, "count": 2.5},
        {"start": 0.0, "stop": 1.0, "step": math.inf},
        {"start": -1e308, "stop": 1e308, "step": 1e302},
        {"start": (0.0, -1e308), "stop": (1.0, 1e308), "count": 3},
    ],
    ids=str,
)
def test_ranges_that_are_refused(given: dict[str, Any]) -> None:
    with pytest.raises(assur.InputError, match="a range"):
        Range(**given)


def test_what_a_file_cannot_ask_for(tmp_path: Path) -> None:
    for name, words in {"effort": "one of 'solve'", "run": "needs a machine"}.items():
        with pytest.raises(assur.InputError, match=words):
            Contents(four_bar(), wanted={name: {}})
    with pytest.raises(assur.InputError, match="not that of the machine"):
        Contents(four_bar(), machine())
    wrong: dict[str, Any] = {"threads": 2, "q": math.nan, "deg": object(), "order": None}
    for key, value in wrong.items():
        contents = Contents(four_bar(), wanted={"solve": {key: value}})
        with pytest.raises(assur.InputError, match=key):
            assur.files.save(contents, tmp_path / "m.toml")


def test_arguments_of_numpy(tmp_path: Path) -> None:
    start, stop, count = np.float64(0.1), np.float64(0.5), cast("int", np.int64(3))
    wanted: dict[str, Any] = {
        "solve": {"deg": Range(start, stop, count=count), "order": 1, "outputs": ("C",)},
        "run": {"t_end": np.float64(0.1), "max_steps": 7, "atol": (1e-9, np.float64(1e-9))},
        "reactions": {"q": np.array([0.1, 0.2]), "sense": np.int64(1)},
    }
    own = assur.Machine(four_bar(), bodies={"crank": assur.Body(inertia=1.0)})
    assur.files.save(Contents(own.mechanism, own, wanted), tmp_path / "m.toml")  # type: ignore[arg-type]
    after = assur.files.read(tmp_path / "m.toml")
    assert after.wanted["solve"]["deg"] == Range(0.1, 0.5, count=3)
    assert after.wanted["run"] == {"t_end": 0.1, "max_steps": 7, "atol": (1e-9, 1e-9)}
    assert after.result("solve").joint("C").value.shape == (3, 2)


def test_motors_of_files_drive(tmp_path: Path) -> None:
    """A result with a motor of each kind is that of the machine in memory."""
    for motor in MOTORS.values():
        own = assur.Machine(four_bar(), bodies={"crank": assur.Body(inertia=1.0)}, motor=motor)
        own.save(tmp_path / "m.toml")
        loaded = assur.load(tmp_path / "m.toml")
        assert isinstance(loaded, assur.Machine)
        runs = [m.run(t_end=0.02, q0=0.5, speed0=1.0) for m in (own, loaded)]
        assert runs[0].speed.tobytes() == runs[1].speed.tobytes()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((5,), "mechanism is 5"),
        ((four_bar(), 5), "machine is 5"),
        ((four_bar(), None, None), "wanted is None"),
        ((four_bar(), None, {"solve": None}), "wanted is"),
    ],
)
def test_contents_are_checked(arguments: tuple[Any, ...], words: str) -> None:
    with pytest.raises(assur.InputError, match=words):
        Contents(*arguments)
