"""Write addresses of PMKS+, for tests."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

LETTERS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
FLAGS = ("slides", "input", "frame", "weld", "path", "sealed")


@dataclass(frozen=True)
class Joint:
    """A record of a joint."""

    id: str
    at: tuple[float, float]
    flags: str = ""
    angle: float = 0.0
    slot: tuple[str, ...] = ()
    speed: float = 0.0

    def __str__(self) -> str:
        flags = sum(1 << FLAGS.index(flag) for flag in self.flags.split())
        words = [
            LETTERS[flags] + self.id,
            f"{self.id}'s",
            *map(thousandths, (*self.at, self.angle)),
        ]
        if self.slot or self.speed:
            words += self.slot or ("", "", "")
        if self.speed:
            words.append(thousandths(self.speed))
        return ",".join(words)


@dataclass(frozen=True)
class Link:
    """A record of a link."""

    id: str
    joints: str | tuple[str, ...]
    root: bool = True
    parts: tuple[str, ...] = ()
    kind: str = "R"

    def __str__(self) -> str:
        numbers = [thousandths(number) for number in (1.0, 2.5, -0.5, 0.0)]
        words = ["NY"[self.root] + self.kind + self.id, self.id, *numbers, "c5cae9"]
        return ",".join([*words, *self.joints, "", *self.parts])


def Block(id: str, joints: str | tuple[str, ...]) -> Link:  # noqa: A002
    """A record of a block."""
    return Link(id, joints, kind="P")


Records: TypeAlias = "list[Joint] | list[Link] | tuple[str, ...]"


def base64(number: int) -> str:
    """A whole number in base 64, with 0 before it for minus."""
    digits = ""
    rest = abs(number)
    while rest or not digits:
        rest, digit = divmod(rest, 64)
        digits = LETTERS[digit] + digits
    return f"0{digits}" if number < 0 else digits


def thousandths(number: float) -> str:
    """A number of three decimals."""
    return base64(round(number * 1000))


def checked(text: str) -> str:
    """A text with the letter that checks its length."""
    return text + LETTERS[len(text) % 62]


def written(
    joints: list[Joint],
    links: list[Link],
    rpm: int = 10,
    clockwise: bool = False,
    linear: float = 0.0,
    unit: str = "1",
    forces: tuple[str, ...] = (),
) -> str:
    """A linkage as the program writes it."""
    flags = base64(8 + clockwise)
    decimals = "Fe" + (f",{thousandths(linear)}" if linear else "")
    parts = [flags, decimals, f"{base64(rpm)},0", f"{unit}111"]
    parts += [*map(str, joints), "", *map(str, links), "", *("0" + force for force in forces)]
    return checked(".".join([*parts, "", "N_"]))
