"""Linkages that were found, the best first."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol, TypeVar, overload

from assur import _later
from assur._arrays import counted
from assur._files import checked_path, writing
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from os import PathLike
    from pathlib import Path

    from assur.fitting.effort import Progress
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Fits"]

# Rows of the table that is printed.
ROWS = 16


class Found(Protocol):
    """What was found, with its cells of a table by their heads."""

    @property
    def mechanism(self) -> Mechanism: ...
    def cells(self) -> dict[str, str]: ...


FoundT = TypeVar("FoundT", bound=Found)


class Fits(Sequence[FoundT]):
    """Different linkages for a task, the best first; made by `assur.search` and `assur.fit`.

    Attributes
    ----------
    rejected : int
        Linkages that the search offered and that the solver's proof refused.

    Examples
    --------
    >>> import assur
    >>> hook = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
    >>> found = assur.search({"P": hook}, evaluations=1)
    >>> len(found) > 3, found[0].error <= found[-1].error, found.rejected
    (True, True, 0)
    """

    def __init__(
        self,
        fits: Sequence[FoundT],
        rejected: int,
        go_on: Callable[[float, int | None, Progress], Fits[FoundT]] | None,
    ) -> None:
        self._fits = tuple(fits)
        self.rejected = rejected
        self._go_on = go_on

    @overload
    def __getitem__(self, index: int) -> FoundT: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[FoundT]: ...
    def __getitem__(self, index: int | slice) -> FoundT | Sequence[FoundT]:
        return self._fits[index]

    def __len__(self) -> int:
        return len(self._fits)

    def __iter__(self) -> Iterator[FoundT]:
        return iter(self._fits)

    def resume(
        self,
        *,
        time_limit: float = 10.0,
        evaluations: int | None = None,
        progress: Progress = False,
    ) -> Fits[FoundT]:
        """Go on with the search, and return what it has then found.

        Parameters
        ----------
        time_limit : float
            How long, s.
        evaluations : int, optional
            In place of the time: about how many more linkages to evaluate.
        progress : bool or callable
            As for `assur.search`.

        Returns
        -------
        Fits
            New ones, at least as good by the search's own measure. Those before stay as they are.

        Raises
        ------
        InputError
            If the search is not there any more: a copy or a pickle has the linkages alone.

        Examples
        --------
        >>> import assur
        >>> hook = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
        >>> found = assur.search({"P": hook}, evaluations=1)
        >>> later = found.resume(evaluations=20_000)
        >>> later[0].error <= found[0].error
        True
        """
        if self._go_on is None:
            message = "resume(): a copy or a pickle has no search to go on with: call search again"
            raise InputError(message)
        return self._go_on(time_limit, evaluations, progress)

    def save(self, folder: str | PathLike[str]) -> list[Path]:
        """Write each mechanism to a file of its own, ``fit_01.toml`` and so on.

        `assur.load` and the studio open them.

        Parameters
        ----------
        folder : path
            Made if it is not there; files of these names are replaced.

        Returns
        -------
        list of Path
            The files, the best first.

        Raises
        ------
        InputError
            If a file cannot be written.

        Examples
        --------
        >>> import assur, tempfile
        >>> hook = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
        >>> found = assur.search({"P": hook}, evaluations=1)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     files = found.save(folder)
        ...     found[0].mechanism == assur.load(files[0])
        True
        """
        into = checked_path(folder, what="folder")
        with writing(into):
            into.mkdir(parents=True, exist_ok=True)
        files = [into / f"fit_{number:02d}.toml" for number in range(1, len(self) + 1)]
        for fit, file in zip(self, files, strict=True):
            _later.save(fit.mechanism, file)
        return files

    def __reduce__(self) -> tuple[Any, ...]:
        # A search in progress belongs to its process.
        return (Fits, (self._fits, self.rejected, None))

    def __repr__(self) -> str:
        dropped = f", {self.rejected} rejected" if self.rejected else ""
        return f"<assur.Fits: {counted(len(self), 'linkage')}{dropped}\n{_table(self)}>"


def _table(fits: Sequence[Found]) -> str:
    """Return a row for each of the first linkages."""
    rows = [fit.cells() for fit in fits[:ROWS]]
    heads = list(rows[0]) if rows else []
    widths = [max(len(head), *(len(row[head]) for row in rows)) for head in heads]
    lines = [dict(zip(heads, heads, strict=True)), *rows]
    table = [
        f"{'' if number == 0 else number - 1:>3} "
        + " ".join(f"{line[head]:>{width}}" for head, width in zip(heads, widths, strict=True))
        for number, line in enumerate(lines)
    ]
    more = [f"    … {len(fits) - ROWS} more"] if len(fits) > ROWS else []
    return "\n".join([*table, *more])
