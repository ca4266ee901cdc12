"""Whatever is drawn on axes has a name, and the call returns these axes."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING

import matplotlib.pyplot as plt
import numpy as np
import pytest

from fuzzing.usual_calls import usual_calls

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.filterwarnings("ignore::assur.AssurWarning")
def test_artists_have_names_and_axes_come_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    nameless, kept, drawn = set(), set(), 0
    plt.close("all")
    for call, (function, usual) in usual_calls().items():
        if "ax" not in inspect.signature(function).parameters:
            continue
        returned = {id(ax) for ax in np.ravel(function(**usual))}
        for ax in plt.gcf().axes:
            artists = (*ax.lines, *ax.patches, *ax.texts, *ax.collections, *ax.images)
            drawn += len(artists)
            nameless |= {f"{call}: {artist}" for artist in artists if not artist.get_gid()}
            kept |= set() if id(ax) in returned else {call}
        plt.close("all")
    assert drawn > 300
    assert nameless == set()
    assert kept == set()
