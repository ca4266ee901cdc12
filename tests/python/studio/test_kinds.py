"""What the kinds answer is what the package computes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from assur import examples
from assur.description.words import Status
from assur.files.write import text_of
from assur.studio import document
from studio.asking import FOUR_BAR, PRESS, Reply, ask, refused

TURN = 2.0 * np.pi


def machine() -> assur.Machine:
    return document.read_machine(PRESS)


@pytest.mark.parametrize("name", list(examples.ALL))
def test_open_and_turn(name: str) -> None:
    opened = ask("open", example=name)
    made: Any = examples.ALL[name]()
    contents = document.read(opened["document"])
    mechanism = contents.mechanism
    if contents.machine is None:
        assert mechanism == made
    else:
        assert text_of(contents.machine) == text_of(made)
    assert opened["structure"]["formula"] == mechanism.structure.formula.split(" → ")
    named = {one["name"]: one["value"] for one in opened["dimensions"]}
    assert named == dict(mechanism.dimensions)
    reply = ask("turn", document=opened["document"], rows=37)
    check_rows(reply, mechanism)


def check_rows(reply: Reply, mechanism: assur.Mechanism) -> None:
    """Compare the frames of a turn with joints that were solved for themselves."""
    turn, values = reply["payload"]["turn"], reply.arrays["values"]
    assert turn["values"] is None
    assert values.shape[:2] == (turn["orders"], turn["rows"])
    grid = turn["grid"]
    own = np.linspace(grid["low"], grid["high"], turn["rows"])
    if grid["kind"] == "cosine":
        own = grid["middle"] - grid["half"] * np.cos(own)
    q: Any = own
    if mechanism.driver_count > 1:
        q = np.repeat(np.asarray(mechanism.q0)[None], len(own), axis=0)
        q[:, 0] = own
    motion = mechanism.solve(q, order=1, on_error="nan")
    links = reply["payload"]["links"]
    for joint in reply["payload"]["joints"]:
        if joint["link"] == 0:
            continue
        x, y, angle = values[0, :, joint["link"] - 1].T
        px, py = joint["at"]
        there = np.stack(
            [
                x + np.cos(angle) * px - np.sin(angle) * py,
                y + np.sin(angle) * px + np.cos(angle) * py,
            ]
        )
        wanted = motion.joint(joint["name"]).value
        assert pytest.approx(wanted, abs=1e-6, nan_ok=True) == there.T, links[joint["link"]]


def test_turn_with_derivatives_and_limits() -> None:
    reply = ask("turn", document=FOUR_BAR, rows=91)
    motion = document.read_mechanism(FOUR_BAR).solve(np.linspace(0.0, TURN, 91))
    link = reply["payload"]["links"].index("rocker") - 1
    for order, wanted in enumerate((motion.link("rocker").value, motion.link("rocker").d1)):
        assert np.array_equal(reply.arrays["values"][order, :, link, 2], wanted)
    assert reply["payload"]["turn"]["limits"]["full_rotation"]
    assert ask("turn", document=FOUR_BAR, rows=91, orders=2).arrays["values"].shape[0] == 2
    double = {**FOUR_BAR, "dimensions": {"rocker.length": 1.2}}
    limits = assur.Mechanism.limits(document.read_mechanism(double))
    found = ask("turn", document=double, rows=91)["payload"]["turn"]["limits"]
    assert found["intervals"] == limits.intervals.tolist()
    assert [p["q"] for p in found["dead_points"]] == [p.q for p in limits.dead_points]


def test_turn_begins_where_it_can() -> None:
    short = {**FOUR_BAR, "dimensions": {"rocker.length": 1.2}}
    low, high = document.read_mechanism(short).limits().intervals[0]
    beyond = float(high) + 0.5
    turn = ask("turn", document=short, q=beyond)["payload"]["turn"]
    assert turn["at"] == pytest.approx((low + high) / 2.0)


def test_several_drivers_move_one_by_one() -> None:
    opened = ask("open", example="five_bar")["document"]
    mechanism = document.read_mechanism(opened)
    q = [1.6, 1.3]
    turn = ask("turn", document=opened, q=q, axis=1, rows=91)["payload"]["turn"]
    low, high = turn["grid"]["low"], turn["grid"]["high"]
    assert low < 1.3 < high
    for end, beyond in ((low, -0.02), (high, 0.02)):
        at_end = mechanism.solve([q[0], end], on_error="nan").status
        assert at_end < assur.Status.SINGULAR
        if high - low < TURN - 1e-9:
            assert mechanism.solve([q[0], end + beyond], on_error="nan").status > 0


def test_assemblies() -> None:
    opened = ask("open", example="triad")["document"]
    mechanism = document.read_mechanism(opened)
    q = float(mechanism.q0) + 0.1
    reply = ask("assemblies", document={**opened, "bodies": {}}, q=q)
    found = mechanism.assemblies(q)
    assert len(reply["assemblies"]) == len(found) > 1
    assert sum(one["is_current"] for one in reply["assemblies"]) == 1
    for one, wanted in zip(reply["assemblies"], found, strict=True):
        assert one["joints"] == {name: list(at) for name, at in (wanted.joints or {}).items()}
        limits = mechanism.limits(assembly=wanted)
        reach = np.array(one["reach"]["intervals"], dtype=float)
        ends = np.where(np.isfinite(limits.intervals), limits.intervals, np.nan)
        assert reach == pytest.approx(ends, abs=1e-9, nan_ok=True)
        assert "bodies" in one["document"]
        drawn = document.read_mechanism(one["document"])
        for name, at in one["joints"].items():
            assert drawn.solve(q).joint(name).value == pytest.approx(at, abs=1e-9)


def test_of_many_assemblies_those_that_differ_in_one_dyad() -> None:
    """Nine rockers on one crank have 512; all signs but one are the present ones."""
    joints: dict[str, tuple[float, float]] = {"A": (0, 0), "B": (0.3, 0.6)}
    links = {"ground": ["A"], "crank": ["A", "B"]}
    for i in range(9):
        joints |= {f"C{i}": (1.5 + 0.1 * i, 1.4), f"D{i}": (2 + 0.1 * i, 0)}
        links |= {f"rod{i}": ["B", f"C{i}"], f"rocker{i}": [f"D{i}", f"C{i}"]}
        links["ground"].append(f"D{i}")
    mechanism = assur.Mechanism(joints, links, "crank")
    q = float(mechanism.q0) + 0.05
    reply = ask("assemblies", document=document.document_of(mechanism), q=q)
    assert reply["most"] == 512
    own = dict(mechanism.assembly)
    assert reply["assemblies"][0]["is_current"]
    assert reply["assemblies"][0]["signs"] == own
    differ = [
        [name for name in own if one["signs"][name] != own[name]] for one in reply["assemblies"][1:]
    ]
    assert all(len(names) == 1 for names in differ)
    for one in reply["assemblies"]:
        drawn = document.read_mechanism(one["document"]).solve(q)
        for name, at in one["joints"].items():
            assert drawn.joint(name).value == pytest.approx(at, abs=1e-9)
    assert {name for names in differ for name in names} == set(own)


def test_a_group_above_class_ii_among_many_dyads_may_have_more_assemblies() -> None:
    own = ask("open", example="triad")["document"]
    x, y = own["joints"]["A"]
    links = {**own["links"], "ground": [*own["links"]["ground"], *(f"d{i}" for i in range(7))]}
    joints = dict(own["joints"])
    for i in range(7):
        joints |= {f"c{i}": [x + 1.5 + 0.1 * i, y + 1], f"d{i}": [x + 2.2 + 0.1 * i, y - 1]}
        links |= {f"rod{i}": ["A", f"c{i}"], f"rocker{i}": [f"d{i}", f"c{i}"]}
    many = {**own, "joints": joints, "links": links}
    reply = ask("assemblies", document=many)
    assert (reply["most"], reply["is_complete"]) == (128, False)
    assert len(reply["assemblies"]) == 8


def test_sensitivity_by_differences() -> None:
    reply = ask("sensitivity", document=FOUR_BAR, q=0.7, of="P.x")
    mechanism = document.read_mechanism(FOUR_BAR)
    assert reply["value"] == mechanism.solve(0.7).joint("P").value[0]
    for name, derivative in reply["by"].items():
        h = 1e-6
        ends = [
            mechanism.with_dimensions({name: mechanism.dimensions[name] + s * h}).solve(0.7)
            for s in (1, -1)
        ]
        difference = (ends[0].joint("P").value[0] - ends[1].joint("P").value[0]) / (2 * h)
        assert derivative == pytest.approx(difference, abs=1e-8)
    assert reply["units"]["rocker.length"] == "m/m"
    assert ask("sensitivity", document=PRESS, of="guide")["units"]["guide.angle"] == "m/rad"


def test_position() -> None:
    reply = ask("position", document=FOUR_BAR, q=0.7, speed=3.0, acceleration=-2.0)
    motion = document.read_mechanism(FOUR_BAR).solve(0.7)
    joint = motion.joint("P")
    assert reply["joints"]["P"] == {
        "value": joint.value.tolist(),
        "speed": joint.velocity(3.0).tolist(),
        "acceleration": joint.acceleration(3.0, -2.0).tolist(),
    }
    assert reply["transmission"] == {"C": float(motion.transmission_angle("C"))}


def test_runs() -> None:
    reply = ask("run", document=PRESS, by="machine", t_end=0.6, rows=61, reactions=True)
    run = machine().run(t_end=0.6, rtol=1e-8)
    t = np.linspace(0.0, 0.6, 61)
    assert reply.arrays["t"] == pytest.approx(t)
    assert reply.arrays["speed"] == pytest.approx(run.at(t).speed)
    assert reply.arrays["kinetic"] == pytest.approx(run.energy.kinetic)
    found = machine().reactions(run.at(t).q, run.at(t).speed, run.at(t).acceleration)
    at = [(one["joint"], one["on"]) for one in reply["reactions"]["joints"]]
    for i, (joint, on) in enumerate(at):
        assert reply.arrays["forces"][:, i] == pytest.approx(found.joint(joint, on=on))
    law = {"law": "Cycloidal", "start": 0.2, "end": 2.0, "duration": 0.5}
    moved = ask("run", document=FOUR_BAR, by="law", law=law, rows=31).arrays
    own = assur.laws.Cycloidal(0.2, 2.0, 0.5).at(np.linspace(0.0, 0.5, 31))
    for name, wanted in zip(("q", "speed", "acceleration"), own, strict=False):
        assert np.array_equal(moved[name], wanted)
    even = ask("run", document=FOUR_BAR, by="speed", q0=0.5, speed=4.0, t_end=1.0, rows=31).arrays
    assert even["q"] == pytest.approx(0.5 + 4.0 * even["t"])


def test_reactions_stand_at_the_rows_of_the_turn() -> None:
    reply = ask("reactions", document=PRESS, speed=10.0, rows=91)
    q = np.linspace(0.0, TURN, 91)
    assert np.array_equal(reply.arrays["q"], q)
    found = machine().reactions(q, 10.0)
    assert reply["joints"][0] == {"joint": "O", "on": "crank", "from": "ground"}
    assert reply.arrays["forces"][:, 0] == pytest.approx(found.joint("O", on="crank"))
    slide = found.slide("guide")
    assert reply.arrays["slide_forces"][:, 0, 0] == pytest.approx(slide.normal)
    assert reply.arrays["drive"] == pytest.approx(found.driver)
    one = ask("reactions", document=PRESS, q=1.0, speed=10.0)
    grid = ask("turn", document=PRESS, q=2.0, rows=91)["payload"]["turn"]["grid"]
    again = ask("reactions", document=PRESS, begin=2.0, speed=10.0, rows=91).arrays["q"]
    assert (grid["low"], grid["high"]) == (again[0], again[-1])
    assert one.arrays["forces"].shape == (1, 3, 2)


def test_flywheel_and_steady_state() -> None:
    reply = ask("flywheel", document=PRESS, fluctuation=0.02, rows=73)
    found = machine().flywheel(0.02)
    assert reply["inertia"] == found.inertia
    assert reply["delta"] == pytest.approx(0.02)
    assert reply.arrays["speed"] == pytest.approx(found.speed(np.linspace(0.0, TURN, 73)))
    steady = ask("steady", document=PRESS, flywheel=reply["inertia"], rows=73)
    assert steady["delta"] == pytest.approx(0.02, rel=1e-6)


def test_warnings_are_told() -> None:
    document_ = {**PRESS, "motor": {"type": "ConstantTorque", "torque": 5.0}}
    reply = ask("flywheel", document=document_, fluctuation=0.02, mean_speed=20.0)
    assert "5 N·m" in reply["warnings"][0]


def test_map() -> None:
    x = {"dimension": "coupler.length", "low": 3.0, "high": 5.0}
    y = {"dimension": "rocker.length", "low": 1.0, "high": 4.0}
    metric = {"metric": "min_transmission_angle", "at": "C"}
    reply = ask("map", document=FOUR_BAR, x=x, y=y, n=9, metric=metric)
    mechanism = document.read_mechanism(FOUR_BAR)
    grid = assur.Grid(
        {"rocker.length": np.linspace(1.0, 4.0, 9), "coupler.length": np.linspace(3.0, 5.0, 9)}
    )
    q = np.linspace(0.0, TURN, 72, endpoint=False)
    asked = {"value": assur.metric.min_transmission_angle("C")}
    found = assur.sweep(mechanism, grid, q, metrics=asked)
    assert np.array_equal(reply.arrays["value"], found["value"], equal_nan=True)
    assert np.array_equal(reply.arrays["reason"] > 0, np.isnan(found["value"]))
    assert reply["reasons"]
    forces = {"metric": "peak_effort", "speed": 10.0}
    x = {"dimension": "crank.length", "low": 0.05, "high": 0.12}
    y = {"dimension": "rod.length", "low": 0.3, "high": 0.6}
    efforts = ask("map", document=PRESS, x=x, y=y, n=3, metric=forces).arrays["value"]
    assert np.isfinite(efforts).all()


def test_lesson() -> None:
    lengths: dict[str, Any] = {"l1": 1.0, "l2": 4.5, "l3": 1.5, "l4": 4.995}
    reply = ask("lesson", **lengths, gamma_min=0.2, run=True, phi1=1.0, speed=2.0)
    run = assur.crank_rocker.run(1.0, 4.5, 1.5, 4.995, 0.2, speed=2.0, phi0=1.0)
    assert [event["kind"] for event in reply["run"]["events"]] == ["jam", "return"]
    assert reply["run"]["events"][0]["phi1"] == run.events[0].phi1
    assert np.array_equal(np.diff(reply.arrays["run_sliding"]).nonzero()[0].size, 2)
    assert np.degrees(reply["blocked"]) == pytest.approx(np.array([[-11.744097, 11.744097]]))
    assert reply["ground_range"] == pytest.approx([4.04451986, 4.97753284])  # reference of P5
    figures: dict[str, Any] = {"phi1": 2.1, "speed": 3.0, "ground_speed": 0.7, **lengths, "l4": 4.9}
    instant = ask("lesson", **figures)["instant"]
    assert instant["dS"] == pytest.approx(-2.14608490763)
    assert instant["v_C"] == pytest.approx(2.38405545)
    least = assur.crank_rocker.least_transmission_angle(0.1, 0.05, 0.1, 0.05, 1.5)
    friction: dict[str, Any] = {"f_c": 0.1, "r_c": 0.05, "f_d": 0.1, "r_d": 0.05}
    assert ask("lesson", **lengths, friction=friction)["gamma_min"] == least
    wrong = ask("lesson", l1=3.0, l2=1.0, l3=1.0, l4=2.0)
    assert wrong["message"] == ("The crank cannot turn: l1 + l4 (5) must be less than l2 + l3 (2).")


@pytest.mark.parametrize("ground", [4.0, 4.6, 4.995, 5.2])
def test_lesson_in_motion(ground: float) -> None:
    """Its stretches are the run of the package, which finds the changes one after another."""
    lengths: dict[str, Any] = {"l1": 1.0, "l2": 4.5, "l3": 1.5, "l4": ground}
    reply = ask("lesson", **lengths, gamma_min=0.2, motion=True, rows=721)
    run = assur.crank_rocker.run(1.0, 4.5, 1.5, ground, 0.2, phi0=np.pi / 2)
    changes = [event.phi1 for event in run.events]
    parts = reply["stretches"]
    if not changes:
        assert parts == [{"start": 0.0, "end": 2 * np.pi, "side": None, "rod": None}]
    else:
        assert [part["side"] for part in parts] == [run.events[0].side, None]
        assert parts[0]["start"] % (2 * np.pi) == pytest.approx(changes[0] % (2 * np.pi))
        assert parts[0]["end"] % (2 * np.pi) == pytest.approx(changes[1] % (2 * np.pi))
    for part, frames, by_ground in zip(
        parts, reply.arrays["frames"], reply.arrays["by_ground"], strict=True
    ):
        phi = np.linspace(part["start"], part["end"], 721)
        # The run goes from π/2 once around.
        first = np.argsort(run.phi1 % (2 * np.pi))
        own = run.phi1[first] % (2 * np.pi)
        l4 = np.interp(phi % (2 * np.pi), own, run.l4[first], period=2 * np.pi)
        assert -frames[0, :, 3, 0] == pytest.approx(l4, abs=2e-5)
        exact = assur.crank_rocker.solve(phi, 1.0, 4.5, 1.5, -frames[0, :, 3, 0])
        assert np.cos(frames[0, :, 1:3, 2].T) == pytest.approx(np.cos([exact.phi2, exact.phi3]))
        # The derivatives are those of the values, by differences.
        for order in (0, 1):
            slope = np.gradient(frames[order], phi, axis=0, edge_order=2)
            assert frames[order + 1][2:-2] == pytest.approx(slope[2:-2], rel=2e-2, abs=2e-3)
        if part["side"] is None:
            # Of a moving support too: l₄ enters as φ₁ does.
            moved = assur.crank_rocker.solve(phi, 1, 4.5, 1.5, ground, speed=2.0, ground_speed=0.7)
            rates = 2.0 * frames[1, :, 1:3, 2] + 0.7 * by_ground
            assert rates == pytest.approx(np.stack([moved.dphi2, moved.dphi3], axis=-1))
        else:
            assert not by_ground.any()


@pytest.mark.parametrize(("phi1", "side"), [(2.1, None), (-0.1, "outer"), (6.2, "outer")])
def test_lesson_at_an_instant(phi1: float, side: str | None) -> None:
    case: dict[str, Any] = {"l1": 1.0, "l2": 4.5, "l3": 1.5, "l4": 4.995, "gamma_min": 0.2}
    speeds: dict[str, Any] = {"speed": 3.0, "ground_speed": 0.7}
    found = ask("lesson", **case, **speeds, phi1=phi1, motion=True, rows=9)["position"]
    assert found["sliding"] == side
    if side is None:
        exact = assur.crank_rocker.solve(phi1, 1.0, 4.5, 1.5, 4.995, speed=3.0, ground_speed=0.7)
        assert found["gamma"] == pytest.approx(float(exact.gamma))
        assert found["links"]["rocker"]["speed"] == pytest.approx(float(exact.dphi3))
        assert np.hypot(*found["joints"]["C"]["speed"]) == pytest.approx(float(exact.v_C))
        assert found["rod"] is None
    else:
        assert (found["gamma"], found["rod"]) == pytest.approx((0.2, 5.977532835615105))
    if side is None:
        # What a moving support adds to the accelerations.
        still = ask("lesson", **case, speed=3.0, phi1=phi1, motion=True, rows=9)["position"]
        for link in ("coupler", "rocker"):
            mixed, twice = found["by_ground"][link]
            added = 2.0 * mixed * 3.0 * 0.7 + twice * 0.7**2
            rate = still["links"][link]["acceleration"] + added
            assert found["links"][link]["acceleration"] == pytest.approx(rate)
    # By differences: in a small time the crank has turned and the support moved.
    step = 1e-5
    near = []
    for sign in (-1.0, 1.0):
        moved = {**case, "l4": case["l4"] + sign * step * 0.7}
        near.append(
            ask("lesson", **moved, **speeds, phi1=phi1 + sign * step * 3.0, motion=True, rows=9)[
                "position"
            ]
        )
    for name in "BCD":
        for rate, of in (("speed", "value"), ("acceleration", "speed")):
            states = [np.array(one["joints"][name][of]) for one in near]
            slope = (states[1] - states[0]) / (2.0 * step)
            assert np.array(found["joints"][name][rate]) == pytest.approx(slope, abs=1e-4)


def test_lesson_beside_other_grounds() -> None:
    case: dict[str, Any] = {"l1": 1.0, "l2": 4.5, "l3": 1.5, "l4": 4.995}
    reply = ask("lesson", **case, grounds=[4.8, 5.2], rows=13)
    exact = assur.crank_rocker.table1().true[:, 0]
    assert reply.arrays["gamma_of"][0] == pytest.approx(exact, abs=1e-9)
    assert np.isnan(reply.arrays["gamma_of"][1]).any()
    assert reply["turning_range"] == pytest.approx([4.0, 5.0])
    assert refused("lesson", **case, grounds=[])["key"] == "grounds"
    assert "above 0" in refused("lesson", **case, gamma_min=0.0, motion=True)["message"]


def test_lesson_with_a_support_that_is_dragged() -> None:
    places = {"t": [0.0, 1.0, 2.0, 7.0], "l4": [4.6, 4.7, 4.6, 4.6]}
    reply = ask("lesson", l1=1, l2=4.5, l3=1.5, l4=4.6, gamma_min=0.1, run=True, support=places)
    t, l4 = reply.arrays["run_t"], reply.arrays["run_l4"]
    assert l4 == pytest.approx(assur.laws.Tabulated(**_table(places)).at(t)[0])
    C, D = reply.arrays["run_C"], reply.arrays["run_D"]
    assert np.hypot(*(C - D).T) == pytest.approx(np.full(len(t), 1.5))


def _table(places: dict[str, list[float]]) -> Any:
    return {"t": places["t"], "value": places["l4"]}


def test_applied_forces_act_where_their_loads_are() -> None:
    spring = {"type": "Spring", "first": "O", "second": "B", "stiffness": 500.0, "length": 0.3}
    cut = {"type": "Force", "at": "B", "force": [-70.0, 0.0], "while_": "forward", "over": "guide"}
    document_ = {**PRESS, "loads": [*PRESS["loads"], spring, cut]}
    reply = ask("reactions", document=document_, speed=10.0, rows=91)
    assert reply["applied"] == [
        {"load": 0, "on": "ram", "joint": "B"},
        {"load": 2, "on": "ram", "joint": "B"},
        {"load": 3, "on": "ram", "joint": "B"},
    ]
    applied = reply.arrays["applied"]
    motion = document.read_mechanism(PRESS).solve(reply.arrays["q"], order=1)
    place = motion.joint("B").value
    assert applied[:, 0] == pytest.approx(np.column_stack([place, np.full(91, -900), np.zeros(91)]))
    pull = 500.0 * (np.hypot(*place.T) - 0.3)
    assert applied[:, 1, 2] == pytest.approx(-pull * place[:, 0] / np.hypot(*place.T))
    forward = motion.slide("guide").d1 > 1e-12  # at the dead points it rests
    assert applied[:, 2, 2] == pytest.approx(np.where(forward, -70.0, 0.0))


def test_reactions_where_the_drawing_cannot_be_reached() -> None:
    own = {"coupler.length": 1.5, "rocker.length": 2.2}
    joints = {"A": [0, 0], "B": [0, 2], "C": [3, 3], "D": [4, 0]}
    document_ = {**FOUR_BAR, "joints": joints, "dimensions": own, "bodies": {"crank": {"mass": 1}}}
    document_["links"] = {**FOUR_BAR["links"], "coupler": ["B", "C"]}
    reached = ask("turn", document=document_, rows=91)["payload"]["turn"]["limits"]["intervals"][0]
    q = ask("reactions", document=document_, speed=1.0, rows=91).arrays["q"]
    assert (q[0], q[-1]) == pytest.approx(reached, rel=1e-5)
    assert q[-1] < np.pi / 2.0


def test_a_turn_tells_the_least_transmission_angle() -> None:
    reply = ask("turn", document=FOUR_BAR)
    (own,) = reply["transmission"]
    # The diagonal from B to D is shortest where the crank points at D.
    joints = {name: np.array(place) for name, place in FOUR_BAR["joints"].items()}
    a, b, c, d = (joints[name] for name in "ABCD")
    coupler, rocker = np.linalg.norm(c - b), np.linalg.norm(c - d)
    diagonal = np.linalg.norm(d - a) - np.linalg.norm(b - a)
    cosine = (coupler**2 + rocker**2 - diagonal**2) / (2.0 * coupler * rocker)
    assert own["at"] == "C"
    assert own["min"] == pytest.approx(np.arccos(cosine))
    assert own["q"] == pytest.approx(0.0)
    assert reply["reach"] is None
    assert "transmission" not in ask("turn", document=FOUR_BAR, orders=2).header


def test_a_turn_tells_where_several_drivers_can_go() -> None:
    m = assur.examples.excavator()
    data = document.document_of(m)
    q = np.array(m.q0)
    reply = ask("turn", document=data, q=q.tolist(), axis=1)
    assert len(reply["reach"]) == 3
    grid = reply["payload"]["turn"]["grid"]
    assert reply["reach"][1] == pytest.approx([grid["low"], grid["high"]])
    for axis, ends in enumerate(reply["reach"]):
        for end, outward in zip(ends, (-1.0, 1.0), strict=True):
            for step, is_there in ((-0.01, True), (0.05, False)):
                place = q.copy()
                place[axis] = end + outward * step
                status = m.solve(place, order=0, on_error="nan").status
                assert bool(status < Status.SINGULAR) is is_there
    # Where a dyad's links meet at a cylinder that is driven, the angle is always right.
    least = {one["at"]: one["min"] for one in reply["transmission"]}
    assert least["boom_eye"] == pytest.approx(np.pi / 2)


def find_crank(value: float, **changed: Any) -> Reply:
    opened = ask("open", example="crank_rocker")
    x = {"dimension": "crank.length", "low": 0.02, "high": 0.08}
    asked = {"x": x, "metric": {"metric": "span", "of": "rocker"}, "value": value, **changed}
    return ask("find", document=opened["document"], **asked)


def test_find_gives_the_crank_of_a_swing() -> None:
    reply = find_crank(np.pi / 3.0)
    # Crank and coupler are in line at the ends of the swing.
    crank, coupler, rocker, ground = reply["value"], 0.12, 0.08, 0.1

    def rocker_angle(diagonal: float) -> float:
        cosine = (ground**2 + rocker**2 - diagonal**2) / (2.0 * ground * rocker)
        return float(np.arccos(cosine))

    swing = rocker_angle(coupler + crank) - rocker_angle(coupler - crank)
    assert swing == pytest.approx(np.pi / 3.0, abs=1e-5)
    assert reply["metric"] == pytest.approx(np.pi / 3.0, abs=1e-6)


def test_find_says_what_there_is_where_there_is_none() -> None:
    reply = find_crank(3.0)
    assert reply["value"] is None
    assert reply["metric"] is None
    assert 0.0 < reply["min"] < reply["max"] < 3.0
    # A dimension with which nothing can be assembled has no metric at all.
    reply = find_crank(1.0, x={"dimension": "coupler.length", "low": 1.0, "high": 2.0})
    assert (reply["value"], reply["min"], reply["max"]) == (None, None, None)
