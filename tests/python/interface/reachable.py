"""What a user can call and read, with its types: public names, and every class these give back."""

from __future__ import annotations

import dataclasses
import enum
import functools
import inspect
import sys
import types
import typing
from typing import TYPE_CHECKING, Any, NamedTuple

import assur
from assur import _core
from interface.public_interface import callables
from interface.test_public_interface import RESULTS
from interface.type_names import MISSING, annotations_of, of_init, of_stub

if TYPE_CHECKING:
    from collections.abc import Iterator

# Methods that users call by signs; what the others give, such as __eq__, Python says.
SIGNS = {
    *("__add__", "__radd__", "__sub__", "__rsub__", "__mul__", "__rmul__", "__truediv__"),
    *("__rtruediv__", "__neg__", "__abs__", "__pow__", "__lt__", "__le__", "__gt__", "__ge__"),
    *("__getitem__", "__iter__", "__len__", "__call__", "__and__", "__or__"),
}


class Hint(NamedTuple):
    """One annotation: where it stands, and its type; `MISSING` where there is none."""

    place: str
    type: Any


def hints() -> list[Hint]:
    """Every annotation that a user meets, in the order in which it is reached."""
    found: list[Hint] = []
    seen: set[Any] = set()
    waiting: list[tuple[str, Any]] = [(name, getattr(assur, name)) for name in assur.__all__]
    while waiting:
        name, what = waiting.pop(0)
        if inspect.ismodule(what):
            public = getattr(what, "__all__", ())
            waiting += [(f"{name}.{part}", getattr(what, part)) for part in public]
        elif id(what) not in seen and (inspect.isclass(what) or inspect.isroutine(what)):
            seen.add(id(what))
            new = [*(of_class(what) if inspect.isclass(what) else of_function(name, what))]
            found += new
            waiting += [
                (cls.__name__, cls) for hint in new for cls in classes(hint.type) if is_met(cls)
            ]
    return found


def is_ours(what: Any) -> bool:
    return (getattr(what, "__module__", None) or "").startswith("assur")


def is_met(cls: type) -> bool:
    """Whether users have its objects: protocols of `_faces` say what pictures ask of ours."""
    return is_ours(cls) and cls.__module__ != "assur._faces"


def classes(hint: Any) -> Iterator[type]:
    """The classes that an annotation names, however deep."""
    if inspect.isclass(hint):
        yield hint
    elif isinstance(hint, typing.TypeVar):
        for bound in (hint.__bound__, *hint.__constraints__):
            yield from classes(bound)
    origin = typing.get_origin(hint)
    if inspect.isclass(origin):
        yield origin
    if origin is not typing.Literal:
        for part in parts(hint):
            yield from classes(part)


def parts(hint: Any) -> list[Any]:
    """The arguments of an annotation, those of a callable in a row with its result."""
    found: list[Any] = []
    for part in typing.get_args(hint):
        found += part if isinstance(part, list) else [part]
    return found


def of_class(cls: type) -> Iterator[Hint]:
    """The annotations of a class's fields, properties and methods, of its bases among ours too."""
    if issubclass(cls, enum.Enum):
        return
    if cls.__module__ == _core.__name__:
        yield from (Hint(place, Any) for place in of_stub(cls.__name__))
        return
    for field, hint in fields(cls).items():
        yield Hint(f"{cls.__name__}.{field}", hint)
    for member in dir(cls):
        own = inspect.getattr_static(cls, member)
        if member == "__init__" and is_made_by_users(cls) and inspect.isfunction(own):
            yield from of_function(cls.__name__, own)
        elif (not member.startswith("_") or member in SIGNS) and is_written(own):
            yield from of_member(f"{cls.__name__}.{member}", own)


def fields(cls: type) -> dict[str, Any]:
    """The annotated attributes of a class, those that its `__init__` annotates too."""
    found: dict[str, Any] = {}
    for base in filter(is_ours, cls.__mro__):
        of_base = {**annotations_of(base), **of_init(base)}
        found |= {name: hint for name, hint in of_base.items() if not name.startswith("_")}
    return found


def is_made_by_users(cls: type) -> bool:
    """Whether users call it, with arguments that are not its fields."""
    is_record = dataclasses.is_dataclass(cls) or hasattr(cls, "_fields")
    return cls.__name__ in made() and not is_record


@functools.cache
def made() -> set[str]:
    return {name.rpartition(".")[2] for name in {*callables()} - RESULTS}


def read(own: Any) -> Any:
    """The function behind a property, or None."""
    return getattr(own, "fget", None) or getattr(own, "func", None)


def is_written(own: Any) -> bool:
    """Whether one of our sources has it, not Python (as the methods of a named tuple)."""
    function = inspect.unwrap(read(own) or getattr(own, "__func__", own))
    return inspect.isfunction(function) and is_ours(function)


def of_member(place: str, own: Any) -> Iterator[Hint]:
    """The annotations of a method, or the type of a property."""
    getter = read(own)
    if getter:
        yield result(place, getter)
    else:
        yield from of_function(place, getattr(own, "__func__", own))


def of_function(name: str, function: Any) -> Iterator[Hint]:
    """The annotations of its arguments and of its result; with overloads those of each."""
    function = inspect.unwrap(function)
    overloads = typing.get_overloads(function) if sys.version_info >= (3, 11) else []
    for one in overloads or [function]:
        known = annotations_of(one)
        for parameter in inspect.signature(one).parameters:
            if parameter not in ("self", "cls"):
                yield Hint(f"{name}({parameter})", known.get(parameter, MISSING))
        yield result(name, one)


def result(name: str, function: Any) -> Hint:
    return Hint(f"{name} ->", annotations_of(inspect.unwrap(function)).get("return", MISSING))


def members(record: object) -> dict[str, Any]:
    """What can be read of an object, with its declared types."""
    found = fields(type(record))
    for base in filter(is_ours, type(record).__mro__):
        for name, own in vars(base).items():
            if not name.startswith("_") and read(own) and name not in found:
                found[name] = result(name, read(own)).type
    return found


def is_union(hint: Any) -> bool:
    return typing.get_origin(hint) in (typing.Union, types.UnionType)
