"""The numbers of a page: the scene of a mechanism, and the frames of its links, as JSON."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError
from assur.pictures.page.selection import checked_diagrams, checked_joints
from assur.pictures.scene.build import scene_of
from assur.pictures.scene.extent import corners, usual_link
from assur.pictures.scene.frames import Frames
from assur.pictures.scene.shapes import Disc, Hatching

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from assur._arrays import Float
    from assur._faces import Mechanism
    from assur.pictures.page.turn import Turn
    from assur.pictures.scene.shapes import Part, Scene, Stroke, Vertex

# The greatest float32: the page stores no other numbers.
GREATEST_NUMBER = float(np.finfo(np.float32).max)
ROMAN = ("0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X")
ARROW = " → "
# Seconds of a turn on a page without a given speed.
SECONDS = 4.0


@dataclass(frozen=True, eq=False)
class Played:
    """What a page shows: a mechanism, its scene, and the turn that it plays."""

    mechanism: Mechanism
    turn: Turn
    scene: Scene

    @property
    def frames(self) -> Frames:
        """The positions, with derivatives by the grid's parameter."""
        return self.turn.frames

    def bounds(self) -> tuple[Float, Float]:
        """Return the corners of the whole motion, m."""
        index = {link: i for i, link in enumerate(self.frames.links)}
        fixed = np.array([(index[link], x, y) for link, x, y in corners(self.scene)])
        links = fixed[:, 0].astype(int)
        px, py = fixed[:, 1:].T
        x, y, angle = self.frames.values[0][self.known()].transpose(2, 0, 1)
        cosine, sine = np.cos(angle)[:, links], np.sin(angle)[:, links]
        across = x[:, links] + cosine * px - sine * py
        up = y[:, links] + sine * px + cosine * py
        lows, highs = ([f(across), f(up)] for f in (np.min, np.max))
        return np.array(lows), np.array(highs)

    def row(self) -> int:
        """Return the row next to where the page begins."""
        q = self.turn.coordinates()
        return int(np.argmin(np.where(self.known(), np.abs(q - self.turn.at), np.inf)))

    def known(self) -> Any:
        """Whether there is a position at each row."""
        return self.frames.is_known


def played_of(turn: Turn) -> Played:
    """Return a mechanism with its scene over the turn that is played."""
    mechanism = turn.mechanism
    known = turn.frames.is_known
    values = (turn.frames.values[0][known],)
    scene = scene_of(mechanism, Frames(turn.frames.links, values, turn.frames.local))
    return Played(mechanism, turn, scene)


def payload(
    played: Played,
    title: str,
    speed: float | None = None,
    joint: Any = None,
    diagrams: Any = None,
    encode: Callable[[Float], Any] | None = None,
) -> dict[str, Any]:
    """Return the page's data, ready for `json.dumps`.

    `encode` makes JSON of the array of positions; by default it becomes base64 of Float32.
    """
    mechanism, scene, turn = played.mechanism, played.scene, played.turn
    links = ["ground", *(link for link in scene.links if link != "ground")]
    index = {link: i for i, link in enumerate(links)}
    low, high = played.bounds()
    groups = mechanism.structure.groups
    return {
        "title": title,
        "formula": mechanism.structure.formula.split(ARROW),
        "driver": _driver(mechanism),
        "links": links,
        "driven": [index[link] for link in links if link in scene.driven],
        "groups": [scene.groups.get(link, -1) for link in links],
        "classes": [ROMAN[g.cls] if g.cls < len(ROMAN) else str(g.cls) for g in groups],
        "joints": list(_joints(played, index)),
        "slides": list(_slides(played, index)),
        "parts": [_part(part, index) for part in scene.parts],
        "bounds": _short([*low, *high]),
        "usual": _short([usual_link(turn.frames)])[0],
        "speed": speed if speed is not None else _usual_speed(turn),
        "paths": checked_joints(mechanism, joint),
        "diagrams": checked_diagrams(mechanism, diagrams),
        "turn": {
            "grid": turn.grid,
            "closes": turn.closes,
            "unit": turn.unit,
            "at": turn.at,
            "dead": [{"q": q, "group": group} for q, group in turn.dead_points],
            "orders": len(turn.frames.values),
            "rows": len(turn.frames.values[0]),
            "ground": _ground(turn.frames),
            "values": (encode or _base64)(link_values(turn.frames, links[1:])),
        },
    }


def link_values(frames: Frames, moving: list[str]) -> Float:
    """Return [order][row][link][x, y, angle] of all links but the ground."""
    columns = [frames.links.index(link) for link in moving]
    return np.stack([values[:, columns] for values in frames.values])


def _base64(array: Float) -> str:
    greatest = float(np.abs(array).max(initial=0.0, where=np.isfinite(array)))
    if greatest > GREATEST_NUMBER:
        message = f"the page would have the number {greatest:.3g}: up to {GREATEST_NUMBER:.3g} fit"
        raise InputError(message, value=greatest)
    return base64.b64encode(array.astype("<f4").tobytes()).decode("ascii")


def _ground(frames: Frames) -> list[float]:
    """Return the frame of the ground, which may lie at its first joint."""
    row = int(np.flatnonzero(frames.is_known)[0])
    return _short(frames.values[0][row, frames.links.index("ground")])


def _driver(mechanism: Mechanism) -> str:
    drivers = mechanism.description.drivers
    return ", ".join(d if isinstance(d, str) else f"{d.link} − {d.relative_to}" for d in drivers)


def _usual_speed(turn: Turn) -> float:
    if turn.unit == "angle":
        return round(2.0 * np.pi / SECONDS, 2)
    if turn.unit == "time":
        return 1.0
    q = turn.grid.get("q")
    stroke = q[-1] - q[0] if q else 2.0 * turn.grid.get("half", 0.5)
    return float(f"{2.0 * stroke / SECONDS:.2g}")


def _joints(played: Played, index: dict[str, int]) -> Iterable[dict[str, Any]]:
    local = played.frames.local
    for name in played.scene.names:
        yield {
            "name": name.text,
            "link": index[name.link],
            "links": [index[link] for link, on in local.items() if name.text in on],
            "at": _short(name.at[:2]),
            "radius": name.radius,
        }


def _slides(played: Played, index: dict[str, int]) -> Iterable[dict[str, Any]]:
    """Slides as projections: of a point of the sliding link on a direction of the other."""
    mechanism, frames = played.mechanism, played.frames
    for name, slide in mechanism.slides.items():
        block = next(iter(frames.local[slide.link].values()), np.zeros(2))
        origin = np.zeros(2)
        angle = float(mechanism.dimensions.get(f"{name}.angle", 0.0))
        origin_joint = slide.origin
        if origin_joint is not None:
            origin = frames.local[slide.on][origin_joint]
            offset = 0.0
        else:
            # Zero is the drawing's place.
            offset = _drawn_value(played, name, block, angle)
        yield {
            "name": name,
            "link": index[slide.link],
            "on": index[slide.on],
            "at": _short(block),
            "origin": _short(origin),
            "angle": angle,
            "offset": float(f"{offset:.9g}"),
        }


def _drawn_value(played: Played, name: str, block: Float, angle: float) -> float:
    """Return what the projection gives where the slide's value is zero."""
    mechanism = played.mechanism
    motion = mechanism.solve(mechanism.q0_array, order=0)
    slide = mechanism.slides[name]
    places = []
    for link in (slide.link, slide.on):
        place = motion.reference_points[link].value.reshape(2)
        places.append((place, float(motion.link(link).value)))
    (at, turned), (base, guide) = places
    cosine, sine = np.cos(turned), np.sin(turned)
    arm = np.array([cosine * block[0] - sine * block[1], sine * block[0] + cosine * block[1]])
    along = (np.cos(guide + angle), np.sin(guide + angle))
    return float((at + arm - base) @ along) - float(motion.slide(name).value)


def _part(part: Part, index: dict[str, int]) -> dict[str, Any]:
    entry: dict[str, Any] = {"link": index[part.link], "name": part.name}
    if part.colour != "link":
        entry["colour"] = part.colour
    if isinstance(part, Disc):
        return {**entry, "disc": part.radius, "at": _flat([part.centre]), "width": part.width,
                "fill": part.fill}  # fmt: skip
    if isinstance(part, Hatching):
        return {**entry, "hatching": part.spacing, "at": _flat([part.start, part.end])}
    return {**entry, **_stroke(part)}


def _stroke(part: Stroke) -> dict[str, Any]:
    entry: dict[str, Any] = {"at": _flat(part.vertices), "width": part.width}
    for key in ("closed", "fill", "hatched", "dashes", "floor"):
        if value := getattr(part, key):
            entry[key] = value
    return entry


def _flat(vertices: Iterable[Vertex]) -> list[float]:
    """Return x, y, dx, dy of each vertex."""
    return _short([number for vertex in vertices for number in vertex])


def _short(numbers: Iterable[float]) -> list[float]:
    """Return numbers to the seven digits of Float32."""
    return [int(x) if x == int(x) else x for x in (float(f"{number:.7g}") for number in numbers)]
