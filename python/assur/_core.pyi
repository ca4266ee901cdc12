from typing import TypeAlias, final

import numpy as np
import numpy.typing as npt
from typing_extensions import Self

__all__ = [
    "Mechanism",
    "acute",
    "asin",
    "atan2",
    "curvature",
    "instant_centre",
    "sin_cos",
    "version",
]

_Float: TypeAlias = npt.NDArray[np.float64]

@final
class Mechanism:
    def __new__(
        cls,
        joints: list[tuple[str, float, float]],
        links: list[tuple[str, list[str]]],
        slides: list[tuple[str, str, str, float, str | None]],
        drivers: list[tuple[str, str | None]],
        assembly: list[tuple[str, int]],
    ) -> Self: ...
    @property
    def dimension_names(self) -> list[str]: ...
    @property
    def drawing(self) -> list[float]: ...
    @property
    def q0(self) -> list[float]: ...
    @property
    def assembly(self) -> list[tuple[str, int]]: ...
    @property
    def formula(self) -> str: ...
    @property
    def mobility(self) -> tuple[int, int, int]: ...
    @property
    def cls(self) -> int: ...
    @property
    def redundant(self) -> tuple[list[str], list[str]]: ...
    @property
    def groups(
        self,
    ) -> list[tuple[int, int, str | None, int | None, list[str], list[str], list[str]]]: ...
    def dimension(self, name: str) -> int: ...
    def require(self, kind: str, name: str) -> int: ...
    def check_dimensions(self, values: list[float]) -> None: ...
    def solve(
        self,
        dimensions: _Float,
        q: _Float,
        per_design: bool,
        signs: list[int],
        order: int,
        outputs: tuple[list[int], list[int], list[int], list[int]],
        threads: int | None,
        kept: tuple[list[_Float], npt.NDArray[np.uint8]] | None,
    ) -> tuple[dict[tuple[str, int, int], _Float], npt.NDArray[np.uint8]]: ...
    def diagnostics(
        self,
        dimensions: _Float,
        q: _Float,
        per_design: bool,
        signs: list[int],
    ) -> tuple[_Float, _Float]: ...
    def explain(
        self, dimensions: list[float], q: list[float], signs: list[int]
    ) -> tuple[int, str | None, str]: ...
    def assemblies(self, dimensions: list[float], q: list[float]) -> list[list[int]]: ...
    @staticmethod
    def statuses() -> list[tuple[str, int]]: ...

def asin(x: _Float) -> _Float: ...
def atan2(y: _Float, x: _Float) -> _Float: ...
def sin_cos(x: _Float) -> tuple[_Float, _Float]: ...
def acute(a: _Float, b: _Float) -> _Float: ...
def curvature(d1: _Float, d2: _Float) -> _Float: ...
def instant_centre(
    a: tuple[_Float, _Float, _Float],
    b: tuple[_Float, _Float, _Float],
) -> _Float: ...
def version() -> str: ...
