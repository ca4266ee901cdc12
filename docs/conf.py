"""How Sphinx builds these pages: `make docs`."""

from __future__ import annotations

import inspect
import sys
from typing import Any

from numpydoc.xref import DEFAULT_LINKS

import assur

# Documented as users write them, though their files are in assur.papers.
for _name in ("crank_rocker", "slider_crank"):
    sys.modules[f"assur.{_name}"] = getattr(assur, _name)


def _classes() -> dict[str, type]:
    """The public classes, by the names under which they are documented."""
    public = {name: getattr(assur, name) for name in assur.__all__}
    for module in filter(inspect.ismodule, tuple(public.values())):
        home = module.__name__.rpartition(".")[2]
        public |= {f"{home}.{name}": getattr(module, name) for name in module.__all__}
    return {f"assur.{name}": thing for name, thing in public.items() if inspect.isclass(thing)}


CLASSES = _classes()

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
exclude_patterns = ["_build"]
language = "en"

# `make docs` makes warnings errors; what is left out has its reason here.
nitpick_ignore = [
    # Python's own: their pages are not here, and nothing is fetched.
    ("py:obj", "concurrent.futures.ProcessPoolExecutor"),
    ("py:obj", "pickle"),
    # Fields of a class, which stand among its parameters.
    ("py:obj", "about"),
    ("py:obj", "joints"),
    ("py:obj", "preload"),
]

# Pages
myst_heading_anchors = 3

# Docstrings state types and shapes; annotations name what only type checkers import.
autodoc_typehints = "none"
autodoc_member_order = "groupwise"
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
    **{name.rpartition(".")[2]: name for name in reversed(CLASSES)},
}

# Theme
html_theme = "pydata_sphinx_theme"
html_title = f"assur {version}"
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "show_toc_level": 2,
    "navigation_with_keys": False,
    "footer_start": ["copyright"],
    "footer_end": [],
    "secondary_sidebar_items": ["page-toc"],
}


def _only_public(_app: Any, _name: str, _cls: type, _options: Any, bases: list[type]) -> None:
    known = {*CLASSES.values(), ValueError, ArithmeticError, Exception, UserWarning}
    bases[:] = [base for base in bases if base in known]


def setup(app: Any) -> None:
    """Shows no private base of a class."""
    app.connect("autodoc-process-bases", _only_public)
