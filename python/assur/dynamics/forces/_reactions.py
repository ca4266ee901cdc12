"""What computations need of reactions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism


class Reactions(Protocol):
    """See `Machine.reactions`."""

    _source: Any

    def __init__(self, *parts: Any) -> None: ...

    @property
    def mechanism(self) -> Mechanism: ...
    @property
    def q(self) -> Any: ...
    @property
    def speed(self) -> Any: ...
    @property
    def acceleration(self) -> Any: ...
    @property
    def status(self) -> npt.NDArray[np.uint8]: ...
    @property
    def at_rest(self) -> Any: ...
    @property
    def by_key(self) -> Mapping[Any, Float]: ...
    @property
    def driver(self) -> Any: ...
    def joint(self, name: str, on: str) -> Any: ...
    def joint_moment(self, name: str, on: str) -> Any: ...
    def slide(self, name: str) -> Any: ...
