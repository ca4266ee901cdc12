"""Symbols of quantities: their texts, and their sizes beside matplotlib's own."""

from __future__ import annotations

import pytest
from matplotlib.textpath import text_to_path

from assur.pictures.vectors.symbols import formula_font, formula_size, symbol


@pytest.mark.parametrize(
    ("letter", "names", "upper", "text"),
    [
        ("v", ["B"], "", "$v_{B}$"),
        ("v", ["C", "B"], "", "$v_{CB}$"),
        ("a", ["A3", "A2"], "k", "$a^{k}_{A3A2}$"),
        ("v", ["wrist", "B"], "", "$v_{wrist/B}$"),
        ("v", ["10", "3"], "", "$v_{10/3}$"),
        ("v", ["pin_2"], "", r"$v_{pin\_2}$"),
        # The font of formulas has no such letters.
        ("v", ["Б"], "", "v(Б)"),
        ("a", ["$"], "n", r"a^n(\$)"),
    ],
)
def test_symbols(letter: str, names: list[str], upper: str, text: str) -> None:
    assert symbol(letter, names, upper) == text


@pytest.mark.parametrize(
    "text",
    [
        "$v_{B}$ = 0.400",
        "$a^{n}_{CB}$ = 12.3",
        "$R_{bore}$ = 1.25 kN",
        "$P_{14}^{\\infty}$",
        "$P_{13}$, $P_{24}$",
        "$v$ 0.380 m/s",
        "v(Б) = 1",
    ],
)
def test_sizes(text: str) -> None:
    font = formula_font(9.0)
    width, height, _ = text_to_path.get_text_width_height_descent(text, font, ismath=True)
    own = formula_size(text, font)
    assert own[0] == pytest.approx(width, abs=2.0, rel=0.04)
    assert -1.0 < own[1] - height < 5.0
