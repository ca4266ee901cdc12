"""Names that users may try, earlier ones and those of other tools: errors give the name here."""

from __future__ import annotations

from functools import wraps
from typing import TYPE_CHECKING, Any, NoReturn, ParamSpec, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

P = ParamSpec("P")
T = TypeVar("T")


def renamed(**names: str) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Decorate a function some of whose arguments had other names: old name to new name."""

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        @wraps(function)
        def checked(*args: P.args, **kwargs: P.kwargs) -> T:
            if kwargs and not names.keys().isdisjoint(kwargs):
                old = next(name for name in kwargs if name in names)
                message = (
                    f"{_called(function, args)}() has no argument {old!r}: it is {names[old]}="
                )
                raise TypeError(message)
            return function(*args, **kwargs)

        return checked

    return decorate


def _called(function: Callable[..., Any], args: tuple[Any, ...]) -> str:
    """Return the name of a function, of a class for what makes its objects."""
    return type(args[0]).__name__ if function.__name__ == "__init__" else function.__name__


def refuse_attribute(owner: Any, of: str, name: str, other: Mapping[str, str]) -> NoReturn:
    """Raise the AttributeError of a name that a class or module does not have."""
    message = f"{of} has no attribute {name!r}"
    if name in other:
        message = f"{message}: {other[name]}"
    raise AttributeError(message, name=name, obj=owner)


def other_names(**names: str) -> Callable[[type[T]], type[T]]:
    """Decorate a class: for names that it does not have, say what there is instead."""

    def decorate(cls: type[T]) -> type[T]:
        known = {**getattr(cls, "_other_names", {}), **names}

        def refuse(self: Any, name: str) -> NoReturn:
            refuse_attribute(self, f"{type(self).__name__!r} object", name, known)

        # Not in the class statement: type checkers are to refuse such names, too.
        for attribute, value in (("_other_names", known), ("__getattr__", refuse)):
            setattr(cls, attribute, value)
        return cls

    return decorate


# The rates of drivers.
renamed_rates = renamed(omega="speed", alpha="acceleration", beta="jerk")
