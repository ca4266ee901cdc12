"""Annotations as a type checker reads them: with what is imported for types alone."""

from __future__ import annotations

import ast
import functools
import importlib
import inspect
import textwrap
import types
from pathlib import Path
from typing import TYPE_CHECKING, Any

import assur
from assur import _core

if TYPE_CHECKING:
    from collections.abc import Iterable

STUB = Path(assur.__file__).with_name("_core.pyi")
MISSING = object()


def annotations_of(what: Any) -> dict[str, Any]:
    """The annotations of a class itself or of a function."""
    own = vars(what).get("__annotations__", {}) if inspect.isclass(what) else what.__annotations__
    return {name: evaluated(hint, what.__module__) for name, hint in own.items()}


def of_init(cls: type) -> dict[str, Any]:
    """The attributes that `__init__` annotates itself."""
    made = inspect.unwrap(vars(cls).get("__init__", object.__init__))
    # That of a dataclass has no source.
    if not inspect.isfunction(made) or made.__code__.co_filename.startswith("<"):
        return {}
    tree = ast.parse(textwrap.dedent(inspect.getsource(made)))
    return {
        node.target.attr: evaluated(ast.unparse(node.annotation), cls.__module__)
        for node in ast.walk(tree)
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Attribute)
    }


def of_stub(cls: str) -> list[str]:
    """Where the stub of the compiled core has `Any` in a class."""
    tree = ast.parse(STUB.read_text(encoding="utf-8"))
    (known,) = (node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == cls)
    named = (node for node in ast.walk(known) if isinstance(node, ast.Name))
    return [f"_core.{cls}, line {node.lineno}" for node in named if node.id == "Any"]


def evaluated(hint: Any, module: str) -> Any:
    """The type that an annotation means."""
    text = getattr(hint, "__forward_arg__", hint)  # a named tuple keeps references
    value = eval(text, names(module)) if isinstance(text, str) else hint
    return type(None) if value is None else value


@functools.cache
def names(module: str) -> dict[str, Any]:
    """The names of a module as a type checker sees them."""
    source = importlib.import_module(module)
    scope = dict(vars(source))
    tree = ast.parse(inspect.getsource(source)).body
    take([line for line in tree if isinstance(line, ast.ImportFrom)], scope)
    for node in tree:
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            take(node.body, scope)
    if "_core" in scope:
        scope["_core"] = Core()
    for line in tree:
        if isinstance(line, ast.AnnAssign) and ast.unparse(line.annotation) == "TypeAlias":
            alias = ast.unparse(line.target)
            if isinstance(scope.get(alias), str):  # written as a text
                scope[alias] = eval(scope[alias], scope)
    return scope


def take(lines: Iterable[ast.stmt], scope: dict[str, Any]) -> None:
    """Do what lines for type checkers say."""
    for line in lines:
        if isinstance(line, ast.ImportFrom):
            for name in line.names:
                scope[name.asname or name.name] = imported(line.module or "", name.name)
        elif isinstance(line, ast.Import):
            for name in line.names:
                module = importlib.import_module(name.name)
                scope[name.asname or name.name] = stubbed(module)
        elif isinstance(line, ast.ClassDef):  # `Number` is two things, which no class can be
            scope[line.name] = type(line.name, (), {"__module__": "types"})
        else:
            exec(compile(ast.Module([line], []), "<types>", "exec"), scope)


def imported(module: str, name: str) -> Any:
    """One name of a module; what it has for types alone as a type checker sees it."""
    if module == _core.__name__:
        return getattr(Core(), name)
    value = getattr(importlib.import_module(module), name, MISSING)
    if value is not MISSING and not (isinstance(value, str) and module.startswith("assur")):
        return value
    try:
        return importlib.import_module(f"{module}.{name}")
    except ImportError:
        return names(module)[name]


def stubbed(module: types.ModuleType) -> Any:
    """A library; of pandas only the stub knows a Series as generic."""
    if module.__name__ != "pandas":
        return module
    return types.SimpleNamespace(DataFrame=module.DataFrame, Series=list)


class Core:
    """The compiled core with the names that its stub alone has."""

    def __getattr__(self, name: str) -> Any:
        return getattr(_core, name, None) or type(name, (), {"__module__": _core.__name__})
