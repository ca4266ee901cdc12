"""One argument of a call anything at all: a result, or an error of this package that says which."""

from __future__ import annotations

import inspect
import signal
import warnings
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib import pyplot as plt

import assur
from assur.dynamics.forces.bearing import Bearing
from assur.dynamics.forces.reactions import Reactions
from assur.kinematics.extremes import Extremes
from assur.kinematics.timed import TimedMotion
from fuzzing.fuzz_entries import LONGEST, LONGEST_MESSAGE, give_up
from fuzzing.fuzz_values import ODD_NUMBERS, ODD_OBJECTS, ODD_STRINGS
from fuzzing.usual_calls import MODULES, usual_calls
from support.samples import sample

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

mpl.use("Agg")

EXAMPLES = sample(2_000, 50_000)
# Made anew for each call.
ODD: tuple[Callable[[], Any], ...] = (
    *(lambda one=one: one for one in (*ODD_NUMBERS, *ODD_STRINGS)),
    *ODD_OBJECTS,
)
# Results whose classes are named in no module that users import.
RESULTS = (Bearing, Extremes, Reactions, TimedMotion)
# Made by the package alone; codes and words; base classes; what opens a browser; mappings, which
# raise KeyError.
NOT_CALLED = {
    *("Analogues", "Assemblies", "ConfigurationCurve", "DeadPoint", "Defect", "DesignMap", "Group"),
    *(
        "DesignFit",
        "Fit",
        "Fits",
        "Fits.__getitem__",
        "Limits",
        "LinkageFit",
        "Measures",
        "Motion",
        "ParetoFront",
        "ParetoFront.__getitem__",
        "Remedy",
        "Run",
        "Sensitivity",
        "SingularLocus",
        "Status",
    ),
    *("Runs", "SteadyState", "Structure", "Workspace", "balance.Harmonics", "balance.MomentBounds"),
    *("balance.RotatingParts", "crank_rocker.JammingEvent", "crank_rocker.JammingRun"),
    *("crank_rocker.Solution", "crank_rocker.Table1", "files.Contents", "flywheel.Extreme"),
    *("flywheel.Flywheel", "flywheel.Mean", "flywheel.ReducedTable", "flywheel.Spline"),
    *("importers.Imported", "metric.Condition"),
    *("slider_crank.Deviation", "slider_crank.Extreme", "Law.at", "Metric.value"),
    *("ClassIV.paper_equations", "MachineModel.explore", "Mechanism.explore"),
    *("Assembly.__getitem__", "Grid.__getitem__", "Runs.__getitem__"),
}


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Work in a directory of its own, in which calls read and write."""
    monkeypatch.chdir(tmp_path)
    usual_calls.cache_clear()
    yield
    usual_calls.cache_clear()


def check(message: str, kind: str | None) -> None:
    """Check that an error has a sentence, which can be printed."""
    assert message.strip()
    assert len(message.encode()) <= LONGEST_MESSAGE, message[:200]
    assert kind != "internal", message


def call_with(call: str, /, **odd: Any) -> None:
    """Call with odd values for some arguments; what is no error of this package goes through."""
    function, usual = usual_calls()[call]
    before = signal.signal(signal.SIGALRM, give_up)
    signal.setitimer(signal.ITIMER_REAL, LONGEST)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", assur.AssurWarning)
            function(**{**usual, **odd})
    except assur.AssurError as error:
        check(str(error), error.kind)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
        plt.close("all")


def test_one_odd_argument_gives_a_result_or_an_error_of_the_package() -> None:
    places = [(name, one) for name, call in usual_calls().items() for one in call.usual]

    @settings(max_examples=EXAMPLES)
    @given(st.sampled_from(places), st.integers(0, len(ODD) - 1))
    def one(place: tuple[str, str], which: int) -> None:
        name, parameter = place
        call_with(name, **{parameter: ODD[which]()})

    one()


@pytest.mark.filterwarnings("ignore::assur.AssurWarning")
def test_the_usual_arguments_are_taken() -> None:
    """Else an odd one would be refused for another reason."""
    for function, usual in usual_calls().values():
        function(**usual)
        plt.close("all")


def public() -> set[str]:
    """Return what users call with arguments: functions, classes, and methods of their classes."""
    found, owners = set[str](), set[type](RESULTS)
    for module in (assur, *MODULES):
        prefix = "" if module is assur else f"{module.__name__.rpartition('.')[2]}."
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isclass(thing):
                owners.add(thing)
            if callable(thing) and not _is_error(thing) and _parameters(thing):
                found.add(f"{prefix}{name}")
    bases = {base for owner in owners for base in owner.__mro__ if not _is_error(owner)}
    for owner in bases:
        for name, member in vars(owner).items() if owner.__module__.startswith("assur") else ():
            plain = getattr(member, "__func__", member)
            is_public = name == "__getitem__" or not name.startswith("_")
            if is_public and inspect.isfunction(plain) and _parameters(plain):
                found.add(f"{owner.__name__}.{name}")
    return found


def _parameters(function: Any) -> set[str]:
    return set(inspect.signature(function).parameters) - {"self", "cls"}


def _is_error(thing: Any) -> bool:
    return inspect.isclass(thing) and issubclass(thing, BaseException | Warning)


def test_every_public_call_is_tried() -> None:
    """A new one must be added to `usual_calls`."""
    wanted = public()
    called = {name.removeprefix("assur.") for name in usual_calls()}
    assert wanted - called == NOT_CALLED
    assert called - wanted == set()
