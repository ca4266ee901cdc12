"""How Sphinx builds these pages: `make docs`."""

from __future__ import annotations

import inspect
import re
import sys
from pathlib import Path
from typing import Any

from numpydoc.xref import DEFAULT_LINKS
from sphinx.ext.autosummary import import_by_name

import assur

# Documented as users write them, though their files are in assur.papers.
for _name in ("crank_rocker", "slider_crank"):
    sys.modules[f"assur.{_name}"] = getattr(assur, _name)

# The classes that the pages of api/ list, by the names under which they are documented.
_LINE = re.compile(r"^   ((?:\w+\.)*[A-Z]\w*)$", re.MULTILINE)
API = Path(__file__).parent / "reference" / "api"
_PAGES = [page.read_text("utf-8") for page in API.glob("*.rst")]
CLASSES = {
    name: import_by_name(name)[1]
    for name in (f"assur.{line}" for page in _PAGES for line in _LINE.findall(page))
}
SHORT = {name.rpartition(".")[2]: name for name in CLASSES}
assert len(SHORT) == len(CLASSES), "docs/reference/api lists two classes of the same name"

project = "assur"
copyright = "the authors of assur"  # noqa: A001 (Sphinx's name)
version = release = assur.__version__

extensions = [
    "myst_parser",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.viewcode",
]
templates_path = ["_templates"]
exclude_patterns = ["_build", "gallery/_live", "gallery/_front.md"]
language = "en"
smartquotes = False  # {"open", "crossed"} are to be typed
highlight_options = {"python": {"stripnl": True}}  # README ends its sessions with an empty line

# `make docs` makes warnings errors; what is left out has its reason here.
nitpick_ignore = [
    # Python's own: its pages are not here, and nothing is fetched.
    ("py:obj", "concurrent.futures.ProcessPoolExecutor"),
]
nitpick_ignore_regex = [
    # Fields: they stand among the parameters or attributes of their class.
    ("py:obj", "[a-z_0-9]+"),
]

# Pages
myst_heading_anchors = 3

# Docstrings state types and shapes; annotations name what only type checkers import.
autodoc_typehints = "none"
autodoc_member_order = "bysource"
toc_object_entries_show_parents = "hide"
autosummary_generate = True
autosummary_context = {
    # Pages of these name their bases, instead of repeating all of their methods.
    "derived": [
        name.removeprefix("assur.")
        for name, cls in CLASSES.items()
        if issubclass(cls, Exception) or set(cls.__mro__[1:]) & set(CLASSES.values())
    ]
}
default_role = "autolink"  # `Motion` is a link, `q` is none
numpydoc_show_class_members = False  # _templates/autosummary/class.rst shows them
numpydoc_xref_param_type = True
numpydoc_xref_ignore = "all"
numpydoc_xref_aliases = {
    **{word: word for word in DEFAULT_LINKS},  # no links to other sites
    **SHORT,
}

# Checks of docstrings besides ruff's; tests ask for examples, prose says what else is worth saying.
numpydoc_validation_checks = {"GL07", "PR01", "PR02", "PR10", "RT01", "RT03", "YD01"}
# Results and errors are made by the package: what they hold, not how they are made.
numpydoc_validation_overrides = {"PR01": [r"\n *Attributes\n *---"]}
numpydoc_validation_exclude = {r"Error$", r"\.Defect$", r"\.Status$"}

# Theme
html_theme = "pydata_sphinx_theme"
html_title = f"assur {version}"
html_static_path = ["_static"]
html_extra_path = ["gallery/_live"]  # pages that play, as they are
html_css_files = ["assur.css"]
html_show_sourcelink = False
html_copy_source = False
html_sidebars = {"index": []}
html_theme_options = {
    "show_toc_level": 2,
    "header_links_before_dropdown": 6,
    "navigation_with_keys": False,
    "footer_start": ["copyright"],
    "footer_end": [],
    "secondary_sidebar_items": ["page-toc"],
}


def _bases(_app: Any, _name: str, _cls: type, _options: Any, bases: list[type]) -> None:
    """Keep those that a reader knows."""
    known = {*CLASSES.values(), ValueError, ArithmeticError, Exception, UserWarning}
    bases[:] = [base for base in bases if base in known]


def _signature(
    _app: Any, what: str, _name: str, thing: Any, _options: Any, signature: str, _returns: str
) -> tuple[str, str] | None:
    """Show none of a class that only the package makes: of a result, an error, an enumeration."""
    makes = what == "class" and "Parameters\n" in (thing.__doc__ or "")
    is_class = what in ("class", "exception")
    return ("", "") if signature and is_class and not makes else None


def _docstring(
    _app: Any, _what: str, _name: str, _thing: Any, _options: Any, lines: list[str]
) -> None:
    """Make `Machine.duty` a link in every module, as `duty` is one within its class."""

    def link(found: re.Match[str]) -> str:
        path, name = SHORT[found[1]], found[2] or ""
        member = getattr(CLASSES[path], name, None)
        is_field = name in (CLASSES[path].__doc__ or "") and not callable(member)
        target = path if not name or (is_field and not isinstance(member, property)) else None
        return f":py:obj:`{found[0][1:-1]} <{target or f'{path}.{name}'}>`"

    names = "|".join(SHORT)
    lines[:] = [re.sub(rf"(?<![:`])`({names})(?:\.(\w+))?`(?!`)", link, line) for line in lines]


def _skip(
    _app: Any, _what: str, _name: str, thing: Any, _skipped: bool, _options: Any
) -> bool | None:
    """Leave out fields of named tuples: they stand among the attributes."""
    return True if (thing.__doc__ or "").startswith("Alias for field number") else None


def _api_index(_app: Any, page: str, source: list[str]) -> None:
    """Put every public name in the place of a comment, with a sentence each."""
    mark = "% every name\n"
    if page == "reference/api/index":
        pages = re.findall(r"^(\w+)$", source[0].partition("```{toctree}")[2], re.MULTILINE)
        texts = [(API / f"{name}.rst").read_text("utf-8") for name in pages]
        source[0] = source[0].replace(mark, "".join(map(_of_page, texts)))


def _of_page(text: str) -> str:
    """A heading and the table of a page of the API, with the methods of its classes."""
    lines = []
    for name in re.findall(r"^   ([a-zA-Z_][\w.]*)$", text, re.MULTILINE):
        lines.append(f"   {name}")
        thing = CLASSES.get(f"assur.{name}")
        lines += [f"   {name}.{method}" for method in _methods(thing)] if thing else []
    title = text.partition("\n")[0]
    head = [".. currentmodule:: assur", "", ".. autosummary::", "   :nosignatures:", ""]
    block = "\n".join([*head, *lines])
    return f"## {title}\n\n```{{eval-rst}}\n{block}\n```\n\n"


def _methods(cls: type) -> list[str]:
    """Public methods of a class, that it has itself, in the order of its source."""
    if issubclass(cls, Exception | tuple):
        return []
    return [
        name
        for name, member in vars(cls).items()
        if not name.startswith("_") and inspect.isroutine(member) and inspect.getdoc(member)
    ]


def setup(app: Any) -> None:
    """Connects what Sphinx asks while it reads pages and docstrings."""
    app.connect("source-read", _api_index)
    app.connect("autodoc-process-bases", _bases)
    app.connect("autodoc-process-docstring", _docstring)
    app.connect("autodoc-process-signature", _signature)
    app.connect("autodoc-skip-member", _skip)
