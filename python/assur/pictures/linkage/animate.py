"""Moving pictures: see `Motion.animate`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.animation import FFMpegWriter

from assur._files import checked_path, writing
from assur._validate import checked_names, real_number, whole_number
from assur.errors import InputError
from assur.pictures.linkage.film import Film
from assur.pictures.style import style_of

if TYPE_CHECKING:
    from collections.abc import Sequence
    from os import PathLike
    from pathlib import Path

    from assur._faces import Motion


SUFFIXES = (".gif", ".webp", ".mp4")
# A thousand frames of the usual size take 1 GiB.
MOST_FRAMES = 1000
# Length of a film, s; GIF counts hundredths of a second in 16 bits for each frame.
LONGEST = 600.0
# Steps from the ground to each colour of a GIF, for the edges of lines.
SHADES = 18


def animate(
    motion: Motion,
    path: str | PathLike[str],
    joint: str | Sequence[str] | None,
    frames: int,
    seconds: float,
    groups: bool,
    dark: bool,
) -> None:
    """See `Motion.animate`."""
    out = checked_path(path, SUFFIXES)
    if motion.mechanism.shape or len(motion.shape) != 1:
        message = f"animate shows one mechanism over q; this motion has shape {motion.shape}"
        raise InputError(message)
    count = whole_number(frames, "frames", 2, MOST_FRAMES)
    duration = real_number(seconds, "seconds")
    if not 0.0 < duration <= LONGEST:
        message = f"seconds is {seconds}: a time from 0 to {LONGEST:g} is needed"
        raise InputError(message)

    joints = checked_names(joint, "joint")
    film = Film(motion, joints, groups, style_of(dark))
    try:
        rows = _rows(film, count)
        with writing(out):
            if out.suffix.lower() == ".mp4":
                _write_mp4(out, film, rows, duration)
            else:
                _write_image(out, film, rows, duration)
    finally:
        film.close()


def _rows(film: Film, count: int) -> list[int]:
    """Return the positions to show in turn: round and round, or to and fro."""
    known = film.rows
    if known.size < 2:
        message = f"this motion has {known.size} position: nothing moves"
        raise InputError(message)
    closes = film.closes
    if closes:
        known = known[:-1]
    # To and fro all but both ends come twice.
    most = count if closes else count // 2 + 1
    if known.size > most:
        known = known[
            np.linspace(0, known.size - (not closes), most, endpoint=not closes).astype(int)
        ]
    rows: list[int] = known.tolist()
    return rows if closes else [*rows, *rows[-2:0:-1]]


def _write_image(out: Path, film: Film, rows: list[int], seconds: float) -> None:
    """Write an animated GIF or WebP with Pillow, which matplotlib brings."""
    from PIL import Image, features

    if out.suffix.lower() == ".webp" and not features.check("webp"):
        message = f"{out}: this Pillow writes no WebP; write .gif"
        raise InputError(message)
    images = [Image.fromarray(film.show(row)[..., :3]) for row in rows]
    options: dict[str, Any] = {"loop": 0, "duration": round(1e3 * seconds / len(rows))}
    if out.suffix.lower() == ".gif":
        palette = Image.new("P", (1, 1))
        palette.putpalette(_palette(film.colours))
        images = [
            _with_canvas(image.quantize(palette=palette, dither=Image.Dither.NONE), film.colours[0])
            for image in images
        ]
        options["optimize"] = False
    images[0].save(out, save_all=True, append_images=images[1:], **options)


def _palette(colours: list[tuple[int, ...]]) -> list[int]:
    """Return the ground, which is the first colour, and its mixtures with every other one."""
    ground, *hues = (np.array(colour) for colour in colours)
    steps = np.linspace(1.0, 0.0, SHADES, endpoint=False)[:, None]
    mixed = [ground[None], *(ground + steps * (hue - ground) for hue in hues)]
    entries: list[int] = np.rint(np.concatenate(mixed)).astype(int).reshape(-1).tolist()
    return entries[: 3 * 256]


def _with_canvas(image: Any, colour: tuple[int, ...]) -> Any:
    """Return an image whose corner, which is empty, has a colour exactly: quantising shifts it."""
    palette = image.getpalette()
    corner = 3 * image.getpixel((0, 0))
    palette[corner : corner + 3] = colour
    image.putpalette(palette)
    return image


def _write_mp4(out: Path, film: Film, rows: list[int], seconds: float) -> None:
    """Write a film with ffmpeg, where there is one."""
    if not FFMpegWriter.isAvailable():
        message = f"{out}: an MP4 needs the program ffmpeg, which is not found; write .gif"
        raise InputError(message)
    writer = FFMpegWriter(fps=max(1, round(len(rows) / seconds)))
    with writer.saving(film.figure, str(out), film.figure.dpi):
        for row in rows:
            film.show(row)
            writer.grab_frame(facecolor=film.figure.get_facecolor())
