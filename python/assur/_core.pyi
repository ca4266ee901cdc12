from typing import TypedDict, final

import numpy as np
import numpy.typing as npt
from typing_extensions import Self

__all__ = ["Mechanism", "acute", "curvature", "instant_centre", "version"]

class _Arrays(TypedDict):
    joints: dict[int, list[npt.NDArray[np.float64]]]
    links: dict[int, list[npt.NDArray[np.float64]]]
    places: dict[int, list[npt.NDArray[np.float64]]]
    slides: dict[int, list[npt.NDArray[np.float64]]]
    status: npt.NDArray[np.uint8]

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
        dimensions: npt.NDArray[np.float64],
        q: npt.NDArray[np.float64],
        per_design: bool,
        signs: list[int],
        order: int,
        joints: list[int],
        links: list[int],
        slides: list[int],
    ) -> _Arrays: ...
    def diagnostics(
        self,
        dimensions: npt.NDArray[np.float64],
        q: npt.NDArray[np.float64],
        per_design: bool,
        signs: list[int],
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]: ...
    def explain(
        self, dimensions: list[float], q: list[float], signs: list[int]
    ) -> tuple[int, str | None, str]: ...
    def assemblies(self, dimensions: list[float], q: list[float]) -> list[list[int]]: ...
    @staticmethod
    def statuses() -> list[tuple[str, int]]: ...

def acute(a: npt.NDArray[np.float64], b: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]: ...
def curvature(
    d1: npt.NDArray[np.float64], d2: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]: ...
def instant_centre(
    a: tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]],
    b: tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]],
) -> npt.NDArray[np.float64]: ...
def version() -> str: ...
