"""Progress of a sweep: a function that is called, or a bar."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeAlias

from assur._arrays import short
from assur.errors import InputError

Progress: TypeAlias = bool | Callable[[int, int], object]
Report: TypeAlias = Callable[[int], object]


def silent(_: int) -> None:
    """Report nothing."""


@contextmanager
def reporter(progress: Any, total: int) -> Iterator[Report]:
    """Yield the function to call with the number of designs done; a bar is always closed."""
    if progress is False or progress is None:
        yield silent
    elif callable(progress):
        yield lambda done: progress(done, total)
    elif progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError as error:
            message = "progress=True needs tqdm: pip install assur[progress], or pass a function"
            raise ImportError(message) from error
        with tqdm(total=total, unit="design", unit_scale=True) as bar:
            yield lambda done: bar.update(done - bar.n)
    else:
        message = f"progress is {short(progress)}: True, False or a function is needed"
        raise InputError(message)
