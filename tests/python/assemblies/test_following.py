"""Assemblies followed along q, compared, saved."""

from __future__ import annotations

import copy
import os
import pickle
import subprocess
import sys
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from models.errors.refusals import refused
from models.mechanisms.assembly_models import CASES, triad
from oracles.kinematics.assembly_checks import Followed, follow, places, random_cases

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Float = NDArray[np.float64]

# The sample; `make campaign` follows ten thousand.
FOLLOWED = 150


def test_following_arrives_at_an_assembly() -> None:
    followed = Followed()
    for mechanism, q, other in random_cases(1):
        follow(mechanism, q, other, followed)
        if followed.cases >= FOLLOWED:
            break
    assert followed.wrong == followed.refused == 0
    assert followed.lost < 0.8 * followed.cases


@pytest.mark.parametrize("kind", CASES)
def test_assemblies_close(kind: str) -> None:
    rng = np.random.default_rng(7)
    for _ in range(3):
        mechanism = CASES[kind][0](rng).mechanism
        found = mechanism.assemblies(mechanism.q0)
        assert len(found) >= 2
        for assembly in found:
            motion = mechanism.solve(mechanism.q0, order=0, assembly=assembly)
            size = float(np.ptp(np.array(list(mechanism.joints.values())), axis=0).max())
            assert float(motion.residual) <= 1e-14 * size


def test_an_assembly_equals_what_it_leads_to() -> None:
    mechanism = triad(np.random.default_rng(3)).mechanism
    q = float(mechanism.q0)
    found = mechanism.assemblies(q)
    assert len(found) == 4
    for assembly in found:
        motion = mechanism.solve(q + 0.02, order=0, assembly=assembly)
        again = [other for other in mechanism.assemblies(q + 0.02) if other == assembly]
        assert len(again) == 1
        assert hash(again[0]) == hash(assembly)
        assert assembly == again[0]
        assert again[0].joints is not None
        np.testing.assert_allclose(again[0].joints["R"], motion.joint("R").value, atol=1e-9)


def test_assemblies_are_different_and_can_be_saved() -> None:
    mechanism = triad(np.random.default_rng(3)).mechanism
    found = mechanism.assemblies(mechanism.q0)
    assert len(found) > 1
    for index, assembly in enumerate(found):
        assert [assembly == other for other in found] == [i == index for i in range(len(found))]
        for again in (pickle.loads(pickle.dumps(assembly)), copy.deepcopy(assembly)):
            assert again == assembly
            assert again.q == assembly.q
            assert again.joints == assembly.joints
        drawn = mechanism.with_assembly(assembly)
        assert assembly.joints
        assert drawn.q0 == assembly.q
        np.testing.assert_allclose(drawn.joints["R"], assembly.joints["R"], atol=1e-12)
        saved = pickle.loads(pickle.dumps(drawn))
        assert saved == drawn
        assert saved != mechanism
        motion = saved.solve(float(saved.q0) + 0.01, on_error="nan")
        other = mechanism.solve(float(saved.q0) + 0.01, assembly=assembly, on_error="nan")
        assert motion.joint("R").value.tobytes() == other.joint("R").value.tobytes()
    lists = pickle.loads(pickle.dumps(found))
    assert lists.complex_count == (6,)
    assert lists == found


def test_several_positions_and_designs() -> None:
    mechanism = triad(np.random.default_rng(3)).mechanism
    q = float(mechanism.q0) + np.array([0.0, 0.1, 0.2])
    rows = mechanism.assemblies(q)
    assert [len(row) for row in rows] == [len(mechanism.assemblies(one)) for one in q]
    lengths = mechanism.dimensions["l1.length"] * np.array([[1.0, 1.01], [1.02, 1.03]])
    batch = mechanism.with_dimensions({"l1.length": lengths})
    nested: Any = batch.assemblies(q)
    assert len(nested) == 2
    assert len(nested[0]) == 2
    assert len(nested[0][0]) == 3
    for i in range(2):
        for j in range(2):
            for k, one in enumerate(q):
                alone = batch.design((i, j)).assemblies(one)
                assert (
                    places(mechanism, alone).tobytes()
                    == places(mechanism, nested[i][j][k]).tobytes()
                )


def test_a_batch_in_an_assembly_of_one_design() -> None:
    mechanism = triad(np.random.default_rng(3)).mechanism
    assembly = mechanism.assemblies(mechanism.q0)[-1]
    assert assembly.joints
    lengths = mechanism.dimensions["l1.length"] * np.array([1.0, 1.001])
    batch = mechanism.with_dimensions({"l1.length": lengths})
    motion = batch.solve(mechanism.q0, order=0, assembly=assembly)
    np.testing.assert_allclose(motion.joint("R").value[0], assembly.joints["R"], atol=1e-12)
    assert np.abs(motion.joint("R").value[1] - motion.joint("R").value[0]).max() < 0.2


def test_a_parallelogram_on_three_legs_is_not_listed_as_if_complete() -> None:
    # Three equal parallel legs: the plate moves on a circle while the crank is locked.
    mechanism = assur.Mechanism(
        {
            "O": (-2.0, 0.0),
            "A": (0.0, 0.0),
            "P": (0.3, 1.0),
            "Q": (1.3, 1.2),
            "R": (2.3, 0.9),
            "U": (1.0, 0.2),
            "V": (2.0, -0.1001),
        },
        {"ground": "OUV", "crank": "OA", "plate": "PQR", "l1": "AP", "l2": "UQ", "l3": "VR"},
        "crank",
    )
    equal = mechanism.with_dimensions(
        {"ground.V.y": -0.1, "l3.length": mechanism.dimensions["l1.length"]}
    )
    with pytest.warns(assur.AssurWarning, match="incomplete"):
        found = equal.assemblies(equal.q0)
    assert not found.is_complete
    assert found.failures


def test_refusals() -> None:
    mechanism = triad(np.random.default_rng(3)).mechanism
    other = triad(np.random.default_rng(4)).mechanism
    found = mechanism.assemblies(mechanism.q0)
    refused(assur.InputError, "another mechanism", lambda: other.solve(1.0, assembly=found[0]))
    refused(assur.InputError, "finite", lambda: mechanism.assemblies(float("nan")))
    refused(assur.InputError, "no opposite", lambda: -found[0])


def test_every_level_of_instructions_gives_the_same_bits() -> None:
    code = (
        "import numpy as np\n"
        "from models.mechanisms.assembly_models import CASES\n"
        "for kind in ('triad', 'IV', 'triad, two blocks'):\n"
        "    m = CASES[kind][0](np.random.default_rng(5)).mechanism\n"
        "    for q in (0.0, 0.7):\n"
        "        for one in m.assemblies(m.q0 + q):\n"
        "            print([[x.hex() for x in at] for at in one.joints.values()])\n"
    )
    texts = set()
    for level in ("baseline", "avx2", "avx512"):
        env = {**os.environ, "ASSUR_SIMD": level, "PYTHONPATH": os.pathsep.join(sys.path)}
        command = [sys.executable, "-c", code]
        texts.add(subprocess.run(command, env=env, capture_output=True, check=True).stdout)
    assert len(texts) == 1
    assert texts.pop()
