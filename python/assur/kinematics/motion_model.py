"""What a motion holds: the request, its results by name, statuses."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from assur._arrays import short
from assur._summary import FORMULA, shortened
from assur._validate import checked_name
from assur.errors import InputError
from assur.kinematics.model import as_made
from assur.kinematics.pose import in_signs
from assur.kinematics.quantity import Analogues

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import numpy.typing as npt
    from typing_extensions import Self

    from assur._arrays import Float
    from assur._later import Mechanism
    from assur.kinematics.request import SolveRequest
    from assur.kinematics.result_columns import Results

__all__ = ["AnyMotion", "MotionModel"]

AnyMotion = TypeVar("AnyMotion", bound="MotionModel")


class MotionModel:
    """A request and what the core answered."""

    def __init__(
        self, request: SolveRequest, results: Results, status: npt.NDArray[np.uint8]
    ) -> None:
        self._replace_with(request, results, status)

    def _replace_with(
        self, request: SolveRequest, results: Results, status: npt.NDArray[np.uint8]
    ) -> None:
        self._mechanism: Mechanism | None = None
        self.q = request.q
        self.order = request.order
        self._status = status
        self.request = request
        self.stored = results
        self.driver_count = request.mechanism.driver_count
        self._reference_points: dict[str, tuple[Float, ...]] = {}
        self._diagnostics: tuple[Float, Float] | None = None
        self.kept: npt.NDArray[np.intp] | None = None

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism solved, drawn in the assembly that was solved."""
        request = self.request
        if request.signs == request.mechanism.signs:
            return as_made(request.mechanism)
        # Made when first needed: solving need not compile it.
        if self._mechanism is None:
            self._mechanism = as_made(in_signs(request.mechanism, request.signs))
        return self._mechanism

    @property
    def _results(self) -> Results:
        """The arrays held, by name."""
        self._require_complete()
        return self.stored

    def _require_complete(self) -> None:
        """Raise if a solve(out=) overwrites this motion or was stopped while doing so."""
        buffers = self.stored.buffers
        if buffers is not None and not buffers.complete:
            message = (
                "this motion is incomplete: a call that overwrites it (out=) is running, was "
                "interrupted or failed; solve it again"
            )
            raise InputError(message)

    @property
    def status(self) -> npt.NDArray[np.uint8]:
        """`Status` of each position, S + (N,)."""
        self._require_complete()
        return self._status

    def __getstate__(self) -> dict[str, Any]:
        # A copy has no buffers: only the original may be overwritten.
        return {**self.__dict__, "stored": self._results.without_buffers(copy=False)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        stored = self.stored
        held = (stored.joints, stored.links, stored.slides, self._reference_points)
        for array in (a for kind in held for arrays in kind.values() for a in arrays):
            array.flags.writeable = False
        for array in (self.q, self._status, *(self._diagnostics or ())):
            array.flags.writeable = False

    def __copy__(self) -> Self:
        # Copies its arrays, which solve(out=) may overwrite; q never is.
        copied = object.__new__(type(self))
        state = self.__getstate__()
        copied.__setstate__(
            {
                **state,
                "stored": self._results.without_buffers(copy=True),
                "_status": self.status.copy(),
            }
        )
        return copied

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape S + (N,): designs, then positions."""
        return self._status.shape

    def __repr__(self) -> str:
        formula = shortened(self.request.mechanism.core.formula, FORMULA)
        return f"<assur.Motion of {formula}, shape {self.shape}, order {self.order}>"

    def _find(
        self, kind: str, held: Mapping[str, tuple[Float, ...]], name: str
    ) -> tuple[Float, ...]:
        name = checked_name(name, kind)
        if name not in held:
            self.request.mechanism.core.index_of(kind, name)
            message = f"{kind} {name!r} was not among the outputs of this motion"
            raise InputError(message, **{kind: name})  # type: ignore[arg-type]
        return held[name]

    def joint(self, name: str | Sequence[str]) -> Analogues:
        """Return the position of a joint, m, with its analogues.

        A sequence of names stacks the results along a new first axis.

        Parameters
        ----------
        name : str or sequence of str
            The joint, or several.

        Returns
        -------
        Analogues
            Values of shape S + (N, 2).

        Examples
        --------
        >>> import assur, numpy as np
        >>> motion = assur.SliderCrank(crank=0.1, rod=0.4).solve([0.0, np.pi / 2])
        >>> motion.joint("A").value  # m
        array([[0.1, 0. ],
               [0. , 0.1]])
        """
        return self._quantity("joint", self._results.joints, name)

    def link(self, name: str | Sequence[str]) -> Analogues:
        """Return the angle of a link, rad, continuous along q, with its analogues.

        A sequence of names stacks the results along a new first axis.

        Parameters
        ----------
        name : str or sequence of str
            The link, or several.

        Returns
        -------
        Analogues
            Values of shape S + (N,).

        Examples
        --------
        >>> import assur
        >>> motion = assur.SliderCrank(crank=0.1, rod=0.4).solve([0.0, 7.0])
        >>> motion.link("crank").value  # rad; not reduced to a turn
        array([0., 7.])
        """
        return self._quantity("link", self._results.links, name)

    def slide(self, name: str | Sequence[str]) -> Analogues:
        """Return the value of a slide, m, with its analogues.

        A sequence of names stacks the results along a new first axis.

        Parameters
        ----------
        name : str or sequence of str
            The slide, or several.

        Returns
        -------
        Analogues
            Values of shape S + (N,).

        Examples
        --------
        >>> import assur, numpy as np
        >>> motion = assur.SliderCrank(crank=0.1, rod=0.4).solve([0.0, np.pi])
        >>> motion.slide("bore").value  # m
        array([0.5, 0.3])
        """
        return self._quantity("slide", self._results.slides, name)

    def _quantity(
        self, kind: str, held: Mapping[str, tuple[Float, ...]], name: str | Sequence[str]
    ) -> Analogues:
        is_point = kind == "joint"
        if isinstance(name, str):
            return Analogues(name, self._find(kind, held, name), self.driver_count, is_point)
        if not isinstance(name, list | tuple) or not name:
            message = f"{kind}: {short(name)} is not a name or a list of names"
            raise InputError(message)
        several = [self._find(kind, held, item) for item in name]
        arrays = tuple(np.stack(order) for order in zip(*several, strict=True))
        return Analogues(", ".join(name), arrays, self.driver_count, is_point)

    def __len__(self) -> int:
        if not self.shape:
            message = "a motion of one position has no length"
            raise TypeError(message)
        return self.shape[0]

    def __bool__(self) -> bool:
        return True

    @property
    def held_indices(self) -> tuple[dict[str, int], dict[str, int], dict[str, int]]:
        """The core's indices of the joints, links and slides held.

        :meta private:
        """
        held = (self._results.joints, self._results.links, self._results.slides)
        index_of = self.request.mechanism.core.index_of
        joints, links, slides = (
            {name: index_of(kind, name) for name in of}
            for kind, of in zip(("joint", "link", "slide"), held, strict=True)
        )
        return joints, links, slides

    @property
    def reference_points(self) -> Mapping[str, Analogues]:
        """The origins of the frames of links by name, solved when they are read.

        :meta private:
        """
        return _ReferencePoints(self, self._reference_points)


def overwrite(
    motion: MotionModel, request: SolveRequest, results: Results, status: npt.NDArray[np.uint8]
) -> None:
    """Turn a motion into that of another request."""
    motion._replace_with(request, results, status)


class _ReferencePoints(Mapping[str, Analogues]):
    """Reference points of a motion's links; the motion keeps those that were solved."""

    def __init__(self, motion: MotionModel, solved: dict[str, tuple[Float, ...]]) -> None:
        self._motion, self._solved = motion, solved

    def __getitem__(self, link: str) -> Analogues:
        link = checked_name(link, "link")
        # Rarely needed, so solved on request.
        if link not in self._solved:
            self._solved[link] = self._motion.request.reference_point(link)
        return Analogues(link, self._solved[link], self._motion.driver_count, True)

    def __iter__(self) -> Iterator[str]:
        return iter(self._motion.request.mechanism.links)

    def __len__(self) -> int:
        return len(self._motion.request.mechanism.links)
