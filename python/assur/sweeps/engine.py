"""Blocks of designs on an engine: anything with ``submit``, as in `concurrent.futures` and Dask."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from assur._arrays import short
from assur.errors import AssurError, InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

# Blocks that wait or are at work at a time: more would only fill memory.
MOST_AT_ONCE = 32

Task = TypeVar("Task")
Result = TypeVar("Result")


class Future(Protocol):
    """The future result of a call."""

    def result(self) -> Any:
        """Return it, or raise what the call raised."""

    def cancel(self) -> Any:
        """Cancel the call if it has not started."""


class Engine(Protocol):
    """What makes calls elsewhere."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future:
        """Make a call."""


def checked_engine(engine: Any) -> Any:
    """Return an engine, or None."""
    if engine is None or callable(getattr(engine, "submit", None)):
        return engine
    message = f"engine is {short(engine)}: submit(function, ...) is needed, as a Dask client has"
    raise InputError(message)


def results(
    engine: Any, work: Callable[[Task], Result], tasks: Iterable[tuple[slice, Task]]
) -> Iterator[tuple[slice, Result]]:
    """Run tasks, each of a block of designs, and yield their results in order.

    Without an engine each runs when its result is asked for.
    """
    if engine is None:
        for block, task in tasks:
            yield block, work(task)
        return
    waiting: deque[tuple[slice, Future]] = deque()
    try:
        for block, task in tasks:
            waiting.append((block, engine.submit(work, task)))
            if len(waiting) == MOST_AT_ONCE:
                yield _result(*waiting.popleft())
        while waiting:
            yield _result(*waiting.popleft())
    finally:
        for _, future in waiting:
            future.cancel()


def _result(block: slice, future: Future) -> tuple[slice, Any]:
    try:
        return block, future.result()
    except AssurError:
        raise
    except Exception as error:
        what = f"{type(error).__name__}: {error}"
        message = f"engine: designs {block.start} to {block.stop - 1} failed with {what}"
        raise AssurError(message) from error
