"""Steps from a file's links to those of one mechanism: weld, merge, fix, leave out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.importers.names import listed
from assur.importers.sketch import GROUND

if TYPE_CHECKING:
    from assur.importers.sketch import Input, Sketch
    from assur.importers.source import Source


def tidy(source: Source, sketch: Sketch) -> None:
    """Make the sketch one connected mechanism; say what this changes."""
    _weld(sketch)
    _fix(source, sketch)
    for driven in sketch.inputs:
        _resolve(source, sketch, driven)
    _merge_joints(sketch)
    _fix(source, sketch)
    _leave_out_unconnected(sketch)
    while _leave_out_hanging(sketch):
        pass
    _leave_out_unused(sketch)


def _weld(sketch: Sketch) -> None:
    names = {link: link for link in sketch.links}
    for joint, welded in sketch.welds:
        links = list(dict.fromkeys(names[link] for link in welded))
        if len(links) < 2:
            continue
        kept = GROUND if GROUND in links else links[0]
        for link in links:
            if link != kept:
                sketch.rename_link(link, kept)
                names = {old: kept if new == link else new for old, new in names.items()}
        at = f" at {joint}" if joint else ""
        sketch.omitted.append(f"Links {listed(links)} are welded{at}: they are one link, {kept}.")


def _resolve(source: Source, sketch: Sketch, driven: Input) -> None:
    """Find which link an input turns, and against which."""
    joint = driven.joint
    if joint is None:
        return
    links = sketch.links_at(joint)
    if driven.base is None:
        candidates = [link for link in links if link != driven.link]
        driven.base = GROUND if GROUND in candidates else next(iter(candidates), None)
    if driven.link is None:
        candidates = [link for link in links if link != driven.base]
        if len(candidates) > 1:
            # Links of one joint only mark it.
            candidates = [link for link in candidates if len(sketch.links[link]) > 1] or candidates
        if len(candidates) > 1:
            problem = (
                f"input joint {joint!r} has several links, {listed(candidates)}: "
                "the file does not say which of them it turns"
            )
            raise source.error(driven.place, problem, joint=joint)
        driven.link = next(iter(candidates), None)
    if driven.link is None or driven.base is None or driven.link == driven.base:
        problem = f"input joint {joint!r} joins no two links: it turns nothing"
        raise source.error(driven.place, problem, joint=joint)


def _merge_joints(sketch: Sketch) -> None:
    """Merge joints of one link at one place."""
    for link in list(sketch.links):
        first: dict[tuple[float, float], str] = {}
        for joint in list(sketch.links[link]):
            kept = first.setdefault(sketch.joints[joint], joint)
            if kept != joint:
                sketch.rename_joint(joint, kept)
                sketch.omitted.append(
                    f"Joints {kept} and {joint} are at one place of link {link}: "
                    f"they are one joint, {kept}."
                )


def _fix(source: Source, sketch: Sketch) -> None:
    """A link with two joints on the frame is part of it."""
    while True:
        frame = set(sketch.links[GROUND])
        fixed = [
            link
            for link, members in sketch.links.items()
            if link != GROUND
            and len({sketch.joints[joint] for joint in frame.intersection(members)}) > 1
        ]
        for link in fixed:
            for driven in sketch.inputs:
                if driven.link == link:
                    problem = f"link {link!r} cannot turn: the frame has two of its joints"
                    raise source.error(driven.place, problem, link=link)
            sketch.rename_link(link, GROUND)
            sketch.omitted.append(f"Link {link} has two joints on the frame: it is part of it.")
        if not fixed:
            return


def _leave_out_unconnected(sketch: Sketch) -> None:
    """Leave out links that nothing connects with the frame: they decorate."""
    connected, joints = {GROUND}, set(sketch.links[GROUND])
    size = 0
    while size != len(connected) + len(joints):
        size = len(connected) + len(joints)
        for link, members in sketch.links.items():
            if link in connected or joints.intersection(members):
                connected.add(link)
                joints.update(members)
        for slot in sketch.slots.values():
            if slot.carrier in connected or slot.joint in joints:
                connected.add(slot.carrier)
                joints.add(slot.joint)
        for ends in sketch.cylinders.values():
            if joints.intersection(ends):
                joints.update(ends)
    loose = [link for link in sketch.links if link not in connected]
    _remove(sketch, loose, "not connected with the frame")


def _leave_out_hanging(sketch: Sketch) -> bool:
    """Leave out links of one joint that do not slide, and pins in slots that carry nothing."""
    sliding = {slot.carrier for slot in sketch.slots.values()}
    for slot in sketch.slots.values():
        sliding.update(() if slot.turns else slot.riders)
    hanging = [
        link
        for link, members in sketch.links.items()
        if link != GROUND and link not in sliding and len(members) < 2
    ]
    _remove(sketch, hanging, "held by a single joint")
    ends = {joint for pair in sketch.cylinders.values() for joint in pair}
    idle = [
        name
        for name, slot in sketch.slots.items()
        if slot.turns and not sketch.links_at(slot.joint) and slot.joint not in ends
    ]
    for name in idle:
        slot = sketch.slots.pop(name)
        sketch.omitted.append(f"Joint {slot.joint} slides and carries no link: left out.")
        _remove_inputs(sketch)
    return bool(hanging or idle)


def _leave_out_unused(sketch: Sketch) -> None:
    used = {joint for members in sketch.links.values() for joint in members}
    used.update(slot.joint for slot in sketch.slots.values())
    used.update(joint for ends in sketch.cylinders.values() for joint in ends)
    unused = [joint for joint in sketch.joints if joint not in used]
    for joint in unused:
        del sketch.joints[joint]
    if unused:
        them = "Joint {} is" if len(unused) == 1 else "Joints {} are"
        sketch.omitted.append(f"{them.format(listed(unused))} on no link: left out.")


def _remove(sketch: Sketch, links: list[str], why: str) -> None:
    if not links:
        return
    for link in links:
        del sketch.links[link]
    for name, slot in list(sketch.slots.items()):
        slot.riders = [rider for rider in slot.riders if rider in sketch.links]
        if slot.carrier not in sketch.links or not (slot.turns or slot.riders):
            del sketch.slots[name]
    held = {joint for members in sketch.links.values() for joint in members}
    held.update(slot.joint for slot in sketch.slots.values())
    for name, (base, end) in list(sketch.cylinders.items()):
        if base not in held and end not in held:
            del sketch.cylinders[name]
    them = "Link {} is" if len(links) == 1 else "Links {} are"
    sketch.omitted.append(f"{them.format(listed(links))} {why}: left out.")
    _remove_inputs(sketch)


def _remove_inputs(sketch: Sketch) -> None:
    """Remove the inputs of omitted parts."""
    for driven in list(sketch.inputs):
        slides = driven.slide in sketch.slots or driven.slide in sketch.cylinders
        turns = driven.link in sketch.links and driven.base in sketch.links
        if not (turns if driven.slide is None else slides):
            sketch.inputs.remove(driven)
            what = driven.joint or driven.slide
            sketch.omitted.append(f"The input at {what} drives only what is left out.")
