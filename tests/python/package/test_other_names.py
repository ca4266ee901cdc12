"""Names of earlier versions and of other tools: each error gives the name here."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

MOTION: Any = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve([0.5, 1.0, 1.5], order=3)
PIN: Any = MOTION.joint("C")
KEYWORDS: dict[str, tuple[Callable[..., object], str, str]] = {
    "velocity": (PIN.velocity, "omega", "speed"),
    "acceleration": (PIN.acceleration, "alpha", "acceleration"),
    "jerk": (PIN.jerk, "beta", "jerk"),
    "table": (MOTION.to_dataframe, "omega", "speed"),
    "diagram": (MOTION.diagram, "beta", "jerk"),
    "paths": (MOTION.plot, "alpha", "acceleration"),
    "plan": (MOTION.polygon, "omega", "speed"),
    "page": (MOTION.mechanism.to_html, "omega", "speed"),
}


@pytest.mark.parametrize("name", KEYWORDS)
def test_an_old_keyword_is_refused_by_the_new_one(name: str) -> None:
    call, old, new = KEYWORDS[name]
    with pytest.raises(TypeError, match=rf"\(\) has no argument '{old}': it is {new}=$"):
        call(**{old: 1.0})
