"""Which key of a file an error of the mechanism's constructor is about."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur.errors import AssurError
    from assur.files.positions import KeyPath

SECTIONS = ("joints", "links", "slides")
# In which section the words of a slide or cylinder are; others name links that a cylinder makes.
SLIDE_WORDS = {
    "link": "links",
    "on": "links",
    "origin": "joints",
    "base": "joints",
    "end": "joints",
}


def key_of(error: AssurError, data: dict[str, Any]) -> KeyPath:
    """Return the key that an error of the constructor is about.

    Parameters
    ----------
    error : AssurError
        The error; its fields name joints, links, slides.
    data : dict
        The file, each value of the right type.
    """
    sections_of: dict[str, dict[str, Any]] = {what: data.get(what, {}) for what in SECTIONS}
    made = {
        link: name for name, slide in sections_of["slides"].items() for link in _made(name, slide)
    }
    if error.kind == "bad_sign":
        return ("assembly", str(error.joint or error.slide))
    names = [n for n in (error.slide, error.link, error.joint, error.driver) if n is not None]
    for path, name, sections in _references(data):
        is_known = name in made or any(name in sections_of[section] for section in sections)
        if name in names and not is_known:
            return path
    if error.kind == "unknown" and names and names[0] in data.get("assembly", {}):
        return ("assembly", names[0])  # a joint, but not an inner one
    if error.driver is not None:
        return ("driver",)
    named_fields = (("slides", error.slide), ("links", error.link), ("joints", error.joint))
    # A name that is used twice is in another section than its field says.
    elsewhere = ((section, name) for name in names for section in SECTIONS)
    for section, named in (*named_fields, *elsewhere):
        if named in sections_of[section]:
            return (section, str(named))
    return next((("slides", made[name]) for name in names if name in made), ("links",))


def _made(name: str, slide: dict[str, Any]) -> tuple[str, ...]:
    """Return the links that a cylinder makes."""
    if "base" not in slide:
        return ()
    return tuple(slide.get(part, f"{name}_{part}") for part in ("barrel", "rod"))


def _references(data: dict[str, Any]) -> Iterator[tuple[KeyPath, str, tuple[str, ...]]]:
    """Yield every name that refers to something: its key, and in which sections it may be."""
    for link, joints in data["links"].items():
        for i, joint in enumerate(joints):
            yield ("links", link, i), joint, ("joints",)
    for name, slide in data.get("slides", {}).items():
        for key, section in SLIDE_WORDS.items():
            if key in slide:
                yield ("slides", name, key), slide[key], (section,)
    for name in data.get("assembly", {}):
        yield ("assembly", name), name, ("joints", "slides")
    driver = data["driver"]
    for i, drive in enumerate(driver if isinstance(driver, list) else [driver]):
        path: KeyPath = ("driver", i) if isinstance(driver, list) else ("driver",)
        if isinstance(drive, str):
            yield path, drive, ("links", "slides")
        else:
            for key, link in drive.items():
                yield (*path, key), link, ("links",)
