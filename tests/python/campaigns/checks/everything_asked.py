"""Asks a result for all that it has: every public property, and every method that needs nothing.

Results of these are asked in turn. What is raised must be an error that the library documents.
"""

from __future__ import annotations

import inspect
import warnings
from typing import TYPE_CHECKING, Any

import assur

if TYPE_CHECKING:
    from collections.abc import Iterator

DEEP = 3  # results of results of results
# Draw, write, open windows, or run a search over all of a turn: not questions to a result.
LEFT_OUT = frozenset(
    {
        *("plot", "polygon", "diagram", "animate", "explore", "plan", "show"),
        *("equilibria", "self_locking", "steady_state", "workspace", "singular_loci", "run"),
        *("configuration_curve", "limits", "duty"),
    }
)
WRITES = ("to_", "save", "_repr_")


def asked(result: Any, path: str = "", deep: int = DEEP) -> Iterator[str]:
    """What went wrong, by the way from the result to it."""
    path = path or type(result).__name__
    for name in dir(type(result)):
        if name.startswith("_") or name.startswith(WRITES) or name in LEFT_OUT:
            continue
        found, wrong = ask(result, name)
        if wrong:
            yield f"{path}.{name}: {wrong}"
        elif deep > 1:
            for k, one in enumerate(own_results(found)):
                yield from asked(one, f"{path}.{name}[{k}]", deep - 1)
    with_words = ("__repr__", "_repr_html_", "__str__")
    for name in with_words[:1]:
        _, wrong = guarded(lambda: repr(result))
        if wrong:
            yield f"{path}.{name}: {wrong}"


def ask(result: Any, name: str) -> tuple[Any, str]:
    """A property, or a method without arguments that must be given."""
    static = inspect.getattr_static(type(result), name)
    if not callable(static) or isinstance(static, property):
        return guarded(lambda: getattr(result, name))
    if isinstance(static, staticmethod | classmethod) or not inspect.isfunction(static):
        return None, ""
    parameters = list(inspect.signature(static).parameters.values())[1:]
    needed = [p for p in parameters if p.default is p.empty and p.kind != p.VAR_KEYWORD]
    return (None, "") if needed else guarded(getattr(result, name))


def guarded(call: Any) -> tuple[Any, str]:
    """What it gives, and what is wrong with how it failed."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            found = call()
        except assur.AssurError as error:
            text = str(error)
            return None, text if "fault of assur" in text else ""
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # noqa: BLE001 (a panic of the core is no Exception)
            return None, f"{type(error).__name__}: {error}"
    strange = [w for w in caught if not issubclass(w.category, assur.AssurWarning)]
    return found, f"{strange[0].category.__name__}: {strange[0].message}" if strange else ""


def own_results(found: Any) -> Iterator[Any]:
    """The library's own results in it, a few of a list."""
    few = list(found[:2]) if isinstance(found, list | tuple) else [found]
    for one in few:
        module = type(one).__module__
        if module.startswith("assur.") and not isinstance(one, assur.Machine | assur.Mechanism):
            yield one
