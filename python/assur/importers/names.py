"""Names that `assur` takes, for those of other programs."""

from __future__ import annotations

import unicodedata

# Blanks, brackets and quotes, and what cannot be seen.
FORBIDDEN = frozenset(("Zs", "Zl", "Zp", "Cc", "Cf", "Cs", "Cn", "Co", "Ps", "Pe", "Pi", "Pf"))
FORBIDDEN_LETTERS = frozenset("./\\'\"`<>")
# A name that is longer would fill messages.
LONGEST_NAME = 60


class Names:
    """Allowed names, each given once.

    Examples
    --------
    >>> from assur.importers.names import Names
    >>> names = Names()
    >>> names.add("left arm"), names.add("left_arm"), names.add("")
    ('left_arm', 'left_arm_2', '_')
    """

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def add(self, name: str) -> str:
        """Return the name, changed where it is not allowed or not new."""
        letters = (_allowed(letter) for letter in name[:LONGEST_NAME])
        plain = "".join(letters) or "_"
        unique, count = plain, 1
        while unique in self._taken:
            count += 1
            unique = f"{plain}_{count}"
        self._taken.add(unique)
        return unique


def _allowed(letter: str) -> str:
    bad = letter in FORBIDDEN_LETTERS or unicodedata.category(letter) in FORBIDDEN
    return "_" if bad else letter


def listed(names: list[str]) -> str:
    """Return names for a sentence: "a, b and 3 more"."""
    shown = [name[:LONGEST_NAME] for name in names[:8]]
    more = len(names) - len(shown)
    if more:
        return f"{', '.join(shown)} and {more} more"
    return " and ".join([", ".join(shown[:-1]), shown[-1]] if len(shown) > 1 else shown)
