"""The four-bar and the slider-crank in a description with any names."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from assur.description.words import Drive
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism

GROUND = "ground"


class FourBarChain(NamedTuple):
    """Links and joints of a four-bar: crank A-B, coupler B-C, rocker D-C."""

    crank: str
    coupler: str
    rocker: str
    A: str
    B: str
    C: str
    D: str


class SliderCrankChain(NamedTuple):
    """Links and joints of a slider-crank: crank O-A, rod A-B, piston at B."""

    crank: str
    rod: str
    piston: str
    O: str  # noqa: E741 - its usual name
    A: str
    B: str


def find_four_bar(mechanism: Mechanism) -> FourBarChain:
    """Return the four-bar that a mechanism is; the driven link counts as the crank."""
    moving, pins = _moving(mechanism), _pins(mechanism, "four-bar")
    if len(moving) != 3 or mechanism.slides or len(pins) != 4:
        raise _refusal(mechanism, "four-bar", "3 moving links, 4 pins and no slides")
    pivoted = [link for link in moving if frozenset((GROUND, link)) in pins]
    if len(pivoted) != 2:
        raise _refusal(mechanism, "four-bar", "2 links pivoted on the ground")
    coupler = next(link for link in moving if link not in pivoted)
    drivers = mechanism.description.drivers
    driven = {driver.link if isinstance(driver, Drive) else driver for driver in drivers}
    crank, rocker = sorted(pivoted, key=lambda link: link not in driven)
    around = ((GROUND, crank), (crank, coupler), (coupler, rocker), (rocker, GROUND))
    if not all(frozenset(pair) in pins for pair in around):
        raise _refusal(mechanism, "four-bar", "a ring of 4 links")
    return FourBarChain(crank, coupler, rocker, *(pins[frozenset(pair)] for pair in around))


def find_slider_crank(mechanism: Mechanism) -> SliderCrankChain:
    """Return the slider-crank that a mechanism is."""
    moving, pins = _moving(mechanism), _pins(mechanism, "slider-crank")
    slides = list(mechanism.slides.values())
    sliding = [{slide.link, slide.on} - {GROUND} for slide in slides]
    if len(moving) != 3 or len(pins) != 3 or len(sliding) != 1 or len(sliding[0]) != 1:
        needed = "3 moving links, 3 pins and a slide on the ground"
        raise _refusal(mechanism, "slider-crank", needed)
    (piston,) = sliding[0]
    cranks = [link for link in moving if frozenset((GROUND, link)) in pins and link != piston]
    rods = [link for link in moving if link not in cranks and link != piston]
    if len(cranks) != 1 or len(rods) != 1:
        raise _refusal(mechanism, "slider-crank", "a crank, a rod and a piston")
    around = ((GROUND, cranks[0]), (cranks[0], rods[0]), (rods[0], piston))
    if not all(frozenset(pair) in pins for pair in around):
        raise _refusal(mechanism, "slider-crank", "a rod between crank and piston")
    return SliderCrankChain(cranks[0], rods[0], piston, *(pins[frozenset(pair)] for pair in around))


def _moving(mechanism: Mechanism) -> list[str]:
    return [link for link in mechanism.links if link != GROUND]


def _pins(mechanism: Mechanism, kind: str) -> dict[frozenset[str], str]:
    """Return the joint of every two links that share one; points of one link are not pins."""
    pins: dict[frozenset[str], str] = {}
    for joint in mechanism.joint_names:
        links = [link for link, joints in mechanism.links.items() if joint in joints]
        if len(links) > 2:
            message = (
                f"not a {kind}: joint {joint!r} has {len(links)} links, {', '.join(links)} "
                "(assur.balance.fit takes any linkage)"
            )
            raise InputError(message, joint=joint)
        if len(links) == 2:
            pins[frozenset(links)] = joint
    return pins


def _refusal(mechanism: Mechanism, kind: str, needed: str) -> InputError:
    links, slides = _moving(mechanism), list(mechanism.slides)
    has = f"links {', '.join(links)}; slides {', '.join(slides) or 'none'}"
    message = (
        f"not a {kind}, which has {needed}: this mechanism has the {has} "
        "(assur.balance.fit takes any linkage)"
    )
    return InputError(message)
