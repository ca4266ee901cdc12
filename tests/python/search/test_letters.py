"""The letters that the search is measured by are whole: no line smoothed or left out."""

from __future__ import annotations

import numpy as np
import pytest

from search.letters import GAP, LETTERS, graph, path, strokes


def distance(point: np.ndarray, corners: np.ndarray) -> float:
    """From a point to a line through corners."""
    start, along = corners[:-1], np.diff(corners, axis=0)
    parts = np.sum((point - start) * along, axis=1) / np.sum(along * along, axis=1)
    feet = start + np.clip(parts, 0.0, 1.0)[:, np.newaxis] * along
    return float(np.hypot(*(feet - point).T).min())


@pytest.mark.parametrize("letter", LETTERS)
def test_one_stroke_draws_all_strokes_and_nothing_else(letter: str) -> None:
    corners, own = path(letter), strokes()[letter]
    for stroke in own:
        for part in np.linspace(0.0, 1.0, 21):
            between = stroke[:-1] + part * np.diff(stroke, axis=0)
            assert max(distance(point, corners) for point in between) < 1e-9
    for part in np.linspace(0.0, 1.0, 21):
        between = corners[:-1] + part * np.diff(corners, axis=0)
        # Only a gap of the font is bridged.
        assert max(min(distance(p, stroke) for stroke in own) for p in between) < GAP


@pytest.mark.parametrize("letter", LETTERS)
def test_it_goes_back_no_farther_than_it_must(letter: str) -> None:
    lines = graph(strokes()[letter])
    corners = path(letter)
    length = np.hypot(*np.diff(corners, axis=0).T).sum()
    whole = sum(np.hypot(*(lines.places[i] - lines.places[j])) for i, j in lines.lines)
    odd = np.count_nonzero(np.bincount(np.ravel(lines.lines)) % 2)
    # A route without a way back is there where no more than two places are ends or forks (Euler).
    assert (length < whole + 1e-9) == (odd <= 2)
    assert length <= 1.5 * whole + 1e-9


def test_letters_that_are_drawn_twice_over_somewhere() -> None:
    def goes_back(letter: str) -> bool:
        lines = graph(strokes()[letter])
        return bool(np.count_nonzero(np.bincount(np.ravel(lines.lines)) % 2) > 2)

    assert "".join(filter(goes_back, LETTERS)) == "AEFHKRTXY"
