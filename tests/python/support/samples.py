"""How many random cases a test tries: a few with every change, many in `make campaign`."""

from __future__ import annotations

import os

IS_CAMPAIGN = os.environ.get("HYPOTHESIS_PROFILE") == "slow"


def sample(few: int, many: int) -> int:
    """Return how many cases of those that a seed makes are tried, from the first on."""
    return many if IS_CAMPAIGN else few
