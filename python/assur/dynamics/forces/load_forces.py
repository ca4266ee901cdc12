"""What each load does to each link of a machine over a motion, by the core."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur.dynamics.forces.reaction_key import Key
from assur.dynamics.loads.loads import Gravity

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.dynamics.forces._reactions import Reactions


class LoadForce(NamedTuple):
    """The force of a load at a point of a link, or its couple on the link; NaN without position.

    Attributes
    ----------
    load : int
        Index into the machine's loads.
    link : str
        The link on which it acts.
    joint : str or None
        The joint of the link where it acts, if it acts at one.
    place : ndarray or None
        Where it acts, m, in the drawing's axes, (..., 2); None of a couple.
    force : ndarray
        (..., 2), N.
    couple : ndarray
        (...), N·m.
    """

    load: int
    link: str
    joint: str | None
    place: Float | None
    force: Float
    couple: Float

    def at(self, index: tuple[int, ...]) -> LoadForce:
        """Return the same at one position, as a row of one."""
        place = None if self.place is None else self.place[index][np.newaxis]
        force, couple = self.force[index][np.newaxis], self.couple[index][np.newaxis]
        return self._replace(place=place, force=force, couple=couple)


def loads_of(solved: Reactions) -> list[LoadForce]:
    """Return what the loads do to links at the positions of reactions, weight aside.

    Where a motion stays at rest, loads of one sense only do not act.
    """
    assert solved._source is not None
    machine, again = solved._source
    # The core counts the loads without gravity, which acts on bodies.
    counted = [index for index, load in enumerate(machine.loads) if not isinstance(load, Gravity)]
    actions = machine.core.load_actions
    keys = [
        Key(kind, index)
        for index, (*_, is_couple) in enumerate(actions)
        for kind in (("load couple",) if is_couple else ("load force", "load place"))
    ]
    if not keys:
        return []
    values, rests = again(keys, 0).by_key, np.asarray(solved.at_rest)
    all_forces = []
    for index, (load, link, joint, is_couple) in enumerate(actions):
        strength = values[Key("load couple" if is_couple else "load force", index)]
        if getattr(machine.loads[counted[load]], "while_", None) is not None:
            strength = np.where(rests if is_couple else rests[..., np.newaxis], 0.0, strength)
        place = None if is_couple else values[Key("load place", index)]
        couple = strength if is_couple else np.zeros(strength.shape[:-1])
        force = np.zeros((*strength.shape, 2)) if is_couple else strength
        all_forces.append(LoadForce(counted[load], link, joint, place, force, couple))
    return all_forces
