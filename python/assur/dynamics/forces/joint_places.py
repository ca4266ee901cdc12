"""Where joints and centres of mass are: in the frames of links, as complex numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from assur.dynamics.loads.loads import Body
    from assur.kinematics.mechanism import Mechanism


def joint_place(mechanism: Mechanism, link: str, joint: str) -> complex:
    """Return a joint in its link's frame, of one design: x + iy, m.

    Origin at the link's first joint, x toward its second; the ground has the drawing's frame.
    """
    joints, dimensions = mechanism.links[link], mechanism.dimensions
    if link != "ground":
        if joint == joints[0]:
            return 0j
        if joint == joints[1]:
            return complex(dimensions[f"{link}.length"])
    return complex(dimensions[f"{link}.{joint}.x"], dimensions[f"{link}.{joint}.y"])


def mass_centre(mechanism: Mechanism, link: str, body: Body) -> complex:
    """Return the centre of mass of a body in its link's frame, of one design."""
    if body.at is None:
        joints = mechanism.links[link]
        return joint_place(mechanism, link, joints[0]) if joints else 0j
    return joint_place(mechanism, link, body.at) if isinstance(body.at, str) else complex(*body.at)


def links_at(mechanism: Mechanism) -> dict[str, list[str]]:
    """Return the links of every joint, in the order of the description."""
    return {
        joint: [link for link, joints in mechanism.links.items() if joint in joints]
        for joint in mechanism.joint_names
    }
