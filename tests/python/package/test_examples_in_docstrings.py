"""Every public name has a page of its own and an example that runs (pytest --doctest-modules).

It needs nothing but what it imports itself: pasted alone it runs.

Public are the names in ``assur.__all__`` and in ``__all__`` of the modules among them, and the
classes of results that the pages of docs/reference/api list besides. An example is asked of
every such class and function, and of every public method that such a class has from this package.
None is asked of properties and fields, which the example of their class shows, of constants, of
what Python adds to tuples, enumerations and exceptions, nor of a method that overrides one with an
example.
"""

import ast
import builtins
import doctest
import inspect
import pkgutil
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import FunctionType

import pytest

import assur

PAGES = Path(__file__).parents[3] / "docs" / "reference" / "api"
LISTED = re.compile(r"^   ([a-zA-Z_][\w.]*)$", re.MULTILINE)


def public_names() -> dict[str, object]:
    """Classes and functions by the names that users write."""
    names = {name: getattr(assur, name) for name in assur.__all__}
    for name, module in tuple(names.items()):
        if inspect.ismodule(module):
            names |= {f"{name}.{part}": getattr(module, part) for part in module.__all__}
    return {
        name: thing
        for name, thing in names.items()
        if inspect.isclass(thing) or inspect.isfunction(thing)
    }


def listed_names() -> dict[str, object]:
    """What docs/reference/api lists, by its name there, without ``assur.``."""
    names = (name for page in PAGES.glob("*.rst") for name in LISTED.findall(page.read_text()))
    return {name: found(name) for name in names}


def found(name: str) -> object:
    """The thing of a dotted name: of a module that users name, or of a file of the package."""
    home, _, last = name.rpartition(".")
    if not home:
        return getattr(assur, last)
    module = getattr(assur, home, None) or import_module(f"assur.{home}")
    return getattr(module, last)


def examples_asked(names: dict[str, object]) -> Iterator[tuple[str, bool]]:
    """Each name that must have an example, and whether it has one."""
    for name, thing in names.items():
        yield name, ">>>" in (thing.__doc__ or "")
        if inspect.isclass(thing):
            for method, documents in methods(thing).items():
                yield f"{name}.{method}", any(">>>" in text for text in documents)


def methods(cls: type) -> dict[str, list[str]]:
    """Docstrings of each public method, the class' own first, then those that it overrides."""
    documents: dict[str, list[str]] = {}
    for base in cls.__mro__:
        if not base.__module__.startswith("assur"):
            continue
        for name, member in vars(base).items():
            function = getattr(member, "__func__", member)
            if not name.startswith("_") and isinstance(function, FunctionType):
                documents.setdefault(name, []).append(function.__doc__ or "")
    return documents


def test_every_public_name_has_a_page() -> None:
    """A new name goes to the page of its subject."""
    listed = list(listed_names().values())
    missing = [name for name, thing in public_names().items() if thing not in listed]
    assert not missing, f"list these in a page of docs/reference/api: {missing}"


def test_every_public_name_has_an_example() -> None:
    """A short one that is true and shows units or shapes."""
    names = {**public_names(), **listed_names()}
    asked = dict(examples_asked(names))
    missing = sorted(name for name, has_one in asked.items() if not has_one)
    assert len(asked) > 200
    assert not missing, f"{len(missing)} docstrings without >>>: {', '.join(missing)}"


def documented() -> Iterator[tuple[str, str]]:
    """Every docstring with an example, by its name, and the code of that example."""
    files = (file.name for file in pkgutil.walk_packages(assur.__path__, "assur."))
    for name in ["assur", *(file for file in files if "__main__" not in file)]:
        for test in doctest.DocTestFinder().find(import_module(name), name, globs={}):
            if test.examples:
                yield test.name, "\n".join(example.source for example in test.examples)


def unknown_names(source: str) -> set[str]:
    """Names that code uses and neither Python nor the code itself defines."""
    known = set(dir(builtins))
    used: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Name):
            (used if isinstance(node.ctx, ast.Load) else known).add(node.id)
        elif isinstance(node, ast.alias):
            known.add((node.asname or node.name).partition(".")[0])
        elif isinstance(node, ast.arg):
            known.add(node.arg)
        elif isinstance(node, ast.FunctionDef | ast.ClassDef | ast.ExceptHandler) and node.name:
            known.add(node.name)
    return used - known


def test_every_example_imports_what_it_uses() -> None:
    """Doctest gives an example the names of its file, and conftest.py NumPy: a user has neither."""
    sources = dict(documented())
    missing = {name: unknown for name, text in sources.items() if (unknown := unknown_names(text))}
    assert len(sources) > 300
    assert not missing


def test_a_missing_import_is_seen() -> None:
    assert unknown_names("import assur\n[x for x in np.ones(2)]\ny = assur") == {"np"}


@pytest.mark.parametrize("part", ["class", "own", "inherited", "overriding"])
def test_a_missing_example_is_seen(part: str) -> None:
    """The test above can fail: of a class, of a method, of an inherited one; not of one shown."""

    class Base:
        def inherited(self) -> None:
            """Do something."""

        def overriding(self) -> None:
            """Do something.

            >>> None
            """

    class Thing(Base):
        @classmethod
        def own(cls) -> None:
            """Make something."""

        def overriding(self) -> None:
            """Do it in another way."""

    Base.__module__ = Thing.__module__ = "assur.test"
    name = "Thing" if part == "class" else f"Thing.{part}"
    assert dict(examples_asked({"Thing": Thing}))[name] == (part == "overriding")
