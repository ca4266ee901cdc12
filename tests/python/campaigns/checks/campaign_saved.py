"""A mechanism read back from its file is equal to the one that was saved."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import assur
from campaigns.campaign_report import Findings
from models.mechanisms.mechanism_data import arguments

if TYPE_CHECKING:
    from models.mechanisms import dyad_models


class Saved(Findings):
    """One mechanism and its file."""

    def __init__(self, case: dyad_models.Case) -> None:
        super().__init__()
        try:
            m = assur.Mechanism(**arguments(case.description))
        except assur.StructureError:  # a singular drawing, which the other checks report
            return
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "mechanism.toml"
            m.save(path)
            again = assur.load(path)
        self.report.counts["mechanisms loaded"] += 1
        if again != m:
            self.fail("file mechanism", "is not equal")
